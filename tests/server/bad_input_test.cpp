// Whatever is sent, the answer says what is wrong, and the service goes on.
#include "tests/server/service_fixture.h"
#include "tests/server/test_scenes.h"
#include "tests/server/zip_bomb.h"

namespace coppice::test {
namespace {

using ::testing::HasSubstr;

class BadInput : public ServiceTest {
  protected:
    BadInput() {
        config.http.body_bytes = 2 << 20;
        start();
    }
    ~BadInput() override { EXPECT_EQ(get("/healthz").status, 200); }
};

TEST_F(BadInput, an_empty_body) {
    EXPECT_THAT(optimize(""), is_problem(400, "asset.empty"));
    const auto [type, body] = multipart({{"asset", "", "a.glb"}});
    EXPECT_THAT(post("/v1/optimize", {{"Content-Type", type}}, body), is_problem(400, "asset.empty"));
}

TEST_F(BadInput, a_wrong_type) {
    EXPECT_EQ(optimize(glb_scene(), "", {{"Content-Type", "model/obj"}}).status, 415);
    EXPECT_EQ(optimize("\x89PNG\r\n\x1a\n....................", "", {{"Content-Type", "image/png"}}).status,
              415);
    EXPECT_THAT(optimize("x", "", {{"Content-Type", "multipart/mixed; boundary=x"}}),
                is_problem(415, "request.type_unsupported"));
    EXPECT_THAT(optimize("x", "", {{"Content-Encoding", "gzip"}}),
                is_problem(415, "request.encoding_unsupported"));
}

TEST_F(BadInput, an_index_out_of_range) {
    EXPECT_THAT(optimize("v 0 0 0\nf 1 2 3\n", "", {{"Content-Type", "model/obj"}}),
                is_problem(422, "asset.malformed"));
}

TEST_F(BadInput, a_position_that_is_no_number) {
    EXPECT_THAT(optimize("v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "", {{"Content-Type", "model/obj"}}),
                is_problem(422, "asset.malformed"));
}

TEST_F(BadInput, a_zip_bomb) {
    EXPECT_THAT(optimize(zip_bomb()), is_problem(422, "asset.too_large"));
}

TEST_F(BadInput, options_that_are_not_there_or_out_of_range) {
    EXPECT_THAT(optimize(iobj_scene(), "?rato=0.5"), is_problem(400, "option.unknown"));
    for (const char* ratio : {"0", "1.5", "abc", "-1", "nan", ""}) {
        const Answer answer = optimize(iobj_scene(), std::string("?ratio=") + ratio);
        EXPECT_THAT(answer, is_problem(400, "option.invalid")) << ratio;
        EXPECT_EQ(json_member(answer.body, "where"), "\"ratio\"");
        EXPECT_TRUE(answer.header("location").empty()) << "no job was made";
    }
    const auto [type, body] = multipart({{"asset", iobj_scene(), "a.iobj"}, {"options", R"({"ratio":2})"}});
    EXPECT_THAT(post("/v1/optimize", {{"Content-Type", type}}, body), is_problem(400, "option.invalid"));
    EXPECT_THAT(post("/v1/optimize?ratio=0.5", {{"Content-Type", type}}, body),
                is_problem(400, "option.conflict"));
}

TEST_F(BadInput, options_are_refused_before_the_body_has_come) {
    Connection connection(port);
    connection.send_bytes("POST /v1/optimize?ratio=7 HTTP/1.1\r\nHost: a\r\nContent-Length: 1000000\r\n\r\n");
    EXPECT_THAT(connection.receive(), is_problem(400, "option.invalid"));
}

TEST_F(BadInput, forms_that_are_not_as_agreed) {
    const std::vector<std::vector<FormPart>> forms = {
        {{"asset", "o a\n", "a.obj"}, {"colour", "red"}},
        {{"asset", "o a\n", "a.obj"}, {"asset", "o a\n", "b.obj"}},
        {{"resource", "x", "a.bin"}},
        {{"asset", "o a\n", "a.obj"}, {"resource", "no name"}},
        {{"asset", "o a\n", "a.obj"}, {"options", "not json"}},
    };
    for (const auto& form : forms) {
        const auto [type, body] = multipart(form);
        EXPECT_EQ(post("/v1/optimize", {{"Content-Type", type}}, body).status, 400) << form.back().name;
    }
    EXPECT_THAT(post("/v1/optimize", {{"Content-Type", "multipart/form-data"}}, "x"),
                is_problem(400, "request.malformed"));
}

TEST_F(BadInput, a_body_over_the_limit) {
    const Answer answer = optimize(std::string((2 << 20) + 1, 'x'));
    EXPECT_THAT(answer, is_problem(413, "request.too_large"));
    EXPECT_THAT(answer.body, HasSubstr("upload_bytes"));
}

TEST_F(BadInput, methods_and_paths_that_are_not_there) {
    EXPECT_THAT(get("/v1/nothing"), is_problem(404, "route.not_found"));
    EXPECT_THAT(get("/v1/jobs/1/events"), is_problem(404, "route.not_found"));
    const Answer answer = get("/v1/optimize");
    EXPECT_THAT(answer, is_problem(405, "method.not_allowed"));
    EXPECT_EQ(answer.header("allow"), "POST");
    EXPECT_THAT(request(port, "BREW", "/v1/optimize"), is_problem(405, "method.not_allowed"));
}

TEST_F(BadInput, leaves_no_bytes_behind_once_it_was_tidied) {
    optimize(iobj_scene(), "?ratio=7");
    const auto [type, body] = multipart({{"asset", iobj_scene(), "a.iobj"}, {"colour", "red"}});
    post("/v1/optimize", {{"Content-Type", type}}, body);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "data" / "incoming"));
}

}  // namespace
}  // namespace coppice::test
