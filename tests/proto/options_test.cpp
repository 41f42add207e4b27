#include "proto/options.h"

#include <gtest/gtest.h>

#include <functional>

#include "core/base/error.h"
#include "core/simplify/registry.h"

namespace coppice {
namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

Error refusal(const std::function<void()>& parse) {
    try {
        parse();
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "the options were taken";
    return {ErrorCode::internal, "", ""};
}

Error query_refusal(const Pairs& pairs) {
    return refusal([&pairs] { parse_options(pairs); });
}

Error json_refusal(std::string_view json) {
    return refusal([json] { parse_options_json(json); });
}

TEST(Options, of_a_query_are_text_that_becomes_typed) {
    const OptimizeOptions options = parse_options({{"algorithm", "its"},
                                                   {"ratio", "0.25"},
                                                   {"error", "1e-3"},
                                                   {"format", "iobj"},
                                                   {"instancing", "nodes"}});
    EXPECT_EQ(options.algorithm, "its");
    EXPECT_EQ(options.ratio, 0.25);
    EXPECT_EQ(options.error, 0.001);
    EXPECT_EQ(options.format, Format::iobj);
    EXPECT_EQ(options.instancing, Instancing::nodes);
}

TEST(Options, of_json_mean_the_same_as_those_of_a_query) {
    EXPECT_EQ(
        print_options(parse_options_json(
            R"({"triangles":1000,"algorithm":"its","parameters":{"mode":"faithful"},"entry":"a/scene.gltf"})")),
        print_options(parse_options({{"entry", "a/scene.gltf"},
                                     {"parameters.mode", "faithful"},
                                     {"triangles", "1000"},
                                     {"algorithm", "its"}})));
}

TEST(Options, carry_the_switches_and_whole_numbers_of_an_algorithm) {
    const auto query = parse_options(
        {{"algorithm", "ias"}, {"parameters.prune_instances", "true"}, {"parameters.seed", "7"}});
    const auto json =
        parse_options_json(R"({"algorithm":"ias","parameters":{"prune_instances":true,"seed":7}})");
    for (const OptimizeOptions& options : {query, json}) {
        const auto values = ParameterValues::parse(find_algorithm("ias").parameters, options.parameters);
        EXPECT_TRUE(values.boolean("prune_instances"));
        EXPECT_EQ(values.number("seed"), 7);
    }
    EXPECT_EQ(query_refusal({{"algorithm", "ias"}, {"parameters.seed", "7"}}).where(), "parameters.seed");
    EXPECT_EQ(query_refusal(
                  {{"algorithm", "ias"}, {"parameters.prune_instances", "true"}, {"parameters.seed", "0.5"}})
                  .code(),
              ErrorCode::option_invalid);
}

TEST(Options, of_an_inspection_are_the_one_that_chooses_the_asset) {
    EXPECT_EQ(parse_options({{"entry", "a.obj"}}, JobKind::inspect).entry, "a.obj");
    const Error in_query = refusal([] {
        parse_options({{"entry", "a.obj"}, {"ratio", "0.5"}}, JobKind::inspect);
    });
    EXPECT_EQ(in_query.code(), ErrorCode::option_invalid);
    EXPECT_EQ(in_query.where(), "ratio");
    EXPECT_EQ(in_query.message(), "ratio is an option of optimizing; an inspection takes entry alone");
    const Error in_json =
        refusal([] { parse_options_json(R"({"parameters":{"mode":"full"}})", JobKind::inspect); });
    EXPECT_EQ(in_json.where(), "parameters.mode");
    const Error unknown = refusal([] { parse_options({{"entri", "a.obj"}}, JobKind::inspect); });
    EXPECT_EQ(unknown.message(), "entri is not an option; did you mean entry? (options are entry)");
}

TEST(Options, print_what_was_given_sorted_and_read_it_back) {
    const std::string text = R"({"algorithm":"its","parameters":{"mode":"faithful"},"ratio":0.1})";
    EXPECT_EQ(print_options(parse_options_json(text)), text);
    EXPECT_EQ(print_options(parse_options({})), "{}");
    EXPECT_EQ(print_options(parse_options({{"instancing", "auto"}})), "{}");
}

TEST(Options, print_numbers_so_that_they_read_back_to_the_same_bits) {
    OptimizeOptions options;
    options.ratio = 0.1 + 0.2;
    EXPECT_EQ(parse_options_json(print_options(options)).ratio, 0.1 + 0.2);
}

TEST(Options, refuse_a_ratio_out_of_its_range_naming_it_and_the_range) {
    for (const char* ratio : {"0", "1.5", "-1", "1e9"}) {
        const Error error = query_refusal({{"ratio", ratio}});
        EXPECT_EQ(error.code(), ErrorCode::option_invalid) << ratio;
        EXPECT_EQ(error.where(), "ratio") << ratio;
        EXPECT_NE(error.message().find("at most 1"), std::string::npos) << error.message();
    }
}

TEST(Options, refuse_a_ratio_that_is_no_number) {
    EXPECT_EQ(query_refusal({{"ratio", "abc"}}).message(),
              "ratio is abc; it takes a number over 0 and at most 1");
    EXPECT_EQ(query_refusal({{"ratio", ""}}).message(),
              "ratio is empty; it takes a number over 0 and at most 1");
    for (const char* ratio : {"nan", "inf", "0,5", " 0.5", "0x1p-1"}) {
        EXPECT_EQ(query_refusal({{"ratio", ratio}}).code(), ErrorCode::option_invalid) << ratio;
    }
}

TEST(Options, refuse_json_of_the_wrong_type_showing_it) {
    EXPECT_EQ(json_refusal(R"({"ratio":"0.5"})").message(),
              "ratio is \"0.5\"; it takes a number over 0 and at most 1");
    EXPECT_EQ(json_refusal(R"({"ratio":[0.5]})").where(), "ratio");
    EXPECT_EQ(json_refusal(R"({"ratio":null})").code(), ErrorCode::option_invalid);
    EXPECT_EQ(json_refusal(R"({"format":7})").message(), "format is 7; it takes glb, gltf, obj or iobj");
    EXPECT_EQ(json_refusal(R"({"parameters":"mode"})").where(), "parameters");
    EXPECT_EQ(json_refusal(R"({"parameters":{"normal_scale":"2"}})").where(), "parameters.normal_scale");
    EXPECT_EQ(json_refusal("[]").where(), "options");
}

TEST(Options, refuse_triangles_that_are_not_a_count) {
    for (const char* triangles : {"0", "1.5", "-3", "1e30", "many"}) {
        const Error error = query_refusal({{"triangles", triangles}});
        EXPECT_EQ(error.code(), ErrorCode::option_invalid) << triangles;
        EXPECT_EQ(error.where(), "triangles") << triangles;
    }
}

TEST(Options, refuse_an_instancing_that_is_not_written) {
    for (const char* instancing : {"gpu", "all"}) {
        const Error error = query_refusal({{"instancing", instancing}});
        EXPECT_EQ(error.code(), ErrorCode::option_invalid);
        EXPECT_EQ(error.where(), "instancing");
        EXPECT_EQ(error.message(),
                  "instancing is " + std::string(instancing) + "; it takes auto, nodes or expand");
    }
}

TEST(Options, that_exclude_each_other_are_a_conflict) {
    EXPECT_EQ(query_refusal({{"ratio", "0.5"}, {"triangles", "100"}}).code(), ErrorCode::option_conflict);
    EXPECT_EQ(query_refusal({{"format", "obj"}, {"instancing", "nodes"}}).code(), ErrorCode::option_conflict);
}

TEST(Options, that_are_given_twice_are_a_conflict) {
    const Error error = query_refusal({{"ratio", "0.5"}, {"ratio", "0.9"}});
    EXPECT_EQ(error.code(), ErrorCode::option_conflict);
    EXPECT_EQ(error.message(), "ratio is given twice, as 0.5 and 0.9; give it once");
    EXPECT_EQ(json_refusal(R"({"ratio":0.5,"ratio":0.9})").code(), ErrorCode::option_conflict);
}

TEST(Options, that_do_not_exist_are_named_with_the_one_that_was_meant) {
    const Error error = query_refusal({{"rato", "0.5"}});
    EXPECT_EQ(error.code(), ErrorCode::option_unknown);
    EXPECT_EQ(error.where(), "rato");
    EXPECT_NE(error.message().find("did you mean ratio?"), std::string::npos) << error.message();
    EXPECT_EQ(json_refusal(R"({"Ratio":0.5})").code(), ErrorCode::option_unknown);
}

TEST(Options, of_later_versions_do_not_exist_yet) {
    for (const char* name : {"compression", "quantize", "budget", "lods", "max_bytes", "webhook", "preset"}) {
        const Error error = query_refusal({{name, "1"}});
        EXPECT_EQ(error.code(), ErrorCode::option_unknown) << name;
        EXPECT_NE(error.message().find("in this version"), std::string::npos) << error.message();
    }
}

TEST(Options, take_discover_only_as_none_until_copies_are_found) {
    EXPECT_NO_THROW(parse_options({{"discover", "none"}}));
    EXPECT_EQ(query_refusal({{"discover", "exact"}}).message(),
              "discover is exact; it takes none, because this version does not find copies yet");
}

TEST(Options, check_parameters_against_the_algorithm) {
    EXPECT_EQ(query_refusal({{"parameters.mod", "full"}}).code(), ErrorCode::option_unknown);
    EXPECT_EQ(query_refusal({{"parameters.mode", "half"}}).code(), ErrorCode::option_invalid);
    EXPECT_EQ(query_refusal({{"parameters.mode", "half"}}).where(), "parameters.mode");
    EXPECT_EQ(query_refusal({{"parameters", "mode"}}).code(), ErrorCode::option_invalid);
    EXPECT_EQ(json_refusal(R"({"parameters.mode":"full"})").code(), ErrorCode::option_invalid);
}

TEST(Options, refuse_an_algorithm_that_does_not_exist_and_list_those_that_do) {
    const Error error = query_refusal({{"algorithm", "qslim"}});
    EXPECT_EQ(error.code(), ErrorCode::option_invalid);
    EXPECT_EQ(error.where(), "algorithm");
    EXPECT_NE(error.message().find("its"), std::string::npos);
}

TEST(Options, refuse_formats_that_are_only_read) {
    EXPECT_EQ(query_refusal({{"format", "stl"}}).message(), "format is stl; it takes glb, gltf, obj or iobj");
}

TEST(Options, cut_long_values_in_messages) {
    EXPECT_LT(query_refusal({{"ratio", std::string(100'000, '9') + "x"}}).message().size(), 200U);
}

}  // namespace
}  // namespace coppice
