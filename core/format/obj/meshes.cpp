#include "core/format/obj/meshes.h"

#include <algorithm>
#include <functional>
#include <span>
#include <unordered_map>

#include "core/base/watched_loop.h"
#include "core/base/watched_sort.h"
#include "core/format/normals.h"
#include "core/format/triangulate.h"
#include "core/mesh/weld.h"

namespace coppice {

namespace {

constexpr size_t faces_between_checks = 4096;
constexpr size_t longest_list = 32;

// Builds the meshes one after the other; tables over all of the file's positions are made once.
class MeshBuilder {
  public:
    explicit MeshBuilder(const ObjFile& file) : file_(file), vertex_of_(file.positions.size(), obj_none) {}

    void begin(const std::string& name) {
        mesh_ = {};
        mesh_.name = name;
        used_.clear();
        wedge_corners_.clear();
        first_wedge_.clear();
        next_wedge_.clear();
        slot_keys_.clear();
        slot_numbers_.clear();
        crowded_.clear();
    }

    void add_faces(uint32_t material, size_t first, size_t end, const Watch& watch) {
        for (size_t face = first; face < end; ++face) {
            add_face(material, std::span(file_.corners).subspan(file_.face_begin(face), corner_count(face)));
            if (face % faces_between_checks == 0) watch.check();
        }
    }

    Mesh finish(WarningTally& tally, const Watch& watch) {
        number_as_in_file(watch);
        add_attributes();
        for (const uint32_t position : used_) vertex_of_[position] = obj_none;
        repair_normals(mesh_, tally);
        weld(mesh_, watch);
        return std::move(mesh_);
    }

  private:
    struct SlotKey {
        uint32_t material;
        bool uvs, normals;

        uint64_t number() const { return uint64_t{material} << 2 | uint64_t{uvs} << 1 | uint64_t{normals}; }
    };
    struct HashCorner {
        size_t operator()(const ObjCorner& c) const {
            return (c.position * size_t{0x9e3779b97f4a7c15} + c.uv) * size_t{0xc2b2ae3d27d4eb4f} + c.normal;
        }
    };

    size_t corner_count(size_t face) const { return file_.face_ends[face] - file_.face_begin(face); }

    // A face has texture coordinates when all of its corners have.
    void add_face(uint32_t material, std::span<const ObjCorner> corners) {
        SlotKey key = {material, true, true};
        for (const ObjCorner& c : corners) {
            key.uvs = key.uvs && c.uv != obj_none;
            key.normals = key.normals && c.normal != obj_none;
        }
        const uint32_t slot = slot_of(key);
        face_wedges_.clear();
        face_positions_.clear();
        for (const ObjCorner& c : corners) {
            face_wedges_.push_back(
                wedge_of({c.position, key.uvs ? c.uv : obj_none, key.normals ? c.normal : obj_none}));
            if (corners.size() > 3) face_positions_.push_back(to_double(file_.positions[c.position]));
        }
        if (corners.size() == 3) {
            mesh_.triangles.insert(mesh_.triangles.end(), face_wedges_.begin(), face_wedges_.end());
            mesh_.triangle_slot.push_back(slot);
            return;
        }
        face_triangles_.clear();
        triangulate(face_positions_, face_triangles_);
        for (const uint32_t corner : face_triangles_) mesh_.triangles.push_back(face_wedges_[corner]);
        mesh_.triangle_slot.resize(mesh_.triangles.size() / 3, slot);
    }

    uint32_t slot_of(const SlotKey& key) {
        if (!slot_keys_.empty() && slot_keys_[last_slot_].number() == key.number()) return last_slot_;
        const auto [at, is_new] =
            slot_numbers_.emplace(key.number(), static_cast<uint32_t>(slot_keys_.size()));
        last_slot_ = at->second;
        if (is_new) {
            slot_keys_.push_back(key);
            MaterialSlot& slot = mesh_.slots.emplace_back();
            if (key.material != obj_none) slot.material = key.material;
        }
        return last_slot_;
    }

    // Wedges of a vertex form a list; few vertices have more than two. What goes beyond a short list is
    // hashed.
    uint32_t wedge_of(const ObjCorner& c) {
        uint32_t& vertex = vertex_of_[c.position];
        if (vertex == obj_none) {
            vertex = static_cast<uint32_t>(mesh_.positions.size());
            mesh_.positions.push_back(file_.positions[c.position]);
            used_.push_back(c.position);
            first_wedge_.push_back(obj_none);
        }
        size_t length = 0;
        for (uint32_t wedge = first_wedge_[vertex]; wedge != obj_none; wedge = next_wedge_[wedge], ++length) {
            if (wedge_corners_[wedge].uv == c.uv && wedge_corners_[wedge].normal == c.normal) return wedge;
        }
        const auto wedge = static_cast<uint32_t>(wedge_corners_.size());
        const bool is_crowded = length >= longest_list;
        if (is_crowded) {
            const auto [at, is_new] = crowded_.emplace(c, wedge);
            if (!is_new) return at->second;
        }
        wedge_corners_.push_back(c);
        mesh_.wedge_vertex.push_back(vertex);
        next_wedge_.push_back(is_crowded ? obj_none : first_wedge_[vertex]);
        if (!is_crowded) first_wedge_[vertex] = wedge;
        return wedge;
    }

    // Vertices have the numbers of their first use so far: now those of the file, without what is not used.
    void number_as_in_file(const Watch& watch) {
        watched_sort(used_.begin(), used_.end(), watch, std::less<>());
        std::vector<uint32_t> number = watched_vector<uint32_t>(used_.size(), watch);
        watched_loop(used_.size(), watch, [&](size_t i) {
            number[vertex_of_[used_[i]]] = static_cast<uint32_t>(i);
            mesh_.positions[i] = file_.positions[used_[i]];
        });
        watched_loop(mesh_.wedge_count(), watch,
                     [&](size_t w) { mesh_.wedge_vertex[w] = number[mesh_.wedge_vertex[w]]; });
    }

    void add_attributes() {
        const bool normals =
            std::any_of(slot_keys_.begin(), slot_keys_.end(), [](SlotKey k) { return k.normals; });
        const bool uvs = std::any_of(slot_keys_.begin(), slot_keys_.end(), [](SlotKey k) { return k.uvs; });
        const bool colors =
            !file_.colors.empty() && std::any_of(used_.begin(), used_.end(), [&](uint32_t position) {
                return file_.colors[position] != Vec3f{1, 1, 1};
            });
        if (normals) {
            add_attribute("NORMAL", 3, [&](const ObjCorner& c, float* out) {
                if (c.normal != obj_none) put(file_.normals[c.normal], out);
            });
        }
        if (uvs) {
            add_attribute("TEXCOORD_0", 2, [&](const ObjCorner& c, float* out) {
                if (c.uv == obj_none) return;
                out[0] = file_.uvs[c.uv][0];
                out[1] = 1 - file_.uvs[c.uv][1];  // glTF's v runs down
            });
        }
        if (colors) {
            add_attribute("COLOR_0", 3,
                          [&](const ObjCorner& c, float* out) { put(file_.colors[c.position], out); });
        }
        for (size_t i = 0; i < mesh_.slots.size(); ++i) {
            std::vector<bool>& has = mesh_.slots[i].has_attribute;
            if (normals) has.push_back(slot_keys_[i].normals);
            if (uvs) has.push_back(slot_keys_[i].uvs);
            if (colors) has.push_back(true);
            if (std::find(has.begin(), has.end(), false) == has.end()) has.clear();
        }
    }

    static void put(Vec3f value, float* out) {
        out[0] = value.x;
        out[1] = value.y;
        out[2] = value.z;
    }

    template <typename Fill>
    void add_attribute(std::string name, uint32_t components, Fill fill) {
        Attribute& attribute = mesh_.attributes.emplace_back();
        attribute.name = std::move(name);
        attribute.components = components;
        attribute.values.resize(size_t{components} * wedge_corners_.size());
        for (size_t i = 0; i < wedge_corners_.size(); ++i)
            fill(wedge_corners_[i], &attribute.values[i * components]);
    }

    const ObjFile& file_;
    std::vector<uint32_t> vertex_of_;  // by position of the file: vertex of the mesh at work
    std::vector<uint32_t> used_;       // positions that the mesh at work uses
    Mesh mesh_;
    std::vector<ObjCorner> wedge_corners_;
    std::vector<uint32_t> first_wedge_, next_wedge_;
    std::unordered_map<ObjCorner, uint32_t, HashCorner> crowded_;
    std::vector<SlotKey> slot_keys_;
    std::unordered_map<uint64_t, uint32_t> slot_numbers_;  // by SlotKey::number()
    uint32_t last_slot_ = 0;
    std::vector<uint32_t> face_wedges_, face_triangles_;
    std::vector<Vec3d> face_positions_;
};

}  // namespace

ObjMeshes build_meshes(const ObjFile& file, const Watch& watch, std::vector<Warning>& warnings) {
    ObjMeshes out;
    out.mesh_of_object.resize(file.objects.size());
    MeshBuilder builder(file);
    WarningTally tally;
    for (size_t run = 0; run < file.runs.size();) {
        const uint32_t object = file.runs[run].object;
        builder.begin(file.objects[object]);
        for (; run < file.runs.size() && file.runs[run].object == object; ++run) {
            const size_t end =
                run + 1 < file.runs.size() ? file.runs[run + 1].first_face : file.face_ends.size();
            builder.add_faces(file.runs[run].material, file.runs[run].first_face, end, watch);
        }
        out.mesh_of_object[object] = static_cast<uint32_t>(out.meshes.size());
        out.meshes.push_back(builder.finish(tally, watch));
    }
    tally.move_to(warnings);
    return out;
}

}  // namespace coppice
