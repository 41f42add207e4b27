// No algorithm takes more memory than it declares.
#include <gtest/gtest.h>

#include <vector>

#include "tests/core/simplify/variants.h"
#include "tests/heap/heap_use.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

// What does not grow with the mesh.
constexpr size_t allowance_bytes = size_t{1} << 17;

class Memory : public testing::TestWithParam<test::Variant> {};

TEST_P(Memory, stays_within_what_the_algorithm_declares) {
    if (!test::HeapUse::is_counted()) GTEST_SKIP() << "a sanitizer has its own allocator";
    const size_t declared = find_algorithm(GetParam().algorithm).bytes_per_triangle;
    EXPECT_LE(declared, 400U);
    const std::vector<Mesh> meshes = {shapes::sphere({.segments = 224, .rings = 112}),
                                      shapes::blob({.segments = 224, .rings = 112}),
                                      shapes::grid({.columns = 150, .rows = 150, .height = 0.1})};
    for (const Mesh& mesh : meshes) {
        for (const double ratio : {0.9, 0.1}) {
            const test::HeapUse heap;
            test::simplify(GetParam(), mesh, test::part_of(mesh, ratio));
            EXPECT_LE(heap.peak_bytes(), declared * mesh.triangle_count() + allowance_bytes)
                << mesh.triangle_count() << " triangles at " << ratio;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Registry, Memory, testing::ValuesIn(test::all_variants()),
                         [](const testing::TestParamInfo<test::Variant>& tested) {
                             return test::test_name(tested.param, "declared");
                         });

}  // namespace
}  // namespace coppice
