#include "core/format/clean_triangles.h"

#include <fmt/core.h>

#include "core/mesh/weld.h"

namespace coppice {

void clean_triangles(Scene& scene, const Watch& watch) {
    for (Mesh& mesh : scene.meshes) {
        const std::string name = fmt::format("mesh \"{}\"", mesh.name);
        clean_triangles(mesh, name, name, scene.warnings, watch);
    }
}

void clean_triangles(Mesh& mesh, const std::string& name, const std::string& where,
                     std::vector<Warning>& warnings, const Watch& watch) {
    const CleanedTriangles cleaned = drop_degenerate_and_duplicate(mesh, watch);
    if (cleaned.degenerate + cleaned.duplicate > 0) drop_unused(mesh, watch);
    const auto warn = [&](const char* kind, size_t count) {
        if (count == 0) return;
        warnings.push_back({fmt::format("repair.{}_triangles", kind),
                            fmt::format("{} {} triangles of {} were dropped", count, kind, name), where,
                            count});
    };
    warn("degenerate", cleaned.degenerate);
    warn("duplicate", cleaned.duplicate);
}

}  // namespace coppice
