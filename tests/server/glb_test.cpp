// GLB through the service.
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

}  // namespace
}  // namespace coppice::test
