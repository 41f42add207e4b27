#include "core/format/stl/read_stl.h"

#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/format/line_reader.h"
#include "core/format/single_mesh.h"
#include "core/mesh/weld.h"

namespace coppice {

namespace {

constexpr auto malformed = ErrorCode::asset_malformed;
constexpr size_t header_bytes = 80, head_bytes = 84, facet_bytes = 50, normal_bytes = 12;
constexpr uint64_t facets_between_checks = 4096;

void require_room(uint64_t triangles, const ReadLimits& limits) {
    require(triangles <= limits.triangles && triangles * 3 <= limits.vertices * 6, ErrorCode::asset_too_large,
            "", "the STL has {} triangles, over the limit triangles of {}", triangles, limits.triangles);
}

// Positions are those of the corners, three a triangle.
void finish(Scene& scene, Mesh mesh, const Watch& watch) {
    if (mesh.positions.empty()) return;
    mesh.wedge_vertex.resize(mesh.positions.size());
    std::iota(mesh.wedge_vertex.begin(), mesh.wedge_vertex.end(), 0U);
    mesh.triangles = mesh.wedge_vertex;
    mesh.triangle_slot.assign(mesh.positions.size() / 3, 0);
    mesh.slots.resize(1);
    weld(mesh, watch);
    add_placed_mesh(scene, std::move(mesh));
}

void read_binary(ByteView bytes, std::string name, const ReadLimits& limits, const Watch& watch,
                 Scene& scene) {
    const uint64_t triangles = load_u32(bytes, header_bytes);
    const uint64_t room = (bytes.size() - head_bytes) / facet_bytes;
    require(triangles <= room, malformed, fmt::format("byte {}", header_bytes),
            "the STL declares {} triangles, but its bytes hold {}", triangles, room);
    require_room(triangles, limits);
    Mesh mesh;
    mesh.name = std::move(name);
    mesh.positions.reserve(3 * triangles);
    for (uint64_t t = 0; t < triangles; ++t) {
        if (t % facets_between_checks == 0) watch.check();
        for (size_t corner = 0; corner < 3; ++corner) {
            const size_t at = head_bytes + t * facet_bytes + normal_bytes + corner * 12;
            const Vec3f p = {load_f32(bytes, at), load_f32(bytes, at + 4), load_f32(bytes, at + 8)};
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
                fail(malformed, fmt::format("byte {}", at),
                     fmt::format("a corner of triangle {} is not finite", t));
            }
            mesh.positions.push_back(p);
        }
    }
    finish(scene, std::move(mesh), watch);
}

bool is_word(std::string_view word, std::string_view wanted) {
    if (word.size() != wanted.size()) return false;
    for (size_t i = 0; i < word.size(); ++i) {
        if ((word[i] | 0x20) != wanted[i]) return false;  // some write it in capitals
    }
    return true;
}

class TextReader {
  public:
    TextReader(std::string_view text, const ReadLimits& limits, const Watch& watch, Scene& scene)
        : reader_(text), limits_(limits), watch_(watch), scene_(scene) {}

    void read() {
        Line line;
        while (reader_.next(line)) statement(line);
        end_solid(line);
    }

  private:
    void statement(Line& line) {
        const std::string_view word = line.word();
        if (word.empty() || is_word(word, "outer") || is_word(word, "endfacet")) return;
        if (is_word(word, "vertex")) return vertex(line);
        if (is_word(word, "facet")) return begin_facet(line);
        if (is_word(word, "endloop")) return end_facet(line);
        if (is_word(word, "endsolid")) return end_solid(line);
        if (is_word(word, "solid")) {
            end_solid(line);
            mesh_.name = std::string(line.rest());
            return;
        }
        line.fail("\"{}\" is no STL word; solid, facet, outer, vertex, endloop, endfacet, endsolid are",
                  word.substr(0, 40));
    }

    void vertex(Line& line) {
        Vec3d p;
        p.x = line.number("the x of a vertex");
        p.y = line.number("the y of a vertex");
        p.z = line.number("the z of a vertex");
        const Vec3f position = to_float(p);
        if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z)) {
            line.fail("a vertex is not at finite 32-bit numbers");
        }
        if (++corners_ > 3) line.fail("a facet has more than 3 vertices");
        mesh_.positions.push_back(position);
    }

    void begin_facet(const Line& line) {
        if (corners_ != 0) line.fail("a facet begins before the last one ended");
        require_room(++triangles_, limits_);
        if (triangles_ % facets_between_checks == 0) watch_.check();
    }

    void end_facet(const Line& line) {
        if (corners_ != 3) line.fail("a facet has {} vertices; it takes 3", corners_);
        corners_ = 0;
    }

    void end_solid(const Line& line) {
        if (corners_ != 0) line.fail("the STL ends inside a facet");
        finish(scene_, std::exchange(mesh_, {}), watch_);
    }

    LineReader reader_;
    const ReadLimits& limits_;
    const Watch& watch_;
    Scene& scene_;
    Mesh mesh_;
    int corners_ = 0;
    uint64_t triangles_ = 0;
};

bool is_text(ByteView bytes) {
    const std::string_view text = as_text(bytes);
    const size_t begin = text.find_first_not_of(" \t\r\n");
    return begin != text.npos && is_word(text.substr(begin, 5), "solid");
}

std::string stem(std::string_view file_name) {
    file_name = file_name.substr(file_name.rfind('/') + 1);
    return std::string(file_name.substr(0, file_name.rfind('.')));
}

}  // namespace

bool is_binary_stl(ByteView bytes) {
    return bytes.size() >= head_bytes &&
           bytes.size() == head_bytes + uint64_t{load_u32(bytes, header_bytes)} * facet_bytes;
}

Scene read_stl(ByteView bytes, std::string_view file_name, const ReadLimits& limits, const Watch& watch) {
    watch.check();
    Scene scene;
    if (is_binary_stl(bytes) || !is_text(bytes)) {
        require(bytes.size() >= head_bytes, malformed, "", "a binary STL has at least {} bytes, this has {}",
                head_bytes, bytes.size());
        read_binary(bytes, stem(file_name), limits, watch, scene);
    } else {
        TextReader(as_text(bytes), limits, watch, scene).read();
    }
    require(!scene.meshes.empty(), malformed, "", "the STL has no triangles");
    return scene;
}

}  // namespace coppice
