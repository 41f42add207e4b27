#include "proto/json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/error.h"

namespace coppice {
namespace {

// The error that parsing the text gives; fails the test when it gives none.
Error refusal(std::string_view text, const JsonLimits& limits = {}) {
    try {
        parse_json(text, limits, "options");
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << text << " was taken";
    return {ErrorCode::internal, "", ""};
}

TEST(Json, takes_what_is_within_its_limits) {
    EXPECT_EQ(parse_json(R"({"a":{"b":[1,2]}})", {.bytes = 17, .depth = 3}, "options")["a"]["b"][1], 2);
}

TEST(Json, names_the_line_and_column_of_a_mistake) {
    const Error error = refusal("{\n  \"ratio\": 0,5}");
    EXPECT_EQ(error.code(), ErrorCode::request_malformed);
    EXPECT_EQ(error.where(), "line 2, column 14");
    EXPECT_TRUE(error.message().starts_with("options is not valid JSON")) << error.message();
}

TEST(Json, refuses_keys_that_are_given_twice_at_any_depth) {
    EXPECT_EQ(refusal(R"({"ratio":0.1,"ratio":0.9})").code(), ErrorCode::option_conflict);
    EXPECT_EQ(refusal(R"({"parameters":{"mode":"full","mode":"faithful"}})").where(), "mode");
    EXPECT_NO_THROW(parse_json(R"({"a":{"x":1},"b":{"x":1}})", {}, "options"));
}

TEST(Json, refuses_deep_nesting_before_it_costs_anything) {
    EXPECT_EQ(refusal(std::string(9, '[') + std::string(9, ']')).message(),
              "options is nested deeper than 8 levels");
    EXPECT_EQ(refusal(std::string(50'000, '[')).code(), ErrorCode::request_malformed);
}

TEST(Json, refuses_a_text_over_its_limit) {
    EXPECT_EQ(refusal("{\"a\":1}", {.bytes = 6}).message(), "options is 7 bytes long; it may be 6");
}

TEST(Json, refuses_numbers_that_no_double_holds_and_bytes_that_are_no_utf_8) {
    EXPECT_EQ(refusal("{\"ratio\":1e999}").code(), ErrorCode::request_malformed);
    EXPECT_EQ(refusal("{\"ratio\":\"\xff\"}").code(), ErrorCode::request_malformed);
    EXPECT_EQ(refusal("{\"ratio\":NaN}").code(), ErrorCode::request_malformed);
    EXPECT_EQ(refusal("").code(), ErrorCode::request_malformed);
}

}  // namespace
}  // namespace coppice
