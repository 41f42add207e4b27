// The main job: an instanced scene in, a smaller one out.
#include "tests/server/service_fixture.h"
#include "tests/server/test_scenes.h"

namespace coppice::test {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::StartsWith;

class Optimize : public ServiceTest {};

TEST_F(Optimize, gives_the_smaller_scene_back_with_its_figures) {
    start();
    const std::string scene = iobj_scene();
    const Answer answer = optimize(scene, "?ratio=0.5", {{"Content-Type", "model/vnd.coppice.iobj"}});
    ASSERT_EQ(answer.status, 200) << answer.body;
    EXPECT_THAT(answer.body, StartsWith("#@iobj 1.0"));
    EXPECT_THAT(answer.body, HasSubstr("#@instance"));
    EXPECT_LT(answer.body.size(), scene.size());
    EXPECT_EQ(answer.header("content-type"), "model/vnd.coppice.iobj");
    EXPECT_EQ(answer.header("coppice-input-bytes"), std::to_string(scene.size()));
    EXPECT_EQ(answer.header("coppice-output-bytes"), std::to_string(answer.body.size()));
    EXPECT_THAT(answer.header("coppice-triangles"), MatchesRegex("128;6[0-9]"));
    EXPECT_EQ(answer.header("coppice-cache"), "miss");
    EXPECT_THAT(answer.header("server-timing"), HasSubstr("simplify;dur="));
    EXPECT_THAT(answer.header("etag"), MatchesRegex("\"[0-9a-f]{64}\""));
    EXPECT_EQ(answer.header("content-disposition"), "attachment; filename=\"scene.iobj\"");
    EXPECT_EQ(answer.header("x-content-type-options"), "nosniff");
    const std::string job = answer.header("location");
    EXPECT_EQ(answer.header("link"), "<" + job + "/report>; rel=\"describedby\"");
    EXPECT_EQ(get(job + "/result").body, answer.body);
    EXPECT_THAT(get(job + "/report").body, HasSubstr("\"unique_triangles\":128"));
}

TEST_F(Optimize, takes_a_form_with_options_and_resources_as_curl_sends_it) {
    start();
    const auto [type, body] = multipart({
        {"asset", "mtllib scene.mtl\nusemtl red\n" + obj_scene(), "my scene.obj", "application/octet-stream"},
        {"resource", "newmtl red\nKd 1 0 0\n", "scene.mtl", "application/octet-stream"},
        {"options", R"({"algorithm":"its","ratio":0.25,"format":"iobj"})"},
    });
    const Answer answer = post("/v1/optimize", {{"Content-Type", type}}, body);
    ASSERT_EQ(answer.status, 200) << answer.body;
    EXPECT_EQ(answer.header("content-type"), "application/zip");
    EXPECT_EQ(answer.header("content-disposition"),
              "attachment; filename=\"my_scene.zip\"; filename*=UTF-8''my%20scene.zip");
    EXPECT_THAT(get(answer.header("location")).body, HasSubstr("\"ratio\":0.25"));
}

TEST_F(Optimize, takes_a_body_of_unknown_length_in_chunks) {
    start();
    const std::string scene = iobj_scene();
    Connection connection(port);
    connection.send_bytes("POST /v1/optimize HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n");
    for (size_t at = 0; at < scene.size(); at += 100) {
        const std::string chunk = scene.substr(at, 100);
        connection.send_bytes(fmt::format("{:x}\r\n{}\r\n", chunk.size(), chunk));
    }
    connection.send_bytes("0\r\n\r\n");
    EXPECT_EQ(connection.receive().status, 200);
}

TEST_F(Optimize, the_same_input_gives_the_same_bytes) {
    config.slots = 2;
    start();
    EXPECT_EQ(optimize(iobj_scene()).header("etag"), optimize(iobj_scene()).header("etag"));
}

TEST_F(Optimize, answers_202_at_once_where_the_client_prefers_it) {
    start_gated();
    const Answer answer = optimize("o a\n", "", {{"Prefer", "respond-async"}});
    EXPECT_EQ(answer.status, 202);
    EXPECT_EQ(answer.header("preference-applied"), "respond-async");
    EXPECT_FALSE(answer.header("retry-after").empty());
    EXPECT_THAT(answer.header("location"), StartsWith("/v1/jobs/"));
    EXPECT_EQ("/v1/jobs/" + json_member(answer.body, "id").substr(1, 32), answer.header("location"));
}

TEST_F(Optimize, answers_202_when_the_wait_runs_out_and_the_job_goes_on) {
    start_gated();
    const Answer answer = optimize("o a\n", "", {{"Prefer", "wait=0"}});
    EXPECT_EQ(answer.status, 202);
    EXPECT_EQ(answer.header("preference-applied"), "wait=0");
    gate.open();
    wait_for_status(answer.header("location"), "succeeded");
}

TEST_F(Optimize, a_wait_that_is_too_long_is_cut_and_said_so) {
    start();
    EXPECT_EQ(optimize(iobj_scene(), "", {{"Prefer", "wait=1000"}}).header("preference-applied"), "wait=55");
    EXPECT_EQ(optimize(iobj_scene(), "", {{"Prefer", "handling=strict, respond-async, wait=20"}})
                  .header("preference-applied"),
              "respond-async, wait=20");
    const Answer refused = optimize(iobj_scene(), "", {{"Prefer", "wait=soon"}});
    EXPECT_THAT(refused, is_problem(400, "request.malformed"));
    EXPECT_THAT(refused.body, HasSubstr("Prefer has wait=soon; it takes wait=SECONDS and respond-async"));
}

TEST_F(Optimize, preferences_are_read_as_rfc_7240_says) {
    start();
    const std::vector<std::pair<std::string, std::string>> applied = {
        {"wait=20", "wait=20"},
        {"Wait = \"20\"; x=y", "wait=20"},
        {"wait=20, wait=30", "wait=20"},  // the first one counts
        {"waiting=20", ""},
        {"return=minimal", ""},
    };
    for (const auto& [prefer, expected] : applied) {
        EXPECT_EQ(optimize(iobj_scene(), "", {{"Prefer", prefer}}).header("preference-applied"), expected)
            << prefer;
    }
    EXPECT_EQ(optimize(iobj_scene(), "", {{"Prefer", "Respond-Async"}}).status, 202);
}

TEST_F(Optimize, an_asset_that_fails_is_a_problem_that_names_the_job) {
    start();
    const Answer answer = optimize("#@iobj 1.0\no a\nv 0 0 0\nf 1 2 3\n");
    EXPECT_THAT(answer, is_problem(422, "asset.malformed"));
    const std::string job = answer.header("location");
    EXPECT_EQ(status_of(job), "failed");
    EXPECT_EQ(get(job + "/result").status, 409);
    EXPECT_THAT(get(job + "/result"), is_problem(409, "asset.malformed"));
    EXPECT_EQ(json_member(get(job + "/result").body, "status"), "409");
    EXPECT_THAT(get(job + "/report"), is_problem(409, "asset.malformed"));
}

TEST_F(Optimize, inspect_tells_what_is_there_and_takes_no_other_option) {
    start();
    const Answer answer = post("/v1/inspect", {}, iobj_scene());
    ASSERT_EQ(answer.status, 200) << answer.body;
    EXPECT_EQ(answer.header("content-type"), "application/json");
    EXPECT_THAT(answer.body, HasSubstr("\"instances\":3"));
    EXPECT_EQ(json_member(get(answer.header("location")).body, "kind"), "\"inspect\"");
    const Answer refused = post("/v1/inspect?ratio=0.5", {}, iobj_scene());
    EXPECT_THAT(refused, is_problem(400, "option.invalid"));
    EXPECT_EQ(json_member(refused.body, "where"), "\"ratio\"");
}

}  // namespace
}  // namespace coppice::test
