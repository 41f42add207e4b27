// Many equal parts: plates, a bolt in each of their holes, and on each plate a bracket and its mirror image,
// which is the same mesh under a negative scale.
#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/sample/parts.h"
#include "core/sample/scenes.h"
#include "core/sample/texture.h"

namespace coppice {

namespace {

struct Part {
    const char* name;
    uint32_t mesh;
    Transform place;
};

std::vector<Part> assembly() {
    constexpr uint32_t plate = 0, bolt = 1, bracket = 2;
    const Transform bolt_down = translation({0, 0, -2.1}) * scaling({0.9, 0.9, 1});
    return {
        {"plate", plate, {}},
        {"bolt-1", bolt, translation({-1, -1, 0}) * bolt_down},
        {"bolt-2", bolt, translation({1, -1, 0}) * bolt_down},
        {"bolt-3", bolt, translation({1, 1, 0}) * bolt_down},
        {"bolt-4", bolt, translation({-1, 1, 0}) * bolt_down},
        {"bracket-right", bracket, translation({0, 0.2, 0.3}) * scaling({0.5, 0.5, 0.5})},
        {"bracket-left", bracket, translation({0, -0.2, 0.3}) * scaling({0.5, -0.5, 0.5})},
    };
}

Rgb steel_colour(double u, double v) {
    const double brushed = noise(u, 0.1 * v, 128, 31), stain = noise(u, v, 8, 32);
    return {0.55 + 0.2 * brushed - 0.08 * stain, 0.56 + 0.2 * brushed - 0.08 * stain, 0.6 + 0.2 * brushed};
}

Rgb zinc_colour(double u, double v) {
    const double flake = noise(u, v, 48, 33);
    return {0.62 + 0.2 * flake, 0.6 + 0.18 * flake, 0.42 + 0.15 * flake};
}

}  // namespace

Scene make_cad(const SampleSize& size) {
    Scene scene;
    const uint32_t steel =
        add_material(scene, {.name = "steel", .metallic = 1, .roughness = 0.45F, .colour = steel_colour});
    const uint32_t zinc =
        add_material(scene, {.name = "zinc", .metallic = 1, .roughness = 0.35F, .colour = zinc_colour});
    add_mesh(scene, plate_mesh(size.triangles, steel));
    add_mesh(scene, bolt_mesh(size.triangles, zinc));
    add_mesh(scene, bracket_mesh(size.triangles, steel));

    Random random(size.seed);
    const std::vector<Part> parts = assembly();
    const auto assemblies = static_cast<uint32_t>((size.copies + parts.size() - 1) / parts.size());
    const auto side = static_cast<uint32_t>(std::ceil(std::sqrt(assemblies)));
    for (uint32_t i = 0, placed = 0; i < assemblies; ++i) {
        const double height = random.uniform(0, 1), turn = std::numbers::pi / 2 * random.below(4);
        const uint32_t column = i % side, row = i / side;
        const Transform place = translation({5.0 * column, 5.0 * row, height}) * rotation({0, 0, 1}, turn);
        const std::string name = "assembly-" + std::to_string(i + 1);
        const uint32_t node = add_node(scene, name, place);
        for (const Part& part : parts) {
            if (placed++ == size.copies) return scene;
            add_node(scene, name + "/" + part.name, part.place, part.mesh, node);
        }
    }
    return scene;
}

}  // namespace coppice
