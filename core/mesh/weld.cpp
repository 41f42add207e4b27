#include "core/mesh/weld.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <map>
#include <random>

#include "core/base/watched_loop.h"
#include "core/mesh/attribute_set.h"

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
// first member. An open-addressing table of item indices: one allocation, no keys. hash(seed, i) starts from
// a seed that no file can know, or one could be made whose items all meet in one place of the table. No
// result depends on it.
template <typename Hash, typename Equal>
std::vector<uint32_t> group_equal(size_t count, Hash hash, Equal equal, std::vector<uint32_t>& first_of_group,
                                  const Watch& watch) {
    const size_t size = std::bit_ceil(count + count / 2 + 1);
    std::vector<uint32_t> table = watched_vector(size, watch, none);
    std::vector<uint32_t> group = watched_vector<uint32_t>(count, watch);
    const uint64_t seed = std::random_device()();
    first_of_group.clear();
    watched_loop(count, watch, [&](size_t i) {
        size_t at = hash(seed, i) & (size - 1);
        while (table[at] != none && !equal(first_of_group[table[at]], i)) at = (at + 1) & (size - 1);
        if (table[at] == none) {
            table[at] = static_cast<uint32_t>(first_of_group.size());
            first_of_group.push_back(static_cast<uint32_t>(i));
        }
        group[i] = table[at];
    });
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

// Item i of the result is the `components` values of item kept[i].
template <typename T>
void keep_items(std::vector<T>& values, size_t components, const std::vector<uint32_t>& kept,
                const Watch& watch) {
    std::vector<T> result = watched_vector<T>(kept.size() * components, watch);
    watched_loop(kept.size(), watch, [&](size_t i) {
        std::copy_n(values.data() + kept[i] * components, components, result.data() + i * components);
    });
    values = std::move(result);
}

void keep_wedges(Mesh& mesh, const std::vector<uint32_t>& kept, const Watch& watch) {
    keep_items(mesh.wedge_vertex, 1, kept, watch);
    for (Attribute* stream : streams(mesh)) keep_items(stream->values, stream->components, kept, watch);
}

void keep_triangles(Mesh& mesh, const std::vector<uint32_t>& kept, const Watch& watch) {
    if (kept.size() == mesh.triangle_count()) return;
    keep_items(mesh.triangles, 3, kept, watch);
    keep_items(mesh.triangle_slot, 1, kept, watch);
}

void weld_vertices(Mesh& mesh, const Watch& watch) {
    const auto& positions = mesh.positions;
    std::vector<uint32_t> first;
    const std::vector<uint32_t> group = group_equal(
        positions.size(),
        [&](uint64_t seed, size_t i) {
            const uint64_t xy = uint64_t{bits_of(positions[i].x)} << 32 | bits_of(positions[i].y);
            return mix(mix(seed, xy), bits_of(positions[i].z));
        },
        [&](size_t a, size_t b) { return positions[a] == positions[b]; }, first, watch);
    keep_items(mesh.positions, 1, first, watch);
    watched_loop(mesh.wedge_count(), watch,
                 [&](size_t w) { mesh.wedge_vertex[w] = group[mesh.wedge_vertex[w]]; });
}

// For each wedge the lowest slot of its class: slots with equal attribute sets are one class, so that wedges
// are only merged when whoever uses them agrees on which attributes exist. Wedges that no triangle uses are
// class none.
std::vector<uint32_t> slot_class_of_wedges(const Mesh& mesh, const Watch& watch) {
    // By attribute set: the lowest slot. Not hashed: a file could be made whose sets all have one hash.
    std::map<std::vector<bool>, uint32_t> classes;
    std::vector<uint32_t> slot_class;
    for (const MaterialSlot& slot : mesh.slots) {
        const auto next = static_cast<uint32_t>(slot_class.size());
        slot_class.push_back(classes.try_emplace(attribute_set(mesh, slot), next).first->second);
    }
    std::vector<uint32_t> wedge_class = watched_vector(mesh.wedge_count(), watch, none);
    watched_loop(mesh.triangles.size(), watch, [&](size_t corner) {
        wedge_class[mesh.triangles[corner]] = slot_class[mesh.triangle_slot[corner / 3]];
    });
    return wedge_class;
}

void weld_wedges(Mesh& mesh, const Watch& watch) {
    const std::vector<Attribute*> all = streams(mesh);
    const std::vector<uint32_t> wedge_class = slot_class_of_wedges(mesh, watch);
    std::vector<uint32_t> first;
    const std::vector<uint32_t> group = group_equal(
        mesh.wedge_count(),
        [&](uint64_t seed, size_t w) {
            uint64_t hash = mix(mix(seed, mesh.wedge_vertex[w]), wedge_class[w]);
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
        first, watch);
    keep_wedges(mesh, first, watch);
    watched_loop(mesh.triangles.size(), watch,
                 [&](size_t corner) { mesh.triangles[corner] = group[mesh.triangles[corner]]; });
}

// Whether a morph target moves the corners of a triangle to different sides.
bool is_morphed(const Mesh& mesh, size_t triangle) {
    const uint32_t* wedge = mesh.triangles.data() + 3 * triangle;
    const auto moves_apart = [wedge](const Attribute& deltas) {
        const size_t n = deltas.components;
        const float* first = deltas.values.data() + wedge[0] * n;
        return !std::equal(first, first + n, deltas.values.data() + wedge[1] * n) ||
               !std::equal(first, first + n, deltas.values.data() + wedge[2] * n);
    };
    return std::any_of(mesh.morph_targets.begin(), mesh.morph_targets.end(), [&](const MorphTarget& target) {
        return std::any_of(target.deltas.begin(), target.deltas.end(), [&](const Attribute& deltas) {
            return deltas.name == "POSITION" && moves_apart(deltas);
        });
    });
}

// A triangle that is flat at rest may be opened by a morph target, an eyelid say.
bool is_degenerate(const Mesh& mesh, size_t triangle) {
    const uint32_t u = mesh.corner_vertex(triangle, 0), v = mesh.corner_vertex(triangle, 1),
                   w = mesh.corner_vertex(triangle, 2);
    if (u == v || v == w || w == u) return true;
    const Vec3d a = to_double(mesh.positions[u]), b = to_double(mesh.positions[v]),
                c = to_double(mesh.positions[w]);
    return squared_length(cross(b - a, c - a)) == 0 && !is_morphed(mesh, triangle);
}

size_t drop_degenerate(Mesh& mesh, const Watch& watch) {
    std::vector<uint32_t> kept;
    kept.reserve(mesh.triangle_count());
    watched_loop(mesh.triangle_count(), watch, [&](size_t t) {
        if (!is_degenerate(mesh, t)) kept.push_back(static_cast<uint32_t>(t));
    });
    const size_t dropped = mesh.triangle_count() - kept.size();
    keep_triangles(mesh, kept, watch);
    return dropped;
}

// The slot and the wedges, which are the same for the three rotations of a triangle.
std::array<uint32_t, 4> identity(const Mesh& mesh, size_t triangle) {
    const uint32_t* w = mesh.triangles.data() + 3 * triangle;
    const size_t least = w[0] < w[1] ? (w[0] < w[2] ? 0 : 2) : (w[1] < w[2] ? 1 : 2);
    return {mesh.triangle_slot[triangle], w[least], w[(least + 1) % 3], w[(least + 2) % 3]};
}

size_t drop_duplicate(Mesh& mesh, const Watch& watch) {
    std::vector<uint32_t> first;
    group_equal(
        mesh.triangle_count(),
        [&](uint64_t hash, size_t t) {
            for (const uint32_t part : identity(mesh, t)) hash = mix(hash, part);
            return hash;
        },
        [&](size_t a, size_t b) { return identity(mesh, a) == identity(mesh, b); }, first, watch);
    const size_t dropped = mesh.triangle_count() - first.size();
    keep_triangles(mesh, first, watch);
    return dropped;
}

// What is used, in the old order; turns every index into the new one.
std::vector<uint32_t> number_used(std::vector<uint32_t>& indices, size_t count, const Watch& watch) {
    std::vector<uint32_t> number = watched_vector(count, watch, none);
    std::vector<uint32_t> used;
    watched_loop(indices.size(), watch, [&](size_t i) { number[indices[i]] = 0; });
    watched_loop(count, watch, [&](size_t i) {
        if (number[i] == none) return;
        number[i] = static_cast<uint32_t>(used.size());
        used.push_back(static_cast<uint32_t>(i));
    });
    watched_loop(indices.size(), watch, [&](size_t i) { indices[i] = number[indices[i]]; });
    return used;
}

}  // namespace

void weld(Mesh& mesh, const Watch& watch) {
    weld_vertices(mesh, watch);
    weld_wedges(mesh, watch);
}

void drop_unused(Mesh& mesh, const Watch& watch) {
    keep_wedges(mesh, number_used(mesh.triangles, mesh.wedge_count(), watch), watch);
    keep_items(mesh.positions, 1, number_used(mesh.wedge_vertex, mesh.vertex_count(), watch), watch);
}

CleanedTriangles drop_degenerate_and_duplicate(Mesh& mesh, const Watch& watch) {
    CleanedTriangles cleaned;
    cleaned.degenerate = drop_degenerate(mesh, watch);
    cleaned.duplicate = drop_duplicate(mesh, watch);
    return cleaned;
}

}  // namespace coppice
