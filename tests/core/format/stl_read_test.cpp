#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "core/base/error.h"
#include "core/format/stl/read_stl.h"

namespace coppice {
namespace {

const std::string facet =
    "  facet normal 0 0 1\n    outer loop\n      vertex 0 0 0\n      vertex 1 0 0\n      vertex 0 1 0\n"
    "    endloop\n  endfacet\n";

Scene read(const std::string& text, const ReadLimits& limits = {}) {
    Scene scene = read_stl(as_bytes(text), "part.stl", limits, Watch{});
    for (const Mesh& mesh : scene.meshes) EXPECT_TRUE(is_consistent(mesh));
    return scene;
}

// Triangles in a row that share corners, and one more number in the count than there are if asked.
std::string binary(uint32_t triangles, float z = 0) {
    std::string text(80, ' ');
    text.append(reinterpret_cast<const char*>(&triangles), 4);
    for (uint32_t t = 0; t < triangles; ++t) {
        const auto x = static_cast<float>(t);
        const float values[12] = {0, 0, 0, x, 0, z, x + 1, 0, z, x + 1, 1, z};
        text.append(reinterpret_cast<const char*>(values), sizeof(values));
        text += std::string(2, '\0');
    }
    return text;
}

TEST(StlRead, reads_a_mesh_for_each_solid) {
    const Scene scene =
        read("solid one\n" + facet + facet + "endsolid one\nsolid two\n" + facet + "endsolid two\n");
    ASSERT_EQ(scene.meshes.size(), 2U);
    EXPECT_EQ(scene.meshes[0].name, "one");
    EXPECT_EQ(scene.meshes[0].triangle_count(), 2U);
    EXPECT_EQ(scene.meshes[0].vertex_count(), 3U);
    EXPECT_TRUE(scene.meshes[0].attributes.empty());
}

TEST(StlRead, reads_capitals_and_windows_line_ends) {
    std::string text = "SOLID x\r\n" + facet;
    for (const auto& [from, to] :
         {std::pair("vertex", "VERTEX"), std::pair("facet normal", "FACET NORMAL")}) {
        for (size_t at = text.find(from); at != text.npos; at = text.find(from))
            text.replace(at, std::string(from).size(), to);
    }
    EXPECT_EQ(read(text + "ENDSOLID\r\n").meshes[0].triangle_count(), 1U);
}

TEST(StlRead, reads_binary_and_welds) {
    const Scene scene = read(binary(3));
    EXPECT_EQ(scene.meshes[0].name, "part");
    EXPECT_EQ(scene.meshes[0].triangle_count(), 3U);
    EXPECT_EQ(scene.meshes[0].vertex_count(), 7U);
}

TEST(StlRead, reads_binary_whose_header_says_solid) {
    std::string text = binary(2);
    text.replace(0, 5, "solid");
    EXPECT_EQ(read(text).meshes[0].triangle_count(), 2U);
}

TEST(StlRead, refuses_what_is_malformed) {
    const std::string nan_corner = binary(1, std::numeric_limits<float>::quiet_NaN());
    for (const std::string& text :
         {std::string("solid\nendsolid\n"), "solid\n" + facet.substr(0, 60),
          std::string("solid\nfacet\nvertex 0 0 nan\n"), std::string("solid\nfacet\nvertex 0 0\n"),
          std::string("solid\nwhat\n"),
          std::string("solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n"), nan_corner,
          binary(0), binary(2).substr(0, 150), std::string("short")}) {
        try {
            read(text);
            ADD_FAILURE() << "was read: " << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::asset_malformed) << text;
        }
    }
}

TEST(StlRead, refuses_more_triangles_than_the_limit) {
    ReadLimits limits;
    limits.triangles = 2;
    for (const std::string& text : {binary(3), "solid\n" + facet + facet + facet + "endsolid\n"}) {
        try {
            read(text, limits);
            ADD_FAILURE() << "was read";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::asset_too_large);
        }
    }
}

}  // namespace
}  // namespace coppice
