#include "core/simplify/parameter.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>

#include "core/base/error.h"
#include "core/simplify/registry.h"

namespace coppice {
namespace {

using Kind = Parameter::Kind;

constexpr std::array<std::string_view, 2> colors = {"red", "green"};

const std::vector<Parameter>& parameters() {
    static const std::vector<Parameter> list = {
        {.id = "color", .title = "", .kind = Kind::choice, .default_value = "red", .choices = colors},
        {.id = "part", .title = "", .minimum = 0, .maximum = 1, .minimum_excluded = true},
        {.id = "length", .title = "", .unit = "mesh units", .minimum = 0},
        {.id = "passes",
         .title = "",
         .kind = Kind::integer,
         .default_value = 1.0,
         .minimum = 1,
         .maximum = 16},
        {.id = "strict", .title = "", .kind = Kind::boolean},
        {.id = "radius", .title = "", .kind = Kind::length, .unit = "mean edges", .minimum = 0},
        {.id = "count",
         .title = "",
         .kind = Kind::text,
         .pattern = "all|[1-9][0-9]*",
         .form = "all or a whole number"},
    };
    return list;
}

ParameterValues parse(const std::map<std::string, ParameterValue>& given) {
    return ParameterValues::parse(parameters(), given);
}

Error refusal(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "was accepted";
    return Error(ErrorCode::internal, "", "");
}

TEST(ParameterValues, reads_text_and_typed_values_alike) {
    EXPECT_EQ(parse({{"part", "0.5"}}).number("part"), 0.5);
    EXPECT_EQ(parse({{"part", 0.5}}).number("part"), 0.5);
    EXPECT_TRUE(parse({{"strict", "true"}}).boolean("strict"));
    EXPECT_TRUE(parse({{"strict", true}}).boolean("strict"));
    EXPECT_EQ(parse({{"color", "green"}}).text("color"), "green");
}

TEST(ParameterValues, reads_lengths_in_mean_edges_or_with_the_suffix_u_in_mesh_units) {
    EXPECT_EQ(parse({{"radius", "0.5"}}).length("radius")->in(10), 5);
    EXPECT_EQ(parse({{"radius", 0.5}}).length("radius")->in(10), 5);
    EXPECT_EQ(parse({{"radius", "0.5u"}}).length("radius")->in(10), 0.5);
    for (const char* text : {"u", "-1u", "1 u", "1uu", "nanu"}) {
        EXPECT_EQ(refusal([&] {
                      parse({{"radius", text}});
                  }).message(),
                  fmt::format("parameters.radius is \"{}\"; it takes a number from 0 up (mean edges), or one "
                              "with the suffix u (mesh units)",
                              text));
    }
}

TEST(ParameterValues, reads_texts_that_match_their_pattern_and_whole_numbers_for_them) {
    EXPECT_EQ(parse({{"count", "all"}}).text("count"), "all");
    EXPECT_EQ(parse({{"count", 3.0}}).text("count"), "3");
    for (const std::string& text : {std::string("some"), std::string("0"), std::string(1000, '1')})
        EXPECT_EQ(refusal([&] { parse({{"count", text}}); }).code(), ErrorCode::option_invalid);
}

TEST(ParameterValues, fills_in_defaults_and_leaves_the_rest_unset) {
    const ParameterValues values = parse({});
    EXPECT_EQ(values.text("color"), "red");
    EXPECT_EQ(values.number("passes"), 1.0);
    EXPECT_EQ(values.number("part"), std::nullopt);
    EXPECT_FALSE(values.boolean("strict"));
    EXPECT_EQ(values.all().size(), 2U);
}

TEST(ParameterValues, names_what_it_does_not_know_and_what_there_is) {
    const Error error = refusal([] { parse({{"colour", "red"}}); });
    EXPECT_EQ(error.code(), ErrorCode::option_unknown);
    EXPECT_EQ(error.where(), "parameters.colour");
    EXPECT_EQ(error.message(),
              "parameters.colour is not a parameter of this algorithm, which takes color, part, length, "
              "passes, strict, radius, count");
}

struct Wrong {
    std::string id;
    ParameterValue value;
    std::string message;
};

std::ostream& operator<<(std::ostream& out, const Wrong& wrong) {
    out << wrong.message;
    return out;
}

class WrongValue : public testing::TestWithParam<Wrong> {};

TEST_P(WrongValue, is_refused_with_what_it_is_and_what_it_may_be) {
    const Error error = refusal([] { parse({{GetParam().id, GetParam().value}}); });
    EXPECT_EQ(error.code(), ErrorCode::option_invalid);
    EXPECT_EQ(error.where(), "parameters." + GetParam().id);
    EXPECT_EQ(error.message(), "parameters." + GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongValue,
    testing::Values(Wrong{"color", "blue", "color is \"blue\"; it takes one of red, green"},
                    Wrong{"color", 1.0, "color is 1; it takes one of red, green"},
                    Wrong{"part", 0.0, "part is 0; it takes a number greater than 0 up to 1"},
                    Wrong{"part", "1.5", "part is \"1.5\"; it takes a number greater than 0 up to 1"},
                    Wrong{"part", "half", "part is \"half\"; it takes a number greater than 0 up to 1"},
                    Wrong{"part", "0.5x", "part is \"0.5x\"; it takes a number greater than 0 up to 1"},
                    Wrong{"part", "nan", "part is \"nan\"; it takes a number greater than 0 up to 1"},
                    Wrong{"part", true, "part is true; it takes a number greater than 0 up to 1"},
                    Wrong{"length", -1.0, "length is -1; it takes a number from 0 up (mesh units)"},
                    Wrong{"passes", 1.5, "passes is 1.5; it takes a whole number from 1 to 16"},
                    Wrong{"strict", "yes", "strict is \"yes\"; it takes true or false"}));

TEST(Registry, lists_each_algorithm_once_and_finds_it_by_its_id) {
    for (const Algorithm& a : algorithms()) {
        EXPECT_EQ(&find_algorithm(a.id), &a);
        EXPECT_NE(a.simplify == nullptr, a.simplify_scene == nullptr);  // one of the two
        EXPECT_FALSE(a.title.empty());
        EXPECT_FALSE(a.citation.empty());
    }
    EXPECT_EQ(default_algorithm().id, "its");
}

TEST(Registry, says_which_algorithms_there_are) {
    const Error error = refusal([] { find_algorithm("best"); });
    EXPECT_EQ(error.code(), ErrorCode::option_invalid);
    EXPECT_THAT(error.message(), testing::HasSubstr("\"best\" does not exist; it may be "));
    for (const Algorithm& a : algorithms()) EXPECT_THAT(error.message(), testing::HasSubstr(a.id));
}

TEST(Registry, has_defaults_that_are_allowed) {
    for (const Algorithm& a : algorithms()) {
        const ParameterValues parsed = ParameterValues::parse(a.parameters, {});
        const std::map<std::string, ParameterValue> defaults(parsed.all().begin(), parsed.all().end());
        EXPECT_NO_THROW(ParameterValues::parse(a.parameters, defaults));
    }
}

}  // namespace
}  // namespace coppice
