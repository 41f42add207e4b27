#include "core/format/triangulate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace coppice {
namespace {

using testing::ElementsAre;
using Polygon = std::vector<Vec3d>;

std::vector<uint32_t> split(const Polygon& polygon) {
    std::vector<uint32_t> triangles;
    triangulate(polygon, triangles);
    EXPECT_EQ(triangles.size(), 3 * (polygon.size() - 2));
    return triangles;
}

double signed_area(const Polygon& p, const std::vector<uint32_t>& t, size_t i) {
    return 0.5 * cross(p[t[i + 1]] - p[t[i]], p[t[i + 2]] - p[t[i]]).z;
}

// Of a polygon in the plane z = 0: every triangle turns left and together they cover it once.
void expect_covers(const Polygon& polygon, double area) {
    const std::vector<uint32_t> triangles = split(polygon);
    double covered = 0;
    for (size_t i = 0; i < triangles.size(); i += 3) {
        EXPECT_GE(signed_area(polygon, triangles, i), 0) << "triangle " << i / 3;
        covered += signed_area(polygon, triangles, i);
    }
    EXPECT_NEAR(covered, area, 1e-9 * area);
}

TEST(Triangulate, keeps_a_triangle) {
    EXPECT_THAT(split({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), ElementsAre(0, 1, 2));
}

TEST(Triangulate, splits_a_quad_along_its_shorter_diagonal) {
    EXPECT_THAT(split({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 1, 0}}), ElementsAre(0, 1, 3, 1, 2, 3));
    EXPECT_THAT(split({{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {-1, 1, 0}}), ElementsAre(0, 1, 2, 0, 2, 3));
}

TEST(Triangulate, splits_a_concave_quad_inside_whichever_corner_it_starts_at) {
    const Polygon arrow = {{0, 0, 0}, {4, -2, 0}, {1, 0, 0}, {4, 2, 0}};  // reflex at the third
    for (size_t start = 0; start < 4; ++start) {
        Polygon turned;
        for (size_t i = 0; i < 4; ++i) turned.push_back(arrow[(start + i) % 4]);
        expect_covers(turned, 2);
    }
}

TEST(Triangulate, clips_a_star) {
    Polygon star;
    constexpr int points = 9;
    for (int i = 0; i < 2 * points; ++i) {
        const double radius = i % 2 == 0 ? 2 : 0.5, angle = i * std::numbers::pi / points;
        star.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
    expect_covers(star, points * 2 * 0.5 * std::sin(std::numbers::pi / points));
}

TEST(Triangulate, clips_a_comb_with_flat_corners) {
    Polygon comb = {{0, 0, 0}, {10, 0, 0}};
    for (int tooth = 9; tooth >= 0; tooth -= 2) {
        const double x = tooth;
        comb.insert(comb.end(), {{x + 1, 3, 0}, {x, 3, 0}, {x, 1, 0}, {x - 0.5, 1, 0}, {x - 1, 1, 0}});
    }
    comb.resize(comb.size() - 2);
    comb.back() = {0, 1, 0};
    double area = 0;
    for (size_t i = 0; i < comb.size(); ++i) area += 0.5 * cross(comb[i], comb[(i + 1) % comb.size()]).z;
    expect_covers(comb, area);
}

TEST(Triangulate, clips_a_frame_whose_hole_is_bridged) {
    expect_covers({{0, 0, 0},
                   {4, 0, 0},
                   {4, 4, 0},
                   {0, 4, 0},
                   {0, 0, 0},
                   {1, 1, 0},
                   {1, 3, 0},
                   {3, 3, 0},
                   {3, 1, 0},
                   {1, 1, 0}},
                  12);
}

TEST(Triangulate, works_on_any_plane_and_far_from_the_origin) {
    const Polygon l_shape = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    Polygon moved;
    for (const Vec3d& p : l_shape) moved.push_back({1e6 + p.y, 1e6 - p.x, 1e6 + p.x});
    EXPECT_EQ(split(moved), split(l_shape));
}

TEST(Triangulate, gives_the_right_number_for_degenerate_polygons) {
    split({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
    split({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}});
    split({{0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 0}, {0.5, 2, 0}});  // crosses itself
}

TEST(Triangulate, ends_on_a_polygon_of_many_corners) {
    Polygon spiral;
    constexpr int corners = 3000;
    for (int i = 0; i < corners; ++i) {
        const double turn = i < corners / 2 ? i : corners - i, radius = i < corners / 2 ? turn : turn - 0.5;
        spiral.push_back({radius * std::cos(turn / 50), radius * std::sin(turn / 50), 0});
    }
    split(spiral);
}

}  // namespace
}  // namespace coppice
