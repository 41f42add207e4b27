#include "core/format/ply/read_ply.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/format/normals.h"
#include "core/format/ply/ply_body.h"
#include "core/format/single_mesh.h"
#include "core/mesh/weld.h"

namespace coppice {

namespace {

std::string stem(std::string_view file_name) {
    file_name = file_name.substr(file_name.rfind('/') + 1);
    return std::string(file_name.substr(0, file_name.rfind('.')));
}

// A material for each TextureFile, with its image where the upload has it. MeshLab writes "<this>" for the
// file's name.
void add_materials(const PlyHeader& header, const std::string& name, const Resources& resources,
                   const ReadLimits& limits, Scene& scene, WarningTally& tally) {
    for (std::string path : header.texture_files) {
        require(scene.images.size() < limits.images, ErrorCode::asset_too_large, "",
                "the PLY names more textures than the limit images of {}", limits.images);
        if (const size_t self = path.find("<this>"); self != path.npos) path.replace(self, 6, name);
        Material material;
        material.name = path;
        const ResourceFile* file = nullptr;
        try {
            file = resources.find_path(path, "comment TextureFile");
        } catch (const Error& error) {
            tally.note("resource.forbidden", error.message(), error.where());
        }
        if (file) {
            material.base_color_texture.image = static_cast<uint32_t>(scene.images.size());
            scene.images.push_back({path,
                                    std::string(image_mime_type(file->bytes)),
                                    path,
                                    {file->bytes.begin(), file->bytes.end()}});
        } else {
            tally.note("resource.missing",
                       fmt::format("texture \"{}\" is not in the upload{}", path, resources.listing()),
                       "comment TextureFile");
        }
        scene.materials.push_back(std::move(material));
    }
}

// A wedge per vertex, or per corner where corners have texture coordinates of their own.
void add_wedges(const PlyBody& body, Mesh& mesh) {
    if (body.corner_uvs.empty()) {
        mesh.wedge_vertex.resize(body.positions.size());
        std::iota(mesh.wedge_vertex.begin(), mesh.wedge_vertex.end(), 0U);
        mesh.triangles = body.triangles;
    } else {
        mesh.wedge_vertex = body.triangles;
        mesh.triangles.resize(body.triangles.size());
        std::iota(mesh.triangles.begin(), mesh.triangles.end(), 0U);
    }
}

void add_attribute(Mesh& mesh, std::string name, uint32_t components, const std::vector<float>& of_vertices,
                   Storage storage = {}) {
    if (of_vertices.empty()) return;
    Attribute& attribute = mesh.attributes.emplace_back(Attribute{std::move(name), components, storage, {}});
    attribute.values.reserve(mesh.wedge_count() * components);
    for (const uint32_t vertex : mesh.wedge_vertex) {
        const auto first = of_vertices.begin() + static_cast<std::ptrdiff_t>(size_t{vertex} * components);
        attribute.values.insert(attribute.values.end(), first, first + components);
    }
}

void add_attributes(const PlyBody& body, Mesh& mesh) {
    add_attribute(mesh, "NORMAL", 3, body.normals);
    if (body.corner_uvs.empty()) {
        add_attribute(mesh, "TEXCOORD_0", 2, body.uvs);
    } else {
        mesh.attributes.push_back({"TEXCOORD_0", 2, {}, body.corner_uvs});
    }
    add_attribute(mesh, "COLOR_0", body.color_components, body.colors, body.color_storage);
    for (Attribute& attribute : mesh.attributes) {
        if (attribute.name != "TEXCOORD_0") continue;
        for (size_t i = 1; i < attribute.values.size(); i += 2) attribute.values[i] = 1 - attribute.values[i];
    }
}

void add_slots(const PlyBody& body, size_t materials, Mesh& mesh) {
    mesh.slots.resize(std::max<size_t>(1, materials));
    for (size_t i = 0; i < materials; ++i) mesh.slots[i].material = static_cast<uint32_t>(i);
    mesh.triangle_slot.assign(mesh.triangles.size() / 3, 0);
    for (size_t t = 0; t < body.triangle_texture.size(); ++t) {
        if (body.triangle_texture[t] < mesh.slots.size()) mesh.triangle_slot[t] = body.triangle_texture[t];
    }
}

void require_triangles(const PlyHeader& header, const PlyBody& body) {
    if (!body.triangles.empty()) return;
    const size_t vertices = body.positions.size();
    const bool has_faces =
        std::any_of(header.elements.begin(), header.elements.end(), [](const PlyElement& element) {
            return element.count > 0 && (element.name == "face" || element.name == "tristrips");
        });
    require(vertices == 0 || has_faces, ErrorCode::asset_unsupported, "",
            "the PLY has no faces ({} vertices): point clouds are not read", vertices);
    fail(ErrorCode::asset_malformed, "",
         fmt::format("the PLY has no triangles ({} vertices){}", vertices,
                     has_faces ? ": its faces have fewer than 3 corners" : ""));
}

}  // namespace

Scene read_ply(ByteView bytes, std::string_view file_name, const Resources& resources,
               const ReadLimits& limits, const Watch& watch) {
    const PlyHeader header = parse_ply_header(bytes);
    WarningTally tally;
    PlyBody body = read_ply_body(bytes, header, limits, watch, tally);
    require_triangles(header, body);
    Scene scene;
    Mesh mesh;
    mesh.name = stem(file_name);
    add_materials(header, mesh.name, resources, limits, scene, tally);
    add_wedges(body, mesh);
    add_attributes(body, mesh);
    mesh.positions = std::move(body.positions);
    add_slots(body, scene.materials.size(), mesh);
    drop_unused(mesh, watch);
    repair_normals(mesh, tally);
    weld(mesh, watch);
    add_placed_mesh(scene, std::move(mesh));
    tally.move_to(scene.warnings);
    return scene;
}

}  // namespace coppice
