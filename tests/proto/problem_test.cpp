#include "proto/problem.h"

#include <gtest/gtest.h>

#include <new>
#include <set>
#include <stdexcept>

namespace coppice {
namespace {

TEST(Problem, is_printed_in_the_members_of_rfc_9457) {
    const Problem problem = {.code = ErrorCode::option_invalid,
                             .detail = "ratio is 1.5; it takes a number over 0 and at most 1",
                             .where = "ratio"};

    EXPECT_EQ(print_problem(problem),
              R"({"type":"urn:coppice:problem:option.invalid",)"
              R"("title":"An option has a value that it does not take","status":400,)"
              R"("detail":"ratio is 1.5; it takes a number over 0 and at most 1","code":"option.invalid",)"
              R"("where":"ratio"})");
}

TEST(Problem, leaves_out_where_when_the_detail_says_it_all) {
    EXPECT_EQ(
        print_problem({.code = ErrorCode::queue_full, .detail = "try again", .where = ""}).find("where"),
        std::string::npos);
}

TEST(Problem, reads_back_what_it_printed) {
    for (size_t i = 0; i < static_cast<size_t>(ErrorCode::count_); ++i) {
        const Problem problem = {
            .code = static_cast<ErrorCode>(i), .detail = "a \"detail\"", .where = "/nodes/3"};
        const Problem read = parse_problem(print_problem(problem));
        EXPECT_EQ(read.code, problem.code);
        EXPECT_EQ(read.detail, problem.detail);
        EXPECT_EQ(read.where, problem.where);
    }
}

TEST(Problem, has_an_error_status_and_a_title_for_every_code) {
    std::set<std::string_view> titles;
    for (size_t i = 0; i < static_cast<size_t>(ErrorCode::count_); ++i) {
        const auto code = static_cast<ErrorCode>(i);
        EXPECT_GE(http_status(code), 400) << name(code);
        EXPECT_LE(http_status(code), 599) << name(code);
        EXPECT_TRUE(titles.insert(title(code)).second) << name(code) << " shares its title with another code";
    }
}

TEST(Problem, tells_apart_bytes_of_the_body_formats_and_what_the_asset_holds) {
    EXPECT_EQ(http_status(ErrorCode::request_too_large), 413);
    EXPECT_EQ(http_status(ErrorCode::asset_unsupported), 415);
    EXPECT_EQ(http_status(ErrorCode::asset_malformed), 422);
}

TEST(Problem, shows_an_error_as_it_is) {
    const Problem problem =
        to_problem(Error(ErrorCode::asset_malformed, "/accessors/7", "accessor 7 is too long"), "id");
    EXPECT_EQ(problem.code, ErrorCode::asset_malformed);
    EXPECT_EQ(problem.where, "/accessors/7");
    EXPECT_EQ(problem.detail, "accessor 7 is too long");
}

TEST(Problem, says_that_the_asset_is_too_large_when_memory_runs_out) {
    EXPECT_EQ(to_problem(std::bad_alloc(), "id").code, ErrorCode::asset_too_large);
}

TEST(Problem, keeps_what_other_exceptions_say_for_the_log) {
    const Problem problem = to_problem(std::runtime_error("password=hunter2"), "4711");
    EXPECT_EQ(problem.code, ErrorCode::internal);
    EXPECT_EQ(problem.detail.find("hunter2"), std::string::npos);
    EXPECT_NE(problem.detail.find("4711"), std::string::npos);
}

TEST(Problem, replaces_bytes_that_are_not_utf_8) {
    const std::string text =
        print_problem({.code = ErrorCode::resource_missing, .detail = "no \xff.png", .where = ""});
    EXPECT_NE(text.find("no \xEF\xBF\xBD.png"), std::string::npos);
}

}  // namespace
}  // namespace coppice
