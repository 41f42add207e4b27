// A few unique buildings with windows set into their walls, placed many times along streets.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/random.h"
#include "core/sample/builder.h"
#include "core/sample/scenes.h"
#include "core/sample/texture.h"

namespace coppice {

namespace {

constexpr uint32_t kinds_of_buildings = 6;

struct Building {
    uint32_t columns = 3, rows = 3, floors = 5;  // windows along x and y, and upwards
    double cell = 1;                             // width of a window's piece of wall
    double storey = 1.2;
    double taper = 0;  // how much narrower the top is

    double height() const { return storey * floors; }
    Vec3d shaped(Vec3d p) const {
        const double narrow = 1 - taper * p.z / height();
        return {p.x * narrow, p.y * narrow, p.z};
    }
};

struct Slots {
    uint32_t wall, glass, roof;
};

// One side: starts at `origin` (lower left, seen from outside) and runs to the right for `columns` cells.
struct Facade {
    const Building& building;
    Vec3d origin, right, outward;
    uint32_t columns, side;

    // x, z in cells and storeys; in: how far set back
    Corner wall(double x, double z, double in) const {
        return {.position = at(x, z, in),
                .u = 0.25 * (side + x / columns),
                .v = 1 - z / building.floors + 0.01 * in,
                .smoothing = flat};
    }
    Corner glass(double x, double z, double in) const {
        return {.position = at(x, z, in), .u = x - std::floor(x), .v = z - std::floor(z), .smoothing = flat};
    }
    Vec3d at(double x, double z, double in) const {
        return building.shaped(origin + right * (x * building.cell) + Vec3d{0, 0, z * building.storey} -
                               outward * in);
    }
};

void add_window(MeshBuilder& builder, const Slots& slots, const Facade& facade, uint32_t column,
                uint32_t floor) {
    constexpr double frame = 0.2, depth = 0.15;
    // Around the cell: its corners and the middles of its sides.
    constexpr std::array<double, 8> around_x = {0, 0.5, 1, 1, 1, 0.5, 0, 0};
    constexpr std::array<double, 8> around_z = {0, 0, 0, 0.5, 1, 1, 1, 0.5};
    const auto inset = [](double c) { return frame + (1 - 2 * frame) * c; };
    for (size_t i = 0; i < 8; ++i) {
        const size_t j = (i + 1) % 8;
        const auto outer = [&](size_t k) {
            return facade.wall(column + around_x[k], floor + around_z[k], 0);
        };
        const auto inner = [&](size_t k, double in) {
            return facade.wall(column + inset(around_x[k]), floor + inset(around_z[k]), in);
        };
        builder.quad(slots.wall, outer(i), outer(j), inner(j, 0), inner(i, 0));
        builder.quad(slots.wall, inner(i, 0), inner(j, 0), inner(j, depth), inner(i, depth));
    }
    builder.patch(slots.glass, 2, 2, [&](uint32_t row, uint32_t c) {  // rows to the right, columns upwards
        return facade.glass(column + inset(0.5 * row), floor + inset(0.5 * c), depth);
    });
}

void add_lid(MeshBuilder& builder, uint32_t slot, const Building& building, double z, bool up) {
    const uint32_t rows = 2 * building.columns, columns = 2 * building.rows;  // to meet the walls' vertices
    builder.patch(slot, rows, columns, [&](uint32_t row, uint32_t column) {
        const double x = 0.5 * (up ? row : rows - row) - 0.5 * building.columns;
        const double y = 0.5 * column - 0.5 * building.rows;
        return Corner{.position = building.shaped({x * building.cell, y * building.cell, z}),
                      .u = 0.5 + x / building.columns,
                      .v = 0.5 + y / building.rows,
                      .smoothing = flat};
    });
}

Mesh building_mesh(const std::string& name, const Building& building, std::array<uint32_t, 3> materials) {
    MeshBuilder builder(name);
    const Slots slots = {builder.add_slot(materials[0]), builder.add_slot(materials[1]),
                         builder.add_slot(materials[2])};
    const double x = 0.5 * building.columns * building.cell, y = 0.5 * building.rows * building.cell;
    const std::array facades = {
        Facade{building, {-x, -y, 0}, {1, 0, 0}, {0, -1, 0}, building.columns, 0},
        Facade{building, {x, -y, 0}, {0, 1, 0}, {1, 0, 0}, building.rows, 1},
        Facade{building, {x, y, 0}, {-1, 0, 0}, {0, 1, 0}, building.columns, 2},
        Facade{building, {-x, y, 0}, {0, -1, 0}, {-1, 0, 0}, building.rows, 3},
    };
    for (const Facade& facade : facades) {
        for (uint32_t floor = 0; floor < building.floors; ++floor) {
            for (uint32_t c = 0; c < facade.columns; ++c) add_window(builder, slots, facade, c, floor);
        }
    }
    add_lid(builder, slots.roof, building, building.height(), true);
    add_lid(builder, slots.roof, building, 0, false);
    return builder.finish();
}

// Of the buildings with that many columns, the one whose triangles come closest.
Building design(Random& random, uint32_t triangles) {
    Building best{.columns = triangles < 1000 ? 1 + random.below(2) : 2 + random.below(4)};
    double best_off = std::numeric_limits<double>::infinity();
    for (uint32_t rows = 1; rows <= 5; ++rows) {
        const double storey = 80.0 * (best.columns + rows), lids = 16.0 * best.columns * rows;  // 40 a window
        const auto floors = static_cast<uint32_t>(std::max(1L, std::lround((triangles - lids) / storey)));
        const double off = std::abs(lids + storey * floors - triangles);
        if (off >= best_off) continue;
        best_off = off;
        best.rows = rows;
        best.floors = floors;
    }
    best.cell = random.uniform(0.8, 1.2);
    const bool tapers = random.below(2) == 1;
    best.taper = tapers ? random.uniform(0.1, 0.4) : 0;
    return best;
}

Mesh street_mesh(double size, uint32_t material) {
    MeshBuilder builder("street");
    constexpr uint32_t cells = 24;
    builder.patch(builder.add_slot(material), cells, cells, [&](uint32_t row, uint32_t column) {
        const double u = static_cast<double>(row) / cells, v = static_cast<double>(column) / cells;
        return Corner{.position = {(u - 0.5) * size, (v - 0.5) * size, 0}, .u = u, .v = v, .smoothing = flat};
    });
    return builder.finish();
}

Rgb brick_colour(double u, double v) {
    const double row = std::floor(v * 64), x = u * 32 + (static_cast<int>(row) % 2) * 0.5;
    const bool mortar = v * 64 - row < 0.15 || x - std::floor(x) < 0.08;
    const double tone = noise(u, v, 32, 51);
    return mortar ? Rgb{0.7, 0.68, 0.64} : Rgb{0.5 + 0.2 * tone, 0.25 + 0.1 * tone, 0.2 + 0.08 * tone};
}

Rgb concrete_colour(double u, double v) {
    const double grain = noise(u, v, 64, 52), damp = noise(u, v, 6, 53);
    return {0.6 + 0.1 * grain - 0.1 * damp, 0.6 + 0.1 * grain - 0.1 * damp, 0.58 + 0.1 * grain - 0.09 * damp};
}

Rgb glass_colour(double u, double v) {
    const double sky = 0.5 + 0.5 * (1 - v) * noise(u, v, 4, 54);
    return {0.25 * sky, 0.4 * sky, 0.6 * sky};
}

Rgb tar_colour(double u, double v) {
    const double grain = noise(u, v, 64, 55);
    return {0.2 + 0.12 * grain, 0.2 + 0.12 * grain, 0.22 + 0.12 * grain};
}

}  // namespace

Scene make_city(const SampleSize& size) {
    Scene scene;
    const uint32_t brick = add_material(scene, {.name = "brick", .colour = brick_colour});
    const uint32_t concrete = add_material(scene, {.name = "concrete", .colour = concrete_colour});
    const uint32_t glass = add_material(
        scene, {.name = "glass", .metallic = 0.3F, .roughness = 0.1F, .size = 64, .colour = glass_colour});
    const uint32_t tar = add_material(scene, {.name = "tar", .colour = tar_colour});

    Random random(size.seed);
    for (uint32_t i = 0; i < kinds_of_buildings; ++i) {
        const Building building = design(random, size.triangles);
        add_mesh(scene, building_mesh("building-" + std::to_string(i + 1), building,
                                      {i % 2 == 0 ? brick : concrete, glass, tar}));
    }
    const auto side = static_cast<uint32_t>(std::ceil(std::sqrt(size.copies)));
    const double lot = 9;
    const uint32_t street = add_mesh(scene, street_mesh(lot * (side + 1), tar));

    const uint32_t root = add_node(scene, "city", {});
    add_node(scene, "street", {}, street, root);
    uint32_t block = root;
    for (uint32_t i = 0; i < size.copies; ++i) {
        const uint32_t row = i / side;
        if (i % side == 0)
            block = add_node(scene, "block-" + std::to_string(row + 1),
                             translation({0, lot * (row - 0.5 * (side - 1)), 0}), {}, root);
        const double setback = random.uniform(-1, 1), turn = std::numbers::pi / 2 * random.below(4);
        const double height = random.uniform(0.6, 1.6);
        const uint32_t kind = random.below(kinds_of_buildings);
        add_node(scene, "house-" + std::to_string(i + 1),
                 translation({lot * (i % side - 0.5 * (side - 1)), setback, 0}) * rotation({0, 0, 1}, turn) *
                     scaling({1, 1, height}),
                 kind, block);
    }
    return scene;
}

}  // namespace coppice
