// Every file of the assets' invalid/ folder, against the table of what becomes of it.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "core/base/error.h"
#include "core/optimize/optimize.h"
#include "tests/support/gltf_validator.h"
#include "tests/support/test_assets.h"

namespace coppice::test {
namespace {

namespace fs = std::filesystem;

// A row of tests/assets/invalid_files.tsv, without the file's name.
struct Outcome {
    std::string kind;   // "problem", "repaired" (some warning is a repair) or "result"
    std::string codes;  // the problem's code, or the warnings' codes, sorted, joined by commas; "-": none

    friend bool operator==(const Outcome&, const Outcome&) = default;
};

using Table = std::map<std::string, Outcome>;

fs::path table_path() {
    return source_root() / "tests/assets/invalid_files.tsv";
}

Table read_table() {
    Table table;
    std::ifstream file(table_path());
    std::string line;
    while (std::getline(file, line)) {
        if (line.empty() || line.front() == '#') continue;
        std::istringstream cells(line);
        std::string name;
        Outcome outcome;
        std::getline(cells, name, '\t');
        std::getline(cells, outcome.kind, '\t');
        std::getline(cells, outcome.codes, '\t');
        EXPECT_TRUE(table.emplace(name, outcome).second) << name << " has two rows";
    }
    return table;
}

// Everything but companions: buffers, images and materials that assets refer to, and the validator's reports.
std::vector<std::string> invalid_assets() {
    std::vector<std::string> files;
    const fs::path root = *asset_folder() / "invalid";
    const std::set<std::string> companions = {".bin", ".png", ".jpg", ".ktx2", ".dds", ".mtl", ".json"};
    for (const auto& entry : fs::recursive_directory_iterator(root))
        if (entry.is_regular_file() && !companions.contains(entry.path().extension().string()))
            files.push_back(fs::relative(entry.path(), root).generic_string());
    std::sort(files.begin(), files.end());
    return files;
}

std::string codes(const std::vector<Warning>& warnings) {
    std::set<std::string> sorted;
    for (const Warning& warning : warnings) sorted.insert(warning.code);
    std::string joined;
    for (const std::string& code : sorted) joined += (joined.empty() ? "" : ",") + code;
    return joined.empty() ? "-" : joined;
}

bool is_repair(const Warning& warning) {
    return warning.code.starts_with("repair.");
}

// A message names what is wrong: it is a sentence, and not the library's or the compiler's words for a
// failure.
void expect_useful(const Error& error) {
    EXPECT_GE(error.message().size(), 20U) << error.message();
    for (const std::string_view word :
         {"std::", "json.exception", "nlohmann", "vector::", "basic_string", "stoi"})
        EXPECT_EQ(error.message().find(word), std::string::npos) << error.message();
    EXPECT_NE(error.code(), ErrorCode::internal) << error.message();
}

Outcome optimize_file(const std::string& file, ValidatorBatch& results) {
    const UploadedAsset asset = load_asset("invalid/" + file);
    OptimizeOptions options;
    options.ratio = 0.5;
    options.format = Format::glb;
    try {
        const Optimized result = optimize(asset.upload(), options, {}, {});
        results.add(file, result.asset);
        const std::vector<Warning>& warnings = result.report.warnings;
        const bool repaired = std::any_of(warnings.begin(), warnings.end(), is_repair);
        return {repaired ? "repaired" : "result", codes(warnings)};
    } catch (const Error& error) {
        expect_useful(error);
        return {"problem", std::string(name(error.code()))};
    }
}

// The table as it would have to be, with each problem's words behind it; where it is written is told.
std::string write_actual(const Table& actual) {
    const fs::path path = fs::temp_directory_path() / "invalid_files.actual.tsv";
    std::ofstream file(path);
    for (const auto& [name, outcome] : actual)
        file << name << '\t' << outcome.kind << '\t' << outcome.codes << '\n';
    return path.string();
}

TEST(InvalidFiles, become_what_the_table_says) {
    if (!asset_folder()) GTEST_SKIP() << no_assets_message();
    const Table expected = read_table();
    Table actual;
    ValidatorBatch results;
    for (const std::string& file : invalid_assets()) {
        SCOPED_TRACE(file);
        actual[file] = optimize_file(file, results);  // one that hangs ends with the time limit of the test
    }

    std::string difference;
    for (const auto& [file, outcome] : actual) {
        const auto row = expected.find(file);
        if (row == expected.end())
            difference +=
                fmt::format("  {}: not in the table, became {} {}\n", file, outcome.kind, outcome.codes);
        else if (row->second != outcome)
            difference += fmt::format("  {}: became {} {}, the table says {} {}\n", file, outcome.kind,
                                      outcome.codes, row->second.kind, row->second.codes);
    }
    for (const auto& [file, outcome] : expected)
        if (!actual.contains(file))
            difference += fmt::format("  {}: in the table, but there is no such file\n", file);
    EXPECT_EQ(difference, "") << "the table as it would have to be is in " << write_actual(actual);

    EXPECT_TRUE(results.has_no_errors());
}

// Asserted apart from the table, so that a row cannot excuse what the validator calls an error.
TEST(InvalidFiles, that_the_validator_calls_errors_are_refused_or_repaired) {
    if (!asset_folder()) GTEST_SKIP() << no_assets_message();
    ValidatorBatch results;
    size_t checked = 0;
    for (const std::string& file : invalid_assets()) {
        const fs::path report = *asset_folder() / "invalid" / (file + ".report.json");
        if (!fs::exists(report)) continue;
        const auto issues = nlohmann::json::parse(as_text(read_file(report))).at("issues");
        if (issues.at("numErrors").get<int>() == 0) continue;
        ++checked;
        const Outcome outcome = optimize_file(file, results);
        EXPECT_TRUE(outcome.kind == "problem" || outcome.kind == "repaired")
            << file << " became a " << outcome.kind << " (" << outcome.codes << "), the validator says "
            << issues.at("messages").front().dump();
    }
    EXPECT_GE(checked, 160U);
}

// What is wrong with a file as a whole has no place in it.
bool speaks_of_the_whole(const std::string& message) {
    for (const std::string_view whole : {"the content is ", "the asset ", "the document ", "the OBJ has no ",
                                         "the PLY has no ", "the vertices of the PLY lack "})
        if (message.starts_with(whole)) return true;
    return false;
}

// For whoever reads the table: what each refusal says.
TEST(InvalidFiles, are_refused_with_a_place_or_a_message_that_needs_none) {
    if (!asset_folder()) GTEST_SKIP() << no_assets_message();
    for (const std::string& file : invalid_assets()) {
        const UploadedAsset asset = load_asset("invalid/" + file);
        try {
            read_asset(asset.upload(), {}, {});
        } catch (const Error& error) {
            if (std::getenv("COPPICE_TEST_VERBOSE") != nullptr)
                fmt::print("{}\t{}\t{}\t{}\n", file, name(error.code()), error.where(), error.message());
            EXPECT_TRUE(speaks_of_the_whole(error.message()) || !error.where().empty())
                << file << ": " << error.message();
        }
    }
}

}  // namespace
}  // namespace coppice::test
