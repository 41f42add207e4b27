// The unified error of GAPS and ITS: what a collapse costs, in mesh units.
//
//     E = (S Gamma + sum over attributes X0 A) / (S + sum over attributes X0)
//
// S: area around both vertices; Gamma = sqrt(Q / weight): distance to the planes that both stand for; X0 and
// A: weight and error of the attribute clouds of both (attribute_cloud.h), all at the vertex that stays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/watch.h"
#include "core/simplify/attribute_cloud.h"
#include "core/simplify/collapse_mesh.h"
#include "core/simplify/instance_metric.h"
#include "core/simplify/quadric.h"
#include "core/simplify/vertex_kind.h"

namespace coppice {

enum class PlaneWeights {
    // Q = sum A_f K_f, Gamma = sqrt(Q / sum A_f); planes that hold borders and seams in place; short edges
    // first where the surface is flat.
    area,
    // As printed: Q = sum K_f, Gamma = sqrt(Q / number of planes).
    count,
};

class UnifiedError {
  public:
    struct Cost {
        double geometric = 0;  // Gamma
        double unified = 0;    // E
    };

    UnifiedError(const CollapseMesh& mesh, std::span<const FeatureEdge> features, AttributeClouds& clouds,
                 PlaneWeights weights, const InstanceMetric& metric, const Watch& watch);

    // wedge_map as WedgeMap gives it for the pair.
    Cost cost(uint32_t removed, uint32_t kept, const std::vector<uint32_t>& wedge_map) const;

    // To be called with every collapse, before the mesh changes.
    void merge(uint32_t removed, uint32_t kept, const std::vector<uint32_t>& wedge_map);

  private:
    // Together, since they are read together and at random.
    struct Geometry {
        Quadric quadric;
        double plane_weight = 0;  // what Q is divided by
        double area = 0;          // S
    };
    struct Spread {
        double weight = 0;   // X0, all wedges of a vertex
        double squared = 0;  // Pi of its clouds at its own values
    };

    void add_planes(const InstanceMetric& metric, const Watch& watch);
    void add_constraints(std::span<const FeatureEdge> features, const InstanceMetric& metric,
                         const Watch& watch);
    double gathered_error(uint32_t removed, const std::vector<uint32_t>& wedge_map, uint32_t channel) const;

    const CollapseMesh& mesh_;
    AttributeClouds& clouds_;
    PlaneWeights weights_;
    std::vector<Geometry> geometry_;  // per vertex
    std::vector<Spread> spread_;      // per vertex and channel
};

}  // namespace coppice
