// Against sums over triangles, in double precision, from the mesh itself.
#include "core/simplify/attribute_quadric/wedge_quadrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "tests/support/shapes.h"

namespace coppice {
namespace {

constexpr AttributeWeights weights = {.normal = 0.05, .uv = 0.3, .color = 0.2};

// On a triangle, linear: value(p) = at_first + gradient.(p - first).
struct Linear {
    double weight = 0, at_first = 0;
    Vec3d first, gradient;

    double value(Vec3d p) const { return at_first + dot(gradient, p - first); }
};

// A mesh, its quadrics, and what they are sums of.
class Tested {
  public:
    explicit Tested(Mesh source)
        : source_(std::move(source)), mesh_(source_, {}), quadrics(mesh_, source_, weights, {}) {
        double in_space = 0, in_texture = 0;
        for (size_t t = 0; t < mesh_.triangle_count(); ++t) {
            in_space += length(area_normal(corner(t, 0), corner(t, 1), corner(t, 2)));
            const Attribute* uv = source_.find_attribute("TEXCOORD_0");
            if (uv == nullptr) continue;
            Vec3d q[3];
            for (size_t k = 0; k < 3; ++k) {
                const float* value = uv->values.data() + size_t{2} * mesh_.wedge_source[wedge(t, k)];
                q[k] = {double{value[0]}, double{value[1]}, 0};
            }
            in_texture += length(area_normal(q[0], q[1], q[2]));
        }
        for (const Attribute& a : source_.attributes) {
            const double scale = a.name == "NORMAL"    ? weights.normal
                                 : a.name == "COLOR_0" ? weights.color
                                                       : weights.uv * std::sqrt(in_space / in_texture);
            for (uint32_t k = 0; k < a.components; ++k) components_.push_back({&a, k, scale});
        }
    }
    Tested(const Tested&) = delete;
    Tested& operator=(const Tested&) = delete;

    const Mesh& source() const { return source_; }
    const PackedMesh& mesh() const { return mesh_; }
    size_t components() const { return components_.size(); }
    Vec3d to_mesh_units(Vec3d p) const { return p * mesh_.diagonal + mesh_.centre; }

    uint32_t wedge(size_t triangle, size_t k) const {
        return mesh_.has_wedges() ? mesh_.corner_wedges[3 * triangle + k] : mesh_.triangles[3 * triangle + k];
    }
    Vec3d corner(size_t triangle, size_t k) const {
        return to_double(mesh_.positions[mesh_.triangles[3 * triangle + k]]);
    }
    Vec3d position(uint32_t of_wedge) const {
        for (size_t i = 0; i < mesh_.triangles.size(); ++i)
            if (wedge(i / 3, i % 3) == of_wedge) return corner(i / 3, i % 3);
        return {};
    }
    double value(uint32_t of_wedge, size_t component) const {
        const auto& [attribute, k, scale] = components_[component];
        return scale *
               double{attribute->values[size_t{mesh_.wedge_source[of_wedge]} * attribute->components + k]};
    }

    // A third of each triangle, for each of the wedges that it has.
    std::vector<Linear> triangles_at(const std::vector<uint32_t>& wedges, size_t component) const {
        std::vector<Linear> all;
        for (size_t t = 0; t < mesh_.triangle_count(); ++t) {
            for (size_t k = 0; k < 3; ++k) {
                if (std::find(wedges.begin(), wedges.end(), wedge(t, k)) == wedges.end()) continue;
                const Vec3d p = corner(t, 0), e1 = corner(t, 1) - p, e2 = corner(t, 2) - p;
                const double aa = dot(e1, e1), ab = dot(e1, e2), bb = dot(e2, e2), det = aa * bb - ab * ab;
                const double s = value(wedge(t, 0), component), d1 = value(wedge(t, 1), component) - s,
                             d2 = value(wedge(t, 2), component) - s;
                const Vec3d g = e1 * ((bb * d1 - ab * d2) / det) + e2 * ((aa * d2 - ab * d1) / det);
                all.push_back({length(cross(e1, e2)) / 6, s, p, g});
            }
        }
        return all;
    }

    // sum w (g.p + d - s)^2.
    double error(const std::vector<uint32_t>& wedges, size_t component, Vec3d p, double s) const {
        double sum = 0;
        for (const Linear& f : triangles_at(wedges, component)) {
            const double off = f.value(p) - s;
            sum += f.weight * off * off;
        }
        return sum;
    }
    double best(const std::vector<uint32_t>& wedges, size_t component, Vec3d p) const {
        double sum = 0, weight = 0;
        for (const Linear& f : triangles_at(wedges, component))
            sum += f.weight * f.value(p), weight += f.weight;
        return sum / weight;
    }

    WedgeQuadrics::Pair join(uint32_t removed, uint32_t kept) const {
        WedgeQuadrics::Pair pair = {.removed = removed, .kept = kept};
        quadrics.join(to_float(position(removed) - position(kept)), pair);
        return pair;
    }

  private:
    struct Component {
        const Attribute* attribute = nullptr;
        uint32_t index = 0;
        double scale = 1;
    };

    Mesh source_;
    PackedMesh mesh_;
    std::vector<Component> components_;

  public:
    WedgeQuadrics quadrics;
};

Mesh hills() {
    return shapes::grid(
        {.columns = 8, .rows = 8, .height = 0.2, .normals = true, .uvs = true, .colors = true});
}

// p'Ap + 2 b'p + c - 2 s.(G p + D) + W s^2, with values that are so much more than the kept wedge has.
double joined_error(const WedgeQuadrics::Pair& pair, Vec3d p, const std::vector<double>& more) {
    double sum = double{pair.quadric(to_float(p))};
    for (size_t k = 0; k < more.size(); ++k) {
        const double at = double{dot(pair.gradients[k], to_float(p))} + double{pair.offsets[k]};
        sum += more[k] * (double{pair.quadric.weight} * more[k] - 2 * at);
    }
    return sum;
}

const std::vector<Vec3d> places = {{0, 0, 0}, {0.05, 0.02, -0.03}, {-0.1, 0.1, 0.04}, {0.2, -0.1, 0.15}};

// The two wedges of an edge inside the grid.
struct Edge {
    uint32_t removed = 0, kept = 0;
};
Edge inner_edge(const Tested& tested) {
    const auto t = tested.mesh().triangle_count() / 2;
    return {tested.wedge(t, 0), tested.wedge(t, 1)};
}

void expect_join_is_the_sum(const Tested& tested, Edge edge) {
    const WedgeQuadrics::Pair pair = tested.join(edge.removed, edge.kept);
    const Vec3d kept = tested.position(edge.kept);
    for (const Vec3d p : places) {
        for (const double more : {0.0, 0.02, -0.1}) {
            std::vector<double> change;
            double expected = 0;
            for (size_t k = 0; k < tested.components(); ++k) {
                change.push_back(more * static_cast<double>(k + 1));
                expected += tested.error({edge.removed, edge.kept}, k, kept + p,
                                         tested.value(edge.kept, k) + change.back());
            }
            EXPECT_NEAR(joined_error(pair, p, change), expected, 1e-3 * expected + 1e-7)
                << more << " at " << p.x;
        }
    }
}

TEST(WedgeQuadrics, joined_are_the_sum_over_the_triangles_of_both) {
    const Tested tested(hills());
    ASSERT_EQ(tested.components(), 8U);
    expect_join_is_the_sum(tested, inner_edge(tested));
}

TEST(WedgeQuadrics, at_a_seam_are_of_one_side_alone) {
    const Tested tested(shapes::cylinder());
    ASSERT_TRUE(tested.mesh().has_wedges());
    // An edge along the seam: both its wedges have u = 0.
    std::optional<Edge> edge;
    const Attribute& uv = *tested.source().find_attribute("TEXCOORD_0");
    const auto u = [&](uint32_t wedge) { return uv.values[size_t{2} * tested.mesh().wedge_source[wedge]]; };
    for (size_t t = 0; t < tested.mesh().triangle_count(); ++t) {
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = tested.wedge(t, k), b = tested.wedge(t, (k + 1) % 3);
            if (u(a) == 0 && u(b) == 0) edge = {a, b};
        }
    }
    ASSERT_TRUE(edge);
    expect_join_is_the_sum(tested, *edge);
}

TEST(WedgeQuadrics, have_the_error_of_the_best_values) {
    const Tested tested(hills());
    const Edge edge = inner_edge(tested);
    const CentredQuadric error = tested.quadrics.error(tested.join(edge.removed, edge.kept));
    for (const Vec3d p : places) {
        const Vec3d at = tested.position(edge.kept) + p;
        double least = 0, near = 0;
        for (size_t k = 0; k < tested.components(); ++k) {
            const double best = tested.best({edge.removed, edge.kept}, k, at);
            least += tested.error({edge.removed, edge.kept}, k, at, best);
            near += tested.error({edge.removed, edge.kept}, k, at, best + 0.01);
        }
        EXPECT_NEAR(error(to_float(p)), least, 1e-3 * least + 1e-9);
        EXPECT_LT(error(to_float(p)), near);
    }
    EXPECT_EQ(error.weight, 0) << "only planes have one";
}

TEST(WedgeQuadrics, know_the_error_of_values_that_stay) {
    const Tested tested(hills());
    const Edge edge = inner_edge(tested);
    const WedgeQuadrics::Pair pair = tested.join(edge.removed, edge.kept);
    for (const Vec3d p : places) {
        double expected = 0;
        for (size_t k = 0; k < tested.components(); ++k)
            expected += tested.error({edge.removed, edge.kept}, k, tested.position(edge.kept) + p,
                                     tested.value(edge.kept, k));
        EXPECT_NEAR(pair.quadric(to_float(p)), expected, 1e-3 * expected);
    }
}

TEST(WedgeQuadrics, joined_after_a_merge_are_the_sum_over_all_three) {
    for (const bool keep_values : {false, true}) {
        Tested tested(hills());
        const auto t = tested.mesh().triangle_count() / 2;
        const uint32_t a = tested.wedge(t, 0), b = tested.wedge(t, 1), c = tested.wedge(t, 2);
        const Vec3d moved = keep_values ? Vec3d{} : Vec3d{0.04, -0.02, 0.03};
        const Vec3d at = tested.position(b) + moved;
        tested.quadrics.merge(tested.join(a, b), to_float(moved), keep_values);
        WedgeQuadrics::Pair pair = {.removed = c, .kept = b};
        tested.quadrics.join(to_float(tested.position(c) - at), pair);
        for (const Vec3d p : places) {
            std::vector<double> change;
            double expected = 0;
            for (size_t k = 0; k < tested.components(); ++k) {
                const double value = keep_values ? tested.value(b, k) : tested.best({a, b}, k, at);
                change.push_back(0.02 * static_cast<double>(k) - 0.05);
                expected += tested.error({a, b, c}, k, at + p, value + change.back());
            }
            EXPECT_NEAR(joined_error(pair, p, change) / expected, 1, 1e-3) << keep_values;
        }
    }
}

TEST(WedgeQuadrics, write_unit_normals_and_colours_within_their_range) {
    Tested tested(hills());
    ASSERT_FALSE(tested.mesh().has_wedges()) << "so wedges have the source's numbers";
    const Edge edge = inner_edge(tested);
    // So far along x that red would be more than 1.
    tested.quadrics.merge(tested.join(edge.removed, edge.kept), {3, 0, 0}, false);
    Mesh mesh = tested.source();
    tested.quadrics.write(mesh);
    const std::vector<float>& colors = mesh.find_attribute("COLOR_0")->values;
    EXPECT_EQ(colors[size_t{3} * edge.kept], 1);
    for (const float value : colors) {
        EXPECT_GE(value, 0);
        EXPECT_LE(value, 1);
    }
    const std::vector<float>& normals = mesh.find_attribute("NORMAL")->values;
    for (size_t w = 0; w < mesh.wedge_count(); ++w)
        EXPECT_NEAR(std::hypot(normals[3 * w], normals[3 * w + 1], normals[3 * w + 2]), 1, 1e-5);
}

TEST(WedgeQuadrics, write_nothing_where_nothing_was_merged_or_values_were_kept) {
    for (const bool keep_values : {false, true}) {
        Tested tested(hills());
        const Edge edge = inner_edge(tested);
        const Vec3f at = keep_values ? Vec3f{} : Vec3f{0.02F, 0, 0.01F};
        tested.quadrics.merge(tested.join(edge.removed, edge.kept), at, keep_values);
        Mesh mesh = tested.source();
        tested.quadrics.write(mesh);
        for (size_t i = 0; i < mesh.attributes.size(); ++i) {
            const Attribute &now = mesh.attributes[i], &before = tested.source().attributes[i];
            for (size_t w = 0; w < mesh.wedge_count(); ++w) {
                if (w == edge.kept && !keep_values) continue;
                for (size_t k = w * now.components; k < (w + 1) * now.components; ++k)
                    EXPECT_EQ(now.values[k], before.values[k]) << now.name;
            }
        }
    }
}

TEST(WedgeQuadrics, keep_a_linear_texture_exact_wherever_vertices_of_a_flat_grid_merge) {
    for (const Vec3d moved : {Vec3d{}, Vec3d{0.03, 0, 0.01}, Vec3d{-0.2, 0, 0.15}}) {
        Tested tested(shapes::grid({.columns = 8, .rows = 8, .uvs = true}));
        const Edge edge = inner_edge(tested);
        const WedgeQuadrics::Pair pair = tested.join(edge.removed, edge.kept);
        EXPECT_NEAR(tested.quadrics.error(pair)(to_float(moved)), 0, 1e-8);
        tested.quadrics.merge(pair, to_float(moved), false);
        Mesh mesh = tested.source();
        tested.quadrics.write(mesh);
        const Vec3d at = tested.to_mesh_units(tested.position(edge.kept) + moved);
        const std::vector<float>& uv = mesh.find_attribute("TEXCOORD_0")->values;
        EXPECT_NEAR(uv[size_t{2} * edge.kept], at.x, 1e-5);
        EXPECT_NEAR(uv[size_t{2} * edge.kept + 1], at.z, 1e-5);
    }
}

TEST(WedgeQuadrics, foresee_the_texture_that_a_merge_writes) {
    Tested tested(hills());
    ASSERT_EQ(tested.quadrics.uv_sets(), 1U);
    const Edge edge = inner_edge(tested);
    const WedgeQuadrics::Pair pair = tested.join(edge.removed, edge.kept);
    const Vec3f at = {0.03F, 0.01F, -0.02F};
    const auto foreseen = tested.quadrics.uv(pair, at, 0);
    tested.quadrics.merge(pair, at, false);
    EXPECT_EQ(tested.quadrics.uv(edge.kept, 0), foreseen);
}

TEST(WedgeQuadrics, have_no_error_of_what_has_no_weight) {
    const Mesh source = hills();
    const PackedMesh mesh(source, {});
    WedgeQuadrics::Pair pair = {.removed = mesh.triangles[90], .kept = mesh.triangles[91]};
    const WedgeQuadrics none(mesh, source, {}, {});
    none.join(mesh.positions[pair.removed] - mesh.positions[pair.kept], pair);
    EXPECT_EQ(none.error(pair)({0.1F, 0.1F, 0.1F}), 0);
    EXPECT_EQ(none.error_with_values_kept(pair), 0);
}

// Linear values on flat ground stay exact, whatever they weigh.
TEST(WedgeQuadrics, carry_along_what_has_no_weight) {
    const Mesh source = shapes::grid({.columns = 8, .rows = 8, .uvs = true, .colors = true});
    const PackedMesh mesh(source, {});
    for (const AttributeWeights& some : {AttributeWeights{}, AttributeWeights{.color = 0.1}}) {
        WedgeQuadrics quadrics(mesh, source, some, {});
        EXPECT_EQ(quadrics.uv_sets(), 1U);
        WedgeQuadrics::Pair pair = {.removed = mesh.triangles[90], .kept = mesh.triangles[91]};
        const Vec3f offset = mesh.positions[pair.removed] - mesh.positions[pair.kept];
        quadrics.join(offset, pair);
        quadrics.merge(pair, offset * 0.5F, false);
        Mesh merged = source;
        quadrics.write(merged);
        const Vec3f middle = (source.positions[pair.removed] + source.positions[pair.kept]) * 0.5F;
        const std::vector<float>& uv = merged.find_attribute("TEXCOORD_0")->values;
        EXPECT_NEAR(uv[size_t{2} * pair.kept], middle.x, 1e-5);
        EXPECT_NEAR(uv[size_t{2} * pair.kept + 1], middle.z, 1e-5);
        EXPECT_NEAR(merged.find_attribute("COLOR_0")->values[size_t{3} * pair.kept], middle.x, 1e-5);
    }
}

}  // namespace
}  // namespace coppice
