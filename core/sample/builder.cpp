#include "core/sample/builder.h"

#include <array>
#include <map>
#include <tuple>

namespace coppice {

namespace {

// Neighbouring parts compute the same point by different roads; what differs by less than this is one point.
Vec3d snap(Vec3d p) {
    constexpr double steps = 1 << 16;
    const auto round = [](double x) { return std::round(x * steps) / steps + 0.0; };  // + 0.0: no -0
    return {round(p.x), round(p.y), round(p.z)};
}

using PointKey = std::tuple<float, float, float>;
PointKey key(Vec3f p) {
    return {p.x, p.y, p.z};
}

struct Numbered {
    std::vector<Vec3f> positions;
    std::vector<uint32_t> vertex;  // per corner
};

Numbered number_vertices(const std::vector<Corner>& corners) {
    Numbered out;
    std::map<PointKey, uint32_t> known;
    for (const Corner& corner : corners) {
        const Vec3f position = to_float(corner.position);
        const auto [it, added] =
            known.try_emplace(key(position), static_cast<uint32_t>(out.positions.size()));
        if (added) out.positions.push_back(position);
        out.vertex.push_back(it->second);
    }
    return out;
}

std::vector<Vec3f> normals_of(const std::vector<Corner>& corners, const std::vector<uint32_t>& vertex) {
    std::map<std::pair<uint32_t, uint32_t>, Vec3d> sums;  // (vertex, smoothing group) -> area-weighted normal
    const auto area_normal = [&](size_t triangle) {
        const Corner* c = &corners[3 * triangle];
        return cross(c[1].position - c[0].position, c[2].position - c[0].position);
    };
    for (size_t i = 0; i < corners.size(); ++i) {
        Vec3d& sum = sums[{vertex[i], corners[i].smoothing}];
        sum = sum + area_normal(i / 3);
    }
    std::vector<Vec3f> normals;
    for (size_t i = 0; i < corners.size(); ++i) {
        const bool own = corners[i].smoothing == flat;
        normals.push_back(
            to_float(normalized(own ? area_normal(i / 3) : sums[{vertex[i], corners[i].smoothing}])));
    }
    return normals;
}

}  // namespace

uint32_t MeshBuilder::add_slot(uint32_t material) {
    materials_.push_back(material);
    return static_cast<uint32_t>(materials_.size() - 1);
}

void MeshBuilder::triangle(uint32_t slot, const Corner& a, const Corner& b, const Corner& c) {
    std::array<Corner, 3> snapped = {a, b, c};
    for (Corner& corner : snapped) corner.position = snap(corner.position);
    const Vec3d area =
        cross(snapped[1].position - snapped[0].position, snapped[2].position - snapped[0].position);
    if (squared_length(area) == 0) return;
    corners_.insert(corners_.end(), snapped.begin(), snapped.end());
    slots_.push_back(slot);
}

void MeshBuilder::quad(uint32_t slot, const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
    if (squared_length(a.position - c.position) <= squared_length(b.position - d.position)) {
        triangle(slot, a, b, c);
        triangle(slot, a, c, d);
    } else {
        triangle(slot, a, b, d);
        triangle(slot, b, c, d);
    }
}

void MeshBuilder::patch(uint32_t slot, uint32_t rows, uint32_t columns,
                        const std::function<Corner(uint32_t row, uint32_t column)>& corner) {
    for (uint32_t r = 0; r < rows; ++r) {
        for (uint32_t c = 0; c < columns; ++c) {
            quad(slot, corner(r, c), corner(r + 1, c), corner(r + 1, c + 1), corner(r, c + 1));
        }
    }
}

Mesh MeshBuilder::finish() const {
    Mesh mesh;
    mesh.name = name_;
    Numbered numbered = number_vertices(corners_);
    mesh.positions = std::move(numbered.positions);
    const std::vector<Vec3f> normals = normals_of(corners_, numbered.vertex);

    Attribute normal{.name = "NORMAL", .components = 3};
    Attribute uv{.name = "TEXCOORD_0", .components = 2};
    std::map<std::tuple<uint32_t, PointKey, float, float>, uint32_t> known;
    for (size_t i = 0; i < corners_.size(); ++i) {
        const auto u = static_cast<float>(corners_[i].u), v = static_cast<float>(corners_[i].v);
        const auto next = static_cast<uint32_t>(mesh.wedge_count());
        const auto [it, added] = known.try_emplace({numbered.vertex[i], key(normals[i]), u, v}, next);
        mesh.triangles.push_back(it->second);
        if (!added) continue;
        mesh.wedge_vertex.push_back(numbered.vertex[i]);
        normal.values.insert(normal.values.end(), {normals[i].x, normals[i].y, normals[i].z});
        uv.values.insert(uv.values.end(), {u, v});
    }
    mesh.attributes = {std::move(normal), std::move(uv)};

    std::map<uint32_t, uint32_t> used;  // builder's slot -> mesh's slot, in the builder's order
    for (const uint32_t slot : slots_) used.try_emplace(slot, 0);
    for (auto& [slot, index] : used) {
        index = static_cast<uint32_t>(mesh.slots.size());
        mesh.slots.push_back({.material = materials_[slot]});
    }
    for (const uint32_t slot : slots_) mesh.triangle_slot.push_back(used[slot]);
    return mesh;
}

}  // namespace coppice
