#include "core/format/clean_triangles.h"

#include <fmt/core.h>

#include "core/mesh/weld.h"

namespace coppice {

void clean_triangles(Scene& scene, const Watch& watch) {
    for (Mesh& mesh : scene.meshes) {
        const CleanedTriangles cleaned = drop_degenerate_and_duplicate(mesh, watch);
        if (cleaned.degenerate + cleaned.duplicate == 0) continue;
        drop_unused(mesh, watch);
        const std::string where = fmt::format("mesh \"{}\"", mesh.name);
        if (cleaned.degenerate > 0)
            scene.warnings.push_back({"repair.degenerate_triangles",
                                      fmt::format("{} degenerate triangles of mesh \"{}\" were dropped",
                                                  cleaned.degenerate, mesh.name),
                                      where});
        if (cleaned.duplicate > 0)
            scene.warnings.push_back({"repair.duplicate_triangles",
                                      fmt::format("{} duplicate triangles of mesh \"{}\" were dropped",
                                                  cleaned.duplicate, mesh.name),
                                      where});
    }
}

}  // namespace coppice
