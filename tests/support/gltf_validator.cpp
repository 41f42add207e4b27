#include "tests/support/gltf_validator.h"

#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "core/format/archive.h"
#include "tests/support/test_assets.h"

namespace coppice::test {
namespace {

namespace fs = std::filesystem;

void write_file(const fs::path& path, ByteView bytes) {
    fs::create_directories(path.parent_path());
    std::ofstream stream(path, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!stream.flush()) throw std::runtime_error("cannot write " + path.string());
}

// Unpacks into the folder and returns the .gltf.
fs::path unpack(const fs::path& folder, ByteView zip) {
    fs::path gltf;
    for (const NamedFile& file : read_zip(zip, {}, {})) {
        write_file(folder / file.path, file.bytes);
        if (fs::path(file.path).extension() == ".gltf") gltf = folder / file.path;
    }
    if (gltf.empty()) throw std::runtime_error("no .gltf in the zip for " + folder.string());
    return gltf;
}

struct Run {
    int exit_code = -1;
    std::string output;
};

Run run(const std::string& command) {
    Run result;
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    if (pipe == nullptr) return result;
    std::array<char, 4096> buffer{};
    for (size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
        result.output.append(buffer.data(), n);
    const int status = pclose(pipe);
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return result;
}

}  // namespace

ValidatorBatch::ValidatorBatch() {
    std::string pattern = (fs::temp_directory_path() / "coppice-validator-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make a folder like " + pattern);
    folder_ = pattern;
}

ValidatorBatch::~ValidatorBatch() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

void ValidatorBatch::add(std::string_view name, const WrittenAsset& asset) {
    // Names carry no quote, so that they can go to the shell in quotes.
    const std::string plain = fmt::format("{:03}_{}", files_.size(), test_name(name));
    if (asset.file_extension == "zip") {
        files_.push_back(unpack(folder_ / plain, asset.bytes));
        return;
    }
    files_.push_back(folder_ / (plain + "." + asset.file_extension));
    write_file(files_.back(), asset.bytes);
}

::testing::AssertionResult ValidatorBatch::has_no_errors() const {
    if (files_.empty()) return ::testing::AssertionFailure() << "nothing to validate";
    std::string command = fmt::format("node '{}'", (source_root() / "tests/node/validate_gltf.js").string());
    for (const fs::path& file : files_) command += fmt::format(" '{}'", file.string());
    const Run validation = run(command);

    std::istringstream lines(validation.output);
    std::string line;
    std::string faults;
    size_t passed = 0;
    while (std::getline(lines, line)) {
        if (line.find(": 0 errors, ") != std::string::npos)
            ++passed;
        else
            faults += line + '\n';
    }
    if (validation.exit_code == 0 && passed == files_.size()) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure()
           << passed << " of " << files_.size() << " files passed, the validator exited with "
           << validation.exit_code << " (2: run script/bootstrap, which installs it)\n"
           << faults;
}

}  // namespace coppice::test
