#include "core/format/ply/ply_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/format/ply/ply_source.h"
#include "core/format/triangulate.h"

namespace coppice {

namespace {

constexpr auto malformed = ErrorCode::asset_malformed;
constexpr uint64_t rows_between_checks = 4096;
constexpr size_t components = 12;  // of a vertex: what a property's value goes to
enum Component : size_t { x, y, z, nx, ny, nz, u, v, red, green, blue, alpha };
constexpr std::array<std::pair<std::string_view, Component>, 24> names = {{
    {"x", x},
    {"y", y},
    {"z", z},
    {"nx", nx},
    {"ny", ny},
    {"nz", nz},
    {"normal_x", nx},
    {"normal_y", ny},
    {"normal_z", nz},
    {"u", u},
    {"v", v},
    {"s", u},
    {"t", v},
    {"texture_u", u},
    {"texture_v", v},
    {"texture_s", u},
    {"texture_t", v},
    {"red", red},
    {"green", green},
    {"blue", blue},
    {"alpha", alpha},
    {"diffuse_red", red},
    {"diffuse_green", green},
    {"diffuse_blue", blue},
}};

// Which property of the vertex element each component comes from; its number of properties where from none.
using Columns = std::array<size_t, components>;

template <typename Source>
class BodyReader {
  public:
    BodyReader(ByteView bytes, const PlyHeader& header, const ReadLimits& limits, const Watch& watch,
               WarningTally& tally)
        : header_(header), limits_(limits), watch_(watch), tally_(tally), source_(bytes, header) {
        for (const PlyElement& element : header.elements) {
            if (element.name == "vertex") vertices_ = element.count;
        }
    }

    PlyBody read() {
        for (const PlyElement& element : header_.elements) {
            require(source_.can_hold(element.count, element), malformed, source_.where(),
                    "element {} declares {} rows, more than the rest of the file can hold", element.name,
                    element.count);
            if (element.name == "vertex" && body_.positions.empty()) {
                read_vertices(element);
            } else if (element.name == "face" && element.count > 0) {
                read_faces(element);
            } else if (element.name == "tristrips" && element.count > 0) {
                read_strips(element);
            } else {
                skip(element);
            }
        }
        // Faces with texture coordinates may stand beside strips and faces without.
        if (!body_.corner_uvs.empty()) body_.corner_uvs.resize(2 * body_.triangles.size());
        if (body_.positions.empty()) body_.triangles.clear();
        return std::move(body_);
    }

  private:
    // --- vertices

    Columns columns_of(const PlyElement& element) const {
        Columns columns;
        columns.fill(element.properties.size());
        for (size_t i = 0; i < element.properties.size(); ++i) {
            if (element.properties[i].list_count) continue;
            for (const auto& [name, component] : names) {
                if (name == element.properties[i].name && columns[component] == element.properties.size()) {
                    columns[component] = i;
                }
            }
        }
        return columns;
    }

    void read_vertices(const PlyElement& element) {
        require(element.count <= limits_.vertices, ErrorCode::asset_too_large, "",
                "the PLY has {} vertices, over the limit vertices of {}", element.count, limits_.vertices);
        const Columns columns = columns_of(element);
        const size_t none = element.properties.size();
        const auto has = [&](std::initializer_list<Component> all) {
            return std::all_of(all.begin(), all.end(), [&](Component c) { return columns[c] != none; });
        };
        require(has({x, y, z}), malformed, "", "the vertices of the PLY lack x, y or z");
        const bool normals = has({nx, ny, nz}), uvs = has({u, v}), colors = has({red, green, blue});
        body_.color_components = !colors ? 0 : has({alpha}) ? 4 : 3;
        if (colors) body_.color_storage = color_storage(element.properties[columns[red]].type);

        body_.positions.reserve(element.count);
        std::vector<double> row(none + 1);
        for (uint64_t i = 0; i < element.count; ++i) {
            if (i % rows_between_checks == 0) watch_.check();
            for (size_t p = 0; p < none; ++p) row[p] = value(element.properties[p]);
            const auto at = [&](Component c) { return row[columns[c]]; };
            const auto scaled = [&](Component c) {
                return static_cast<float>(at(c) / largest(element.properties[columns[c]].type));
            };
            add_position(at(x), at(y), at(z));
            if (normals) body_.normals.insert(body_.normals.end(), {scaled(nx), scaled(ny), scaled(nz)});
            if (uvs) body_.uvs.insert(body_.uvs.end(), {finite_uv(scaled(u)), finite_uv(scaled(v))});
            for (size_t c = 0; c < body_.color_components; ++c) {
                const auto component = static_cast<Component>(red + c);
                add_color(at(component), element.properties[columns[component]].type);
            }
        }
    }

    void add_position(double px, double py, double pz) {
        const Vec3f p = to_float({px, py, pz});
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
            fail(malformed, source_.where(),
                 fmt::format("vertex {} is not at finite 32-bit numbers", body_.positions.size()));
        }
        body_.positions.push_back(p);
    }

    static Storage color_storage(PlyType type) {
        if (type == PlyType::uint8) return {ComponentType::uint8, true};
        if (type == PlyType::uint16) return {ComponentType::uint16, true};
        return {};
    }

    // Bytes and shorts are normalized; wider integers hold 0 to 255 wherever they were seen.
    void add_color(double value, PlyType type) {
        const double full = !is_integer(type) ? 1 : size_of(type) <= 2 ? largest(type) : 255;
        if (!std::isfinite(value)) {
            tally_.note("repair.non_finite", "a vertex colour is not finite; it was made white",
                        source_.where());
            value = full;
        }
        body_.colors.push_back(static_cast<float>(std::clamp(value / full, 0.0, 1.0)));
    }

    float finite_uv(float value) {
        if (std::isfinite(value)) return value;
        tally_.note("repair.non_finite", "a texture coordinate is not finite; it was made 0",
                    source_.where());
        return 0;
    }

    // --- faces

    void read_faces(const PlyElement& element) {
        auto indices = element.find("vertex_indices");
        if (!indices) indices = element.find("vertex_index");
        require(indices && element.properties[*indices].list_count, malformed, "",
                "the faces of the PLY have no list vertex_indices or vertex_index");
        require(is_integer(element.properties[*indices].type), malformed, "",
                "the list {} of the PLY's faces does not hold integers", element.properties[*indices].name);
        const auto uvs = element.find("texcoord"), texture = element.find("texnumber");
        const bool has_uvs = uvs && element.properties[*uvs].list_count;
        if (element.find("red")) {
            tally_.note("ply.face_colors_lost", "colours of faces are not kept", "element face");
        }
        require(element.count <= limits_.triangles, ErrorCode::asset_too_large, "",
                "the PLY has {} faces, over the limit triangles of {}", element.count, limits_.triangles);
        for (uint64_t i = 0; i < element.count; ++i) {
            if (i % rows_between_checks == 0) watch_.check();
            uint32_t texture_number = 0;
            face_uvs_.clear();
            for (size_t p = 0; p < element.properties.size(); ++p) {
                const PlyProperty& property = element.properties[p];
                if (p == *indices) {
                    read_list(property, face_);
                } else if (has_uvs && p == *uvs) {
                    read_list(property, face_uvs_);
                } else if (texture && p == *texture && !property.list_count) {
                    texture_number = number_of_texture(value(property));
                } else {
                    value(property);
                }
            }
            add_face(texture_number, has_uvs, texture.has_value());
        }
    }

    static uint32_t number_of_texture(double value) {
        return value >= 0 && value < 65536 ? static_cast<uint32_t>(value) : 0;
    }

    uint32_t index(double given) const {
        if (!(given >= 0 && given < static_cast<double>(vertices_) && given == std::floor(given))) {
            fail(malformed, source_.where(),
                 fmt::format("vertex index {} is out of range: the PLY has {} vertices", given, vertices_));
        }
        return static_cast<uint32_t>(given);
    }

    void add_face(uint32_t texture, bool has_uvs, bool has_textures) {
        if (face_.size() < 3) {
            return tally_.note("ply.face_skipped", "a face with fewer than 3 corners was left out",
                               source_.where());
        }
        require_room(face_.size() - 2);
        const bool uvs_fit = face_uvs_.size() == 2 * face_.size();
        if (has_uvs && !uvs_fit) {
            tally_.note("ply.texcoord_count",
                        "a texcoord list does not hold two numbers a corner; they were made 0",
                        source_.where());
        }
        corners_.clear();
        for (const double given : face_) {
            const uint32_t vertex = index(given);
            corners_.push_back(vertex < body_.positions.size() ? to_double(body_.positions[vertex])
                                                               : Vec3d{});
        }
        face_triangles_.clear();
        triangulate(corners_, face_triangles_);
        if (has_uvs) body_.corner_uvs.resize(2 * body_.triangles.size());
        for (const uint32_t corner : face_triangles_) {
            body_.triangles.push_back(static_cast<uint32_t>(face_[corner]));
            if (!has_uvs) continue;
            for (size_t c = 0; c < 2; ++c) {
                const double uv = uvs_fit ? face_uvs_[2 * size_t{corner} + c] : 0;
                body_.corner_uvs.push_back(finite_uv(static_cast<float>(uv)));
            }
        }
        if (has_textures) body_.triangle_texture.resize(body_.triangles.size() / 3, texture);
    }

    // Triangle strips, ended by -1; every other triangle turns round. Those that repeat a vertex only link
    // strips.
    void read_strips(const PlyElement& element) {
        auto indices = element.find("vertex_indices");
        if (!indices) indices = element.find("vertex_index");
        require(indices && element.properties[*indices].list_count &&
                    is_integer(element.properties[*indices].type),
                malformed, "", "the tristrips of the PLY have no integer list vertex_indices");
        for (uint64_t i = 0; i < element.count; ++i) {
            for (size_t p = 0; p < element.properties.size(); ++p) {
                if (p != *indices) {
                    value(element.properties[p]);
                    continue;
                }
                read_list(element.properties[p], face_);
                add_strips();
            }
        }
    }

    void add_strips() {
        size_t length = 0;
        std::array<uint32_t, 2> last{};
        for (const double given : face_) {
            if (given == -1) {
                length = 0;
                continue;
            }
            const uint32_t vertex = index(given);
            if (length >= 2 && vertex != last[0] && vertex != last[1] && last[0] != last[1]) {
                require_room(1);
                const bool turned = length % 2 == 1;
                body_.triangles.insert(body_.triangles.end(),
                                       {last[turned ? 1 : 0], last[turned ? 0 : 1], vertex});
            }
            last = {last[1], vertex};
            ++length;
        }
    }

    void require_room(size_t more) {
        if (body_.triangles.size() / 3 + more > limits_.triangles) {
            fail(ErrorCode::asset_too_large, source_.where(),
                 fmt::format("the PLY has more triangles than the limit triangles of {}", limits_.triangles));
        }
    }

    // --- values

    // A list's items are passed over.
    double value(const PlyProperty& property) {
        if (!property.list_count) return source_.next(property.type);
        read_list(property, skipped_);
        return 0;
    }

    void read_list(const PlyProperty& property, std::vector<double>& items) {
        const double length = source_.next(*property.list_count);
        const bool fits = length >= 0 && length == std::floor(length) && length <= 4294967295.0 &&
                          source_.can_hold_items(static_cast<uint64_t>(length), property.type);
        if (!fits) {
            fail(malformed, source_.where(),
                 fmt::format("a list {} of {} items is more than the rest of the file can hold",
                             property.name, length));
        }
        items.clear();
        for (auto left = static_cast<uint64_t>(length); left > 0; --left)
            items.push_back(source_.next(property.type));
    }

    void skip(const PlyElement& element) {
        if (element.properties.empty()) return;
        for (uint64_t i = 0; i < element.count; ++i) {
            if (i % rows_between_checks == 0) watch_.check();
            for (const PlyProperty& property : element.properties) value(property);
        }
    }

    const PlyHeader& header_;
    const ReadLimits& limits_;
    const Watch& watch_;
    WarningTally& tally_;
    Source source_;
    PlyBody body_;
    uint64_t vertices_ = 0;
    std::vector<double> face_, face_uvs_, skipped_;
    std::vector<Vec3d> corners_;
    std::vector<uint32_t> face_triangles_;
};

}  // namespace

PlyBody read_ply_body(ByteView bytes, const PlyHeader& header, const ReadLimits& limits, const Watch& watch,
                      WarningTally& tally) {
    switch (header.encoding) {
        case PlyEncoding::ascii:
            return BodyReader<PlyText>(bytes, header, limits, watch, tally).read();
        case PlyEncoding::little_endian:
            return BodyReader<PlyBinary<std::endian::little>>(bytes, header, limits, watch, tally).read();
        case PlyEncoding::big_endian:
            break;
    }
    return BodyReader<PlyBinary<std::endian::big>>(bytes, header, limits, watch, tally).read();
}

}  // namespace coppice
