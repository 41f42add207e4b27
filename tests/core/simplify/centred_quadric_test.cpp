#include "core/simplify/attribute_quadric/centred_quadric.h"

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

TEST(CentredQuadric, is_never_negative_where_rounding_would_make_it) {
    const Plane plane = {{1, 2, 3}, {0, 0, 0}, 1};
    const Vec3f along = to_float(normalized(cross(Vec3d{1, 2, 3}, Vec3d{0, 1, 0})));
    const CentredQuadric q = quadric_of(plane).seen_from({100, -30, 20});
    for (int i = 0; i < 100; ++i)
        EXPECT_GE(q(Vec3f{100, -30, 20} + along * static_cast<float>(i)), 0) << "step " << i;
}

TEST(CentredQuadricLeast, of_three_planes_is_where_they_meet) {
    const std::vector<Plane> planes = {
        {{1, 0, 0}, {0.5, 9, 9}, 1}, {{0, 1, 0}, {9, -0.25, 9}, 4}, {{1, 0, 1}, {0.5, 9, 0.75}, 0.5}};
    const auto p = least_point(sum_of(planes), 0, {}, {});
    ASSERT_TRUE(p);
    EXPECT_NEAR(length(to_double(*p) - Vec3d{0.5, -0.25, 0.75}), 0, 1e-5);
}

TEST(CentredQuadricLeast, of_many_planes_is_least_of_all_points) {
    const auto p = least_point(sum_of(slanting), 0, {}, {});
    ASSERT_TRUE(p);
    const double least = squared_distances(slanting, to_double(*p));
    std::mt19937 random(1);
    const auto number = [&random] { return static_cast<double>(random() % 2001) / 1000 - 1; };
    for (int i = 0; i < 1000; ++i) {
        const double x = number(), y = number(), z = number();
        EXPECT_GE(squared_distances(slanting, {x, y, z}), least - 1e-7);
    }
}

TEST(CentredQuadricLeast, keeps_a_condition_and_is_the_least_point_that_does) {
    const Constraint keep = {{0.4F, -0.3F, 0.6F}, 0.5F};
    const Vec3d normal = to_double(keep.normal);
    for (const double spring : {0.0, 0.5}) {
        const Vec3d rest = {0.3, -0.4, 0.2};
        const auto p = least_point(sum_of(slanting), static_cast<float>(spring), to_float(rest), keep);
        ASSERT_TRUE(p);
        EXPECT_NEAR(dot(keep.normal, *p), keep.offset, 1e-5);
        const auto error = [&](Vec3d at) {
            return squared_distances(slanting, at) + spring * squared_length(at - rest);
        };
        const Vec3d side = normalized(cross(normal, Vec3d{0, 0, 1})), up = normalized(cross(normal, side));
        for (int i = -10; i <= 10; ++i) {
            for (int j = -10; j <= 10; ++j) {
                if (i == 0 && j == 0) continue;
                const Vec3d other = to_double(*p) + side * (0.05 * i) + up * (0.05 * j);
                EXPECT_GT(error(other), error(to_double(*p))) << i << ' ' << j << " spring " << spring;
            }
        }
    }
}

TEST(CentredQuadricLeast, is_nowhere_where_planes_leave_a_line_or_a_plane_free) {
    EXPECT_FALSE(least_point(CentredQuadric{}, 0, {}, {}));
    EXPECT_FALSE(least_point(sum_of({{{1, 0, 0}, {1, 0, 0}}}), 0, {}, {}));
    EXPECT_FALSE(least_point(sum_of({{{1, 0, 0}, {1, 0, 0}}, {{0, 1, 0}, {0, 1, 0}}}), 0, {}, {}));
}

TEST(CentredQuadricLeast, is_pulled_to_rest_where_planes_do_not_decide) {
    const auto p = least_point(sum_of({{{1, 0, 0}, {1, 0, 0}}}), 1e-3F, {0.25F, 0.5F, -0.5F}, {});
    ASSERT_TRUE(p);
    EXPECT_NEAR(p->x, 1, 1e-3);  // 0.75 / 1001 short of it
    EXPECT_NEAR(p->y, 0.5, 1e-3);
    EXPECT_NEAR(p->z, -0.5, 1e-3);
}

}  // namespace
}  // namespace coppice
