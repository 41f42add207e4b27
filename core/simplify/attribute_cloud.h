// Point clouds of GAPS (Erikson and Manocha 1999, as ITS prints them): what attribute values a wedge stands
// for.
//
// A cloud of weighted points a_i is X = (X0, X1, X2) = (sum w, sum w a, sum w |a|^2). The weighted sum of
// squared distances of a value a from it is Pi(a) = X0 |a|^2 - 2 a.X1 + X2, and A(a) = sqrt(Pi(a) / X0).
// Merging is adding. Each wedge starts as one point, its value, weighted by the area of the triangles that
// use it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/simplify/collapse_mesh.h"

namespace coppice {

// How long one unit of an attribute is in mesh units, so that errors can be added. Unset: 0.05 of the box's
// diagonal for normals and colours, sqrt(area in space / area in the UV plane) for each set of UVs.
struct AttributeScales {
    std::optional<double> normal = {};
    std::optional<double> uv = {};
    std::optional<double> color = {};
};

class AttributeClouds {
  public:
    // Takes NORMAL, TEXCOORD_n and COLOR_n. A wedge whose slot lacks an attribute gets an empty cloud for it.
    AttributeClouds(const CollapseMesh& mesh, const Mesh& source, const AttributeScales& scales,
                    const Watch& watch = {});

    uint32_t channels() const { return static_cast<uint32_t>(channels_.size()); }  // one per attribute

    // X0 of a wedge's cloud, mesh units squared.
    double weight(uint32_t wedge, uint32_t channel) const { return clouds_[cloud_at(wedge, channel)]; }

    // Pi of the cloud of `from` at the value of `at`. One channel, or the sum over all.
    double squared_error(uint32_t from, uint32_t at, uint32_t channel) const;
    double squared_error(uint32_t from, uint32_t at) const;

    // Pi of the cloud of `from` at a blend of values.
    double squared_error(uint32_t from, std::span<const WedgeShare> at, uint32_t channel) const;

    // Gives a wedge the blend of these values; its cloud stays. Normals are made of unit length again.
    void blend(std::span<const WedgeShare> shares, uint32_t into);

    // Adds the clouds of `from` to those of `to`.
    void merge(uint32_t from, uint32_t to);

  private:
    struct Channel {
        uint32_t components = 0;
        uint32_t value_offset = 0;  // in a wedge's values
        uint32_t cloud_offset = 0;  // in a wedge's clouds: X0, X1 (components), X2
        double unit_length = 0;     // of a normal, as scaled; 0: any
    };

    static constexpr uint32_t most_components = 4;
    using Value = std::array<double, most_components>;
    Value mean(std::span<const WedgeShare> shares, const Channel& channel) const;
    double squared_error(uint32_t from, const double* value, uint32_t channel) const;

    size_t cloud_at(uint32_t wedge, uint32_t channel) const {
        return size_t{wedge} * cloud_stride_ + channels_[channel].cloud_offset;
    }
    void add_channel(const Attribute& attribute);
    void fill(const CollapseMesh& mesh, const Mesh& source, size_t attribute, const Channel& channel,
              double scale, std::span<const double> wedge_areas, const Watch& watch);

    std::vector<Channel> channels_;
    size_t value_stride_ = 0, cloud_stride_ = 0;
    std::vector<double> values_;   // scaled, value_stride_ per wedge
    std::vector<double> clouds_;   // cloud_stride_ per wedge
    std::vector<double> blended_;  // scratch
};

// In the header, since half the time of a cost is spent here.
inline double AttributeClouds::squared_error(uint32_t from, const double* value, uint32_t channel) const {
    const uint32_t n = channels_[channel].components;
    const double* cloud = clouds_.data() + cloud_at(from, channel);
    double squared = 0, product = 0;
    for (uint32_t k = 0; k < n; ++k) {
        squared += value[k] * value[k];
        product += value[k] * cloud[1 + k];
    }
    const double sum = cloud[0] * squared - 2 * product + cloud[n + 1];
    return sum > 0 ? sum : 0;  // rounding
}

inline double AttributeClouds::squared_error(uint32_t from, uint32_t at, uint32_t channel) const {
    return squared_error(from, values_.data() + at * value_stride_ + channels_[channel].value_offset,
                         channel);
}

}  // namespace coppice
