// What most exporters make of a scene with copies: a mesh each, transforms applied, nothing shared. The
// copies are equal up to translation, rotation, uniform scale and mirroring.
#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/sample/loft.h"
#include "core/sample/parts.h"
#include "core/sample/scenes.h"
#include "core/sample/texture.h"

namespace coppice {

namespace {

Mesh pebble_mesh(uint64_t seed, uint32_t triangles, uint32_t material) {
    Random random(seed);
    const double a = random.uniform(0, 6), b = random.uniform(0, 6);
    MeshBuilder builder("pebble");
    Loft loft{.slot = builder.add_slot(material), .chart_columns = 2};
    fit_triangles(loft, triangles, 0.6);
    loft.shape = [=](double s, double t) {
        const Vec3d d = sphere_point(s, t);
        const double lumps =
            0.2 * std::sin(2 * d.x + a) * std::cos(3 * d.y + b) + 0.1 * std::sin(5 * d.z + 4 * d.y + a);
        return Vec3d{1.3 * d.x, d.y, 0.7 * d.z} * (1 + lumps);
    };
    add_loft(builder, loft);
    return builder.finish();
}

Rgb granite_colour(double u, double v) {
    const double grain = noise(u, v, 64, 41), patch = noise(u, v, 12, 42);
    return {0.5 + 0.3 * grain * patch, 0.48 + 0.28 * grain * patch, 0.47 + 0.25 * grain};
}

Rgb rust_colour(double u, double v) {
    const double rust = noise(u, v, 32, 43);
    return {0.45 + 0.25 * rust, 0.25 + 0.12 * rust, 0.15 + 0.05 * rust};
}

}  // namespace

Scene make_baked(const SampleSize& size) {
    Scene scene;
    const uint32_t granite = add_material(scene, {.name = "granite", .colour = granite_colour});
    const uint32_t rust = add_material(scene, {.name = "rust", .metallic = 0.5F, .colour = rust_colour});
    const std::array<Mesh, 2> prototypes = {pebble_mesh(size.seed, size.triangles, granite),
                                            bracket_mesh(size.triangles, rust)};
    Random random(size.seed + 1);
    const auto side = static_cast<uint32_t>(std::ceil(std::sqrt(size.copies)));
    for (uint32_t i = 0; i < size.copies; ++i) {
        const Vec3d axis =
            normalized(Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.1, 1)});
        const double grow = random.uniform(0.6, 1.4), mirror = i % 5 == 4 ? -1 : 1;
        const double turn = random.uniform(0, 2 * std::numbers::pi);
        Mesh copy = prototypes[i % 2];
        copy.name += "-" + std::to_string(i + 1);
        const uint32_t column = i % side, row = i / side;
        transform_mesh(translation({5.0 * column, 5.0 * row, 0}) * rotation(axis, turn) *
                           scaling({grow * mirror, grow, grow}),
                       copy);
        const std::string name = copy.name;
        add_node(scene, name, {}, add_mesh(scene, std::move(copy)));
    }
    return scene;
}

}  // namespace coppice
