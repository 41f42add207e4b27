// The unified error of GAPS (Erikson and Manocha 1999, formulas as ITS prints them), at a point of its own
// for every edge:
//
//     E = (S Gamma + sum over attributes X0 A) / (S + sum over attributes X0)
//
// S: area around both ends; Gamma: root mean square distance to their planes at the point; X0 and A: weight
// and error of the attribute clouds of both (attribute_cloud.h) at the values interpolated there
// (projection.h). In mesh units.
#pragma once

#include <vector>

#include "core/simplify/collapse_error.h"
#include "core/simplify/plane_error.h"

namespace coppice {

class GapsError final : public CollapseError {
  public:
    GapsError(const CollapseParts& parts, const PlaneOptions& options, const Watch& watch);

    std::optional<Placed> place(uint32_t removed, uint32_t kept, Freedom freedom, bool joins,
                                const std::vector<uint32_t>& wedge_map) const override;
    void merge(uint32_t removed, uint32_t kept, const std::vector<uint32_t>& wedge_map) override;
    void set_lines(uint32_t vertex, std::span<const FeatureEdge> edges) override {
        planes_.set_lines(vertex, edges);
    }

  private:
    // Of one attribute: how far all clouds of both ends are from what their wedges get.
    double squared_error(uint32_t removed, uint32_t kept, const std::vector<uint32_t>& wedge_map,
                         uint32_t channel) const;
    double weight(uint32_t vertex, uint32_t channel) const {
        return weights_[size_t{vertex} * channels_ + channel];
    }

    const CollapseMesh& mesh_;
    AttributeClouds& clouds_;
    Projection& projection_;
    PlaneQuadrics planes_;
    uint32_t channels_;
    std::vector<double> weights_;  // per vertex and channel: X0 of all its wedges
};

}  // namespace coppice
