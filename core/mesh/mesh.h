// A unique mesh: flat arrays of vertices, wedges and triangles.
//
// A vertex is a position. A wedge is the set of corners of a vertex that share all attribute values (Hoppe
// 1999); glTF "vertices" are wedges here. A glTF mesh with several primitives is one mesh with several
// material slots, so a border between two materials cannot crack. Values; no thread-safety of their own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/watch.h"
#include "core/mesh/vec.h"

namespace coppice {

// The numbers are glTF's.
enum class ComponentType : uint16_t {
    int8 = 5120,
    uint8 = 5121,
    int16 = 5122,
    uint16 = 5123,
    uint32 = 5125,
    float32 = 5126,
};

// How the source stored a value. In memory everything is decoded to float; a writer that can stores it the
// same way.
struct Storage {
    ComponentType type = ComponentType::float32;
    bool normalized = false;

    friend bool operator==(const Storage&, const Storage&) = default;
};

// One stream of values, one per wedge.
struct Attribute {
    std::string name;  // glTF semantic: NORMAL, TANGENT, TEXCOORD_n, COLOR_n, JOINTS_n, WEIGHTS_n, _ANYTHING
    uint32_t components = 0;  // numbers per wedge, 1..16
    Storage storage = {};
    std::vector<float> values =
        {};  // components * wedge count; zeros where the wedge's slot lacks the attribute
};

// Deltas of one morph target, one per wedge; names are POSITION, NORMAL, TANGENT, TEXCOORD_n, COLOR_n.
struct MorphTarget {
    std::vector<Attribute> deltas;
};

// The triangles that are drawn with one material: a primitive of a glTF mesh, a usemtl group of an OBJ
// object.
struct MaterialSlot {
    std::optional<uint32_t> material = {};          // index into Scene::materials; none: the format's default
    std::vector<bool> has_attribute = {};           // per attribute of the mesh; empty: has all
    std::optional<uint32_t> source_primitive = {};  // index in the source's mesh, for what is passed through

    bool has(size_t attribute) const { return has_attribute.empty() || has_attribute[attribute]; }
};

struct Mesh {
    std::string name;
    std::optional<uint32_t> source_mesh =
        {};                        // index in the source's meshes, for what is passed through; copies keep it
    std::vector<Vec3f> positions;  // one per vertex, model units
    Storage position_storage = {};           // floats unless the source was quantized
    std::vector<uint32_t> wedge_vertex;      // one per wedge: the vertex it belongs to
    std::vector<Attribute> attributes;       // each holds values for every wedge
    std::vector<MorphTarget> morph_targets;  // each holds deltas for every wedge
    std::vector<uint32_t> triangles;         // 3 wedge indices per triangle, counter-clockwise
    std::vector<uint32_t> triangle_slot;     // one per triangle: index into slots
    std::vector<MaterialSlot> slots;

    size_t vertex_count() const { return positions.size(); }
    size_t wedge_count() const { return wedge_vertex.size(); }
    size_t triangle_count() const { return triangle_slot.size(); }

    // The vertex at corner 0..2 of a triangle.
    uint32_t corner_vertex(size_t triangle, size_t corner) const {
        return wedge_vertex[triangles[3 * triangle + corner]];
    }
    Vec3d corner_position(size_t triangle, size_t corner) const {
        return to_double(positions[corner_vertex(triangle, corner)]);
    }

    // Null when there is none of that name.
    const Attribute* find_attribute(std::string_view attribute_name) const;
};

// A copy of everything else: of what may be very large, looking at the watch in between.
Mesh without_triangles(const Mesh& from, const Watch& watch);

// A copy of everything but vertices, wedges, their values and triangles.
Mesh without_geometry(const Mesh& from);

// True when every index is in range and every array has the length that the others imply. For asserts and
// tests.
bool is_consistent(const Mesh& mesh);

}  // namespace coppice
