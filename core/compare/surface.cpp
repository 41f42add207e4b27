#include "core/compare/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "core/base/error.h"
#include "core/base/watched_loop.h"
#include "core/base/watched_sort.h"

namespace coppice {

namespace {

constexpr uint32_t none = std::numeric_limits<uint32_t>::max();

// An attribute of a mesh that is compared, and which slots have it.
struct Compared {
    const Attribute* attribute = nullptr;
    size_t index = 0;

    const float* at(size_t wedge) const { return attribute->values.data() + wedge * attribute->components; }
    bool is_in(const MaterialSlot& slot) const { return attribute != nullptr && slot.has(index); }
};

Compared find(const Mesh& mesh, std::string_view name, uint32_t least, uint32_t most) {
    for (size_t i = 0; i < mesh.attributes.size(); ++i) {
        const Attribute& attribute = mesh.attributes[i];
        if (attribute.name == name && attribute.components >= least && attribute.components <= most)
            return {&attribute, i};
    }
    return {};
}

class Builder {
  public:
    explicit Builder(const Watch& watch) : watch_(watch) {}

    void append(const Mesh& mesh, const Transform& world, bool is_in_place) {
        const size_t first_wedge = wedges_;
        wedges_ += mesh.wedge_count();
        append_positions(mesh, world, is_in_place);
        const Compared normals = find(mesh, "NORMAL", 3, 3), texture = find(mesh, "TEXCOORD_0", 2, 2),
                       colors = find(mesh, "COLOR_0", 3, 4);
        append_normals(mesh, normals, world, is_in_place, first_wedge);
        append_values(mesh, texture, out_.texture, first_wedge);
        append_values(mesh, colors, out_.colors, first_wedge);

        std::vector<uint8_t> has_of_slot;
        for (const MaterialSlot& slot : mesh.slots) {
            const int has = (normals.is_in(slot) ? Surface::has_normals : 0) |
                            (texture.is_in(slot) ? Surface::has_texture : 0) |
                            (colors.is_in(slot) ? Surface::has_colors : 0);
            has_of_slot.push_back(static_cast<uint8_t>(has));
        }
        const bool is_mirrored = !is_in_place && determinant(world) < 0;
        watched_loop(mesh.triangle_count(), watch_, [&](size_t t) {
            for (size_t c = 0; c < 3; ++c) {
                const size_t corner = is_mirrored ? (3 - c) % 3 : c;
                const uint32_t wedge = mesh.triangles[3 * t + corner];
                out_.vertices.push_back(number_[mesh.wedge_vertex[wedge]]);
                out_.wedges.push_back(static_cast<uint32_t>(first_wedge + wedge));
            }
            out_.has.push_back(has_of_slot[mesh.triangle_slot[t]]);
        });
    }

    Surface finish() {
        watched_loop(out_.positions.size(), watch_, [&](size_t v) { out_.bounds.extend(out_.positions[v]); });
        resize_attributes();
        start_with_least_corners();
        sort_triangles();
        return std::move(out_);
    }

  private:
    void append_positions(const Mesh& mesh, const Transform& world, bool is_in_place) {
        number_.assign(mesh.vertex_count(), none);
        watched_loop(mesh.triangles.size(), watch_, [&](size_t corner) {
            uint32_t& number = number_[mesh.wedge_vertex[mesh.triangles[corner]]];
            if (number != none) return;
            number = static_cast<uint32_t>(out_.positions.size());
            const Vec3d p = to_double(mesh.positions[mesh.wedge_vertex[mesh.triangles[corner]]]);
            out_.positions.push_back(is_in_place ? p : world.point(p));
        });
    }

    void append_normals(const Mesh& mesh, const Compared& normals, const Transform& world, bool is_in_place,
                        size_t first_wedge) {
        if (normals.attribute == nullptr) return;
        out_.normals.resize(first_wedge + mesh.wedge_count());
        watched_loop(mesh.wedge_count(), watch_, [&](size_t w) {
            const float* n = normals.at(w);
            out_.normals[first_wedge + w] = is_in_place
                                                ? Vec3f{n[0], n[1], n[2]}
                                                : to_float(transform_normal(world, Vec3d{n[0], n[1], n[2]}));
        });
    }

    template <size_t n>
    void append_values(const Mesh& mesh, const Compared& from, std::vector<std::array<float, n>>& to,
                       size_t first_wedge) {
        if (from.attribute == nullptr) return;
        to.resize(first_wedge + mesh.wedge_count());
        watched_loop(mesh.wedge_count(), watch_, [&](size_t w) {
            auto& value = to[first_wedge + w];
            value.fill(1);
            std::copy_n(from.at(w), from.attribute->components, value.begin());
        });
    }

    // The last meshes may have lacked what earlier ones have.
    void resize_attributes() {
        if (!out_.normals.empty()) out_.normals.resize(wedges_);
        if (!out_.texture.empty()) out_.texture.resize(wedges_);
        if (!out_.colors.empty()) out_.colors.resize(wedges_);
    }

    static bool is_less(Vec3d a, Vec3d b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

    void start_with_least_corners() {
        watched_loop(out_.triangle_count(), watch_, [&](size_t t) {
            size_t least = 0;
            for (size_t c = 1; c < 3; ++c) {
                if (is_less(out_.corner(t, c), out_.corner(t, least))) least = c;
            }
            const auto rotate = [&](std::vector<uint32_t>& of) {
                const auto begin = of.begin() + static_cast<std::ptrdiff_t>(3 * t);
                std::rotate(begin, begin + static_cast<std::ptrdiff_t>(least), begin + 3);
            };
            rotate(out_.vertices);
            rotate(out_.wedges);
        });
    }

    void sort_triangles() {
        const size_t count = out_.triangle_count();
        const std::vector<uint64_t> places = places_on_curve();
        std::vector<uint32_t> order(count);
        std::iota(order.begin(), order.end(), 0U);
        watched_sort(order.begin(), order.end(), watch_, [&](uint32_t a, uint32_t b) {
            if (places[a] != places[b]) return places[a] < places[b];
            for (size_t c = 0; c < 3; ++c) {
                const Vec3d p = out_.corner(a, c), q = out_.corner(b, c);
                if (!(p == q)) return is_less(p, q);
            }
            return a < b;
        });
        reorder(out_, order, watch_);
    }

    // Z-order (Morton 1966) of the centroids, 21 bits for each axis.
    std::vector<uint64_t> places_on_curve() const {
        const Bounds& box = out_.bounds;
        const Vec3d size = box.max - box.min;
        std::vector<uint64_t> places(out_.triangle_count());
        const auto spread = [](double at, double low, double extent) {
            constexpr double cells = 2097151;
            uint64_t x =
                extent > 0 ? static_cast<uint64_t>(std::clamp((at - low) / extent, 0.0, 1.0) * cells) : 0;
            x = (x | x << 32) & 0x1f00000000ffffULL;
            x = (x | x << 16) & 0x1f0000ff0000ffULL;
            x = (x | x << 8) & 0x100f00f00f00f00fULL;
            x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
            return (x | x << 2) & 0x1249249249249249ULL;
        };
        watched_loop(places.size(), watch_, [&](size_t t) {
            const auto [a, b, c] = out_.corners(t);  // in an order that does not depend on the file
            const Vec3d middle = (a + b + c) * (1.0 / 3);
            places[t] = spread(middle.x, box.min.x, size.x) | spread(middle.y, box.min.y, size.y) << 1 |
                        spread(middle.z, box.min.z, size.z) << 2;
        });
        return places;
    }

    const Watch& watch_;
    Surface out_;
    size_t wedges_ = 0;
    std::vector<uint32_t> number_;  // per vertex of the mesh that is appended
};

void require_measurable(const Surface& surface) {
    const Bounds& box = surface.bounds;
    const double largest = std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.min.z),
                                     std::abs(box.max.x), std::abs(box.max.y), std::abs(box.max.z)});
    constexpr double limit = 1e60;  // its fourth power, of squared areas, is still a number
    require(surface.triangle_count() == 0 || largest <= limit, ErrorCode::asset_malformed, "",
            "an instance has coordinates up to {:g}; up to {:g} can be compared", largest, limit);
}

}  // namespace

void reorder(Surface& surface, std::span<const uint32_t> order, const Watch& watch) {
    std::vector<uint32_t> vertices(surface.vertices.size()), wedges(surface.wedges.size());
    std::vector<uint8_t> has(surface.has.size());
    watched_loop(order.size(), watch, [&](size_t i) {
        for (size_t c = 0; c < 3; ++c) {
            vertices[3 * i + c] = surface.vertices[3 * order[i] + c];
            wedges[3 * i + c] = surface.wedges[3 * order[i] + c];
        }
        has[i] = surface.has[order[i]];
    });
    surface.vertices = std::move(vertices);
    surface.wedges = std::move(wedges);
    surface.has = std::move(has);
}

Surface make_surface(const Mesh& mesh, const Watch& watch) {
    Builder builder(watch);
    builder.append(mesh, {}, true);
    return builder.finish();
}

Surface make_surface(const Scene& scene, std::span<const Instance> instances, const Watch& watch) {
    Builder builder(watch);
    for (const Instance& instance : instances)
        builder.append(scene.meshes[instance.mesh], instance.world, false);
    Surface surface = builder.finish();
    require_measurable(surface);
    return surface;
}

}  // namespace coppice
