#include "bench/papers/models.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/format/asset.h"
#include "core/sample/sample.h"
#include "tests/support/test_assets.h"

namespace coppice::papers {

bool is_asset(const std::string& file) {
    return test::asset_folder() && std::filesystem::is_regular_file(*test::asset_folder() / file);
}

Model model(const std::string& file, uint32_t triangles) {
    if (!is_asset(file)) return drawn_model(triangles);
    const test::UploadedAsset asset = test::load_asset(file);
    return {file, read_asset(asset.upload(), {}, {}).scene.meshes.front()};
}

Model drawn_model(uint32_t triangles) {
    return {"drawn", make_sample("bunny13", {.copies = 1, .triangles = triangles}).meshes.front()};
}

Bytes scene_of(const Model& model, uint32_t instances) {
    Scene scene;
    scene.meshes.push_back(model.mesh);
    Mesh& mesh = scene.meshes.front();
    mesh.source_mesh.reset();
    mesh.slots = {MaterialSlot{}};
    std::fill(mesh.triangle_slot.begin(), mesh.triangle_slot.end(), 0);
    const double step = 1.5 * bounds(mesh.positions).diagonal();
    for (uint32_t i = 0; i < instances; ++i) {
        const double half_turn = 1.2 * i, scale = 0.8 + 0.1 * (i % 5);
        Node node;
        node.name = fmt::format("placement {}", i);
        node.local = from_trs({step * i, 0, 0}, {0, std::sin(half_turn), 0, std::cos(half_turn)},
                              {scale, scale, scale});
        node.mesh = 0;
        scene.roots.push_back(i);
        scene.nodes.push_back(std::move(node));
    }
    return write_asset(scene, {}, {}).bytes;
}

}  // namespace coppice::papers
