#include "proto/openapi.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/format/format.h"
#include "proto/job.h"
#include "tests/proto/generated_schemas.h"

namespace coppice {
namespace {

constexpr std::string_view begin_marker =
    "    # begin generated from the code, by the test Openapi.has_what_the_code_generates\n";
constexpr std::string_view end_marker = "    # end generated\n";

std::string read_file(const std::string& path) {
    std::ifstream file(path);
    EXPECT_TRUE(file) << path;
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

nlohmann::json schema(const std::string& name) {
    return nlohmann::json::parse(openapi_json())["components"]["schemas"][name];
}

// To renew the part after a change of the code: COPPICE_RENEW_CONTRACT=1 script/test -R Openapi
TEST(Openapi, has_what_the_code_generates) {
    const std::string path = COPPICE_SOURCE_DIR "/proto/openapi.yaml";
    const std::string text = read_file(path);
    const size_t begin = text.find(begin_marker);
    const size_t end = text.find(end_marker);
    ASSERT_NE(begin, std::string::npos);
    ASSERT_NE(end, std::string::npos);
    const size_t first = begin + begin_marker.size();
    if (std::getenv("COPPICE_RENEW_CONTRACT") != nullptr) {
        std::ofstream(path) << text.substr(0, first) << generated_schemas() << text.substr(end);
        GTEST_SKIP() << "renewed " << path << "; build and test again";
    }
    EXPECT_EQ(text.substr(first, end - first), generated_schemas());
}

TEST(Openapi, is_of_the_version_that_is_built) {
    const auto document = nlohmann::json::parse(openapi_json());
    EXPECT_EQ(document["openapi"], "3.1.0");
    EXPECT_EQ(document["info"]["version"], COPPICE_VERSION);
}

TEST(Openapi, lists_the_statuses_and_kinds_of_jobs) {
    for (const std::string status : schema("JobStatus")["enum"]) {
        EXPECT_TRUE(job_status_from_name(status)) << status;
    }
    EXPECT_EQ(schema("JobStatus")["enum"].size(), 5U);
    EXPECT_EQ(schema("JobKind")["enum"],
              nlohmann::json({name(JobKind::optimize), name(JobKind::inspect), name(JobKind::compare)}));
}

TEST(Openapi, lists_the_formats_that_are_read_and_those_that_are_written) {
    for (const std::string format : schema("Format")["enum"]) EXPECT_TRUE(format_from_id(format)) << format;
    EXPECT_EQ(schema("Format")["enum"].size(), 6U);
    for (const std::string format : schema("Options")["properties"]["format"]["enum"]) {
        EXPECT_TRUE(is_writable(format_from_id(format).value())) << format;
    }
}

}  // namespace
}  // namespace coppice
