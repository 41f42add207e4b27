// What every optimization must leave true, as assertions: EXPECT_TRUE(keeps_bounds(before, after, 0.01)). A
// failure says where it is not. "before" is the scene as it was read, "after" the result read again.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "core/optimize/report.h"
#include "core/scene/scene.h"
#include "tests/support/orientation.h"

namespace coppice::test {

// As many instances, at the same nodes, with the same world transforms (relative tolerance 1e-6: some formats
// store them as floats), and instances that shared a mesh still share one; no more unique meshes than before.
::testing::AssertionResult keeps_instances(const Scene& before, const Scene& after);

// Each side of the scene's box within that fraction of its diagonal.
::testing::AssertionResult keeps_bounds(const Scene& before, const Scene& after, double diagonal_fraction);

// Each unique mesh within 1 % of ratio * triangles, or within 2 triangles, or the report gives another reason
// for which it stopped, and then it kept more; and the report counts the triangles that are really there.
::testing::AssertionResult meets_target(const Report& report, const Scene& after, double ratio);

// Index pairs of meshes that the same instance shows before and after, each once.
std::vector<std::pair<uint32_t, uint32_t>> mesh_pairs(const Scene& before, const Scene& after);

// For one mesh of a pair.

// Not more edges with three triangles or more, nor with two that run along it in the same direction.
::testing::AssertionResult has_no_new_non_manifold_edge(const Mesh& before, const Mesh& after);

// Each border edge runs along an original border, nearer than that fraction of the mesh's diagonal, and no
// original border is without one as near.
::testing::AssertionResult keeps_borders(const Mesh& before, const Mesh& after, double diagonal_fraction);

// The same for the edges along which texture coordinates are cut.
::testing::AssertionResult keeps_seams(const Mesh& before, const Mesh& after, double diagonal_fraction);

// No triangle has its corners in several charts of the original's first texture coordinates: that would smear
// the texture between them. Holds for algorithms that keep original wedges.
::testing::AssertionResult keeps_charts(const Mesh& before, const Mesh& after);

// All of the above, and of orientation.h.
void expect_properties_kept(const Scene& before, const Scene& after, const Report& report, double ratio);

}  // namespace coppice::test
