// Two assets in, and how far one is from the other.
#include <algorithm>
#include <filesystem>

#include "tests/server/service_fixture.h"
#include "tests/server/test_scenes.h"

namespace coppice::test {
namespace {

using ::testing::HasSubstr;

class Compare : public ServiceTest {
  protected:
    Compare() { start(); }
    ~Compare() override { EXPECT_EQ(get("/healthz").status, 200); }

    Answer compare(const std::vector<FormPart>& parts, const std::string& query = "",
                   HeaderList headers = {}) const {
        const auto [type, body] = multipart(parts);
        headers.emplace_back("Content-Type", type);
        return post("/v1/compare" + query, headers, body);
    }
};

TEST_F(Compare, tells_how_far_the_candidate_is) {
    const Answer answer =
        compare({{"reference", iobj_scene(16), "a.iobj"}, {"candidate", glb_scene(8), "b.glb"}});
    ASSERT_EQ(answer.status, 200) << answer.body;
    EXPECT_EQ(answer.header("content-type"), "application/json");
    EXPECT_THAT(answer.body, HasSubstr("\"largest_model_units\":"));
    EXPECT_THAT(answer.body, HasSubstr("\"self_intersections\":null"));

    const std::string job = answer.header("location");
    const Answer record = get(job);
    EXPECT_EQ(json_member(record.body, "kind"), "\"compare\"");
    EXPECT_EQ(json_member(record.body, "status"), "\"succeeded\"");
    EXPECT_THAT(record.body, HasSubstr("\"report\":{\"reference\":{"));
    EXPECT_EQ(get(job + "/result").body, answer.body);
    EXPECT_EQ(get(job + "/report").body, answer.body);
}

TEST_F(Compare, of_an_asset_with_itself_finds_nothing) {
    const Answer answer = compare({{"reference", glb_scene(), "a.glb"}, {"candidate", glb_scene(), "b.glb"}},
                                  "?self_intersections=true&samples=20&seed=3");
    ASSERT_EQ(answer.status, 200) << answer.body;
    EXPECT_THAT(answer.body, HasSubstr("\"measured\":\"meshes\""));
    EXPECT_THAT(answer.body, HasSubstr("\"self_intersections\":{\"pairs\":0,\"triangles\":0}"));
    EXPECT_EQ(json_member(get(answer.header("location")).body, "kind"), "\"compare\"");
    EXPECT_THAT(get(answer.header("location")).body,
                HasSubstr(R"("options":{"samples":20.0,"seed":3,"self_intersections":true})"));
}

TEST_F(Compare, takes_its_options_as_json_and_its_time) {
    const Answer answer = compare({{"options", R"({"samples":20})", ""},
                                   {"reference", glb_scene(), "a.glb"},
                                   {"candidate", glb_scene(), "b.glb"}},
                                  "", {{"Prefer", "respond-async"}});
    ASSERT_EQ(answer.status, 202) << answer.body;
    wait_for_status(answer.header("location"), "succeeded");
    EXPECT_THAT(get(answer.header("location") + "/result").body, HasSubstr("\"surface_distance\""));
}

TEST_F(Compare, finds_the_resources_of_each_asset_with_that_asset) {
    const std::string external = glb_of({.buffer_uri = "data.bin"});
    EXPECT_THAT(compare({{"reference", glb_scene(), "a.glb"},
                         {"candidate", external, "b.glb"},
                         {"reference_resource", std::string(100, '\0'), "data.bin"}}),
                is_problem(422, "resource.missing"));
}

TEST_F(Compare, says_what_is_missing_or_too_much) {
    EXPECT_THAT(compare({{"reference", glb_scene(), "a.glb"}}), is_problem(400, "request.malformed"));
    EXPECT_THAT(compare({{"reference", glb_scene(), "a.glb"}}).body, HasSubstr("no part candidate"));
    EXPECT_THAT(compare({{"candidate", glb_scene(), "a.glb"}}).body, HasSubstr("no part reference"));
    EXPECT_THAT(
        compare({{"asset", glb_scene(), "a.glb"}}).body,
        HasSubstr("it takes reference, candidate, reference_resource, candidate_resource and options"));
    EXPECT_THAT(compare({{"reference", glb_scene(), "a.glb"}, {"reference", glb_scene(), "b.glb"}}).body,
                HasSubstr("several parts reference; other files are parts reference_resource"));
    EXPECT_THAT(compare({{"reference", glb_scene(), "a.glb"}, {"candidate", "", "b.glb"}}),
                is_problem(400, "asset.empty"));
    EXPECT_THAT(post("/v1/compare", {{"Content-Type", "model/gltf-binary"}}, glb_scene()),
                is_problem(415, "request.type_unsupported"));
    EXPECT_THAT(post("/v1/compare?ratio=0.5", {}, glb_scene()), is_problem(400, "option.unknown"));
    EXPECT_THAT(post("/v1/compare?samples=0", {}, glb_scene()), is_problem(400, "option.invalid"));
}

TEST_F(Compare, says_which_of_both_is_bad) {
    const std::vector<std::pair<std::string, std::string>> bad = {
        {"v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "asset.malformed"},
        {glb_scene().substr(0, 100), "asset.malformed"},
        {glb(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{}]})"), "asset.no_surface"},
    };
    for (const auto& [bytes, code] : bad) {
        const Answer second = compare({{"reference", glb_scene(), "a.glb"}, {"candidate", bytes, "b"}});
        EXPECT_THAT(second, is_problem(422, code));
        EXPECT_THAT(second.body, HasSubstr("the candidate"));
        EXPECT_THAT(compare({{"reference", bytes, "b"}, {"candidate", glb_scene(), "a.glb"}}).body,
                    HasSubstr("the reference"));
    }
}

TEST_F(Compare, leaves_no_file_behind_once_the_job_is_deleted) {
    const Answer answer =
        compare({{"reference", glb_scene(9), "a.glb"}, {"candidate", glb_scene(7), "b.glb"}});
    ASSERT_EQ(answer.status, 200) << answer.body;
    const auto files = [&] {
        const auto all = std::filesystem::recursive_directory_iterator(folder.path() / "data" / "blobs");
        return std::count_if(begin(all), end(all), [](const auto& entry) { return entry.is_regular_file(); });
    };
    EXPECT_EQ(files(), 3);  // both assets, and the result
    EXPECT_EQ(request(port, "DELETE", answer.header("location")).status, 204);
    EXPECT_EQ(files(), 0);
}

}  // namespace
}  // namespace coppice::test
