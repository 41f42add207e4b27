// What other formats may describe and glTF may not. That the result is valid is what the reader checks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/format/asset.h"

namespace coppice {
namespace {

using ::testing::Contains;
using ::testing::Field;
using ::testing::IsEmpty;

// The least that passes for an image: a header, and where the pixels begin.
const std::string png("\x89PNG\r\n\x1A\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\x08\2\0\0\0\0\0\0\0\0\0\0\0IDAT", 41);
constexpr std::string_view mtl = "newmtl photo\nKd 1 0 0\nmap_Kd photo.png\n";
constexpr std::string_view with_coordinates =
    "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl photo\nf 1/1 2/2 3/3\n";
constexpr std::string_view without_coordinates =
    "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl photo\nf 1 2 3\n";

Scene read(std::string_view obj, std::string_view image) {
    return read_asset({.asset = {.path = "a.obj", .bytes = as_bytes(obj)},
                       .resources = {{.path = "a.mtl", .bytes = as_bytes(mtl)},
                                     {.path = "photo.png", .bytes = as_bytes(image)}}},
                      {}, {})
        .scene;
}

Scene read_again(const WrittenAsset& written) {
    return read_asset({.asset = {.path = "a.glb", .bytes = written.bytes}}, {}, {}).scene;
}

TEST(DrawableMaterials, are_left_alone_where_triangles_have_coordinates) {
    const WrittenAsset written = write_asset(read(with_coordinates, png), {}, {});
    const Scene scene = read_again(written);
    EXPECT_THAT(written.warnings, IsEmpty());
    ASSERT_EQ(scene.materials.size(), 1U);
    EXPECT_TRUE(scene.materials[0].base_color_texture.image.has_value());
}

TEST(DrawableMaterials, have_no_textures_where_triangles_have_no_coordinates) {
    const WrittenAsset written = write_asset(read(without_coordinates, png), {}, {});
    const Scene scene = read_again(written);
    EXPECT_THAT(written.warnings, Contains(Field(&Warning::code, "texture.no_coordinates")));
    const Material& used = scene.materials.at(*scene.meshes.at(0).slots.at(0).material);
    EXPECT_FALSE(used.base_color_texture.image.has_value());
    EXPECT_EQ(used.name, "photo");
    EXPECT_FLOAT_EQ(used.base_color[0], 1.0F);
}

TEST(DrawableMaterials, leave_out_an_image_that_is_broken) {
    const WrittenAsset written = write_asset(read(with_coordinates, png.substr(0, 20)), {}, {});
    const Scene scene = read_again(written);
    EXPECT_THAT(written.warnings, Contains(Field(&Warning::code, "image.unreadable")));
    EXPECT_THAT(scene.images, IsEmpty());
    EXPECT_FALSE(scene.materials.at(0).base_color_texture.image.has_value());
}

}  // namespace
}  // namespace coppice
