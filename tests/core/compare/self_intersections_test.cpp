#include "core/compare/self_intersections.h"

#include <gtest/gtest.h>

#include <random>

#include "core/base/error.h"
#include "core/compare/orientation.h"
#include "core/compare/triangle_contact.h"
#include "tests/core/compare/meshes.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

using test::mesh_of;

SelfIntersections find(const Mesh& mesh, unsigned threads = 2) {
    Surface surface = make_surface(mesh, {});
    const Bvh bvh(surface, threads, {});
    return find_self_intersections(surface, bvh, threads, {});
}

__extension__ using Wide = __int128;

int sign_of(Wide value) {
    return value > 0 ? 1 : (value < 0 ? -1 : 0);
}

// Whole numbers of few digits scaled by a power of two, so that 128 bits hold the determinant; half of the
// points are put into one plane, where rounding would decide.
TEST(Orientation, has_the_sign_that_whole_numbers_have) {
    std::mt19937 random(5);
    std::uniform_int_distribution<int64_t> number(-8'000'000, 8'000'000);
    int zeros = 0;
    for (int i = 0; i < 20'000; ++i) {
        std::array<std::array<int64_t, 3>, 4> p{};
        for (auto& point : p) point = {number(random), number(random), number(random)};
        if (i % 2 == 0) {  // the middle of two middles
            for (size_t k = 0; k < 3; ++k) {
                for (size_t v = 0; v < 3; ++v) p[v][k] = p[v][k] / 4 * 4;
                p[3][k] = (p[0][k] + p[1][k]) / 4 + p[2][k] / 2;
            }
            if (i % 4 == 0) p[3][2] += 1;
        }
        const auto at = [&](size_t v, size_t k) { return static_cast<Wide>(p[v][k] - p[3][k]); };
        const Wide determinant = at(0, 0) * (at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1)) -
                                 at(0, 1) * (at(1, 0) * at(2, 2) - at(1, 2) * at(2, 0)) +
                                 at(0, 2) * (at(1, 0) * at(2, 1) - at(1, 1) * at(2, 0));
        const auto point = [&](size_t v) {
            return Vec3f{std::ldexp(static_cast<float>(p[v][0]), -30),
                         std::ldexp(static_cast<float>(p[v][1]), -30),
                         std::ldexp(static_cast<float>(p[v][2]), -30)};
        };
        EXPECT_EQ(orientation(point(0), point(1), point(2), point(3)), sign_of(determinant));
        zeros += determinant == 0 ? 1 : 0;
    }
    EXPECT_GT(zeros, 4000);
}

TEST(Orientation, is_exact_over_all_sizes_of_floats) {
    const float tiny = 1e-37F, huge = 1e37F;
    EXPECT_EQ(orientation(Vec3f{0, 0, 0}, {huge, 0, 0}, {0, huge, 0}, {0, 0, -tiny}), 1);
    EXPECT_EQ(orientation(Vec3f{0, 0, 0}, {huge, 0, 0}, {0, huge, 0}, {huge, huge, tiny}), -1);
    EXPECT_EQ(orientation(Vec3f{0, 0, 0}, {huge, 0, 0}, {0, huge, 0}, {tiny, tiny, 0}), 0);
}

TEST(TriangleContact, knows_every_way_in_which_two_triangles_meet) {
    const TriangleCorners t = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
    struct Case {
        const char* what;
        TriangleCorners other;
        bool meets;
    };
    for (const Case& c : std::initializer_list<Case>{
             {"through the inside", {{{1, 1, -1}, {1, 1, 1}, {2, 2, 1}}}, true},
             {"above", {{{1, 1, 1}, {2, 1, 1}, {1, 2, 2}}}, false},
             {"beside, crossing the plane", {{{5, 5, -1}, {5, 5, 1}, {6, 6, 1}}}, false},
             {"touches with a corner", {{{1, 1, 0}, {1, 1, 1}, {2, 2, 1}}}, true},
             {"touches an edge with a corner", {{{2, 0, 0}, {2, -1, 1}, {3, -1, 1}}}, true},
             {"in the plane, apart", {{{5, 5, 0}, {6, 5, 0}, {5, 6, 0}}}, false},
             {"in the plane, within", {{{1, 1, 0}, {1.5F, 1, 0}, {1, 1.5F, 0}}}, true},
             {"in the plane, around", {{{-9, -9, 0}, {30, -9, 0}, {-9, 30, 0}}}, true},
             {"shares a corner, beside", {{{0, 0, 0}, {-4, 0, 0}, {0, -4, 1}}}, false},
             {"shares a corner, cuts through", {{{0, 0, 0}, {4, 4, 1}, {4, 4, -1}}}, true},
             {"shares a corner, lies upon it", {{{0, 0, 0}, {1, 2, 0}, {2, 1, 0}}}, true},
             {"shares an edge, folded up", {{{4, 0, 0}, {0, 0, 0}, {1, 1, 5}}}, false},
             {"shares an edge, flat", {{{4, 0, 0}, {0, 0, 0}, {1, -5, 0}}}, false},
             {"shares an edge, folded back", {{{0, 0, 0}, {4, 0, 0}, {1, 5, 0}}}, true},
             {"the same, turned over", {{{4, 0, 0}, {0, 0, 0}, {0, 4, 0}}}, false},
         }) {
        for (size_t i = 0; i < 3; ++i) {
            const TriangleCorners other = {c.other[i], c.other[(i + 1) % 3], c.other[(i + 2) % 3]};
            EXPECT_EQ(meet_elsewhere(t, other), c.meets) << c.what;
            EXPECT_EQ(meet_elsewhere(other, t), c.meets) << c.what;
        }
    }
}

TEST(SelfIntersections, are_none_on_a_closed_surface) {
    EXPECT_EQ(find(shapes::sphere()).pairs, 0);
    EXPECT_EQ(find(shapes::blob()).pairs, 0);
    EXPECT_EQ(find(shapes::torus()).pairs, 0);
    EXPECT_EQ(find(shapes::fin()).pairs, 0);  // three triangles at an edge are no intersection
}

TEST(SelfIntersections, of_two_tetrahedra_that_run_through_each_other) {
    Mesh pair = shapes::tetrahedron();
    test::append(pair, test::moved(shapes::tetrahedron(), test::shift(0.3, 0.2, 0.1)));
    const SelfIntersections found = find(pair);
    EXPECT_GE(found.pairs, 3);
    EXPECT_LE(found.pairs, 16);
    EXPECT_GE(found.triangles, 4);
    EXPECT_EQ(find(pair, 1).pairs, found.pairs);
}

TEST(SelfIntersections, are_as_many_as_looking_at_every_pair_finds) {
    const Mesh soup = shapes::soup(300);
    const auto corners = [&](size_t t) {
        return TriangleCorners{to_float(soup.corner_position(t, 0)), to_float(soup.corner_position(t, 1)),
                               to_float(soup.corner_position(t, 2))};
    };
    uint64_t expected = 0;
    for (size_t t = 0; t < soup.triangle_count(); ++t) {
        for (size_t u = t + 1; u < soup.triangle_count(); ++u)
            expected += meet_elsewhere(corners(t), corners(u)) ? 1 : 0;
    }
    ASSERT_GT(expected, 100);
    EXPECT_EQ(find(soup).pairs, expected);
}

TEST(SelfIntersections, leave_out_flat_triangles) {
    Mesh mesh = shapes::grid({.columns = 2, .rows = 2});
    test::append(mesh, mesh_of({{0, -1, 0}, {0.5F, 0, 0.5F}, {1, 1, 1}}, {0, 1, 2}));
    EXPECT_EQ(find(mesh).pairs, 0);
}

}  // namespace
}  // namespace coppice
