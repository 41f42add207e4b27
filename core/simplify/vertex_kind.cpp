#include "core/simplify/vertex_kind.h"

#include "core/base/watched_loop.h"
#include "core/simplify/vertex_classifier.h"

namespace coppice {

void lock_sharp_borders(const CollapseMesh& mesh, Features& features) {
    // Unit vectors to both neighbours: they cancel where the border is straight; at 60 degrees their sum has
    // length 1.
    std::vector<Vec3d> turns(mesh.vertex_count());
    for (const FeatureEdge& f : features.edges) {
        if (!f.is_border) continue;
        const Vec3d along = normalized(mesh.position(f.b) - mesh.position(f.a));
        turns[f.a] = turns[f.a] + along;
        turns[f.b] = turns[f.b] - along;
    }
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        if (features.kinds[v] == VertexKind::border && squared_length(turns[v]) > 1) {
            features.kinds[v] = VertexKind::corner;
        }
    }
}

void lock_borders(Features& features) {
    for (const FeatureEdge& f : features.edges)
        if (f.is_border) features.kinds[f.a] = features.kinds[f.b] = VertexKind::corner;
}

Features find_features(const CollapseMesh& mesh, const Watch& watch) {
    Features features;
    features.kinds = watched_vector(mesh.vertex_count(), watch, VertexKind::corner);
    VertexClassifier classifier(mesh, watch);
    watched_loop(mesh.vertex_count(), watch, [&](size_t i) {
        const auto v = static_cast<uint32_t>(i);
        if (!mesh.is_live_vertex(v)) return;
        features.kinds[v] = classifier.classify(v);
        classifier.append_features(v, features.edges);
    });
    return features;
}

}  // namespace coppice
