#include "core/sample/sample.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "core/base/error.h"
#include "core/mesh/adjacency.h"
#include "core/scene/instance.h"

namespace coppice {
namespace {

using testing::HasSubstr;

SampleOptions small() {
    return {.scale = 0.2};
}

class EverySample : public testing::TestWithParam<std::string> {};

std::vector<std::string> names() {
    std::vector<std::string> out;
    for (const SampleKind& kind : sample_kinds()) out.emplace_back(kind.name);
    return out;
}

INSTANTIATE_TEST_SUITE_P(Sample, EverySample, testing::ValuesIn(names()),
                         [](const auto& test) { return test.param; });

bool is_ground(const Mesh& mesh) {
    return mesh.name == "ground" || mesh.name == "street";
}
bool is_open_by_design(const Mesh& mesh) {
    return is_ground(mesh) || mesh.name == "bunny";
}

TEST_P(EverySample, is_consistent_and_watertight) {
    for (const Mesh& mesh : make_sample(GetParam(), small()).meshes) {
        SCOPED_TRACE(mesh.name);
        EXPECT_TRUE(is_consistent(mesh));
        const Topology t = topology(mesh);
        EXPECT_EQ(t.non_manifold_edges, 0U);
        EXPECT_EQ(t.inconsistent_edges, 0U);
        if (!is_open_by_design(mesh)) {
            EXPECT_EQ(t.border_edges, 0U);
        }
    }
}

TEST_P(EverySample, has_no_degenerate_triangle_and_faces_outwards) {
    for (const Mesh& mesh : make_sample(GetParam(), {}).meshes) {
        SCOPED_TRACE(mesh.name);
        double volume = 0;
        for (size_t t = 0; t < mesh.triangle_count(); ++t) {
            const Vec3d a = mesh.corner_position(t, 0), b = mesh.corner_position(t, 1),
                        c = mesh.corner_position(t, 2);
            ASSERT_GT(length(cross(b - a, c - a)), 1e-9) << "triangle " << t;
            volume += dot(a, cross(b, c)) / 6;
        }
        if (!is_open_by_design(mesh)) {
            EXPECT_GT(volume, 0);
        }
    }
}

TEST_P(EverySample, has_unit_normals_that_agree_with_its_triangles) {
    for (const Mesh& mesh : make_sample(GetParam(), small()).meshes) {
        const Attribute& normal = *mesh.find_attribute("NORMAL");
        for (size_t t = 0; t < mesh.triangle_count(); ++t) {
            const Vec3d a = mesh.corner_position(t, 0);
            const Vec3d face = cross(mesh.corner_position(t, 1) - a, mesh.corner_position(t, 2) - a);
            Vec3d sum;
            for (size_t c = 0; c < 3; ++c) {
                const float* n = &normal.values[size_t{3} * mesh.triangles[3 * t + c]];
                ASSERT_NEAR(length(Vec3f{n[0], n[1], n[2]}), 1, 1e-5);
                sum = sum + Vec3d{n[0], n[1], n[2]};
            }
            ASSERT_GT(dot(sum, face), 0) << mesh.name << ", triangle " << t;
        }
    }
}

TEST_P(EverySample, has_texture_coordinates_with_seams_and_textures) {
    const Scene scene = make_sample(GetParam(), small());
    for (const Mesh& mesh : scene.meshes) {
        const Attribute& uv = *mesh.find_attribute("TEXCOORD_0");
        for (const float value : uv.values)
            ASSERT_TRUE(value >= 0 && value <= 1) << mesh.name << ": " << value;
        if (!is_ground(mesh)) {
            EXPECT_GT(mesh.wedge_count(), mesh.vertex_count());
        }
    }
    ASSERT_FALSE(scene.images.empty());
    for (const Image& image : scene.images) {
        EXPECT_EQ(as_text(image.bytes).substr(1, 3), "PNG");
        EXPECT_LT(image.bytes.size(), 200'000U);
    }
    for (const Material& material : scene.materials) EXPECT_TRUE(material.base_color_texture.image);
}

TEST_P(EverySample, is_the_same_for_the_same_options_and_another_for_another_seed) {
    const Scene first = make_sample(GetParam(), small()), again = make_sample(GetParam(), small());
    SampleOptions other_seed = small();
    other_seed.seed = 2;
    const Scene other = make_sample(GetParam(), other_seed);
    bool differs = false;
    ASSERT_EQ(first.nodes.size(), again.nodes.size());
    for (size_t i = 0; i < first.nodes.size(); ++i) {
        EXPECT_EQ(first.nodes[i].local, again.nodes[i].local);
        differs = differs || first.nodes[i].local != other.nodes[i].local;
    }
    for (size_t i = 0; i < first.meshes.size(); ++i) {
        EXPECT_EQ(first.meshes[i].positions, again.meshes[i].positions);
        EXPECT_EQ(first.meshes[i].triangles, again.meshes[i].triangles);
        differs = differs || first.meshes[i].positions != other.meshes[i].positions;
    }
    EXPECT_TRUE(differs);
    EXPECT_EQ(instances(first).size(), instances(other).size());
}

TEST_P(EverySample, has_as_many_copies_and_triangles_as_asked) {
    const Scene scene = make_sample(GetParam(), {.copies = 50, .triangles = 2000});
    const auto placed = instances(scene).size();
    EXPECT_TRUE(placed == 50 || placed == 51) << placed;  // one more where there is a ground
    for (const Mesh& mesh : scene.meshes) {
        if (!is_ground(mesh)) {
            EXPECT_NEAR(static_cast<double>(mesh.triangle_count()), 2000, 200) << mesh.name;
        }
    }
}

TEST_P(EverySample, joined_is_one_mesh_of_the_same_size_and_place) {
    SampleOptions options = small();
    const Scene scene = make_sample(GetParam(), options);
    options.joined = true;
    const Scene joined = make_sample(GetParam(), options);
    ASSERT_EQ(joined.meshes.size(), 1U);
    EXPECT_TRUE(is_consistent(joined.meshes[0]));
    size_t rendered = 0;
    for (const Instance& instance : instances(scene))
        rendered += scene.meshes[instance.mesh].triangle_count();
    EXPECT_EQ(joined.meshes[0].triangle_count(), rendered);
    EXPECT_NEAR(scene_bounds(joined).diagonal(), scene_bounds(scene).diagonal(), 1e-3);
}

TEST_P(EverySample, works_at_its_smallest) {
    const Scene scene = make_sample(GetParam(), {.copies = 1, .triangles = 60});
    for (const Mesh& mesh : scene.meshes) EXPECT_TRUE(is_consistent(mesh)) << mesh.name;
}

TEST(Sample, stands_with_y_up_as_gltf_is) {
    for (const char* name : {"forest", "city", "bunny13", "cad"}) {
        SCOPED_TRACE(name);
        const Bounds box = scene_bounds(make_sample(name, {}));
        const Vec3d size = box.max - box.min;
        EXPECT_LT(size.y, 0.5 * size.x);
        EXPECT_LT(size.y, 0.5 * size.z);
        EXPECT_GT(box.max.y, -box.min.y);
    }
}

TEST(Bunny, has_the_size_and_the_holes_of_the_real_small_bunny) {
    const Scene scene = make_sample("bunny13", {});
    ASSERT_EQ(scene.meshes.size(), 1U);
    EXPECT_EQ(scene.meshes[0].vertex_count(), 2503U);
    EXPECT_EQ(scene.meshes[0].triangle_count(), 4968U);
    EXPECT_EQ(topology(scene.meshes[0]).border_edges, 42U);
    EXPECT_EQ(instances(scene).size(), 13U);
}

TEST(Cad, mirrors_some_of_its_instances) {
    size_t mirrored = 0;
    for (const Instance& instance : instances(make_sample("cad", {}))) {
        mirrored += determinant(instance.world) < 0 ? 1 : 0;
    }
    EXPECT_GT(mirrored, 10U);
}

TEST(Baked, shares_nothing) {
    const Scene scene = make_sample("baked", {});
    EXPECT_EQ(scene.meshes.size(), instances(scene).size());
}

TEST(Sample, names_what_there_is_when_asked_for_what_there_is_not) {
    try {
        make_sample("jungle", {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::option_invalid);
        EXPECT_THAT(error.message(), HasSubstr("forest, city, bunny13, baked, cad"));
    }
}

TEST(Sample, refuses_numbers_out_of_range) {
    EXPECT_THROW(make_sample("cad", {.scale = 0}), Error);
    EXPECT_THROW(make_sample("cad", {.scale = std::nan("")}), Error);
    EXPECT_THROW(make_sample("cad", {.copies = 0}), Error);
    EXPECT_THROW(make_sample("cad", {.triangles = 3}), Error);
}

}  // namespace
}  // namespace coppice
