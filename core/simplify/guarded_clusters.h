// Rounds of merges under the rules of star_contraction.h: what the clustering algorithms do by default.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/simplify/cluster_rounds.h"
#include "core/simplify/star_contraction.h"

namespace coppice {

// Which sets of vertices an algorithm merges, and where to.
class ClusterRule {
  public:
    // Takes a set; says how many of it were taken, its first ones, 0 for none.
    using Take = std::function<size_t(std::span<const uint32_t> vertices)>;

    ClusterRule() = default;
    virtual ~ClusterRule() = default;
    ClusterRule(const ClusterRule&) = delete;
    ClusterRule& operator=(const ClusterRule&) = delete;

    // Before each round: measures the mesh as it is.
    virtual void begin_round(const CollapseMesh& mesh, const Watch& watch) = 0;
    virtual double usual_threshold() const = 0;
    virtual double largest_threshold() const = 0;
    // Offers the sets that a threshold lets through, in order; connected, and no vertex that was taken.
    virtual void offer(double threshold, const Take& take) = 0;
    virtual Placement place(const CollapseMesh& mesh, std::span<const uint32_t> vertices) = 0;
};

// A whole run: rounds, then Delaunay flips. The mesh is larger than its target.
Simplified simplify_by_guarded_clusters(const Mesh& source, const Target& target, ClusterRule& rule,
                                        const RoundOptions& options, const Watch& watch);

}  // namespace coppice
