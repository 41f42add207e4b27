#include "core/simplify/wedge_values.h"

#include <algorithm>
#include <cmath>

#include "core/simplify/wedge_charts.h"

namespace coppice {

namespace {

constexpr uint32_t no_row = UINT32_MAX;

size_t largest_of(std::span<const WedgeShare> shares) {
    const auto less = [](const WedgeShare& a, const WedgeShare& b) { return a.weight < b.weight; };
    return static_cast<size_t>(std::max_element(shares.begin(), shares.end(), less) - shares.begin());
}

}  // namespace

WedgeValues::WedgeValues(const Mesh& source, std::span<const uint32_t> wedge_source)
    : wedge_source_(wedge_source), row_of_(wedge_source.size(), no_row) {
    for (const Attribute& a : source.attributes) {
        const bool linear = a.name.starts_with("TEXCOORD_") || a.name.starts_with("COLOR_");
        const bool direction = a.name == "NORMAL" && a.components == 3;
        const bool tangent = a.name == "TANGENT" && a.components == 4;
        add_stream(a, linear      ? Mean::linear
                      : direction ? Mean::direction
                      : tangent   ? Mean::tangent
                                  : Mean::none);
    }
    find_skin(source);
    for (const MorphTarget& target : source.morph_targets) {
        for (const Attribute& delta : target.deltas) add_stream(delta, Mean::linear);
    }
    row_.resize(stride_);
}

void WedgeValues::add_stream(const Attribute& attribute, Mean mean) {
    streams_.push_back(
        {&attribute.values, attribute.components, stride_, first_hard_component(attribute), mean});
    stride_ += attribute.components;
}

// JOINTS_n and WEIGHTS_n belong together; one without the other has no mean.
void WedgeValues::find_skin(const Mesh& source) {
    for (uint32_t j = 0; j < source.attributes.size(); ++j) {
        const Attribute& joints = source.attributes[j];
        if (!joints.name.starts_with("JOINTS_")) continue;
        for (uint32_t w = 0; w < source.attributes.size(); ++w) {
            const Attribute& weights = source.attributes[w];
            if (weights.name != "WEIGHTS_" + joints.name.substr(7) ||
                weights.components != joints.components) {
                continue;
            }
            streams_[j].mean = streams_[w].mean = Mean::skin;
            skins_.emplace_back(j, w);
        }
    }
}

const float* WedgeValues::values(uint32_t wedge, const Stream& stream) const {
    const uint32_t row = row_of_[wedge];
    if (row != no_row) return rows_.data() + size_t{row} * stride_ + stream.offset;
    return stream.source->data() + size_t{wedge_source_[wedge]} * stream.components;
}

float WedgeValues::value(uint32_t wedge, size_t attribute, uint32_t component) const {
    return values(wedge, streams_[attribute])[component];
}

bool WedgeValues::same_chart(uint32_t a, uint32_t b) const {
    return std::all_of(streams_.begin(), streams_.end(), [&](const Stream& s) {
        const float* one = values(a, s);
        return s.first_hard >= s.components ||
               std::equal(one + s.first_hard, one + s.components, values(b, s) + s.first_hard);
    });
}

void WedgeValues::blend(std::span<const WedgeShare> shares, uint32_t into) {
    const size_t largest = largest_of(shares);
    for (const Stream& stream : streams_) {
        if (stream.mean != Mean::skin) blend_stream(stream, shares, largest);
    }
    if (!skins_.empty()) blend_skin(shares);
    uint32_t& row = row_of_[into];
    if (row == no_row) {
        row = static_cast<uint32_t>(stride_ == 0 ? 0 : rows_.size() / stride_);
        rows_.resize(rows_.size() + stride_);
    }
    std::copy(row_.begin(), row_.end(), rows_.begin() + static_cast<std::ptrdiff_t>(size_t{row} * stride_));
}

void WedgeValues::blend_stream(const Stream& stream, std::span<const WedgeShare> shares, size_t largest) {
    float* out = blended(stream);
    const float* nearest = values(shares[largest].wedge, stream);
    if (stream.mean == Mean::none) {
        std::copy_n(nearest, stream.components, out);
        return;
    }
    const bool is_direction = stream.mean != Mean::linear;
    const uint32_t count = is_direction ? 3 : stream.components;
    double squared = 0;
    for (uint32_t k = 0; k < count; ++k) {
        double sum = 0;
        for (const WedgeShare& share : shares) sum += share.weight * double{values(share.wedge, stream)[k]};
        out[k] = static_cast<float>(sum);
        squared += sum * sum;
    }
    if (!is_direction) return;
    // Directions that cancel have no mean.
    const double length = std::sqrt(squared);
    for (uint32_t k = 0; k < 3; ++k)
        out[k] = length > 1e-6 ? static_cast<float>(double{out[k]} / length) : nearest[k];
    if (stream.mean == Mean::tangent) out[3] = nearest[3];
}

void WedgeValues::blend_skin(std::span<const WedgeShare> shares) {
    influences_.clear();
    double total = 0;
    size_t room = 0;
    for (const auto& [joints, weights] : skins_) {
        room += streams_[joints].components;
        for (const WedgeShare& share : shares) {
            const float* joint = values(share.wedge, streams_[joints]);
            const float* weight = values(share.wedge, streams_[weights]);
            for (uint32_t k = 0; k < streams_[joints].components; ++k) {
                const double part = share.weight * double{weight[k]};
                if (!(part > 0)) continue;
                total += part;
                influences_.emplace_back(joint[k], static_cast<float>(part));
            }
        }
    }
    std::stable_sort(influences_.begin(), influences_.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    size_t distinct = 0;
    for (const auto& influence : influences_) {
        if (distinct > 0 && influences_[distinct - 1].first == influence.first) {
            influences_[distinct - 1].second += influence.second;
        } else {
            influences_[distinct++] = influence;
        }
    }
    influences_.resize(distinct);
    std::stable_sort(influences_.begin(), influences_.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    if (influences_.size() > room) influences_.resize(room);
    double kept = 0;
    for (const auto& influence : influences_) kept += double{influence.second};

    size_t next = 0;
    for (const auto& [joints, weights] : skins_) {
        for (uint32_t k = 0; k < streams_[joints].components; ++k, ++next) {
            const bool used = next < influences_.size();
            blended(streams_[joints])[k] = used ? influences_[next].first : 0;
            blended(streams_[weights])[k] =
                used ? static_cast<float>(double{influences_[next].second} * total / kept) : 0;
        }
    }
}

void WedgeValues::write(std::span<const uint32_t> wedges, Mesh& mesh) const {
    size_t stream = 0;
    const auto fill = [&](Attribute& attribute) {
        const Stream& from = streams_[stream++];
        attribute.values.clear();
        attribute.values.reserve(wedges.size() * from.components);
        for (const uint32_t wedge : wedges) {
            const float* value = values(wedge, from);
            attribute.values.insert(attribute.values.end(), value, value + from.components);
        }
    };
    for (Attribute& attribute : mesh.attributes) fill(attribute);
    for (MorphTarget& target : mesh.morph_targets) {
        for (Attribute& delta : target.deltas) fill(delta);
    }
}

}  // namespace coppice
