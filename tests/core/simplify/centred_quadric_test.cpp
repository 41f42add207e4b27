#include "core/simplify/attribute_quadric/centred_quadric.h"
#include "core/simplify/attribute_quadric/lanes.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace coppice {
namespace {

// A plane through `point`, seen from the origin.
struct Plane {
    Vec3d normal, point;
    double weight = 1;

    double squared_distance(Vec3d p) const {
        const double distance = dot(normalized(normal), p - point);
        return distance * distance;
    }
};

CentredQuadric quadric_of(const Plane& plane) {
    CentredQuadric q;
    q.add_square(to_float(normalized(plane.normal)), static_cast<float>(plane.weight));
    q.weight = static_cast<float>(plane.weight);
    return q.seen_from(to_float(plane.point));
}

CentredQuadric sum_of(const std::vector<Plane>& planes) {
    CentredQuadric sum;
    for (const Plane& plane : planes) sum += quadric_of(plane);
    return sum;
}

double squared_distances(const std::vector<Plane>& planes, Vec3d p) {
    double sum = 0;
    for (const Plane& plane : planes) sum += plane.weight * plane.squared_distance(p);
    return sum;
}

const std::vector<Vec3d> places = {{0, 0, 0}, {0.3, -0.2, 0.1}, {-0.7, 0.4, 0.9}, {1, 1, -1}};

const std::vector<Plane> slanting = {{{1, 0.2, -0.1}, {0.2, 0.1, 0}, 1},
                                     {{-0.3, 1, 0.4}, {0, 0.4, -0.1}, 0.5},
                                     {{0.1, -0.2, 1}, {-0.1, 0, 0.3}, 2},
                                     {{1, 1, 1}, {0.1, 0.2, 0.5}, 0.7}};

TEST(CentredQuadric, of_a_plane_is_the_squared_distance_from_wherever_it_is_seen) {
    const Plane plane = {{1, 2, -2}, {0.4, -0.3, 0.6}, 3};
    const CentredQuadric q = quadric_of(plane);
    for (const Vec3d from : places) {
        const CentredQuadric moved = q.seen_from(to_float(from * -1));
        for (const Vec3d at : places)
            EXPECT_NEAR(moved(to_float(at)), 3 * plane.squared_distance(from + at), 1e-5);
    }
}

TEST(CentredQuadric, there_and_back_again_is_what_it_was) {
    const CentredQuadric q = sum_of(slanting);
    const CentredQuadric back = q.seen_from({0.5F, -0.25F, 1}).seen_from({-0.5F, 0.25F, -1});
    for (const Vec3d at : places) EXPECT_NEAR(back(to_float(at)), q(to_float(at)), 1e-5);
    EXPECT_EQ(back.weight, q.weight);
}

TEST(CentredQuadric, of_several_planes_is_their_sum) {
    const CentredQuadric q = sum_of(slanting);
    EXPECT_FLOAT_EQ(q.weight, 4.2F);
    for (const Vec3d at : places) EXPECT_NEAR(q(to_float(at)), squared_distances(slanting, at), 1e-5);
}

TEST(CentredQuadric, is_next_to_nothing_on_its_plane) {
    const Plane plane = {{1, 2, 3}, {0, 0, 0}, 1};
    const Vec3f along = to_float(normalized(cross(Vec3d{1, 2, 3}, Vec3d{0, 1, 0})));
    const CentredQuadric q = quadric_of(plane).seen_from({100, -30, 20});
    for (int i = 0; i < 100; ++i)
        EXPECT_NEAR(q(Vec3f{100, -30, 20} + along * static_cast<float>(i)), 0, 0.1) << "step " << i;
}

// Long enough that nothing here is far away; the spring to its middle is weak.
constexpr Vec3f edge = {4, 0, 0};

TEST(CentredQuadricLeast, of_three_planes_is_where_they_meet) {
    const std::vector<Plane> planes = {
        {{1, 0, 0}, {0.5, 9, 9}, 1}, {{0, 1, 0}, {9, -0.25, 9}, 4}, {{1, 0, 1}, {0.5, 9, 0.75}, 0.5}};
    const Vec3f p = least_point<float>(sum_of(planes), edge, nullptr);
    EXPECT_NEAR(length(to_double(p) - Vec3d{0.5, -0.25, 0.75}), 0, 0.01);
}

TEST(CentredQuadricLeast, keeps_a_condition_and_is_the_least_point_that_does) {
    const Constraint<float> keep = {{0.4F, -0.3F, 0.6F}, 0.5F};
    const Vec3f p = least_point(sum_of(slanting), edge, &keep);
    EXPECT_NEAR(dot(keep.normal, p), keep.offset, 1e-5);
    const double spring = double{spring_of_weight} * double{sum_of(slanting).weight};
    const auto error = [&](Vec3d at) {
        return squared_distances(slanting, at) + spring * squared_length(at - Vec3d{2, 0, 0});
    };
    const Vec3d side = normalized(cross(to_double(keep.normal), Vec3d{0, 0, 1}));
    const Vec3d up = normalized(cross(to_double(keep.normal), side));
    for (int i = -10; i <= 10; ++i) {
        for (int j = -10; j <= 10; ++j) {
            if (i == 0 && j == 0) continue;
            const Vec3d other = to_double(p) + side * (0.05 * i) + up * (0.05 * j);
            EXPECT_GT(error(other), error(to_double(p))) << i << ' ' << j;
        }
    }
}

TEST(CentredQuadricLeast, is_on_the_plane_and_near_the_middle_where_planes_leave_it_free) {
    const Vec3f p = least_point<float>(sum_of({{{1, 0, 0}, {1, 0, 0}, 1}}), {1, 2, -2}, nullptr);
    EXPECT_NEAR(p.x, 1, 1e-3);
    EXPECT_NEAR(p.y, 1, 1e-3);
    EXPECT_NEAR(p.z, -1, 1e-3);
}

TEST(CentredQuadricLeast, is_the_best_of_the_edge_where_planes_meet_far_away) {
    const std::vector<Plane> nearly_parallel = {{{0, 0, 1}, {0, 0, 0.1}, 1}, {{0.02, 0, 1}, {0, 0, -0.5}, 1}};
    const CentredQuadric q = sum_of(nearly_parallel);
    const Vec3f end = {0.1F, 0, 0.05F}, p = least_point<float>(q, end, nullptr);
    EXPECT_EQ(p, best_of_edge(q, end));
    EXPECT_EQ(least_point<float>(CentredQuadric{}, end, nullptr), best_of_edge(CentredQuadric{}, end));
}

TEST(CentredQuadricLeast, is_the_same_for_four_at_once) {
    std::array<CentredQuadric, lane_count> quadrics;
    Vec3<Lanes> offset;
    std::array<Vec3f, lane_count> single;
    for (uint32_t i = 0; i < lane_count; ++i) {
        quadrics[i] = sum_of(slanting).seen_from({0.1F * static_cast<float>(i), 0.2F, -0.3F});
        const Vec3f end = {1, static_cast<float>(i), 0.5F};
        offset.x[i] = end.x, offset.y[i] = end.y, offset.z[i] = end.z;
        single[i] = least_point<float>(quadrics[i], end, nullptr);
    }
    const Vec3<Lanes> all = least_point<Lanes>(together(quadrics), offset, nullptr);
    for (uint32_t i = 0; i < lane_count; ++i)
        EXPECT_EQ((Vec3f{all.x[i], all.y[i], all.z[i]}), single[i]) << "lane " << i;
}

}  // namespace
}  // namespace coppice
