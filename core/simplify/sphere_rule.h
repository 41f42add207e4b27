// The sets that spherical scanning merges; see ss.h.
#pragma once

#include <vector>

#include "core/simplify/guarded_clusters.h"
#include "core/simplify/quadric.h"

namespace coppice {

class SphereRule final : public ClusterRule {
  public:
    void begin_round(const CollapseMesh& mesh, const Watch& watch) override;
    double usual_threshold() const override { return mean_edge_; }
    double largest_threshold() const override { return diagonal_; }
    void offer(double radius, const Take& take) override;
    Placement place(const CollapseMesh& mesh, std::span<const uint32_t> vertices) override;

  private:
    struct Place {
        Vec3f position, normal;  // normal: mean of the triangles', unit
    };

    void gather_neighbours(const CollapseMesh& mesh, const Watch& watch);
    void measure(const CollapseMesh& mesh, const Watch& watch);
    void fill_ball(uint32_t seed, double squared_radius);

    double mean_edge_ = 0, diagonal_ = 0, radius_ = 0;
    std::vector<uint32_t> begin_, neighbours_;  // per vertex + 1, into neighbours
    std::vector<Place> places_;                 // per vertex
    std::vector<Quadric> quadrics_;             // per vertex
    std::vector<uint8_t> taken_;
    std::vector<uint32_t> ball_;
    std::vector<double> weights_;
};

}  // namespace coppice
