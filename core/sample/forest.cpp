// A few unique trees, placed many times. Trunk, branches and crowns are closed shapes that reach into each
// other, as trees in real scenes are.
#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/sample/loft.h"
#include "core/sample/scenes.h"
#include "core/sample/texture.h"

namespace coppice {

namespace {

constexpr uint32_t kinds_of_trees = 4;

struct Limb {
    Vec3d from, to;
    double thickness;
};

void add_limb(MeshBuilder& builder, uint32_t slot, uint32_t smoothing, const Limb& limb, double triangles) {
    const Vec3d along = limb.to - limb.from;
    const Vec3d side =
        normalized(cross(along, std::abs(along.z) > std::abs(along.x) ? Vec3d{1, 0, 0} : Vec3d{0, 0, 1}));
    const Vec3d other = normalized(cross(along, side));
    Loft loft{.slot = slot, .smoothing = smoothing};
    fit_triangles(loft, triangles, 2);
    loft.shape = [=](double s, double t) {
        const double angle = 2 * std::numbers::pi * t;
        const double knots = 1 + 0.12 * std::sin(3 * angle + 9 * s) + 0.08 * std::sin(23 * s + 2 * angle);
        const double end = std::sqrt(std::max(0.0, 1 - std::pow(2 * s - 1, 20)));  // rounds both ends off
        const double radius = limb.thickness * (1 - 0.7 * s) * knots * end;
        const Vec3d bend = side * (0.15 * std::sin(std::numbers::pi * s) * limb.thickness * 3);
        return limb.from + along * s + bend + side * (radius * std::cos(angle)) +
               other * (radius * std::sin(angle));
    };
    add_loft(builder, loft);
}

void add_crown(MeshBuilder& builder, uint32_t slot, uint32_t smoothing, Vec3d centre, double radius,
               double phase, double triangles) {
    Loft loft{.slot = slot, .smoothing = smoothing, .chart_columns = 2};
    fit_triangles(loft, triangles, 0.6);
    loft.shape = [=](double s, double t) {
        const Vec3d d = sphere_point(s, t);
        const double leaves =
            std::sin(7 * d.x + phase) * std::sin(6 * d.y - phase) + 0.6 * std::sin(9 * d.z + 3 * d.x);
        const Vec3d shaped = {d.x, d.y, 0.8 * d.z};
        return centre + shaped * (radius * (1 + 0.16 * leaves));
    };
    add_loft(builder, loft);
}

Mesh tree_mesh(const std::string& name, Random random, uint32_t triangles, uint32_t bark, uint32_t leaves) {
    MeshBuilder builder(name);
    const uint32_t wood = builder.add_slot(bark), green = builder.add_slot(leaves);
    const double height = random.uniform(3.5, 6);
    const uint32_t branches = triangles < 400 ? 1 : 3 + random.below(3);
    add_limb(builder, wood, 0, {{0, 0, 0}, {0.2, 0.1, height}, 0.3}, 0.25 * triangles);
    const double top_phase = random.uniform(0, 6);
    add_crown(builder, green, 1, {0.2, 0.1, height}, 1.1, top_phase, 0.25 * triangles);
    for (uint32_t i = 0; i < branches; ++i) {
        const double angle = 2 * std::numbers::pi * (i + random.uniform(0, 0.5)) / branches;
        const double start = height * random.uniform(0.45, 0.7);
        const Vec3d tip = {1.5 * std::cos(angle), 1.5 * std::sin(angle), start + random.uniform(0.4, 1)};
        const double crown = random.uniform(0.7, 1), phase = random.uniform(0, 6);
        const uint32_t smoothing = 2 + 2 * i;
        add_limb(builder, wood, smoothing, {{0.08, 0.04, start}, tip, 0.12}, 0.15 * triangles / branches);
        add_crown(builder, green, smoothing + 1, tip, crown, phase, 0.35 * triangles / branches);
    }
    return builder.finish();
}

double ground_height(double x, double y) {
    return 0.8 * std::sin(0.11 * x) * std::cos(0.09 * y) + 0.3 * std::sin(0.31 * x + 0.2 * y);
}

Mesh ground_mesh(double size, uint32_t cells, uint32_t material) {
    MeshBuilder builder("ground");
    builder.patch(builder.add_slot(material), cells, cells, [&](uint32_t row, uint32_t column) {
        const double u = static_cast<double>(row) / cells, v = static_cast<double>(column) / cells;
        const double x = (u - 0.5) * size, y = (v - 0.5) * size;
        return Corner{.position = {x, y, ground_height(x, y)}, .u = u, .v = v};
    });
    return builder.finish();
}

Rgb bark_colour(double u, double v) {
    const double ridge = noise(u, 0.25 * v, 32, 21) * 0.6 + noise(u, v, 64, 22) * 0.4;
    return {0.25 + 0.25 * ridge, 0.17 + 0.18 * ridge, 0.1 + 0.12 * ridge};
}

Rgb leaf_colour(double u, double v) {
    const double leaf = noise(u, v, 24, 23), vein = noise(u, v, 64, 24);
    return {0.12 + 0.25 * leaf * vein, 0.3 + 0.35 * leaf, 0.08 + 0.1 * vein};
}

Rgb soil_colour(double u, double v) {
    const double grass = noise(u, v, 16, 25), stone = noise(u, v, 64, 26);
    return {0.3 + 0.15 * stone, 0.32 + 0.2 * grass, 0.18 + 0.08 * stone};
}

}  // namespace

Scene make_forest(const SampleSize& size) {
    Scene scene;
    const uint32_t bark = add_material(scene, {.name = "bark", .colour = bark_colour});
    const uint32_t leaves =
        add_material(scene, {.name = "leaves", .double_sided = true, .colour = leaf_colour});
    const uint32_t soil = add_material(scene, {.name = "soil", .colour = soil_colour});

    Random random(size.seed);
    for (uint32_t i = 0; i < kinds_of_trees; ++i) {
        add_mesh(scene, tree_mesh("tree-" + std::to_string(i + 1), Random(random.next()), size.triangles,
                                  bark, leaves));
    }
    const double extent = 5 * std::sqrt(size.copies) + 5;
    const uint32_t ground = add_mesh(scene, ground_mesh(extent, 48, soil));

    const uint32_t root = add_node(scene, "forest", {});
    add_node(scene, "ground", {}, ground, root);
    uint32_t grove = root;
    for (uint32_t i = 0; i < size.copies; ++i) {
        if (i % 25 == 0) grove = add_node(scene, "grove-" + std::to_string(i / 25 + 1), {}, {}, root);
        const double x = random.uniform(-0.45, 0.45) * extent, y = random.uniform(-0.45, 0.45) * extent;
        const double turn = random.uniform(0, 2 * std::numbers::pi);
        const double width = random.uniform(0.7, 1.3), slender = random.uniform(0.8, 1.25);
        add_node(scene, "tree-node-" + std::to_string(i + 1),
                 translation({x, y, ground_height(x, y) - 0.1}) * rotation({0, 0, 1}, turn) *
                     scaling({width, width, width * slender}),
                 i % kinds_of_trees, grove);
    }
    return scene;
}

}  // namespace coppice
