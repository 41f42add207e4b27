#include "core/simplify/gaps.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/simplify/run_algorithm.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

Simplified simplify(const Mesh& mesh, uint64_t triangles, const test::Parameters& parameters = {}) {
    return test::run_algorithm(gaps(), mesh, {.triangles = triangles}, parameters);
}

// A flat sheet, black up to its middle and white from there.
Mesh two_tone() {
    Mesh mesh = shapes::grid({.columns = 20, .rows = 20, .colors = true});
    Attribute& color = mesh.attributes.front();
    for (size_t w = 0; w < mesh.wedge_count(); ++w) {
        const float tone = mesh.positions[mesh.wedge_vertex[w]].x > 0.5F ? 1.0F : 0.0F;
        std::fill_n(color.values.begin() + static_cast<std::ptrdiff_t>(w * color.components), 3, tone);
    }
    return mesh;
}

// Vertices no farther from the line between the tones than its cells are wide.
std::ptrdiff_t vertices_at_the_change(const Mesh& mesh) {
    return std::count_if(mesh.positions.begin(), mesh.positions.end(),
                         [](Vec3f p) { return std::abs(p.x - 0.5F) <= 0.06F; });
}

TEST(Gaps, spends_triangles_where_colours_change) {
    const Mesh with = simplify(two_tone(), 160).mesh;
    const Mesh without = simplify(two_tone(), 160, {{"color_scale", 0.0}}).mesh;
    EXPECT_GT(vertices_at_the_change(with), vertices_at_the_change(without));
}

TEST(Gaps, keeps_colours_between_those_that_were_there) {
    const Mesh result = simplify(two_tone(), 100).mesh;
    for (const float value : result.attributes.front().values) {
        EXPECT_GE(value, 0);
        EXPECT_LE(value, 1);
    }
}

TEST(Gaps, keeps_normals_at_unit_length) {
    const Mesh result = simplify(shapes::sphere({.segments = 40, .rings = 20}), 200).mesh;
    const Attribute* normals = result.find_attribute("NORMAL");
    ASSERT_NE(normals, nullptr);
    for (size_t w = 0; w < result.wedge_count(); ++w) {
        const Vec3d n = {normals->values[3 * w], normals->values[3 * w + 1], normals->values[3 * w + 2]};
        EXPECT_NEAR(length(n), 1, 1e-5);
    }
}

}  // namespace
}  // namespace coppice
