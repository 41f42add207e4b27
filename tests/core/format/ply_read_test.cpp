#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/base/error.h"
#include "core/format/ply/read_ply.h"

namespace coppice {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string square_vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
const std::string xyz = "property float x\nproperty float y\nproperty float z\n";

std::string ascii(const std::string& elements, const std::string& body) {
    return "ply\nformat ascii 1.0\n" + elements + "end_header\n" + body;
}

std::string square(const std::string& face_properties, const std::string& faces, size_t face_count) {
    return ascii(
        "element vertex 4\n" + xyz + "element face " + std::to_string(face_count) + "\n" + face_properties,
        square_vertices + faces);
}

Scene read(const std::string& text, const Resources& resources = {}, const ReadLimits& limits = {}) {
    Scene scene = read_ply(as_bytes(text), "folder/thing.ply", resources, limits, Watch{});
    for (const Mesh& mesh : scene.meshes) EXPECT_TRUE(is_consistent(mesh));
    return scene;
}

Error refused(const std::string& text, const ReadLimits& limits = {}) {
    try {
        read(text, {}, limits);
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "was read: " << text;
    return {ErrorCode::internal, "", ""};
}

template <typename T>
void put(std::string& out, T value, bool big_endian) {
    std::string raw(reinterpret_cast<const char*>(&value), sizeof(T));
    if (big_endian) std::reverse(raw.begin(), raw.end());
    out += raw;
}

std::string binary_triangle(bool big_endian) {
    std::string text =
        std::string("ply\nformat binary_") + (big_endian ? "big" : "little") + "_endian 1.0\n" +
        "element vertex 3\nproperty double x\nproperty float y\nproperty short z\nproperty uchar red\n"
        "property uchar green\nproperty uchar blue\nelement face 1\nproperty list ushort int vertex_index\n"
        "end_header\n";
    for (int i = 0; i < 3; ++i) {
        put<double>(text, i == 1 ? 0.5 : 0, big_endian);
        put<float>(text, i == 2 ? -2.5F : 0, big_endian);
        put<int16_t>(text, 7, big_endian);
        for (const int color : {255, 0, 51}) put<uint8_t>(text, static_cast<uint8_t>(color), big_endian);
    }
    put<uint16_t>(text, 3, big_endian);
    for (int32_t i = 0; i < 3; ++i) put<int32_t>(text, i, big_endian);
    return text;
}

TEST(PlyRead, reads_ascii_and_splits_polygons) {
    const Scene scene = read(square("property list uchar int vertex_indices\n", "4 0 1 2 3\n", 1));
    ASSERT_EQ(scene.meshes.size(), 1U);
    EXPECT_EQ(scene.meshes[0].name, "thing");
    EXPECT_EQ(scene.meshes[0].triangle_count(), 2U);
    EXPECT_EQ(scene.nodes.size(), 1U);
}

TEST(PlyRead, reads_both_binaries_and_any_types) {
    for (const bool big_endian : {false, true}) {
        const Scene scene = read(binary_triangle(big_endian));
        const Mesh& mesh = scene.meshes[0];
        EXPECT_THAT(mesh.positions, ElementsAre(Vec3f{0, 0, 7}, Vec3f{0.5F, 0, 7}, Vec3f{0, -2.5F, 7}));
        const Attribute* color = mesh.find_attribute("COLOR_0");
        ASSERT_NE(color, nullptr);
        EXPECT_EQ(color->storage, (Storage{ComponentType::uint8, true}));
        EXPECT_FLOAT_EQ(color->values[2], 0.2F);
    }
}

TEST(PlyRead, reads_texture_coordinates_of_corners_and_their_textures) {
    std::string text = square("property list uchar int vertex_indices\nproperty list uchar float texcoord\n",
                              "3 0 1 2  6 0 0.25 1 0.25 1 1\n3 0 2 3  6 0.5 0.25 1 1 0 1\n", 2);
    text.insert(text.find("element"), "comment TextureFile <this>.png\n");
    const Scene scene = read(text, Resources({{"thing.png", as_bytes("pixels")}}));
    EXPECT_EQ(scene.meshes[0].vertex_count(), 4U);
    EXPECT_EQ(scene.meshes[0].wedge_count(), 5U);
    EXPECT_EQ(scene.meshes[0].find_attribute("TEXCOORD_0")->values[1], 0.75F);
    ASSERT_EQ(scene.images.size(), 1U);
    EXPECT_EQ(scene.materials[0].base_color_texture.image, 0U);
}

TEST(PlyRead, reads_strips_with_restarts_and_turns_every_other_triangle) {
    const Scene scene =
        read(ascii("element vertex 4\n" + xyz + "element tristrips 1\nproperty list int int vertex_indices\n",
                   square_vertices + "9 0 1 3 2 -1 0 1 2 2\n"));
    EXPECT_THAT(scene.meshes[0].triangles, ElementsAre(0, 1, 3, 3, 1, 2, 0, 1, 2));
}

TEST(PlyRead, skips_elements_and_properties_that_it_does_not_know) {
    const Scene scene =
        read(ascii("element material 1\nproperty list uchar int stuff\nelement vertex 3\nproperty int id\n" +
                       xyz + "element face 1\nproperty char flag\nproperty list uchar uint vertex_indices\n",
                   "2 8 9\n5 0 0 0\n6 1 0 0\n7 0 1 0\n1 3 0 1 2\n"));
    EXPECT_EQ(scene.meshes[0].triangle_count(), 1U);
}

TEST(PlyRead, drops_vertices_that_no_face_uses) {
    EXPECT_EQ(
        read(square("property list uchar int vertex_indices\n", "3 0 1 2\n", 1)).meshes[0].vertex_count(),
        3U);
}

TEST(PlyRead, refuses_point_clouds) {
    const Error cloud = refused(ascii("element vertex 4\n" + xyz, square_vertices));
    EXPECT_EQ(cloud.code(), ErrorCode::asset_unsupported);
    EXPECT_THAT(cloud.message(), HasSubstr("no faces (4 vertices): point clouds are not read"));
    EXPECT_EQ(refused(square("property list uchar int vertex_indices\n", "", 0)).code(),
              ErrorCode::asset_unsupported);
    EXPECT_EQ(refused(ascii("element vertex 0\n" + xyz, "")).code(), ErrorCode::asset_malformed);
    const Error edges = refused(square("property list uchar int vertex_indices\n", "2 0 1\n", 1));
    EXPECT_EQ(edges.code(), ErrorCode::asset_malformed);
    EXPECT_THAT(edges.message(), HasSubstr("no triangles (4 vertices): its faces have fewer than 3 corners"));
}

TEST(PlyRead, refuses_counts_that_the_bytes_cannot_hold_before_it_allocates) {
    for (const char* encoding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        const std::string text = std::string("ply\nformat ") + encoding +
                                 " 1.0\nelement vertex 4000000000\n" + xyz + "end_header\n0 0 0\n";
        EXPECT_EQ(refused(text).code(), ErrorCode::asset_malformed) << encoding;
    }
    std::string list = binary_triangle(false);
    list.replace(list.size() - 14, 2, "\xff\xff");
    EXPECT_EQ(refused(list).code(), ErrorCode::asset_malformed);
}

TEST(PlyRead, refuses_wrong_indices_and_positions) {
    const std::string list = "property list uchar int vertex_indices\n";
    for (const char* face :
         {"3 0 1 4\n", "3 0 1 -1\n", "3 0 1 1.5\n", "3 0 1 nan\n", "3 0 1\n", "-3 0 1 2\n"}) {
        EXPECT_EQ(refused(square(list, face, 1)).code(), ErrorCode::asset_malformed) << face;
    }
    std::string text = square(list, "3 0 1 2\n", 1);
    text.replace(text.find("1 1 0"), 5, "1 inf");
    EXPECT_THAT(refused(text).where(), HasSubstr("line"));
}

TEST(PlyRead, refuses_broken_headers_and_says_where) {
    for (const std::string header :
         {"ply\nend_header\n", "ply\nformat ascii 2.0\nend_header\n",
          "ply\nformat ascii 1.0 more\nend_header\n", "ply\nformat ascii 1.0\nproperty float x\nend_header\n",
          "ply\nformat ascii 1.0\nelement vertex -1\nend_header\n",
          "ply\nformat ascii 1.0\nelement vertex 4294967296\nend_header\n",
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty half x\nend_header\n",
          "ply\nformat ascii 1.0\nelement face 3\nproperty list float int vertex_indices\nend_header\n",
          "ply\nformat ascii 1.0\nheh\nend_header\n", "ply\nformat ascii 1.0\nelement vertex 0\n"}) {
        const Error error = refused(header);
        EXPECT_EQ(error.code(), ErrorCode::asset_malformed) << header;
        EXPECT_THAT(error.where(), HasSubstr("line ")) << header;
    }
}

TEST(PlyRead, refuses_more_than_the_limits) {
    ReadLimits limits;
    limits.triangles = 1;
    EXPECT_EQ(refused(square("property list uchar int vertex_indices\n", "4 0 1 2 3\n", 1), limits).code(),
              ErrorCode::asset_too_large);
    limits = {};
    limits.vertices = 3;
    EXPECT_EQ(refused(square("property list uchar int vertex_indices\n", "3 0 1 2\n", 1), limits).code(),
              ErrorCode::asset_too_large);
}

TEST(PlyRead, survives_every_truncation_and_flipped_byte) {
    const std::string good = binary_triangle(true);
    for (size_t size = 0; size < good.size(); ++size) EXPECT_THROW(read(good.substr(0, size)), Error) << size;
    for (size_t at = 0; at < good.size(); ++at) {
        std::string broken = good;
        broken[at] = static_cast<char>(~broken[at]);
        try {
            read(broken);
        } catch (const Error&) {
        }
    }
}

}  // namespace
}  // namespace coppice
