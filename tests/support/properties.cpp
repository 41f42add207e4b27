#include "tests/support/properties.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "core/mesh/adjacency.h"
#include "core/scene/instance.h"
#include "tests/support/surface.h"

namespace coppice::test {
namespace {

using ::testing::AssertionFailure;
using ::testing::AssertionResult;
using ::testing::AssertionSuccess;

std::string print(Vec3d p) {
    return fmt::format("({:.6g} {:.6g} {:.6g})", p.x, p.y, p.z);
}

double diagonal(const Mesh& mesh) {
    return bounds(mesh.positions).diagonal();
}

bool same_transform(const Transform& a, const Transform& b) {
    double size = 1;
    for (const double value : a.m) size = std::max(size, std::abs(value));
    for (size_t i = 0; i < a.m.size(); ++i)
        if (std::abs(a.m[i] - b.m[i]) > 1e-6 * size) return false;
    return true;
}

std::vector<Segment> border_segments(const Mesh& mesh) {
    std::vector<Segment> segments;
    for (const Edge& edge : edges(mesh))
        if (edge.is_border())
            segments.push_back({to_double(mesh.positions[edge.a]), to_double(mesh.positions[edge.b])});
    return segments;
}

using Uv = std::array<float, 2>;

Uv texture_coordinates(const Attribute& attribute, uint32_t wedge) {
    return {attribute.values[2 * size_t{wedge}], attribute.values[2 * size_t{wedge} + 1]};
}

// Inner edges whose triangles disagree about the texture coordinates at an end.
std::vector<Segment> seam_segments(const Mesh& mesh) {
    std::vector<Segment> segments;
    const Attribute* uv = mesh.find_attribute("TEXCOORD_0");
    if (uv == nullptr || uv->components != 2) return segments;
    std::map<std::pair<uint32_t, uint32_t>, std::set<std::pair<Uv, Uv>>>
        uses;  // of the edge a < b: values at a, b
    std::map<std::pair<uint32_t, uint32_t>, int> triangles;
    for (size_t t = 0; t < mesh.triangle_count(); ++t)
        for (size_t corner = 0; corner < 3; ++corner) {
            uint32_t from = mesh.triangles[3 * t + corner];
            uint32_t to = mesh.triangles[3 * t + (corner + 1) % 3];
            if (mesh.wedge_vertex[from] > mesh.wedge_vertex[to]) std::swap(from, to);
            const std::pair edge(mesh.wedge_vertex[from], mesh.wedge_vertex[to]);
            uses[edge].insert({texture_coordinates(*uv, from), texture_coordinates(*uv, to)});
            ++triangles[edge];
        }
    for (const auto& [edge, values] : uses)
        if (triangles[edge] > 1 && values.size() > 1)
            segments.push_back(
                {to_double(mesh.positions[edge.first]), to_double(mesh.positions[edge.second])});
    return segments;
}

// Every sample of `from` has a place of `to` no farther away than `near`.
AssertionResult all_near(const std::vector<Segment>& from, const Surface& to, double near,
                         std::string_view what) {
    size_t far = 0;
    double worst = 0;
    Vec3d where = {};
    for (const Segment& segment : from)
        for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
            const Vec3d point = segment.a + (segment.b - segment.a) * t;
            const double away = to.distance_to(point);
            if (away <= near) continue;
            ++far;
            if (away > worst) {
                worst = away;
                where = point;
            }
        }
    if (far == 0) return AssertionSuccess();
    return AssertionFailure() << far << " points of " << what << " are farther than " << near
                              << " away, the worst by " << worst << " at " << print(where) << " ("
                              << from.size() << " edges)";
}

AssertionResult same_lines(const std::vector<Segment>& before, const std::vector<Segment>& after, double near,
                           const std::string& what) {
    const AssertionResult nothing_new =
        all_near(after, Surface(before), near, fmt::format("a {} of the result, from the original's,", what));
    if (!nothing_new) return nothing_new;
    return all_near(before, Surface(after), near, fmt::format("an original {}, from the result's,", what));
}

// Sets of wedges, numbered by the texture coordinates that triangles connect: union-find over (vertex, uv).
class Charts {
  public:
    explicit Charts(const Mesh& mesh) : uv_(*mesh.find_attribute("TEXCOORD_0")) {
        for (size_t t = 0; t < mesh.triangle_count(); ++t) {
            std::array<size_t, 3> corners{};
            for (size_t corner = 0; corner < 3; ++corner) {
                const uint32_t wedge = mesh.triangles[3 * t + corner];
                corners[corner] = number(key(mesh, wedge));
            }
            join(corners[0], corners[1]);
            join(corners[0], corners[2]);
        }
    }

    // None where no original corner has that position and value.
    std::optional<size_t> at(Vec3f position, Uv uv) {
        const auto found = numbers_.find(Key(position.x, position.y, position.z, uv[0], uv[1]));
        if (found == numbers_.end()) return {};
        return root(found->second);
    }

  private:
    using Key = std::tuple<float, float, float, float, float>;

    Key key(const Mesh& mesh, uint32_t wedge) const {
        const Vec3f p = mesh.positions[mesh.wedge_vertex[wedge]];
        const Uv uv = texture_coordinates(uv_, wedge);
        return {p.x, p.y, p.z, uv[0], uv[1]};
    }
    size_t number(const Key& key) {
        const auto [place, added] = numbers_.try_emplace(key, parents_.size());
        if (added) parents_.push_back(parents_.size());
        return place->second;
    }
    size_t root(size_t i) {
        while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
        return i;
    }
    void join(size_t a, size_t b) { parents_[root(a)] = root(b); }

    const Attribute& uv_;
    std::map<Key, size_t> numbers_;
    std::vector<size_t> parents_;
};

}  // namespace

AssertionResult keeps_instances(const Scene& before, const Scene& after) {
    const std::vector<Instance> old = instances(before);
    const std::vector<Instance> now = instances(after);
    if (old.size() != now.size())
        return AssertionFailure() << old.size() << " instances became " << now.size();
    std::map<uint32_t, uint32_t> mesh_after;
    for (size_t i = 0; i < old.size(); ++i) {
        if (!same_transform(old[i].world, now[i].world))
            return AssertionFailure() << "instance " << i << " (node " << old[i].node << ", "
                                      << old[i].in_batch << " in its batch) stands elsewhere";
        const auto [place, added] = mesh_after.try_emplace(old[i].mesh, now[i].mesh);
        if (place->second != now[i].mesh)
            return AssertionFailure() << "instances of mesh " << old[i].mesh << " no longer share one mesh";
    }
    if (after.meshes.size() > before.meshes.size())
        return AssertionFailure() << before.meshes.size() << " unique meshes became " << after.meshes.size();
    return AssertionSuccess();
}

AssertionResult keeps_bounds(const Scene& before, const Scene& after, double diagonal_fraction) {
    const Bounds old = scene_bounds(before);
    const Bounds now = scene_bounds(after);
    if (old.empty() != now.empty())
        return AssertionFailure() << "one of the scenes is empty, the other is not";
    if (old.empty()) return AssertionSuccess();
    const double tolerance = diagonal_fraction * old.diagonal();
    const Vec3d low = now.min - old.min;
    const Vec3d high = now.max - old.max;
    for (const double moved : {low.x, low.y, low.z, high.x, high.y, high.z})
        if (!(std::abs(moved) <= tolerance))
            return AssertionFailure()
                   << "a side of the box moved by " << moved << ", " << 100 * moved / old.diagonal()
                   << " % of the diagonal " << old.diagonal();
    return AssertionSuccess();
}

AssertionResult meets_target(const Report& report, const Scene& after, double ratio) {
    uint64_t reported = 0;
    for (const MeshReport& mesh : report.meshes) {
        reported += mesh.triangles_out;
        const double target = ratio * static_cast<double>(mesh.triangles_in);
        const double off = static_cast<double>(mesh.triangles_out) - target;
        const bool met = std::abs(off) <= std::max(0.01 * target, 2.0);
        const bool excused = mesh.stop_reason != StopReason::target && off > 0;
        if (!met && !excused)
            return AssertionFailure() << "mesh \"" << mesh.name << "\" has " << mesh.triangles_out << " of "
                                      << mesh.triangles_in << " triangles, the target is " << target
                                      << ", the stop reason " << name(mesh.stop_reason);
    }
    uint64_t there = 0;
    for (const Mesh& mesh : after.meshes) there += mesh.triangle_count();
    if (reported != there)
        return AssertionFailure() << "the report counts " << reported << " triangles, the result has "
                                  << there;
    return AssertionSuccess();
}

std::vector<std::pair<uint32_t, uint32_t>> mesh_pairs(const Scene& before, const Scene& after) {
    const std::vector<Instance> old = instances(before);
    const std::vector<Instance> now = instances(after);
    std::set<std::pair<uint32_t, uint32_t>> pairs;
    for (size_t i = 0; i < std::min(old.size(), now.size()); ++i) pairs.insert({old[i].mesh, now[i].mesh});
    return {pairs.begin(), pairs.end()};
}

AssertionResult has_no_new_non_manifold_edge(const Mesh& before, const Mesh& after) {
    const Topology old = topology(before);
    const Topology now = topology(after);
    if (now.non_manifold_edges > old.non_manifold_edges)
        return AssertionFailure() << old.non_manifold_edges << " non-manifold edges became "
                                  << now.non_manifold_edges;
    if (now.inconsistent_edges > old.inconsistent_edges)
        return AssertionFailure() << old.inconsistent_edges
                                  << " edges between triangles of opposite winding became "
                                  << now.inconsistent_edges;
    return AssertionSuccess();
}

AssertionResult keeps_borders(const Mesh& before, const Mesh& after, double diagonal_fraction) {
    return same_lines(border_segments(before), border_segments(after), diagonal_fraction * diagonal(before),
                      "border");
}

AssertionResult keeps_seams(const Mesh& before, const Mesh& after, double diagonal_fraction) {
    return same_lines(seam_segments(before), seam_segments(after), diagonal_fraction * diagonal(before),
                      "seam");
}

AssertionResult keeps_charts(const Mesh& before, const Mesh& after) {
    const Attribute* old = before.find_attribute("TEXCOORD_0");
    const Attribute* now = after.find_attribute("TEXCOORD_0");
    if (old == nullptr && now == nullptr) return AssertionSuccess();
    if (old == nullptr || now == nullptr)
        return AssertionFailure() << "texture coordinates appeared or vanished";
    Charts charts(before);
    for (size_t t = 0; t < after.triangle_count(); ++t) {
        std::optional<size_t> chart;
        for (size_t corner = 0; corner < 3; ++corner) {
            const uint32_t wedge = after.triangles[3 * t + corner];
            const Vec3f position = after.positions[after.wedge_vertex[wedge]];
            const Uv uv = texture_coordinates(*now, wedge);
            const std::optional<size_t> here = charts.at(position, uv);
            if (!here)
                return AssertionFailure()
                       << "triangle " << t << " has the texture coordinate " << uv[0] << " " << uv[1]
                       << " at " << print(to_double(position)) << ", where the original has others";
            if (chart && here != chart)
                return AssertionFailure() << "triangle " << t << " at " << print(to_double(position))
                                          << " has its corners in several charts";
            chart = here;
        }
    }
    return AssertionSuccess();
}

void expect_properties_kept(const Scene& before, const Scene& after, const Report& report, double ratio) {
    EXPECT_TRUE(meets_target(report, after, ratio));
    EXPECT_TRUE(keeps_instances(before, after));
    EXPECT_TRUE(keeps_bounds(before, after, 0.01));
    for (const auto& [old, now] : mesh_pairs(before, after)) {
        const Mesh& mesh = before.meshes[old];
        SCOPED_TRACE(fmt::format("mesh {} \"{}\", {} triangles -> {}", old, mesh.name, mesh.triangle_count(),
                                 after.meshes[now].triangle_count()));
        EXPECT_TRUE(is_consistent(after.meshes[now]));
        EXPECT_TRUE(has_no_new_non_manifold_edge(mesh, after.meshes[now]));
        EXPECT_TRUE(has_no_flipped_triangle(mesh, after.meshes[now]));
        EXPECT_TRUE(keeps_borders(mesh, after.meshes[now], 0.05));
        EXPECT_TRUE(keeps_seams(mesh, after.meshes[now], 0.05));
        EXPECT_TRUE(keeps_charts(mesh, after.meshes[now]));
        EXPECT_TRUE(keeps_uv_orientation(mesh, after.meshes[now]));
    }
}

}  // namespace coppice::test
