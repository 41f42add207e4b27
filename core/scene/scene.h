// A scene: unique meshes, materials, images, and nodes that place meshes. Values; readers make one, stages
// change it, writers take it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/bytes.h"
#include "core/mesh/mesh.h"
#include "core/scene/transform.h"

namespace coppice {

// Something the caller should know: a repair, or a loss. code is stable, e.g. "extension.unknown".
struct Warning {
    std::string code;
    std::string message;
    std::string where = {};
    uint64_t count = 0;  // of what was repaired or lost; 0 where it is not counted
};

struct Image {
    std::string name;
    std::string mime_type;  // image/png, image/jpeg, ...; empty when not known
    std::string path;       // as the source named it, relative; empty when it was embedded
    Bytes bytes;            // as they came: images are never decoded here
};

struct TextureUse {
    std::optional<uint32_t> image = {};  // index into Scene::images
    uint32_t texture_coordinates = 0;    // TEXCOORD_n
};

// What the formats have in common. A source's own description of a material is passed through by
// Scene::source.
struct Material {
    std::string name;
    std::array<float, 4> base_color = {1, 1, 1, 1};  // linear RGBA
    float metallic = 0;
    float roughness = 1;
    std::array<float, 3> emissive = {0, 0, 0};
    TextureUse base_color_texture = {};
    TextureUse emissive_texture = {};
    TextureUse normal_texture = {};
    enum class Alpha { opaque, mask, blend } alpha = Alpha::opaque;
    bool double_sided = false;
};

struct Node {
    std::string name;
    std::optional<uint32_t> parent = {};
    std::vector<uint32_t> children = {};
    Transform local = {};
    std::optional<uint32_t> mesh = {};  // index into Scene::meshes
    std::vector<Transform> batch =
        {};  // EXT_mesh_gpu_instancing: one instance each; empty: one at the identity
    bool skinned = false;
    bool animated = false;  // itself; see also its parents
};

// What a reader keeps so that the writer of the same format can pass through what the scene does not model
// (glTF's JSON and untouched buffers, OBJ's MTL text). Immutable and shared.
struct SourceDocument {
    SourceDocument() = default;
    virtual ~SourceDocument() = default;
    SourceDocument(const SourceDocument&) = delete;
    SourceDocument& operator=(const SourceDocument&) = delete;
};

struct Scene {
    std::string name;
    std::vector<Mesh> meshes;  // unique meshes
    std::vector<Material> materials;
    std::vector<Image> images;
    std::vector<Node> nodes;      // a forest; Node::parent and children agree
    std::vector<uint32_t> roots;  // of the default scene
    std::shared_ptr<const SourceDocument> source;
    std::vector<Warning> warnings;
};

}  // namespace coppice
