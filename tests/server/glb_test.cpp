// GLB through the service: the main job, and broken files that answer with what is wrong.
#include <limits>

#include "tests/server/service_fixture.h"
#include "tests/server/test_scenes.h"

namespace coppice::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class Glb : public ServiceTest {
  protected:
    Glb() { start(); }
    ~Glb() override { EXPECT_EQ(get("/healthz").status, 200); }
};

TEST_F(Glb, reads_and_writes_glb_with_the_same_instances) {
    const Answer answer = optimize(glb_scene(), "?ratio=0.5");
    ASSERT_EQ(answer.status, 200) << answer.body;
    EXPECT_THAT(answer.body, StartsWith("glTF"));
    EXPECT_EQ(answer.header("content-type"), "model/gltf-binary");
    const std::string report = get(answer.header("location") + "/report").body;
    EXPECT_THAT(report, HasSubstr("\"instances\":3"));
}

TEST_F(Glb, a_truncated_glb) {
    const std::string whole = glb_scene();
    for (const size_t bytes : {size_t{5}, size_t{12}, size_t{100}, whole.size() - 1}) {
        const Answer answer = optimize(whole.substr(0, bytes));
        EXPECT_THAT(answer, is_problem(422, "asset.malformed")) << bytes;
    }
}

TEST_F(Glb, an_index_out_of_range) {
    EXPECT_THAT(optimize(glb_of({.last_index = 3})), is_problem(422, "asset.malformed"));
}

TEST_F(Glb, a_position_that_is_no_number) {
    EXPECT_THAT(optimize(glb_of({.first_x = std::numeric_limits<float>::quiet_NaN()})),
                is_problem(422, "asset.malformed"));
}

TEST_F(Glb, nodes_that_are_their_own_ancestors) {
    EXPECT_THAT(optimize(glb_of({.nodes = R"([{"children":[1]},{"mesh":0,"children":[0]}])"})),
                is_problem(422, "asset.malformed"));
}

TEST_F(Glb, a_count_of_two_to_the_62) {
    EXPECT_THAT(
        optimize(glb_of(
            {.positions =
                 R"({"bufferView":0,"componentType":5126,"count":4611686018427387904,"type":"VEC3","min":[0,0,0],"max":[1,1,0]})"})),
        is_problem(422, "asset.malformed"));
}

TEST_F(Glb, uris_that_leave_the_upload) {
    for (const char* uri : {"../../../etc/passwd", "%2e%2e/%2e%2e/etc/passwd", "/etc/passwd",
                            "file:///etc/passwd", "http://127.0.0.1/x", "..\\\\x"}) {
        const Answer answer = optimize(glb_of({.buffer_uri = uri}));
        EXPECT_THAT(answer, is_problem(422, "resource.forbidden")) << uri;
    }
    EXPECT_THAT(optimize(glb_of({.buffer_uri = "missing.bin"})), is_problem(422, "resource.missing"));
}

}  // namespace
}  // namespace coppice::test
