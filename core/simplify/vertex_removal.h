// One simplification by removing vertices and filling the holes: the state that the algorithms of the surface
// angle share, as EdgeCollapse is for edges. Nothing moves, and every value of what stays is kept.
//
// A vertex may be removed when
//   - its triangles are one disc, inside a chart, or half a disc at a border; at a seam, both halves are
//     filled apart, so that the line runs on, as it does along a crease that passes through;
//   - the hole can be filled (hole_triangulation.h) without an edge or a triangle that is there already, and
//     no new triangle is flattened, turned away from the surface (collapse_rules.h) or mirrored in its
//     texture (uv_guard.h);
//   - the bounding box stays (bounds_guard.h), borders and seams stay within a tolerance (line_guard.h), or
//     are left alone altogether.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/watch.h"
#include "core/simplify/guarded_mesh.h"
#include "core/simplify/hole_triangulation.h"
#include "core/simplify/vertex_fan.h"

namespace coppice {

class VertexRemoval : public GuardedMesh {
  public:
    // Keeps references to the source and the target. lines: vertices of borders and seams may go.
    // Stitch::paper works without any of the rules, but for those of kinds, since values of two charts cannot
    // be mixed.
    VertexRemoval(const Mesh& source, const Target& target, Stitch stitch, bool lines, const Watch& watch);

    Vec3f normal(uint32_t triangle) const { return normals_[triangle]; }  // unit, zero without area

    // Whether its kind allows it to go: the first rule, and quick.
    bool kind_allows(uint32_t vertex) const;
    // Cosine of the angle by which its border or seam turns there; 1 off these.
    double line_turn_cosine(uint32_t vertex) const { return lines_.turn_cosine(vertex); }
    // Triangles that go with it, if nothing but kinds mattered.
    uint32_t triangles_saved(uint32_t vertex) const;

    // Removes a live vertex unless a rule is broken. `around` are then the vertices around it.
    Refusal try_remove(uint32_t vertex);
    const std::vector<uint32_t>& around() const { return fan_.ring(); }

    // Turns edges that are not Delaunay, if that is how holes are filled.
    Simplified finish(StopReason reason, const Watch& watch);

  private:
    // Neighbouring triangles of the fan, whose hole is filled by itself.
    struct Part {
        uint32_t first = 0, count = 0;
        bool closed = false;  // all of a closed fan

        uint32_t ring_size() const { return closed ? count : count + 1; }
    };
    struct NewTriangle {
        uint32_t replaces = no_index;              // of the fan; none: any that is left
        std::array<uint32_t, 3> vertices, wedges;  // in the order of that one's corners
        Vec3f normal;
    };

    Refusal check(uint32_t vertex);
    bool find_parts(uint32_t vertex);
    bool split_at(uint32_t one, uint32_t other);
    bool is_seam(uint32_t spoke) const;
    bool fill(const Part& part, uint32_t vertex);
    bool add(const Part& part, std::array<uint32_t, 3> places, uint32_t vertex);
    // In the ring, of place i of a part; also the fan's triangle from there to the next place.
    uint32_t place(const Part& part, uint32_t i) const {
        const uint32_t place = part.first + i;
        return place < ring_size_ ? place : place - ring_size_;
    }
    uint32_t wedge_at(const Part& part, uint32_t i, Vec3f normal) const;
    double deviation(uint32_t vertex) const;
    void remove(uint32_t vertex);
    void replace_fan();

    Stitch stitch_;
    bool lines_may_go_;
    HoleTriangulation hole_;
    std::vector<Vec3f> normals_;  // per triangle
    uint32_t removed_ = 0;

    // Of the vertex that is looked at.
    VertexFan fan_;
    uint32_t ring_size_ = 0;
    uint32_t along_ = no_index;  // a neighbour on its line
    std::vector<Part> parts_;
    std::vector<Vec3d> points_;
    std::vector<NewTriangle> new_triangles_;
    std::vector<bool> taken_;  // of the fan's triangles
    double next_deviation_ = 0;
};

}  // namespace coppice
