#include "proto/compare_options.h"

#include <gmock/gmock.h>

#include "core/base/error.h"

namespace coppice {
namespace {

template <typename Call>
Error refusal(Call call) {
    try {
        call();
    } catch (const Error& error) {
        return error;
    }
    return {ErrorCode::internal, "", "nothing was refused"};
}

TEST(CompareOptions, are_typed) {
    const CompareOptions options = parse_compare_options({{"samples", "2.5"},
                                                          {"seed", "7"},
                                                          {"self_intersections", "true"},
                                                          {"reference_entry", "a.obj"},
                                                          {"candidate_entry", "b/c.glb"}});
    EXPECT_EQ(options.samples, 2.5);
    EXPECT_EQ(options.seed, 7U);
    EXPECT_TRUE(options.self_intersections);
    EXPECT_EQ(options.reference_entry, "a.obj");
    EXPECT_EQ(options.candidate_entry, "b/c.glb");
}

TEST(CompareOptions, print_what_differs_from_the_defaults_and_read_it_back) {
    const std::string text = R"({"candidate_entry":"c","samples":20.0,"seed":2,"self_intersections":true})";
    EXPECT_EQ(print_compare_options(parse_compare_options_json(text)), text);
    EXPECT_EQ(print_compare_options(parse_compare_options({{"samples", "10"}, {"seed", "1"}})), "{}");
}

TEST(CompareOptions, that_mean_nothing_are_refused_by_name) {
    const auto where = [](const std::string& name, const std::string& value) {
        const Error error = refusal([&] { parse_compare_options({{name, value}}); });
        EXPECT_NE(error.code(), ErrorCode::internal) << name << "=" << value;
        return error.where();
    };
    EXPECT_EQ(where("samples", "0"), "samples");
    EXPECT_EQ(where("samples", "many"), "samples");
    EXPECT_EQ(where("samples", ""), "samples");
    EXPECT_EQ(where("seed", "-1"), "seed");
    EXPECT_EQ(where("seed", "1.5"), "seed");
    EXPECT_EQ(where("self_intersections", "yes"), "self_intersections");
    EXPECT_EQ(where("reference_entry", ""), "reference_entry");
    EXPECT_EQ(where("ratio", "0.5"), "ratio");
    EXPECT_EQ(refusal([] { parse_compare_options({{"sample", "5"}}); }).code(), ErrorCode::option_unknown);
    EXPECT_EQ(refusal([] {
                  parse_compare_options({{"seed", "5"}, {"seed", "5"}});
              }).code(),
              ErrorCode::option_conflict);
    EXPECT_EQ(refusal([] { parse_compare_options_json(R"({"samples":"20"})"); }).where(), "samples");
    EXPECT_EQ(refusal([] { parse_compare_options_json(R"({"self_intersections":1})"); }).where(),
              "self_intersections");
    EXPECT_EQ(refusal([] { parse_compare_options_json("[]"); }).where(), "options");
}

TEST(CompareOptions, are_those_that_help_texts_describe) {
    for (const OptionDescription& option : describe_compare_options()) {
        EXPECT_NE(refusal([&] {
                      parse_compare_options({{std::string(option.name), ""}});
                  }).code(),
                  ErrorCode::option_unknown);
    }
}

}  // namespace
}  // namespace coppice
