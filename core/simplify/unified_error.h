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
#include "core/simplify/collapse_error.h"
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

struct UnifiedOptions {
    PlaneWeights weights = PlaneWeights::area;
    std::span<const Transform> instances = {};  // how far errors reach in the world; see InstanceMetric
    // Gamma, in mesh units and the instances' proportions: dearer pairs have no place.
    std::optional<double> max_geometric_error = {};
};

class UnifiedError final : public CollapseError {
  public:
    struct Cost {
        double geometric = 0;  // Gamma
        double unified = 0;    // E
    };

    UnifiedError(const CollapseParts& parts, const UnifiedOptions& options, const Watch& watch);

    Cost cost(uint32_t removed, uint32_t kept, const std::vector<uint32_t>& wedge_map) const;

    // At `kept`, whatever the freedom: attributes are never blended.
    std::optional<Placed> place(uint32_t removed, uint32_t kept, Freedom freedom, bool joins,
                                const std::vector<uint32_t>& wedge_map) const override;
    void merge(uint32_t removed, uint32_t kept, const std::vector<uint32_t>& wedge_map) override;

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
    std::optional<double> max_geometric_error_;
    std::vector<Geometry> geometry_;  // per vertex
    std::vector<Spread> spread_;      // per vertex and channel
};

}  // namespace coppice
