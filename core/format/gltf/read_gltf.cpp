#include "core/format/gltf/check_schema.h"
#include "core/format/gltf/checks.h"
#include "core/format/gltf/glb.h"
#include "core/format/gltf/gltf.h"
#include "core/format/gltf/read_buffers.h"
#include "core/format/gltf/read_document.h"
#include "core/format/gltf/read_images.h"
#include "core/format/gltf/read_mesh.h"
#include "core/format/gltf/read_scene.h"

namespace coppice {

namespace gltf {

namespace {

Parsed parse(ByteView bytes, const ReadLimits& limits, const Watch& watch) {
    Parsed parsed;
    ByteView text = bytes;
    if (is_glb(bytes)) {
        const GlbChunks chunks = parse_glb(bytes);
        parsed.is_glb = true;
        text = chunks.json;
        parsed.binary = chunks.binary;
    }
    parsed.json = parse_json(text, limits, watch);
    return parsed;
}

void check_structure(Parsed& parsed, const ReadLimits& limits, const Watch& watch) {
    check_asset(parsed.json);
    check_counts(parsed.json, limits);
    check_schema(parsed.json, watch);
    check_claims(parsed.json, limits, watch);
    check_extensions(parsed, watch);
    check_nodes(parsed, limits, watch);
}

void check_use(Parsed& parsed, const ReadLimits& limits, const Watch& watch) {
    check_meshes(parsed, watch);
    check_skins(parsed, limits, watch);
    check_animations(parsed, watch);
    check_instancing(parsed, watch);
    check_materials(parsed, watch);
    check_cameras_and_lights(parsed);
    check_vertex_data(parsed, limits, watch);
    check_accessor_data(parsed, watch);
}

// Triangles with every instance, before any instance is made.
void check_rendered(const Parsed& parsed, const std::vector<Mesh>& meshes, const ReadLimits& limits) {
    uint64_t rendered = 0;
    uint64_t instances = 0;
    const Json& nodes = list(parsed.json, "nodes");
    for (size_t i = 0; i < nodes.size(); ++i) {
        const auto mesh = index_at(nodes[i], "mesh");
        if (!mesh) continue;
        uint64_t count = 1;
        if (const Json* instancing = extension(nodes[i], "EXT_mesh_gpu_instancing"))
            count = parsed.accessors[(*instancing)["attributes"].begin()->get<uint32_t>()].count;
        require(count <= limits.instances && instances + count <= limits.instances,
                ErrorCode::asset_too_large, pointer("nodes", i),
                "there are more than {} instances (limit instances)", limits.instances);
        instances += count;
        const uint64_t triangles = std::max<uint64_t>(meshes[*mesh].triangle_count(), 1);
        require(count <= limits.rendered_triangles / triangles &&
                    rendered + count * triangles <= limits.rendered_triangles,
                ErrorCode::asset_too_large, pointer("nodes", i),
                "the instances draw more than {} triangles (limit rendered_triangles)",
                limits.rendered_triangles);
        rendered += count * triangles;
    }
}

std::vector<Mesh> read_meshes(Parsed& parsed, const ReadLimits& limits, const Watch& watch) {
    std::vector<Mesh> meshes;
    MeshBudget budget;
    const auto count = static_cast<uint32_t>(list(parsed.json, "meshes").size());
    for (uint32_t i = 0; i < count; ++i) {
        meshes.push_back(read_mesh(parsed, i, limits, budget, watch));
        watch.report((i + 1.0) / count);
    }
    return meshes;
}

}  // namespace

}  // namespace gltf

Scene read_gltf(ByteView bytes, const Resources& resources, const ReadLimits& limits, const Watch& watch) {
    using namespace gltf;
    Parsed parsed = parse(bytes, limits, watch);
    check_structure(parsed, limits, watch);
    read_buffers(parsed, resources, watch);
    read_views(parsed, limits, watch);
    read_accessors(parsed, limits, watch);
    read_images(parsed, resources, limits);
    check_use(parsed, limits, watch);

    Scene scene;
    scene.meshes = read_meshes(parsed, limits, watch);
    check_rendered(parsed, scene.meshes, limits);
    scene.nodes = read_nodes(parsed);
    scene.roots = read_roots(parsed.json, scene.nodes);
    scene.materials = read_materials(parsed.json);
    scene.images = std::move(parsed.images);
    auto document = make_document(parsed, limits);
    document->nodes = scene.nodes;
    scene.source = std::move(document);
    scene.warnings = std::move(parsed.warnings);
    return scene;
}

}  // namespace coppice
