#include "proto/unknown_option.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace coppice {
namespace {

std::string message_for(std::string_view name) {
    try {
        fail_unknown_option(name, {"algorithm", "ratio", "triangles"});
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::option_unknown);
        return error.message();
    }
}

TEST(UnknownOption, names_the_one_that_was_probably_meant) {
    EXPECT_EQ(message_for("ration"),
              "ration is not an option; did you mean ratio? (options are algorithm, ratio, triangles)");
    EXPECT_EQ(
        message_for("tirangles"),
        "tirangles is not an option; did you mean triangles? (options are algorithm, ratio, triangles)");
}

TEST(UnknownOption, guesses_nothing_where_nothing_is_near) {
    EXPECT_EQ(message_for("sharpness"),
              "sharpness is not an option (options are algorithm, ratio, triangles)");
}

TEST(UnknownOption, tells_what_is_planned_from_what_is_misspelled) {
    EXPECT_EQ(message_for("compression"),
              "compression is not an option in this version (options are algorithm, ratio, triangles)");
}

TEST(UnknownOption, knows_what_is_planned_as_a_flag_too) {
    EXPECT_EQ(message_for("--compression"),
              "--compression is not an option in this version (options are algorithm, ratio, triangles)");
}

TEST(UnknownOption, shows_that_a_name_is_empty) {
    EXPECT_EQ(message_for(""), "\"\" is not an option (options are algorithm, ratio, triangles)");
}

TEST(UnknownOption, cuts_a_name_that_is_an_attack_rather_than_a_mistake) {
    EXPECT_LT(message_for(std::string(1'000'000, 'a')).size(), 200U);
}

}  // namespace
}  // namespace coppice
