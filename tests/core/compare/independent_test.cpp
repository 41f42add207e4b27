// Ours against CGAL's, on drawn meshes, on the samples, and on real files where they are there.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/compare/distance_bounds.h"
#include "core/compare/self_intersections.h"
#include "core/compare/surface_samples.h"
#include "core/optimize/optimize.h"
#include "core/sample/sample.h"
#include "tests/core/compare/cgal_oracle.h"
#include "tests/core/compare/meshes.h"
#include "tests/support/shapes.h"
#include "tests/support/test_assets.h"

namespace coppice::test {
namespace {

struct Pair {
    std::string name;
    Mesh reference, candidate;
};

Mesh first_mesh(const Scene& scene) {
    return *std::find_if(scene.meshes.begin(), scene.meshes.end(),
                         [](const Mesh& mesh) { return mesh.triangle_count() > 0; });
}

// A mesh and what is left of it at a fifth of its triangles.
Pair simplified(const std::string& name, const Upload& upload) {
    const Optimized small = optimize(upload, {.ratio = 0.2, .format = Format::glb}, {}, {});
    const Upload again = {.asset = {.path = "small.glb", .bytes = small.asset.bytes}};
    return {name, first_mesh(read_asset(upload, {}, {}).scene), first_mesh(read_asset(again, {}, {}).scene)};
}

std::vector<Pair> pairs() {
    std::vector<Pair> all = {{"blob", shapes::blob(), shapes::blob({.segments = 23, .rings = 16})},
                             {"soup", shapes::soup(400, 1), shapes::soup(400, 2)},
                             {"cube", shapes::box(), moved(shapes::box(), shift(0.1, 0.05, 0))}};
    for (const char* name : {"bunny13", "cad"}) {
        const Bytes bytes = write_asset(make_sample(name, {}), {}, {}).bytes;
        all.push_back(simplified(name, {.asset = {.path = "a.glb", .bytes = bytes}}));
    }
    if (!asset_folder()) return all;
    for (const char* file :
         {"models/bunny-2503.obj", "models/cow.obj", "models/suzanne.obj", "models/fandisk.obj"}) {
        all.push_back(simplified(file, load_asset(file).upload()));
    }
    return all;
}

TEST(AgainstCgal, nearest_points_are_as_far) {
    for (const Pair& pair : pairs()) {
        SCOPED_TRACE(pair.name);
        Surface to = make_surface(pair.candidate, {});
        const Surface from = make_surface(pair.reference, {});
        const Bvh bvh(to, 2, {});
        std::vector<Vec3d> points = from.positions;
        const AreaSamples samples(from, 20'000, 1, {});
        samples.visit(0, samples.count(), [&](const SurfaceSample& sample) {
            const auto [a, b, c] = from.corners(sample.triangle);
            points.push_back(interpolate(sample.weights, a, b, c));
        });
        const std::vector<double> expected = cgal_distances(pair.candidate, points);
        const double tolerance = 1e-9 * from.bounds.diagonal();
        double largest_difference = 0;
        for (size_t i = 0; i < points.size(); ++i)
            largest_difference =
                std::max(largest_difference, std::abs(bvh.nearest(points[i]).distance() - expected[i]));
        EXPECT_LE(largest_difference, tolerance);
    }
}

TEST(AgainstCgal, bounds_of_the_largest_distance_hold_theirs) {
    size_t compared = 0;
    for (const Pair& pair : pairs()) {
        SCOPED_TRACE(pair.name);
        Surface to = make_surface(pair.candidate, {});
        const Surface from = make_surface(pair.reference, {});
        const Bvh bvh(to, 2, {});
        const double tolerance = 1e-3 * from.bounds.diagonal();
        const auto theirs = cgal_one_sided_hausdorff(pair.reference, pair.candidate, tolerance);
        if (!theirs) continue;
        ++compared;
        const DistanceBounds bounds = distance_bounds(from, bvh, tolerance, 2, {});
        EXPECT_LE(*theirs, bounds.upper + tolerance);
        EXPECT_GE(*theirs, bounds.lower - tolerance);
        EXPECT_LE(bounds.upper - bounds.lower, tolerance * (1 + 1e-9));
    }
    EXPECT_GE(compared, 4);
}

TEST(AgainstCgal, self_intersections_are_as_many) {
    std::vector<Mesh> meshes;
    for (const Pair& pair : pairs()) {
        meshes.push_back(pair.reference);
        meshes.push_back(pair.candidate);
    }
    for (Mesh mesh :
         {shapes::tetrahedron(), shapes::box({.faceted = false}), shapes::sphere({.normals = false})}) {
        append(mesh, moved(mesh, shift(0.25, 0.25, 0.125)));  // touches in corners and planes as well
        meshes.push_back(mesh);
    }
    uint64_t all = 0;
    size_t compared = 0;
    for (const Mesh& mesh : meshes) {
        const auto theirs = cgal_self_intersections(mesh);
        if (!theirs) continue;
        ++compared;
        Surface surface = make_surface(mesh, {});
        const Bvh bvh(surface, 2, {});
        const uint64_t ours = find_self_intersections(surface, bvh, 2, {}).pairs;
        EXPECT_EQ(ours, *theirs) << mesh.name << ", " << mesh.triangle_count() << " triangles";
        all += ours;
    }
    EXPECT_GE(compared, 6);
    EXPECT_GT(all, 100);
}

}  // namespace
}  // namespace coppice::test
