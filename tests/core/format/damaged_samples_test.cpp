// A small file of each format, cut short at every place and with thousands of single bytes changed.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>

#include "core/format/archive.h"
#include "core/sample/sample.h"
#include "tests/support/damage.h"

namespace coppice::test {
namespace {

Bytes small_sample(Format format) {
    // The least that still has textures, seams, several meshes and instances.
    const Scene scene = make_sample("cad", {.copies = 4, .triangles = 60});
    return write_asset(scene, {.format = format}, {}).bytes;
}

Upload upload_of(std::string path, ByteView bytes) {
    return {.asset = {.path = std::move(path), .bytes = bytes}};
}

// An octahedron; every value is exact in text.
constexpr std::string_view octahedron_vertices = "1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n";
constexpr std::string_view octahedron_faces =
    "3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n";

std::string ascii_ply() {
    return fmt::format(
        "ply\nformat ascii 1.0\ncomment drawn\nelement vertex 6\nproperty float x\nproperty float y\n"
        "property float z\nelement face 8\nproperty list uchar int vertex_indices\nend_header\n{}{}",
        octahedron_vertices, octahedron_faces);
}

Bytes binary_ply() {
    Bytes bytes = to_bytes(
        "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face 2\n"
        "property list uchar int vertex_indices\nend_header\n");
    for (const float x : {0.0F, 1.0F})
        for (const float y : {0.0F, 1.0F}) {
            for (const float value : {x, y, x * y}) append_u32(bytes, std::bit_cast<uint32_t>(value));
            append(bytes, as_bytes("abc"));
        }
    for (const auto& face : {std::array<uint32_t, 3>{0, 2, 1}, std::array<uint32_t, 3>{1, 2, 3}}) {
        bytes.push_back(std::byte{3});
        for (const uint32_t vertex : face) append_u32(bytes, vertex);
    }
    return bytes;
}

Bytes binary_stl() {
    Bytes bytes(80, std::byte{' '});
    append_u32(bytes, 2);
    for (const float z : {0.0F, 1.0F}) {
        for (const float value : {0.0F, 0.0F, 1.0F, 0.0F, 0.0F, z, 1.0F, 0.0F, z, 0.0F, 1.0F, z})
            append_u32(bytes, std::bit_cast<uint32_t>(value));
        bytes.resize(bytes.size() + 2);
    }
    return bytes;
}

constexpr std::string_view ascii_stl =
    "solid drawn\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
    "0\nendloop\nendfacet\n"
    "facet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid "
    "drawn\n";

constexpr std::string_view iobj =
    "#@iobj 1.0\no tree\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n"
    "f 1/1 2/2 3/3\nf 1/1 4/3 2/2\no \"oak\"\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\nf "
    "-4 -3 -2 -1\n"
    "#@instance tree oak-1  1 0 0 4  0 1 0 5  0 0 1 6  0 0 0 1\n"
    "#@instance tree \"oak 2\"  0 -1 0 4  1 0 0 5  0 0 1 6  0 0 0 1\n";

struct Sample {
    std::string path;
    Bytes bytes;
};

std::vector<Sample> samples() {
    const auto zip = [](std::string path, std::string_view text) {
        return write_zip({{"folder/" + path, to_bytes(text)}, {"folder/readme.txt", to_bytes("words")}}, {});
    };
    return {{"a.glb", small_sample(Format::glb)},
            {"a.iobj", to_bytes(iobj)},
            {"a.obj", to_bytes(iobj.substr(11))},
            {"ascii.ply", to_bytes(ascii_ply())},
            {"binary.ply", binary_ply()},
            {"ascii.stl", to_bytes(ascii_stl)},
            {"binary.stl", binary_stl()},
            {"a.zip", zip("a.iobj", iobj)},
            {"gltf.zip", small_sample(Format::gltf)}};
}

class DamagedSamples : public ::testing::TestWithParam<size_t> {};

TEST_P(DamagedSamples, are_read_whole) {
    const Sample sample = samples()[GetParam()];
    const Scene scene = read_asset(upload_of(sample.path, sample.bytes), {}, {}).scene;
    EXPECT_FALSE(scene.meshes.empty());
    EXPECT_TRUE(reads_or_refuses(upload_of(sample.path, sample.bytes)));
}

TEST_P(DamagedSamples, cut_short_are_refused_or_read) {
    const Sample sample = samples()[GetParam()];
    EXPECT_TRUE(survives_truncation(upload_of(sample.path, sample.bytes), 600));
}

TEST_P(DamagedSamples, with_a_byte_changed_are_refused_or_read) {
    const Sample sample = samples()[GetParam()];
    EXPECT_TRUE(survives_mutation(upload_of(sample.path, sample.bytes), 1500, 7, 8192));
}

constexpr std::array names = {"glb",       "iobj",       "obj", "ascii_ply", "binary_ply",
                              "ascii_stl", "binary_stl", "zip", "gltf_zip"};

INSTANTIATE_TEST_SUITE_P(Formats, DamagedSamples, ::testing::Range<size_t>(0, names.size()),
                         [](const auto& sample) { return std::string(names.at(sample.param)); });

}  // namespace
}  // namespace coppice::test
