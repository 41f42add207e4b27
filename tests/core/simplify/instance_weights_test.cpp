#include "core/simplify/instance_weights.h"

#include <gtest/gtest.h>

#include <cmath>

namespace coppice {
namespace {

const Vec3d corners[] = {{0.1, 0.2, 0.3}, {1.3, 0.1, 0.4}, {0.4, 1.2, -0.5}};
const Vec3d away = {0.7, -0.3, 0.9};  // a point off the triangle's plane

double area_times_squared_distance(Vec3d a, Vec3d b, Vec3d c, Vec3d p) {
    const Vec3d twice = cross(b - a, c - a);
    const double distance = dot(normalized(twice), p - a);
    return 0.5 * length(twice) * distance * distance;
}

Vec3d unit_normal() {
    return normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
}

// What the definition says: each instance transformed, one by one.
double summed(const std::vector<Transform>& instances) {
    double sum = 0;
    for (const Transform& t : instances) {
        sum += area_times_squared_distance(t.point(corners[0]), t.point(corners[1]), t.point(corners[2]),
                                           t.point(away));
    }
    return sum;
}

void expect_sum_is_one_number(const std::vector<Transform>& instances) {
    const double alone = area_times_squared_distance(corners[0], corners[1], corners[2], away);
    EXPECT_NEAR(InstanceWeights(instances)(unit_normal()) * alone / summed(instances), 1, 1e-12);
}

Transform scaled(Vec3d by) {
    return from_trs({3, -2, 1}, {0.1, 0.7, -0.2, 0.6}, by);
}

TEST(InstanceWeights, are_the_fourth_power_of_the_scale_of_similarities) {
    const std::vector<Transform> instances = {scaled({2, 2, 2}), scaled({1, 1, 1}), scaled({-3, -3, -3})};
    EXPECT_NEAR(InstanceWeights(instances)({0, 0, 1}), 16 + 1 + 81, 1e-9);
    expect_sum_is_one_number(instances);
}

TEST(InstanceWeights, agree_with_the_sum_over_instances_that_stretch_shear_and_mirror) {
    Transform sheared;
    sheared.m = {1, 0.7, 0, 4, 0, 1.5, -0.3, 0, 0.2, 0, 0.8, 1};
    Transform mirrored;
    mirrored.m = {-1, 0.2, 0, 0, 0, 2, 0, 0, 0, 0.1, 3, 0};
    expect_sum_is_one_number({sheared});
    expect_sum_is_one_number({mirrored, scaled({1, 2, 5}), sheared, sheared, scaled({0.5, 0.5, 0.5})});
}

TEST(InstanceWeights, are_finite_for_instances_without_volume) {
    const std::vector<Transform> flat = {scaled({1, 0, 1}), scaled({0, 0, 0})};
    EXPECT_TRUE(std::isfinite(InstanceWeights(flat)({0, 1, 0})));
    EXPECT_TRUE(std::isfinite(InstanceWeights(flat)({1, 0, 0})));
}

}  // namespace
}  // namespace coppice
