// The quadric error of Garland and Heckbert 1997: squared distances to the planes of the triangles that a
// vertex stands for, and of planes that hold borders and seams.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/base/watch.h"
#include "core/simplify/collapse_error.h"
#include "core/simplify/quadric.h"

namespace coppice {

struct PlaneOptions {
    bool by_area = true;          // a plane weighs as much as its triangle, else 1
    double boundary_weight = 10;  // of the plane across a border, times its edge squared; 1 for seams
    // By how much more a plane with this unit normal weighs for the instances that show it. None: 1.
    std::function<double(Vec3d)> instance_weight = {};
};

// The planes of every vertex.
class PlaneQuadrics {
  public:
    PlaneQuadrics(const CollapseParts& parts, const PlaneOptions& options, const Watch& watch);

    Quadric sum(uint32_t a, uint32_t b) const {
        Quadric q = quadrics_[a] + quadrics_[b];
        if (line_of_.empty()) return q;
        if (line_of_[a] != no_index) q += lines_[line_of_[a]];
        if (line_of_[b] != no_index) q += lines_[line_of_[b]];
        return q;
    }
    // What a join costs: without what holds lines. Where joins are possible.
    Quadric sum_of_triangles(uint32_t a, uint32_t b) const { return quadrics_[a] + quadrics_[b]; }
    // Of the triangles' planes alone: what their quadric is divided by to get a mean squared distance.
    double weight(uint32_t a, uint32_t b) const { return weights_[a] + weights_[b]; }
    void merge(uint32_t removed, uint32_t kept);
    // The planes of these edges take the place of those that have held lines there.
    void set_lines(uint32_t vertex, std::span<const FeatureEdge> edges);

  private:
    void add_triangles(const Watch& watch);
    void add_lines(std::span<const FeatureEdge> edges, const Watch& watch);
    Quadric& line_quadric(uint32_t vertex);
    Quadric plane_of_line(const FeatureEdge& edge) const;

    const CollapseMesh& mesh_;
    PlaneOptions options_;
    std::vector<Quadric> quadrics_;
    std::vector<double> weights_;
    // Where lines may end, what holds them is apart; else it is in quadrics_. Few vertices have any.
    std::vector<uint32_t> line_of_;  // per vertex: in lines_
    std::vector<Quadric> lines_;
};

// The point of the given freedom that is least far from the planes. anywhere: where Ap = -b, if that has one
// solution near the edge; else, as for segment, the best point between the ends a and b. end_point: b.
Vec3d least_point(const Quadric& q, Vec3d a, Vec3d b, Freedom freedom);

// A collapse costs the sum of squared distances. Where planes cannot tell edges apart (on flat ground) short
// ones go first, by a part too small to matter elsewhere.
class PlaneError final : public CollapseError {
  public:
    PlaneError(const CollapseParts& parts, const PlaneOptions& options, const Watch& watch);

    std::optional<Placed> place(uint32_t removed, uint32_t kept, Freedom freedom, bool joins,
                                const std::vector<uint32_t>& wedge_map) const override;
    void merge(uint32_t removed, uint32_t kept, const std::vector<uint32_t>& wedge_map) override;
    void set_lines(uint32_t vertex, std::span<const FeatureEdge> edges) override {
        planes_.set_lines(vertex, edges);
    }

  private:
    const CollapseMesh& mesh_;
    PlaneQuadrics planes_;
};

}  // namespace coppice
