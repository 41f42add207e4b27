// Real OBJ, PLY and archive files: what is in them, and that none of the broken ones does harm.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/base/error.h"
#include "core/format/asset.h"
#include "tests/support/test_assets.h"

namespace coppice::test {
namespace {

struct Counts {
    std::string file;
    size_t triangles;
    size_t meshes = 1, materials = 0, images = 0;
};

// Triangles without area and second ones are not counted.
const Counts table[] = {
    {"models/suzanne.obj", 968},
    {"models/stanford-bunny.obj", 69451},
    {"models/cylinder.obj", 436, 1, 1},
    {"models/horse_quad.obj", 4796},
    {"models/wolf.obj", 1784, 1, 1},
    {"textured/bunny10k_textured.obj", 9999, 1, 1, 1},
    {"textured/fuze.obj", 1000, 1, 1, 1},
    {"textured/pizza.obj", 49954},
    {"textured/obj2gltf/box-windows-paths/box-windows-paths.obj", 12, 1, 1, 1},
    {"textured/obj2gltf/box-mtllib/box-mtllib.obj", 12, 1, 3},
    {"duplicates/office_chair.obj", 6853, 1, 3},
    {"duplicates/regr01.obj", 2706, 1, 12},
    {"features/obj/box_UTF16BE.obj", 12, 1, 1},
    {"features/obj/concave_polygon.obj", 64, 1, 1},
    {"features/obj/cornell_box_multimaterial.obj", 36, 8, 5},
    {"features/obj/negative_indices.obj", 12},
    {"features/obj/number_formats.obj", 0},
    {"features/obj/catmark_torus_creases0.obj", 64},
    {"models/apple.ply", 1704},
    {"models/horse.ply", 96966},
    {"models/igea.ply", 268686},
    {"textured/TextureDouble.ply", 4, 1, 2},
    {"features/ply/cube_quads.ply", 12},
    {"features/ply/cube_binary_header_with_RN_newline.ply", 12},
    {"features/ply/test_extra_whitespace.ply", 1},
    {"features/ply-magnum/triangle-fast-path-be.ply", 3},
};

size_t triangles(const Scene& scene) {
    size_t sum = 0;
    for (const Mesh& mesh : scene.meshes) sum += mesh.triangle_count();
    return sum;
}

TEST(SimpleFormats, hold_what_their_sources_say) {
    if (!asset_folder()) GTEST_SKIP() << no_assets_message();
    for (const Counts& expected : table) {
        SCOPED_TRACE(expected.file);
        const UploadedAsset asset = load_asset(expected.file);
        const Scene scene = read_asset(asset.upload(), {}, Watch{}).scene;
        EXPECT_EQ(triangles(scene), expected.triangles);
        EXPECT_EQ(scene.meshes.size(), expected.meshes);
        EXPECT_EQ(scene.materials.size(), expected.materials);
        EXPECT_EQ(scene.images.size(), expected.images);
        for (const Mesh& mesh : scene.meshes) EXPECT_TRUE(is_consistent(mesh));
    }
}

// Each is read to something sound, or refused with words.
TEST(SimpleFormats, refuse_broken_files_with_a_reason_or_read_them_to_something_sound) {
    if (!asset_folder()) GTEST_SKIP() << no_assets_message();
    size_t refused = 0, read = 0;
    for (const char* folder :
         {"invalid/obj", "invalid/ply", "invalid/ply-magnum", "invalid/archive", "invalid/other"}) {
        for (const std::string& file : asset_files(folder, {".obj", ".ply", ".zip", ".off"})) {
            SCOPED_TRACE(file);
            const UploadedAsset asset = load_asset(file);
            try {
                const Scene scene = read_asset(asset.upload(), {}, Watch{}).scene;
                EXPECT_TRUE(triangles(scene) > 0 || !scene.warnings.empty());
                for (const Mesh& mesh : scene.meshes) EXPECT_TRUE(is_consistent(mesh));
                ++read;
            } catch (const Error& error) {
                EXPECT_THAT(error.message(), testing::SizeIs(testing::Gt(10U)));
                EXPECT_NE(error.code(), ErrorCode::internal);
                ++refused;
            }
        }
    }
    EXPECT_GT(refused, 40U);
    EXPECT_GT(read, 15U);
}

TEST(SimpleFormats, refuse_a_zip_that_slips_out) {
    if (!asset_folder()) GTEST_SKIP() << no_assets_message();
    const UploadedAsset asset = load_asset("invalid/archive/zip-slip.zip");
    try {
        read_asset(asset.upload(), {}, Watch{});
        FAIL() << "was read";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::resource_forbidden);
    }
}

// What is written reads back to the same triangles. Writing orders triangles by material; from then on the
// bytes stay.
TEST(SimpleFormats, survive_a_round_trip_through_instanced_obj) {
    if (!asset_folder()) GTEST_SKIP() << no_assets_message();
    for (const char* file :
         {"textured/bunny10k_textured.obj", "textured/fuze.obj", "duplicates/regr01.obj",
          "features/obj/cornell_box_multimaterial.obj", "models/wolf.obj", "models/apple.ply",
          "textured/obj2gltf/box-mixed-attributes/box-mixed-attributes.obj"}) {
        SCOPED_TRACE(file);
        const UploadedAsset asset = load_asset(file);
        const Scene scene = read_asset(asset.upload(), {}, Watch{}).scene;
        const WrittenAsset once = write_asset(scene, {.format = Format::iobj}, Watch{});
        const Upload upload{.asset = {.path = "", .bytes = once.bytes}};
        const ReadAsset again = read_asset(upload, {}, Watch{});
        EXPECT_EQ(again.format, Format::iobj);
        EXPECT_EQ(triangles(again.scene), triangles(scene));
        EXPECT_EQ(again.scene.images.size(), scene.images.size());
        EXPECT_EQ(again.scene.nodes.size(), scene.nodes.size());
        for (size_t i = 0; i < scene.meshes.size(); ++i) {
            EXPECT_EQ(again.scene.meshes[i].vertex_count(), scene.meshes[i].vertex_count());
            EXPECT_EQ(again.scene.meshes[i].attributes.size(), scene.meshes[i].attributes.size());
        }
        const WrittenAsset twice = write_asset(again.scene, {.format = Format::iobj}, Watch{});
        const Scene third = read_asset({.asset = {.path = "", .bytes = twice.bytes}}, {}, Watch{}).scene;
        EXPECT_TRUE(write_asset(third, {.format = Format::iobj}, Watch{}).bytes == twice.bytes);
    }
}

}  // namespace
}  // namespace coppice::test
