#include "tests/support/orientation.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "tests/support/surface.h"

namespace coppice::test {
namespace {

using ::testing::AssertionFailure;
using ::testing::AssertionResult;
using ::testing::AssertionSuccess;

constexpr double undecided = 1e-6;  // a sum of votes, each within -1..1

using Corners = std::array<Vec3d, 3>;

Corners corners(const Mesh& mesh, size_t triangle) {
    return {mesh.corner_position(triangle, 0), mesh.corner_position(triangle, 1),
            mesh.corner_position(triangle, 2)};
}

Vec3d unit_normal(const Corners& c) {
    return normalized(cross(c[1] - c[0], c[2] - c[0]));
}

double angle(const Corners& c, size_t corner) {
    const Vec3d a = normalized(c[(corner + 1) % 3] - c[corner]);
    const Vec3d b = normalized(c[(corner + 2) % 3] - c[corner]);
    return std::acos(std::clamp(dot(a, b), -1.0, 1.0));
}

std::string print(size_t triangle, const Corners& c) {
    std::string text = fmt::format("triangle {}", triangle);
    for (const Vec3d p : c) text += fmt::format(" ({:.6g} {:.6g} {:.6g})", p.x, p.y, p.z);
    return text;
}

// Which way the original faces where it is nearest to a point.
class Facing {
  public:
    explicit Facing(const Mesh& mesh) : surface_(mesh), tiny_(1e-7 * bounds(mesh.positions).diagonal()) {}

    // Unit length; zero where the original faces both ways.
    Vec3d at(Vec3d point) const {
        const double nearest = surface_.distance_to(point);
        Vec3d sum;
        double weights = 0;
        for (const uint32_t i : surface_.within(point, nearest * (1 + 1e-6) + tiny_)) {
            const Surface::Triangle& t = surface_.triangle(i);
            const double weight = weight_at(point, {t.a, t.b, t.c}, nearest);
            sum = sum + unit_normal({t.a, t.b, t.c}) * weight;
            weights += weight;
        }
        return length(sum) > undecided * weights ? normalized(sum) : Vec3d{};
    }

    // Of the corners and the centroid, each -1..1.
    double votes_for(const Corners& c, double accuracy = 0) const {
        const Vec3d normal = unit_normal(c);
        double votes = vote((c[0] + c[1] + c[2]) * (1.0 / 3), normal, accuracy);
        for (const Vec3d corner : c) votes += vote(corner, normal, accuracy);
        return votes;
    }

  private:
    double vote(Vec3d point, Vec3d normal, double accuracy) const {
        double best = dot(normal, at(point));
        if (accuracy == 0) return best;
        for (const uint32_t i : surface_.within(point, surface_.distance_to(point) + accuracy)) {
            const Surface::Triangle& t = surface_.triangle(i);
            best = std::max(best, dot(normal, unit_normal({t.a, t.b, t.c})));
        }
        return best;
    }

    // A triangle counts by its angle where the nearest point is its corner, else alike.
    double weight_at(Vec3d point, const Corners& c, double nearest) const {
        for (size_t k = 0; k < 3; ++k)
            if (length(point - c[k]) <= nearest * (1 + 1e-6) + tiny_) return angle(c, k);
        return 3.14159265358979;
    }

    Surface surface_;
    double tiny_;
};

using Uv = std::array<double, 2>;

Uv uv_of(const Attribute& uvs, uint32_t wedge) {
    return {double{uvs.values[2 * size_t{wedge}]}, double{uvs.values[2 * size_t{wedge} + 1]}};
}

// -1, 0 or 1; exact, up to areas that are nothing beside the edges.
int uv_sign(const Mesh& mesh, const Attribute& uvs, size_t triangle, double degenerate_aspect) {
    const Uv a = uv_of(uvs, mesh.triangles[3 * triangle]), b = uv_of(uvs, mesh.triangles[3 * triangle + 1]),
             c = uv_of(uvs, mesh.triangles[3 * triangle + 2]);
    const auto squared = [](Uv p, Uv q) {
        return (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]);
    };
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if (std::abs(area) <= degenerate_aspect * std::max({squared(a, b), squared(b, c), squared(c, a)}))
        return 0;
    return area > 0 ? 1 : -1;
}

// Which way the original's texture is wound around each wedge.
class Winding {
  public:
    explicit Winding(const Mesh& mesh) {
        const Attribute& uvs = *mesh.find_attribute("TEXCOORD_0");
        for (size_t t = 0; t < mesh.triangle_count(); ++t) {
            const int sign = uv_sign(mesh, uvs, t, 1e-6);
            for (size_t k = 0; k < 3; ++k) {
                const auto [place, added] =
                    votes_.try_emplace(key(mesh, uvs, mesh.triangles[3 * t + k]), sign);
                if (place->second != sign) place->second = 0;
            }
        }
    }

    bool is_kept(const Mesh& mesh, const Attribute& uvs, size_t triangle) const {
        int votes = 0;
        for (size_t k = 0; k < 3; ++k) {
            const auto found = votes_.find(key(mesh, uvs, mesh.triangles[3 * triangle + k]));
            if (found != votes_.end()) votes += found->second;  // else keeps_charts tells
        }
        const int sign = uv_sign(mesh, uvs, triangle, 0);
        return sign == 0 ? std::abs(votes) < 3 : votes * sign >= 0;
    }

  private:
    using Key = std::array<float, 5>;

    static Key key(const Mesh& mesh, const Attribute& uvs, uint32_t wedge) {
        const Vec3f p = mesh.positions[mesh.wedge_vertex[wedge]];
        return {p.x, p.y, p.z, uvs.values[2 * size_t{wedge}], uvs.values[2 * size_t{wedge} + 1]};
    }

    std::map<Key, int> votes_;  // -1, 1, or 0 where triangles disagree
};

const Attribute* texture_coordinates(const Mesh& mesh) {
    const Attribute* uvs = mesh.find_attribute("TEXCOORD_0");
    return uvs != nullptr && uvs->components == 2 ? uvs : nullptr;
}

AssertionResult none_of(size_t count, const Mesh& mesh, const std::string& what, const std::string& first) {
    if (count == 0) return AssertionSuccess();
    return AssertionFailure() << count << " of " << mesh.triangle_count() << " triangles " << what
                              << ", the first is " << first;
}

}  // namespace

AssertionResult has_no_flipped_triangle(const Mesh& before, const Mesh& after, double accuracy) {
    const Facing original(before);
    std::set<std::array<double, 3>> inside_out;
    for (size_t t = 0; t < before.triangle_count(); ++t) {
        const Corners c = corners(before, t);
        if (original.votes_for(c) >= -undecided) continue;
        for (const Vec3d p : c) inside_out.insert({p.x, p.y, p.z});
    }
    size_t flipped = 0;
    std::string first;
    for (size_t t = 0; t < after.triangle_count(); ++t) {
        const Corners c = corners(after, t);
        const bool excused = std::any_of(c.begin(), c.end(), [&](Vec3d p) {
            return inside_out.contains({p.x, p.y, p.z});
        });
        if (excused || original.votes_for(c, accuracy) >= -undecided) continue;
        if (flipped++ == 0) first = print(t, c);
    }
    return none_of(flipped, after, "are flipped", first);
}

AssertionResult keeps_uv_orientation(const Mesh& before, const Mesh& after) {
    const Attribute* uvs = texture_coordinates(after);
    if (uvs == nullptr || texture_coordinates(before) == nullptr) return AssertionSuccess();
    const Winding original(before);
    size_t flipped = 0;
    std::string first;
    for (size_t t = 0; t < after.triangle_count(); ++t) {
        if (!original.is_kept(after, *uvs, t) && flipped++ == 0) first = print(t, corners(after, t));
    }
    return none_of(flipped, after, "have a mirrored texture", first);
}

}  // namespace coppice::test
