// How far attributes are from what they were on the source: Hoppe 1999, "New quadric metric for simplifying
// meshes with appearance attributes", in the form that keeps position and attributes apart.
//
// On a triangle an attribute is linear: s(p) = g.p + d with g in its plane. A wedge that stands for triangles
// f of weight w_f, put at p with the value s, is off by
//
//     sum w_f (g_f.p + d_f - s)^2 = p'Ap + 2 b'p + c - 2 s (G.p + D) + W s^2
//
// with A = sum w gg', b = sum w dg, c = sum w d^2, G = sum w g, D = sum w d, W = sum w; A, b and c are sums
// over all attributes. The best value is s = (G.p + D) / W, which leaves a quadric in p alone. All is
// relative to where the wedge is and to the values it has, so single precision is enough.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/watch.h"
#include "core/mesh/mesh.h"
#include "core/simplify/attribute_quadric/centred_quadric.h"
#include "core/simplify/attribute_quadric/packed_mesh.h"

namespace coppice {

// How many diagonals off the surface are as bad as one unit off in the attribute; 0 leaves it out of errors,
// but its values still go where the vertices go.
// UVs: of the lengths in space that the texture has in the mean.
struct AttributeWeights {
    double normal = 0, uv = 0, color = 0;
};

class WedgeQuadrics {
  public:
    static constexpr uint32_t most_components = 16;  // of all attributes together; the rest is left

    WedgeQuadrics(const PackedMesh& mesh, const Mesh& source, const AttributeWeights& weights,
                  const Watch& watch);

    bool any() const { return components_ > 0; }
    bool holds_all_of(const Mesh& source) const { return channels_.size() == source.attributes.size(); }

    // Two wedges as one, seen from the one that stays.
    struct Pair {
        uint32_t removed = no_index, kept = no_index;
        CentredQuadric quadric = {};  // A, b, c; its weight is W
        std::array<Vec3f, most_components> gradients = {};
        std::array<float, most_components> offsets = {};  // D
    };

    // Fills in the sums. offset: where the one that goes is, seen from the one that stays.
    void join(Vec3f offset, Pair& pair) const;

    // What is left where the best values are taken; its weight is 0, since only planes have one.
    CentredQuadric error(const Pair& pair) const;
    // The error where the wedge that stays does so with its values.
    float error_with_values_kept(const Pair& pair) const { return pair.quadric.c; }

    // The wedge that stays is at that point now, with the best values or with those it has.
    void merge(const Pair& pair, Vec3f at, bool keep_values);

    // Of a pair at that point: the texture coordinates that it would have, in sets of two.
    uint32_t uv_sets() const { return static_cast<uint32_t>(uv_components_.size()); }
    std::array<float, 2> uv(uint32_t wedge, uint32_t set) const;
    std::array<float, 2> uv(const Pair& pair, Vec3f at, uint32_t set) const;

    // Writes the values of all wedges that were merged over those in the mesh: wedge i there is i here.
    void write(Mesh& mesh) const;

    void renumber_wedges(const Renumbering& numbers, const Watch& watch);

  private:
    struct Channel {
        size_t attribute = 0;  // of the source
        uint32_t first = 0, count = 0;
        float scale = 1;  // from the attribute's unit to diagonals
        bool is_uv = false;
        enum class Range : uint8_t { any, unit_length, zero_to_one } range = Range::any;
    };

    void add_channels(const PackedMesh& mesh, const Mesh& source, const AttributeWeights& weights,
                      const Watch& watch);
    void add_triangles(const PackedMesh& mesh, const Watch& watch);
    float best_change(const Pair& pair, Vec3f at, uint32_t component) const;

    uint32_t components_ = 0;
    uint32_t weighed_ = 0;  // the first of them; A, b and c are of those alone
    std::vector<Channel> channels_;
    std::vector<uint32_t> uv_components_;   // the first of each set
    std::vector<CentredQuadric> quadrics_;  // per wedge
    std::vector<float> values_;             // per wedge and component, scaled
    std::vector<float> offsets_;            // likewise: D
    std::vector<Vec3f> gradients_;          // likewise: G
    std::vector<bool> is_merged_;           // per wedge
};

}  // namespace coppice
