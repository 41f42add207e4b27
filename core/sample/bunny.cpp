// One organic mesh of the small bunny's size and topology (2,503 vertices, 4,968 triangles, four holes with
// 42 border edges in its base), thirteen times.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/sample/loft.h"
#include "core/sample/scenes.h"
#include "core/sample/texture.h"

namespace coppice {

namespace {

double bump(Vec3d direction, Vec3d centre, double width) {
    return std::exp(-squared_length(direction - centre) / (width * width));
}

// Body and head are two ellipsoids on an upright axis, blended; the rest is bumps.
Vec3d bunny_point(double s, double t, const std::vector<double>& phases) {
    const double z = -0.95 + 2.7 * (0.5 - 0.5 * std::cos(std::numbers::pi * s));
    const auto ellipse = [](double x) { return std::sqrt(std::max(0.0, 1 - x * x)); };
    const double body = ellipse(z / 0.95), head = 0.55 * ellipse((z - 1.2) / 0.55);
    const bool pole = s <= 0 || s >= 1;
    const double radius = pole ? 0 : std::pow(std::pow(body, 4) + std::pow(head, 4), 0.25);
    const double angle = 2 * std::numbers::pi * t;
    const double lean = std::clamp((z - 0.2) / 1.0, 0.0, 1.0);
    Vec3d p = {radius * std::cos(angle), 0.85 * radius * std::sin(angle), z};

    const Vec3d direction = normalized(Vec3d{p.x, p.y, p.z - (z > 0.7 ? 1.2 : 0)});
    for (const double side : {-1.0, 1.0}) {
        if (z > 0.7) {
            p = p + Vec3d{-0.35, 0.25 * side, 0.95} *
                        bump(direction, normalized(Vec3d{-0.3, 0.5 * side, 0.8}), 0.3);
        } else {
            p = p + Vec3d{0.3, 0.1 * side, -0.1} *
                        bump(direction, normalized(Vec3d{0.8, 0.45 * side, -0.5}), 0.35);
        }
    }
    if (z <= 0.7) p = p + Vec3d{-0.3, 0, 0.05} * bump(direction, normalized(Vec3d{-1, 0, -0.35}), 0.25);
    p.x += 0.5 * lean * lean * (3 - 2 * lean);

    double fur = 0;
    for (size_t i = 0; i < phases.size(); ++i) {
        const double waves = 2 + static_cast<double>(i);
        fur += std::sin(waves * (p.x + 2 * p.y) * 2 + phases[i]) *
               std::cos(waves * (p.z - p.y) * 3 - phases[i]) / waves;
    }
    return p + direction * (pole ? 0 : 0.03 * fur);
}

// Four strips of 4, 4, 4 and 5 quads in the third row, where the base curves up, as the scanner left them.
bool is_hole(uint32_t row, uint32_t column, uint32_t segments) {
    if (row != 3 || segments < 40) return false;
    const uint32_t step = segments / 4;
    const uint32_t quarter = std::min(column / step, 3U);
    return column - quarter * step < (quarter == 3 ? 5U : 4U);
}

Mesh bunny_mesh(uint64_t seed, uint32_t triangles, uint32_t material) {
    Random random(seed);
    std::vector<double> phases(6);
    for (double& phase : phases) phase = random.uniform(0, 2 * std::numbers::pi);
    MeshBuilder builder("bunny");
    Loft loft{.slot = builder.add_slot(material), .chart_rows = 2, .chart_columns = 2};
    fit_triangles(loft, triangles, 0.67);
    loft.shape = [&](double s, double t) { return bunny_point(s, t, phases); };
    loft.hole = [&](uint32_t row, uint32_t column) { return is_hole(row, column, loft.segments); };
    add_loft(builder, loft);
    return builder.finish();
}

Rgb fur(double u, double v) {
    const double soft = noise(u, v, 8, 11), fine = noise(u, v, 64, 12);
    const double tint = 0.75 + 0.2 * soft * fine;
    return {tint, tint * (u < 0.5 ? 0.92 : 0.86),
            tint * (v < 0.5 ? 0.8 : 0.72)};  // charts tell themselves apart
}

}  // namespace

Scene make_bunny(const SampleSize& size) {
    Scene scene;
    const uint32_t material = add_material(scene, {.name = "fur", .size = 256, .colour = fur});
    const uint32_t mesh = add_mesh(scene, bunny_mesh(size.seed, size.triangles, material));

    Random random(size.seed + 1);
    const auto side = static_cast<uint32_t>(std::ceil(std::sqrt(size.copies)));
    for (uint32_t i = 0; i < size.copies; ++i) {
        const uint32_t column = i % side, row = i / side;
        const Vec3d place = {4.0 * column, 4.0 * row, 0};
        const Vec3d tilt_axis = normalized(Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), 0.2});
        const double spin = random.uniform(0, 2 * std::numbers::pi), tilt = random.uniform(-0.4, 0.4);
        const double grow = random.uniform(0.5, 1.5);
        add_node(scene, "bunny-" + std::to_string(i + 1),
                 translation(place) * rotation(tilt_axis, tilt) * rotation({0, 0, 1}, spin) *
                     scaling({grow, grow, grow}),
                 mesh);
    }
    return scene;
}

}  // namespace coppice
