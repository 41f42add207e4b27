#include "core/simplify/guarded_mesh.h"

#include <utility>

namespace coppice {

namespace {

Features features_of(const CollapseMesh& mesh, const GuardOptions& options, const Watch& watch) {
    Features features = find_features(mesh, watch);
    if (options.lock_sharp_borders) lock_sharp_borders(mesh, features);
    if (options.lock_borders) lock_borders(features);
    return features;
}

}  // namespace

GuardedMesh::GuardedMesh(const Mesh& source, const Target& target, const GuardOptions& options,
                         const Watch& watch)
    : source_(source),
      target_(target),
      mesh_(source, watch),
      features_(features_of(mesh_, options, watch)),
      rules_(mesh_, features_.kinds, watch),
      bounds_(mesh_, options.tolerance * bounds_tolerance_of_diagonal * mesh_.box().diagonal(), watch),
      lines_(mesh_, features_, options.tolerance * line_tolerance_of_diagonal * mesh_.box().diagonal(),
             watch),
      uvs_(mesh_, source, watch),
      deviation_(mesh_, watch),
      count_(target, mesh_) {
    watch.check();
}

Simplified GuardedMesh::simplified(Mesh mesh, StopReason reason) const {
    return {.mesh = std::move(mesh),
            .error_model_units = deviation_.largest(),
            .certified = false,
            .stop_reason = reason};
}

}  // namespace coppice
