#include "core/simplify/attribute_quadric/wedge_quadrics.h"

#include <algorithm>
#include <cmath>

#include "core/base/watched_loop.h"

namespace coppice {

namespace {

// How long one unit of texture coordinates is in space, in diagonals: sqrt(area / area in the texture).
double length_of_uv(const PackedMesh& mesh, const Attribute& uv, const Watch& watch) {
    double in_space = 0, in_texture = 0;
    watched_loop(mesh.triangle_count(), watch, [&](size_t t) {
        std::array<Vec3d, 3> p, q;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t vertex = mesh.triangles[3 * t + k];
            const uint32_t wedge = mesh.has_wedges() ? mesh.corner_wedges[3 * t + k] : vertex;
            const float* value = uv.values.data() + size_t{2} * mesh.wedge_source[wedge];
            p[k] = to_double(mesh.positions[vertex]);
            q[k] = {double{value[0]}, double{value[1]}, 0};
        }
        in_space += length(area_normal(p[0], p[1], p[2]));
        in_texture += length(area_normal(q[0], q[1], q[2]));
    });
    return in_texture > 0 ? std::sqrt(in_space / in_texture) : 0;
}

}  // namespace

WedgeQuadrics::WedgeQuadrics(const PackedMesh& mesh, const Mesh& source, const AttributeWeights& weights,
                             const Watch& watch) {
    add_channels(mesh, source, weights, watch);
    if (!any()) return;
    const size_t count = mesh.wedge_count();
    watched_resize(quadrics_, count, watch);
    watched_resize(offsets_, count * components_, watch);
    watched_resize(gradients_, count * components_, watch);
    is_merged_.resize(count);
    values_.reserve(count * components_);
    watched_loop(count, watch, [&](size_t w) {
        for (const Channel& channel : channels_) {
            const Attribute& attribute = source.attributes[channel.attribute];
            const float* value = attribute.values.data() + size_t{mesh.wedge_source[w]} * channel.count;
            for (uint32_t k = 0; k < channel.count; ++k) values_.push_back(value[k] * channel.scale);
        }
    });
    add_triangles(mesh, watch);
}

void WedgeQuadrics::add_channels(const PackedMesh& mesh, const Mesh& source, const AttributeWeights& weights,
                                 const Watch& watch) {
    std::vector<Channel> found;
    for (size_t i = 0; i < source.attributes.size(); ++i) {
        const Attribute& a = source.attributes[i];
        Channel channel = {.attribute = i, .count = a.components};
        double scale = 0;
        if (a.name == "NORMAL" && a.components == 3) {
            scale = weights.normal;
            channel.range = Channel::Range::unit_length;
        } else if (a.name.starts_with("TEXCOORD_") && a.components == 2) {
            scale = weights.uv > 0 ? weights.uv * length_of_uv(mesh, a, watch) : 0;
            channel.is_uv = true;
        } else if (a.name.starts_with("COLOR_") && a.components <= 4) {
            scale = weights.color;
            channel.range = Channel::Range::zero_to_one;
        } else {
            continue;
        }
        channel.scale = static_cast<float>(scale);
        found.push_back(channel);
    }
    const auto is_weighed = [](const Channel& channel) { return channel.scale > 0; };
    std::stable_partition(found.begin(), found.end(), is_weighed);
    for (Channel& channel : found) {
        if (components_ + channel.count > most_components) continue;
        channel.first = components_;
        components_ += channel.count;
        if (is_weighed(channel)) {
            weighed_ = components_;
        } else {
            channel.scale = 1;
        }
        if (channel.is_uv) uv_components_.push_back(channel.first);
        channels_.push_back(channel);
    }
}

// Each triangle counts a third at each of its corners, where d is 0.
void WedgeQuadrics::add_triangles(const PackedMesh& mesh, const Watch& watch) {
    watched_loop(mesh.triangle_count(), watch, [&](size_t t) {
        std::array<uint32_t, 3> wedges{};
        for (size_t k = 0; k < 3; ++k)
            wedges[k] = mesh.has_wedges() ? mesh.corner_wedges[3 * t + k] : mesh.triangles[3 * t + k];
        const Vec3f p = mesh.positions[mesh.triangles[3 * t]];
        const Vec3f e1 = mesh.positions[mesh.triangles[3 * t + 1]] - p;
        const Vec3f e2 = mesh.positions[mesh.triangles[3 * t + 2]] - p;
        const Vec3f normal = cross(e1, e2);
        const float squared = squared_length(normal);
        const float weight = std::sqrt(squared) / 6;
        for (const uint32_t w : wedges) quadrics_[w].weight += weight;
        // Of a sliver the gradient is as good as nothing known.
        const float longest = std::max(squared_length(e1), squared_length(e2));
        if (!(squared > 1e-10F * longest * longest)) return;
        // g.e1 = s1 - s0, g.e2 = s2 - s0, g.n = 0.
        const Vec3f along_1 = cross(e2, normal) * (1 / squared), along_2 = cross(normal, e1) * (1 / squared);
        for (uint32_t k = 0; k < components_; ++k) {
            const auto value = [&](size_t corner) {
                return values_[size_t{wedges[corner]} * components_ + k];
            };
            const Vec3f g = along_1 * (value(1) - value(0)) + along_2 * (value(2) - value(0));
            for (const uint32_t w : wedges) {
                if (k < weighed_) quadrics_[w].add_square(g, weight);
                Vec3f& sum = gradients_[size_t{w} * components_ + k];
                sum = sum + g * weight;
            }
        }
    });
}

// With values that differ by delta and points by t: d becomes d + delta - g.t.
void WedgeQuadrics::join(Vec3f offset, Pair& pair) const {
    const size_t r = size_t{pair.removed} * components_, s = size_t{pair.kept} * components_;
    const float weight = quadrics_[pair.removed].weight;
    CentredQuadric moved = quadrics_[pair.removed].seen_from(offset);
    for (uint32_t k = 0; k < components_; ++k) {
        const float change = values_[r + k] - values_[s + k];
        const Vec3f gradient = gradients_[r + k];
        const float at_offset = offsets_[r + k] - dot(gradient, offset);
        if (k < weighed_) {
            moved.b = moved.b + gradient * change;
            moved.c += change * (weight * change + 2 * at_offset);
        }
        pair.offsets[k] = offsets_[s + k] + at_offset + weight * change;
        pair.gradients[k] = gradients_[s + k] + gradient;
    }
    pair.quadric = quadrics_[pair.kept];
    pair.quadric += moved;
}

CentredQuadric WedgeQuadrics::error(const Pair& pair) const {
    CentredQuadric q = pair.quadric;
    const float inverse = q.weight > 0 ? 1 / q.weight : 0;
    q.weight = 0;
    for (uint32_t k = 0; k < weighed_; ++k) {
        q.add_square(pair.gradients[k], -inverse);
        q.b = q.b - pair.gradients[k] * (pair.offsets[k] * inverse);
        q.c -= pair.offsets[k] * pair.offsets[k] * inverse;
    }
    return q;
}

float WedgeQuadrics::best_change(const Pair& pair, Vec3f at, uint32_t component) const {
    const float weight = pair.quadric.weight;
    return weight > 0 ? (dot(pair.gradients[component], at) + pair.offsets[component]) / weight : 0;
}

void WedgeQuadrics::merge(const Pair& pair, Vec3f at, bool keep_values) {
    const size_t s = size_t{pair.kept} * components_;
    const float weight = pair.quadric.weight;
    CentredQuadric q = pair.quadric.seen_from(at * -1);
    for (uint32_t k = 0; k < components_; ++k) {
        const float change = keep_values ? 0 : best_change(pair, at, k);
        const Vec3f gradient = pair.gradients[k];
        const float at_point = pair.offsets[k] + dot(gradient, at);
        if (k < weighed_) {
            q.b = q.b - gradient * change;
            q.c += change * (weight * change - 2 * at_point);
        }
        offsets_[s + k] = at_point - weight * change;
        gradients_[s + k] = gradient;
        values_[s + k] += change;
    }
    q.c = std::max(0.0F, q.c);
    quadrics_[pair.kept] = q;
    if (!keep_values) is_merged_[pair.kept] = true;
}

std::array<float, 2> WedgeQuadrics::uv(uint32_t wedge, uint32_t set) const {
    const float* value = values_.data() + size_t{wedge} * components_ + uv_components_[set];
    return {value[0], value[1]};
}

std::array<float, 2> WedgeQuadrics::uv(const Pair& pair, Vec3f at, uint32_t set) const {
    const auto [u, v] = uv(pair.kept, set);
    const uint32_t first = uv_components_[set];
    return {u + best_change(pair, at, first), v + best_change(pair, at, first + 1)};
}

void WedgeQuadrics::write(Mesh& mesh) const {
    for (size_t w = 0; w < is_merged_.size(); ++w) {
        if (!is_merged_[w]) continue;
        for (const Channel& channel : channels_) {
            float* out = mesh.attributes[channel.attribute].values.data() + w * channel.count;
            const float* value = values_.data() + w * components_ + channel.first;
            double squared = 0;
            for (uint32_t k = 0; k < channel.count; ++k)
                squared +=
                    double{value[k]} / double{channel.scale} * double{value[k]} / double{channel.scale};
            const double length = channel.range == Channel::Range::unit_length ? std::sqrt(squared) : 1;
            if (!(length > 1e-6)) continue;  // normals that cancel: that of the vertex that stayed
            for (uint32_t k = 0; k < channel.count; ++k) {
                out[k] = static_cast<float>(double{value[k]} / (double{channel.scale} * length));
                if (channel.range == Channel::Range::zero_to_one) out[k] = std::clamp(out[k], 0.0F, 1.0F);
            }
        }
    }
}

void WedgeQuadrics::renumber_wedges(const Renumbering& numbers, const Watch& watch) {
    if (!any()) return;
    const size_t left = numbers.wedges_left;
    renumber(quadrics_, numbers.wedges, left, watch);
    renumber(values_, numbers.wedges, left, watch, components_);
    renumber(offsets_, numbers.wedges, left, watch, components_);
    renumber(gradients_, numbers.wedges, left, watch, components_);
    renumber(is_merged_, numbers.wedges, left, watch);
}

}  // namespace coppice
