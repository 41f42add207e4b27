#include "core/sample/parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/sample/builder.h"

namespace coppice {

namespace {

constexpr double tau = 2 * std::numbers::pi;

// Distance from the axis to the side of a hexagon whose flats are at distance 0.8.
double hexagon_radius(double angle) {
    const double sixth = tau / 6;
    return 0.8 / std::cos(angle - sixth * std::floor(angle / sixth) - sixth / 2);
}

// A band of a turned part: from one profile line to the next, each a radius and a height at an angle. The
// profile runs so that the outside is on its right: from the axis below, outwards, up, and back to the axis.
struct Band {
    uint32_t rows = 1;
    uint32_t smoothing = flat;
    bool planar_uv = false;  // a cap or shoulder, seen along the axis; else unrolled
    double u0 = 0, v0 = 0;   // corner of its chart, which is 0.5 x 0.25
    std::function<std::array<double, 2>(double s, double angle)> profile;  // -> radius, height
};

void add_band(MeshBuilder& builder, uint32_t slot, uint32_t segments, const Band& band) {
    builder.patch(slot, band.rows, segments, [&](uint32_t row, uint32_t column) {
        const double s = static_cast<double>(row) / band.rows;
        const double angle = tau * ((segments - column) % segments) / segments;
        const auto [radius, height] = band.profile(s, angle);
        const double x = radius * std::cos(angle), y = radius * std::sin(angle);
        const double u = band.planar_uv ? 0.25 + 0.25 * x : 0.5 * column / segments;
        const double v = band.planar_uv ? 0.125 + 0.125 * y : 0.25 * s;
        return Corner{
            .position = {x, y, height}, .u = band.u0 + u, .v = band.v0 + v, .smoothing = band.smoothing};
    });
}

}  // namespace

Mesh bolt_mesh(uint32_t triangles, uint32_t material) {
    MeshBuilder builder("bolt");
    const uint32_t slot = builder.add_slot(material);
    const auto segments = static_cast<uint32_t>(6 * std::max(1L, std::lround(std::sqrt(triangles) / 10)));
    // Everything but the shank takes 6 triangles a segment: two caps, the shoulder, the side of the head.
    const auto rows = static_cast<uint32_t>(std::max(1L, std::lround((1.0 * triangles / segments - 6) / 2)));
    const auto thread = [](double s, double angle) {
        const double fade = std::min(1.0, 4 * std::min(s, 1 - s));
        return 0.45 + 0.05 * fade * std::sin(angle - 7 * tau * s);
    };
    add_band(builder, slot, segments, {.planar_uv = true, .profile = [](double s, double) {
                                           return std::array{0.45 * s, 0.0};
                                       }});
    add_band(builder, slot, segments,
             {.rows = rows, .smoothing = 1, .v0 = 0.25, .profile = [&](double s, double angle) {
                  return std::array{thread(s, angle), 2.4 * s};
              }});
    add_band(builder, slot, segments, {.planar_uv = true, .u0 = 0.5, .profile = [](double s, double angle) {
                                           return std::array{std::lerp(0.45, hexagon_radius(angle), s), 2.4};
                                       }});
    add_band(builder, slot, segments, {.u0 = 0.5, .v0 = 0.25, .profile = [](double s, double angle) {
                                           return std::array{hexagon_radius(angle), 2.4 + 0.6 * s};
                                       }});
    add_band(builder, slot, segments, {.planar_uv = true, .v0 = 0.5, .profile = [](double s, double angle) {
                                           return std::array{hexagon_radius(angle) * (1 - s), 3.0};
                                       }});
    return builder.finish();
}

namespace {

constexpr double plate_half = 2, plate_thickness = 0.3, hole_radius = 0.5;

// Around a cell of the plate: i-th of 4 * side points on its square, from the lower right corner on, and on
// its hole.
struct Cell {
    Vec3d centre;
    uint32_t side = 1;

    Vec3d square(uint32_t i) const {
        const double along = -1 + 2.0 * (i % side) / side;
        const std::array<Vec3d, 4> edges = {
            Vec3d{1, along, 0}, {-along, 1, 0}, {-1, -along, 0}, {along, -1, 0}};
        return centre + edges[(i / side) % 4];
    }
    Vec3d hole(uint32_t i) const {
        const double angle = tau * ((i % (4 * side)) / (4.0 * side) - 0.125);
        return centre + Vec3d{hole_radius * std::cos(angle), hole_radius * std::sin(angle), 0};
    }
};

void add_plate_cell(MeshBuilder& builder, uint32_t slot, const Cell& cell, uint32_t smoothing) {
    const Vec3d up = {0, 0, plate_thickness};
    const auto face = [&](Vec3d p, double u0) {
        return Corner{.position = p,
                      .u = u0 + 0.06 * (p.x + plate_half),
                      .v = 0.12 * (p.y + plate_half),
                      .smoothing = flat};
    };
    builder.patch(slot, 1, 4 * cell.side, [&](uint32_t row, uint32_t i) {
        return face((row == 0 ? cell.hole(i) : cell.square(i)) + up, 0);
    });
    builder.patch(slot, 1, 4 * cell.side, [&](uint32_t row, uint32_t i) {
        return face(row == 0 ? cell.square(i) : cell.hole(i), 0.25);
    });
    builder.patch(slot, 1, 4 * cell.side, [&](uint32_t row, uint32_t i) {
        return Corner{.position = cell.hole(i) + up * row,
                      .u = 0.5 + 0.4 * i / (4 * cell.side),
                      .v = 0.1 * smoothing + 0.08 * row,
                      .smoothing = smoothing};
    });
}

void add_plate_sides(MeshBuilder& builder, uint32_t slot, uint32_t steps) {
    const std::array<Vec3d, 4> corners = {Vec3d{1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}};
    for (uint32_t side = 0; side < 4; ++side) {
        const Vec3d from = corners[side] * plate_half, to = corners[(side + 1) % 4] * plate_half;
        builder.patch(slot, steps, 1, [&](uint32_t row, uint32_t column) {
            const double s = static_cast<double>(row) / steps;
            return Corner{.position = from * (1 - s) + to * s + Vec3d{0, 0, plate_thickness * column},
                          .u = 0.5 + 0.4 * s,
                          .v = 0.55 + 0.1 * side + 0.08 * column,
                          .smoothing = flat};
        });
    }
}

}  // namespace

Mesh plate_mesh(uint32_t triangles, uint32_t material) {
    MeshBuilder builder("plate");
    const uint32_t slot = builder.add_slot(material);
    const auto side =
        static_cast<uint32_t>(std::max(1L, std::lround(triangles / 112.0)));  // 96 in cells, 16 in sides
    uint32_t smoothing = 0;
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) add_plate_cell(builder, slot, {{x, y, 0}, side}, ++smoothing);
    }
    add_plate_sides(builder, slot, 2 * side);
    return builder.finish();
}

namespace {

// The L as cells of a grid, which are then extruded along y.
struct LShape {
    uint32_t thick = 2;  // cells across a leg
    uint32_t leg = 1;    // cells along a leg, beyond the corner
    uint32_t depth = 1;  // cells along y

    bool has(int64_t x, int64_t z) const {
        const int64_t end = thick + leg;
        return x >= 0 && z >= 0 && x < end && z < end && (x < thick || z < thick);
    }
    double coordinate(uint32_t i) const {  // 0.4 across a leg, 3 long
        return i <= thick ? 0.4 * i / thick : 0.4 + 2.6 * (i - thick) / leg;
    }
    Vec3d point(uint32_t x, uint32_t y, uint32_t z) const {
        const double across = 2.0 * y / depth;
        const double bow = 0.08 * std::sin(std::numbers::pi * y / depth);
        return {coordinate(x) * (1 + 0.2 * across) + bow, across, coordinate(z) + bow};
    }
};

void add_bracket_ends(MeshBuilder& builder, uint32_t slot, const LShape& shape, uint32_t x, uint32_t z) {
    const auto corner = [&](uint32_t i, uint32_t y, uint32_t k) {
        const Vec3d p = shape.point(i, y, k);
        return Corner{.position = p, .u = (y == 0 ? 0 : 0.5) + 0.1 * p.x, .v = 0.13 * p.z, .smoothing = flat};
    };
    const uint32_t far = shape.depth;
    builder.quad(slot, corner(x, 0, z), corner(x + 1, 0, z), corner(x + 1, 0, z + 1), corner(x, 0, z + 1));
    builder.quad(slot, corner(x, far, z), corner(x, far, z + 1), corner(x + 1, far, z + 1),
                 corner(x + 1, far, z));
}

// The wall along y over one edge of the L's outline; the outside is where y cross (to - from) points.
void add_bracket_wall(MeshBuilder& builder, uint32_t slot, const LShape& shape, std::array<uint32_t, 2> from,
                      std::array<uint32_t, 2> to, uint32_t face) {
    builder.patch(slot, shape.depth, 1, [&](uint32_t y, uint32_t end) {
        const auto [x, z] = end == 0 ? from : to;
        const double along = (face % 2 == 0 ? shape.coordinate(x) : shape.coordinate(z)) / 3.0;
        return Corner{.position = shape.point(x, y, z),
                      .u = 0.24 * (face % 4) + 0.22 * along,
                      .v = 0.5 + 0.24 * (face / 4) + 0.2 * y / shape.depth,
                      .smoothing = face};
    });
}

}  // namespace

Mesh bracket_mesh(uint32_t triangles, uint32_t material) {
    MeshBuilder builder("bracket");
    const uint32_t slot = builder.add_slot(material);
    LShape shape;
    shape.leg = static_cast<uint32_t>(std::max(1L, std::lround(std::sqrt(triangles / 12.0))));
    const double ends = 16.0 * (1 + shape.leg), row = 8.0 * (2 + shape.leg);
    shape.depth = static_cast<uint32_t>(std::max(1L, std::lround((triangles - ends) / row)));

    const uint32_t size = shape.thick + shape.leg;
    for (uint32_t x = 0; x < size; ++x) {
        for (uint32_t z = 0; z < size; ++z) {
            if (!shape.has(x, z)) continue;
            add_bracket_ends(builder, slot, shape, x, z);
            const uint32_t inner =
                x >= shape.thick || z >= shape.thick ? 4 : 0;  // inside of the L: charts of its own
            if (!shape.has(x, int64_t{z} - 1)) add_bracket_wall(builder, slot, shape, {x, z}, {x + 1, z}, 0);
            if (!shape.has(int64_t{x} + 1, z))
                add_bracket_wall(builder, slot, shape, {x + 1, z}, {x + 1, z + 1},
                                 1 + (x + 1 < size ? inner : 0));
            if (!shape.has(x, int64_t{z} + 1))
                add_bracket_wall(builder, slot, shape, {x + 1, z + 1}, {x, z + 1},
                                 2 + (z + 1 < size ? inner : 0));
            if (!shape.has(int64_t{x} - 1, z)) add_bracket_wall(builder, slot, shape, {x, z + 1}, {x, z}, 3);
        }
    }
    return builder.finish();
}

}  // namespace coppice
