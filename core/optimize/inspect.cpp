#include "core/optimize/inspect.h"

#include "core/mesh/adjacency.h"
#include "core/optimize/summary.h"
#include "core/scene/instance.h"

namespace coppice {

namespace {

uint64_t bytes_of(ComponentType type) {
    switch (type) {
        case ComponentType::int8:
        case ComponentType::uint8:
            return 1;
        case ComponentType::int16:
        case ComponentType::uint16:
            return 2;
        default:
            return 4;
    }
}

// What the mesh takes uncompressed: its wedges as the source stored them, and its indices.
uint64_t geometry_bytes(const Mesh& mesh) {
    uint64_t per_wedge = 3 * bytes_of(mesh.position_storage.type);
    for (const Attribute& attribute : mesh.attributes)
        per_wedge += attribute.components * bytes_of(attribute.storage.type);
    for (const MorphTarget& target : mesh.morph_targets) {
        for (const Attribute& delta : target.deltas)
            per_wedge += delta.components * bytes_of(delta.storage.type);
    }
    const uint64_t index = mesh.wedge_count() <= 65'535 ? 2 : 4;
    return per_wedge * mesh.wedge_count() + 3 * index * mesh.triangle_count();
}

InspectedMesh inspect_mesh(const Mesh& mesh, uint64_t instances) {
    const Topology shape = topology(mesh);
    InspectedMesh out{.name = mesh.name,
                      .instances = instances,
                      .triangles = mesh.triangle_count(),
                      .vertices = mesh.vertex_count(),
                      .wedges = mesh.wedge_count(),
                      .attributes = {"POSITION"},
                      .material_slots = mesh.slots.size(),
                      .border_edges = shape.border_edges,
                      .non_manifold_edges = shape.non_manifold_edges};
    for (const Attribute& attribute : mesh.attributes) out.attributes.push_back(attribute.name);
    return out;
}

}  // namespace

Inspection inspect(const Upload& upload, const ReadLimits& limits, const Watch& watch) {
    if (watch.stage) watch.stage("read");
    const ReadAsset read = read_asset(upload, limits, watch.part(0, 0.5));
    const Scene& scene = read.scene;
    const std::vector<uint64_t> counts = instances_per_mesh(scene, watch);

    Inspection out;
    out.summary = summarize(scene, counts, read.format, bytes_of(upload));
    out.bounds = scene_bounds(scene, watch);
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        watch.report(0.5 + 0.5 * static_cast<double>(i) / static_cast<double>(scene.meshes.size()));
        out.meshes.push_back(inspect_mesh(scene.meshes[i], counts[i]));
        if (counts[i] > 1) out.bytes_saved_by_instancing += (counts[i] - 1) * geometry_bytes(scene.meshes[i]);
    }
    out.materials = scene.materials.size();
    out.images = scene.images.size();
    out.nodes = scene.nodes.size();
    out.warnings = scene.warnings;
    watch.report(1);
    return out;
}

}  // namespace coppice
