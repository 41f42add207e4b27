#include "core/mesh/weld.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <unordered_map>
#include <unordered_set>

namespace coppice {

namespace {

constexpr uint32_t none = std::numeric_limits<uint32_t>::max();

uint64_t mix(uint64_t hash, uint64_t value) {
    // The finalizer of SplitMix64, Steele, Lea and Flood 2014.
    hash += value + 0x9e3779b97f4a7c15ULL;
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9ULL;
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebULL;
    return hash ^ (hash >> 31);
}

uint32_t bits_of(float value) {
    return std::bit_cast<uint32_t>(value == 0.0F ? 0.0F : value);
}

// Numbers items 0..count by first occurrence among equals: result[i] is the group of i, groups ascend by
// first member. An open-addressing table of item indices: one allocation, no keys.
template <typename Hash, typename Equal>
std::vector<uint32_t> group_equal(size_t count, Hash hash, Equal equal,
                                  std::vector<uint32_t>& first_of_group) {
    const size_t size = std::bit_ceil(count + count / 2 + 1);
    std::vector<uint32_t> table(size, none);
    std::vector<uint32_t> group(count);
    first_of_group.clear();
    for (size_t i = 0; i < count; ++i) {
        size_t at = hash(i) & (size - 1);
        while (table[at] != none && !equal(first_of_group[table[at]], i)) at = (at + 1) & (size - 1);
        if (table[at] == none) {
            table[at] = static_cast<uint32_t>(first_of_group.size());
            first_of_group.push_back(static_cast<uint32_t>(i));
        }
        group[i] = table[at];
    }
    return group;
}

// Every stream of values that a wedge has.
std::vector<Attribute*> streams(Mesh& mesh) {
    std::vector<Attribute*> all;
    for (Attribute& attribute : mesh.attributes) all.push_back(&attribute);
    for (MorphTarget& target : mesh.morph_targets) {
        for (Attribute& delta : target.deltas) all.push_back(&delta);
    }
    return all;
}

void keep_items(std::vector<float>& values, uint32_t components, const std::vector<uint32_t>& kept) {
    std::vector<float> result(kept.size() * components);
    for (size_t i = 0; i < kept.size(); ++i) {
        std::copy_n(values.begin() + static_cast<ptrdiff_t>(size_t{kept[i]} * components), components,
                    result.begin() + static_cast<ptrdiff_t>(i * components));
    }
    values = std::move(result);
}

void keep_wedges(Mesh& mesh, const std::vector<uint32_t>& kept) {
    std::vector<uint32_t> wedge_vertex(kept.size());
    for (size_t i = 0; i < kept.size(); ++i) wedge_vertex[i] = mesh.wedge_vertex[kept[i]];
    mesh.wedge_vertex = std::move(wedge_vertex);
    for (Attribute* stream : streams(mesh)) keep_items(stream->values, stream->components, kept);
}

void weld_vertices(Mesh& mesh) {
    const auto& positions = mesh.positions;
    std::vector<uint32_t> first;
    const std::vector<uint32_t> group = group_equal(
        positions.size(),
        [&](size_t i) {
            const uint64_t xy = uint64_t{bits_of(positions[i].x)} << 32 | bits_of(positions[i].y);
            return mix(mix(0, xy), bits_of(positions[i].z));
        },
        [&](size_t a, size_t b) { return positions[a] == positions[b]; }, first);
    std::vector<Vec3f> welded(first.size());
    for (size_t i = 0; i < first.size(); ++i) welded[i] = positions[first[i]];
    mesh.positions = std::move(welded);
    for (uint32_t& vertex : mesh.wedge_vertex) vertex = group[vertex];
}

// For each wedge the lowest slot of its class: slots with equal attribute sets are one class, so that wedges
// are only merged when whoever uses them agrees on which attributes exist. Wedges that no triangle uses are
// class none.
std::vector<uint32_t> slot_class_of_wedges(const Mesh& mesh) {
    std::unordered_map<std::vector<bool>, uint32_t> classes;  // by attribute set: the lowest slot
    std::vector<uint32_t> slot_class;
    for (const MaterialSlot& slot : mesh.slots) {
        const auto next = static_cast<uint32_t>(slot_class.size());
        slot_class.push_back(classes.try_emplace(slot.has_attribute, next).first->second);
    }
    std::vector<uint32_t> wedge_class(mesh.wedge_count(), none);
    for (size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
        wedge_class[mesh.triangles[corner]] = slot_class[mesh.triangle_slot[corner / 3]];
    }
    return wedge_class;
}

void weld_wedges(Mesh& mesh) {
    const std::vector<Attribute*> all = streams(mesh);
    const std::vector<uint32_t> wedge_class = slot_class_of_wedges(mesh);
    std::vector<uint32_t> first;
    const std::vector<uint32_t> group = group_equal(
        mesh.wedge_count(),
        [&](size_t w) {
            uint64_t hash = mix(mesh.wedge_vertex[w], wedge_class[w]);
            for (const Attribute* stream : all) {
                for (uint32_t c = 0; c < stream->components; ++c) {
                    hash = mix(hash, bits_of(stream->values[w * stream->components + c]));
                }
            }
            return hash;
        },
        [&](size_t a, size_t b) {
            return mesh.wedge_vertex[a] == mesh.wedge_vertex[b] && wedge_class[a] == wedge_class[b] &&
                   std::all_of(all.begin(), all.end(), [&](const Attribute* stream) {
                       const size_t n = stream->components;
                       const float* values = stream->values.data();
                       return std::equal(values + a * n, values + (a + 1) * n, values + b * n);
                   });
        },
        first);
    keep_wedges(mesh, first);
    for (uint32_t& wedge : mesh.triangles) wedge = group[wedge];
}

struct TriangleHash {
    size_t operator()(const std::array<uint32_t, 3>& t) const { return mix(mix(mix(0, t[0]), t[1]), t[2]); }
};

// The same for the three rotations of a triangle, another for its mirror image.
std::array<uint32_t, 3> canonical(std::array<uint32_t, 3> t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

}  // namespace

void weld(Mesh& mesh) {
    weld_vertices(mesh);
    weld_wedges(mesh);
}

void drop_unused(Mesh& mesh) {
    std::vector<uint32_t> new_wedge(mesh.wedge_count(), none);
    for (const uint32_t wedge : mesh.triangles) new_wedge[wedge] = 0;
    std::vector<uint32_t> kept_wedges;
    for (uint32_t w = 0; w < new_wedge.size(); ++w) {
        if (new_wedge[w] == none) continue;
        new_wedge[w] = static_cast<uint32_t>(kept_wedges.size());
        kept_wedges.push_back(w);
    }
    keep_wedges(mesh, kept_wedges);
    for (uint32_t& wedge : mesh.triangles) wedge = new_wedge[wedge];

    std::vector<uint32_t> new_vertex(mesh.vertex_count(), none);
    for (const uint32_t vertex : mesh.wedge_vertex) new_vertex[vertex] = 0;
    std::vector<Vec3f> kept_positions;
    for (size_t v = 0; v < new_vertex.size(); ++v) {
        if (new_vertex[v] == none) continue;
        new_vertex[v] = static_cast<uint32_t>(kept_positions.size());
        kept_positions.push_back(mesh.positions[v]);
    }
    mesh.positions = std::move(kept_positions);
    for (uint32_t& vertex : mesh.wedge_vertex) vertex = new_vertex[vertex];
}

CleanedTriangles drop_degenerate_and_duplicate(Mesh& mesh) {
    CleanedTriangles cleaned;
    std::unordered_set<std::array<uint32_t, 3>, TriangleHash> seen;
    seen.reserve(mesh.triangle_count());
    size_t kept = 0;
    for (size_t t = 0; t < mesh.triangle_count(); ++t) {
        const std::array<uint32_t, 3> v = {mesh.corner_vertex(t, 0), mesh.corner_vertex(t, 1),
                                           mesh.corner_vertex(t, 2)};
        const Vec3d a = to_double(mesh.positions[v[0]]);
        const Vec3d b = to_double(mesh.positions[v[1]]);
        const Vec3d c = to_double(mesh.positions[v[2]]);
        const bool repeats_vertex = v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
        if (repeats_vertex || squared_length(cross(b - a, c - a)) == 0) {
            ++cleaned.degenerate;
        } else if (!seen.insert(canonical(v)).second) {
            ++cleaned.duplicate;
        } else {
            std::copy_n(mesh.triangles.begin() + static_cast<ptrdiff_t>(3 * t), 3,
                        mesh.triangles.begin() + static_cast<ptrdiff_t>(3 * kept));
            mesh.triangle_slot[kept] = mesh.triangle_slot[t];
            ++kept;
        }
    }
    mesh.triangles.resize(3 * kept);
    mesh.triangle_slot.resize(kept);
    return cleaned;
}

}  // namespace coppice
