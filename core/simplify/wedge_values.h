// Attribute values of wedges that change: what a corner has once it is put between others.
//
// Only wedges that were blended take memory; the others read their source. One object, one thread.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/mesh/mesh.h"

namespace coppice {

// A wedge's part in a blend.
struct WedgeShare {
    uint32_t wedge = 0;
    double weight = 0;  // >= 0; those of a blend sum to 1
};

class WedgeValues {
  public:
    // wedge_source: per wedge here, the source's wedge that it starts as. Both must outlive this.
    WedgeValues(const Mesh& source, std::span<const uint32_t> wedge_source);

    // Gives `into` the weighted mean of the shares, which may hold `into` itself:
    //   - normals and tangents of unit length, handedness from the largest share;
    //   - joints with their weights, summed by joint; the strongest stay, as many as there is room for, and
    //   keep the sum of all weights;
    //   - other custom values (_ANYTHING) and what has no mean: as in the largest share;
    //   - UVs, colours, and deltas of morph targets: linear.
    // Ties of shares go to the first.
    void blend(std::span<const WedgeShare> shares, uint32_t into);

    // A value as it is now: attribute, component.
    float value(uint32_t wedge, size_t attribute, uint32_t component) const;

    // Whether two wedges could be of one chart, as they are now (wedge_charts.h).
    bool same_chart(uint32_t a, uint32_t b) const;

    // Replaces the attributes and morph deltas of `mesh`, whose wedge i takes the values of wedges[i].
    void write(std::span<const uint32_t> wedges, Mesh& mesh) const;

  private:
    enum class Mean { linear, direction, tangent, skin, none };
    struct Stream {
        const std::vector<float>* source = nullptr;
        uint32_t components = 0;
        uint32_t offset = 0;    // in a row
        size_t first_hard = 0;  // component
        Mean mean = Mean::none;
    };

    void add_stream(const Attribute& attribute, Mean mean);
    void find_skin(const Mesh& source);
    const float* values(uint32_t wedge, const Stream& stream) const;
    void blend_stream(const Stream& stream, std::span<const WedgeShare> shares, size_t largest);
    void blend_skin(std::span<const WedgeShare> shares);
    float* blended(const Stream& stream) { return row_.data() + stream.offset; }

    std::span<const uint32_t> wedge_source_;
    std::vector<Stream> streams_;                       // of attributes, then of morph targets
    std::vector<std::pair<uint32_t, uint32_t>> skins_;  // streams of JOINTS_n and WEIGHTS_n
    uint32_t stride_ = 0;                               // of a row
    std::vector<uint32_t> row_of_;                      // per wedge; none until it was blended
    std::vector<float> rows_;
    std::vector<float> row_;                           // scratch: the blend that is being made
    std::vector<std::pair<float, float>> influences_;  // scratch: joint, weight
};

}  // namespace coppice
