#include "core/simplify/attribute_cloud.h"

#include <algorithm>
#include <cmath>

#include "core/base/watched_loop.h"

namespace coppice {

namespace {

constexpr double default_scale_of_diagonal = 0.05;

double area(const CollapseMesh& mesh, uint32_t triangle) {
    const Vec3d a = mesh.position(mesh.corner_vertex(3 * triangle));
    const Vec3d b = mesh.position(mesh.corner_vertex(3 * triangle + 1));
    const Vec3d c = mesh.position(mesh.corner_vertex(3 * triangle + 2));
    return 0.5 * length(cross(b - a, c - a));
}

// Area of the triangles that use each wedge.
std::vector<double> wedge_areas(const CollapseMesh& mesh, const Watch& watch) {
    std::vector<double> areas = watched_vector<double>(mesh.wedge_count(), watch);
    watched_loop(mesh.triangle_count(), watch, [&](size_t i) {
        const auto t = static_cast<uint32_t>(i);
        if (!mesh.is_live_triangle(t)) return;
        const double size = area(mesh, t);
        for (uint32_t c = 3 * t; c < 3 * t + 3; ++c) areas[mesh.corner_wedge(c)] += size;
    });
    return areas;
}

// sqrt(sum of areas in space / sum of areas in the UV plane); 0 where the UV plane has none.
double uv_length(const CollapseMesh& mesh, const Mesh& source, size_t attribute, const Watch& watch) {
    double in_space = 0, in_plane = 0;
    const Attribute& uv = source.attributes[attribute];
    watched_loop(mesh.triangle_count(), watch, [&](size_t i) {
        const auto t = static_cast<uint32_t>(i);
        if (!mesh.is_live_triangle(t) || !source.slots[source.triangle_slot[t]].has(attribute)) return;
        const auto value = [&](uint32_t corner, uint32_t axis) {
            return double{uv.values[size_t{source.triangles[3 * t + corner]} * uv.components + axis]};
        };
        const double ax = value(1, 0) - value(0, 0), ay = value(1, 1) - value(0, 1);
        const double bx = value(2, 0) - value(0, 0), by = value(2, 1) - value(0, 1);
        in_space += area(mesh, t);
        in_plane += 0.5 * std::abs(ax * by - ay * bx);
    });
    const double scale = std::sqrt(in_space / in_plane);
    return std::isfinite(scale) ? scale : 0;
}

enum class Role { none, normal, uv, color };

Role role(const Attribute& a) {
    if (a.name == "NORMAL" && a.components == 3) return Role::normal;
    if (a.name.starts_with("TEXCOORD_") && a.components == 2) return Role::uv;
    if (a.name.starts_with("COLOR_") && a.components >= 3 && a.components <= 4) return Role::color;
    return Role::none;
}

double scale_of(const CollapseMesh& mesh, const Mesh& source, size_t attribute, const AttributeScales& scales,
                const Watch& watch) {
    const double by_diagonal = default_scale_of_diagonal * mesh.box().diagonal();
    switch (role(source.attributes[attribute])) {
        case Role::normal:
            return scales.normal.value_or(by_diagonal);
        case Role::color:
            return scales.color.value_or(by_diagonal);
        case Role::uv: {
            if (scales.uv) return *scales.uv;
            const double by_area = uv_length(mesh, source, attribute, watch);
            return by_area > 0 ? by_area : by_diagonal;
        }
        case Role::none:
            break;
    }
    return 0;
}

}  // namespace

AttributeClouds::AttributeClouds(const CollapseMesh& mesh, const Mesh& source, const AttributeScales& scales,
                                 const Watch& watch) {
    std::vector<size_t> taken;
    for (size_t i = 0; i < source.attributes.size(); ++i) {
        if (role(source.attributes[i]) == Role::none) continue;
        add_channel(source.attributes[i]);
        taken.push_back(i);
    }
    if (taken.empty()) return;
    watched_resize(values_, size_t{mesh.wedge_count()} * value_stride_, watch);
    watched_resize(clouds_, size_t{mesh.wedge_count()} * cloud_stride_, watch);
    const std::vector<double> areas = wedge_areas(mesh, watch);
    for (size_t i = 0; i < taken.size(); ++i) {
        const double scale = scale_of(mesh, source, taken[i], scales, watch);
        if (role(source.attributes[taken[i]]) == Role::normal) channels_[i].unit_length = scale;
        fill(mesh, source, taken[i], channels_[i], scale, areas, watch);
    }
}

void AttributeClouds::add_channel(const Attribute& attribute) {
    channels_.push_back(
        {attribute.components, static_cast<uint32_t>(value_stride_), static_cast<uint32_t>(cloud_stride_)});
    value_stride_ += attribute.components;
    cloud_stride_ += attribute.components + 2;
}

void AttributeClouds::fill(const CollapseMesh& mesh, const Mesh& source, size_t attribute,
                           const Channel& channel, double scale, std::span<const double> wedge_areas,
                           const Watch& watch) {
    const std::vector<float>& from = source.attributes[attribute].values;
    const uint32_t n = channel.components;
    watched_loop(mesh.wedge_count(), watch, [&](size_t i) {
        const auto w = static_cast<uint32_t>(i);
        double* value = values_.data() + w * value_stride_ + channel.value_offset;
        double* cloud = clouds_.data() + w * cloud_stride_ + channel.cloud_offset;
        const double weight = source.slots[mesh.wedge_slot(w)].has(attribute) ? wedge_areas[w] : 0.0;
        double squared = 0;
        for (uint32_t k = 0; k < n; ++k) {
            value[k] = scale * double{from[size_t{mesh.wedge_source(w)} * n + k]};
            cloud[1 + k] = weight * value[k];
            squared += value[k] * value[k];
        }
        cloud[0] = weight;
        cloud[n + 1] = weight * squared;
    });
}

double AttributeClouds::squared_error(uint32_t from, std::span<const WedgeShare> at, uint32_t channel) const {
    return squared_error(from, mean(at, channels_[channel]).data(), channel);
}

AttributeClouds::Value AttributeClouds::mean(std::span<const WedgeShare> shares,
                                             const Channel& channel) const {
    Value value = {};
    double squared = 0;
    for (uint32_t k = 0; k < channel.components; ++k) {
        for (const WedgeShare& share : shares)
            value[k] += share.weight * values_[share.wedge * value_stride_ + channel.value_offset + k];
        squared += value[k] * value[k];
    }
    if (channel.unit_length > 0 && squared > 0) {
        for (double& v : value) v *= channel.unit_length / std::sqrt(squared);
    }
    return value;
}

void AttributeClouds::blend(std::span<const WedgeShare> shares, uint32_t into) {
    blended_.resize(value_stride_);
    for (const Channel& channel : channels_) {
        const Value value = mean(shares, channel);
        std::copy_n(value.begin(), channel.components, blended_.begin() + channel.value_offset);
    }
    std::copy(blended_.begin(), blended_.end(),
              values_.begin() + static_cast<std::ptrdiff_t>(into * value_stride_));
}

double AttributeClouds::squared_error(uint32_t from, uint32_t at) const {
    double sum = 0;
    for (uint32_t channel = 0; channel < channels_.size(); ++channel) sum += squared_error(from, at, channel);
    return sum;
}

void AttributeClouds::merge(uint32_t from, uint32_t to) {
    const double* added = clouds_.data() + from * cloud_stride_;
    double* sum = clouds_.data() + to * cloud_stride_;
    for (size_t k = 0; k < cloud_stride_; ++k) sum[k] += added[k];
}

}  // namespace coppice
