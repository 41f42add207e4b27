// Whatever is sent, the answer says what is wrong, and the service goes on.
#include <fmt/format.h>

#include <limits>

#include "tests/server/service_fixture.h"
#include "tests/server/test_scenes.h"
#include "tests/server/zip_bomb.h"

namespace coppice::test {
namespace {

// A problem with this status and code, at this place (none: ""), whose detail says what would be right.
MATCHER_P4(tells, status, code, where, right, "is a problem " + std::string(code) + " that says " + right) {
    const std::string quoted = std::string(where).empty() ? "" : "\"" + std::string(where) + "\"";
    return ExplainMatchResult(is_problem(status, code), arg, result_listener) &&
           json_member(arg.body, "where") == quoted &&
           json_member(arg.body, "detail").find(right) != std::string::npos;
}

class BadInput : public ServiceTest {
  protected:
    BadInput() {
        config.http.body_bytes = 2 << 20;
        start();
    }
    ~BadInput() override { EXPECT_EQ(get("/healthz").status, 200); }
};

TEST_F(BadInput, an_empty_body) {
    EXPECT_THAT(optimize(""), tells(400, "asset.empty", "asset", "send its bytes as the body"));
    const auto [type, body] = multipart({{"asset", "", "a.glb"}});
    EXPECT_THAT(post("/v1/optimize", {{"Content-Type", type}}, body),
                tells(400, "asset.empty", "asset", "or as the part asset of a form"));
}

TEST_F(BadInput, a_wrong_type) {
    EXPECT_THAT(
        optimize(glb_scene(), "", {{"Content-Type", "model/obj"}}),
        tells(415, "asset.format_mismatch", "asset", "send it as model/gltf-binary, or with no type"));
    const auto [type, body] = multipart({{"asset", glb_scene(), "scene.obj"}});
    EXPECT_THAT(post("/v1/optimize", {{"Content-Type", type}}, body),
                tells(415, "asset.format_mismatch", "scene.obj", "end its name with .glb"));
    EXPECT_THAT(
        optimize("\x89PNG\r\n\x1a\n....................", "", {{"Content-Type", "image/png"}}),
        tells(415, "asset.unsupported", "asset", "glTF 2.0 (glb, gltf), OBJ (obj, iobj), PLY and STL"));
    EXPECT_THAT(optimize("x", "", {{"Content-Type", "multipart/mixed; boundary=x"}}),
                tells(415, "request.type_unsupported", "Content-Type", "multipart/form-data"));
    EXPECT_THAT(optimize("x", "", {{"Content-Encoding", "gzip"}}),
                tells(415, "request.encoding_unsupported", "Content-Encoding", "send it as it is"));
}

TEST_F(BadInput, a_truncated_glb) {
    const std::string whole = glb_scene();
    EXPECT_THAT(optimize(whole.substr(0, whole.size() - 8)),
                tells(422, "asset.malformed", "byte 8",
                      fmt::format("declares {} bytes, but the file has {}", whole.size(), whole.size() - 8)));
    for (const size_t bytes : {size_t{5}, size_t{12}, size_t{100}, whole.size() - 1}) {
        EXPECT_THAT(optimize(whole.substr(0, bytes)), is_problem(422, "asset.malformed")) << bytes;
    }
}

TEST_F(BadInput, an_index_out_of_range) {
    EXPECT_THAT(optimize(glb_of({.last_index = 3})),
                tells(422, "asset.malformed", "/meshes/0/primitives/0/indices",
                      "element 2 is 3, but there are 3 vertices"));
    EXPECT_THAT(
        optimize("v 0 0 0\nf 1 2 3\n", "", {{"Content-Type", "model/obj"}}),
        tells(422, "asset.malformed", "line 2, column 8", "vertex 3 is out of range: the file has 1"));
}

TEST_F(BadInput, a_position_that_is_no_number) {
    EXPECT_THAT(optimize(glb_of({.first_x = std::numeric_limits<float>::quiet_NaN()})),
                tells(422, "asset.malformed", "/accessors/0", "all of them must be finite"));
    EXPECT_THAT(optimize("v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "", {{"Content-Type", "model/obj"}}),
                tells(422, "asset.malformed", "line 1, column 6", "not a finite 32-bit number"));
}

TEST_F(BadInput, nodes_that_are_their_own_ancestors) {
    EXPECT_THAT(optimize(glb_of({.nodes = R"([{"children":[1]},{"mesh":0,"children":[0]}])"})),
                tells(422, "asset.malformed", "/nodes/0", "no node may be its own ancestor"));
}

TEST_F(BadInput, a_count_of_two_to_the_62) {
    EXPECT_THAT(
        optimize(glb_of(
            {.positions =
                 R"({"bufferView":0,"componentType":5126,"count":4611686018427387904,"type":"VEC3","min":[0,0,0],"max":[1,1,0]})"})),
        tells(422, "asset.malformed", "/accessors/0/count", "a number may be at most"));
}

TEST_F(BadInput, uris_that_leave_the_upload) {
    for (const char* uri : {"../../../etc/passwd", "%2e%2e/%2e%2e/etc/passwd", "/etc/passwd",
                            "file:///etc/passwd", "http://127.0.0.1/x", "..\\\\x"}) {
        EXPECT_THAT(optimize(glb_of({.buffer_uri = uri})),
                    tells(422, "resource.forbidden", "/buffers/0/uri", "only relative paths"))
            << uri;
    }
    EXPECT_THAT(optimize(glb_of({.buffer_uri = "missing.bin"})),
                tells(422, "resource.missing", "/buffers/0/uri", "send them as parts named"));
}

TEST_F(BadInput, a_zip_bomb) {
    EXPECT_THAT(optimize(zip_bomb()),
                tells(422, "asset.too_large", "asset", "over the limit zip_ratio of 100:1"));
}

TEST_F(BadInput, an_option_that_is_not_there) {
    EXPECT_THAT(optimize(iobj_scene(), "?rato=0.5"),
                tells(400, "option.unknown", "rato", "did you mean ratio?"));
    EXPECT_THAT(optimize(iobj_scene(), "?lods=0.5"),
                tells(400, "option.unknown", "lods", "not an option in this version"));
}

TEST_F(BadInput, a_ratio_that_is_out_of_range_or_no_number) {
    for (const std::string ratio : {"0", "1.5", "abc", "-1", "nan", ""}) {
        const Answer answer = optimize(iobj_scene(), "?ratio=" + ratio);
        EXPECT_THAT(answer, tells(400, "option.invalid", "ratio", "it takes a number over 0 and at most 1"))
            << ratio;
        EXPECT_TRUE(answer.header("location").empty()) << "no job was made";
    }
    const auto [type, body] = multipart({{"asset", iobj_scene(), "a.iobj"}, {"options", R"({"ratio":2})"}});
    EXPECT_THAT(post("/v1/optimize", {{"Content-Type", type}}, body),
                tells(400, "option.invalid", "ratio", "it takes a number over 0 and at most 1"));
    EXPECT_THAT(post("/v1/optimize?ratio=0.5", {{"Content-Type", type}}, body),
                tells(400, "option.conflict", "options", "in the query or in one part options, not in both"));
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
        {{"asset", "o a\n", "a.obj"}, {"resource", "x", "a.mtl"}, {"resource", "y", "a.mtl"}},
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
    EXPECT_THAT(optimize(std::string((2 << 20) + 1, 'x')),
                tells(413, "request.too_large", "", "more than 2097152 bytes, the limit (upload_bytes)"));
}

TEST_F(BadInput, methods_and_paths_that_are_not_there) {
    EXPECT_THAT(get("/v1/nothing"), tells(404, "route.not_found", "", "/openapi.json lists what there is"));
    EXPECT_THAT(get("/v1/jobs/1/events"), is_problem(404, "route.not_found"));
    const Answer answer = get("/v1/optimize");
    EXPECT_THAT(answer, tells(405, "method.not_allowed", "", "GET is not taken here; POST is"));
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
