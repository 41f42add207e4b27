// Rounds of merges as printed, without guards; see vertex_clusters.h.
#pragma once

#include <functional>

#include "core/simplify/cluster_rounds.h"
#include "core/simplify/vertex_clusters.h"

namespace coppice {

// One pass over the mesh: merges clusters at a threshold (mesh units), at most as many times as said; how
// often it did.
using PlainPass = std::function<uint64_t(VertexClusters& clusters, double threshold, uint64_t most)>;

// A whole run: rounds, re-indexing, then Delaunay flips. The mesh is larger than its target.
Simplified simplify_by_plain_clusters(const Mesh& source, const Target& target, const PlainPass& pass,
                                      const RoundOptions& options, const Watch& watch);

}  // namespace coppice
