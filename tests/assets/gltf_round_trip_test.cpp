// Every glTF among the assets that is read: what coppice does not change is the same after writing and
// reading again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/format/gltf/document.h"
#include "core/format/gltf/gltf.h"
#include "tests/support/test_assets.h"

namespace coppice {

namespace {

using gltf::GltfDocument;
using gltf::Json;

// Refused for what Khronos' validator calls an error, for extensions and versions that are not read, or
// because the file's buffer is not there. All else must be read.
const std::set<std::string> refused = {
    "duplicates/ClearCoatTest/ClearCoatTest.gltf",
    "duplicates/cakeBirthday.glb",
    "features/KHR-meshopt-no-fallback/meshopt-no-fallback.gltf",
    "features/box_sparse.glb",
    "features/gltf-validator/accessor/unknown_type.gltf",
    "features/gltf-validator/asset/min_version_valid.gltf",
    "features/gltf-validator/root/named_objects.gltf",
    "features/gltf-validator/root/unused_objects.gltf",
    "instanced/CubeScaledInstances/cube_att.gltf",
    "instanced/TestScene.gltf",
    "instanced/pins.glb",
};

// Files of importers' tests that break rules on purpose, and ones whose buffer was left out.
bool is_read_at_will(const std::string& file) {
    return file.starts_with("features/gltf-magnum/") || file.starts_with("instanced/3d-tiles-tools/");
}

const GltfDocument& document_of(const Scene& scene) {
    return dynamic_cast<const GltfDocument&>(*scene.source);
}

Json without(Json object, std::initializer_list<const char*> keys) {
    for (const char* key : keys) object.erase(key);
    return object;
}

Json without_extension(Json object, const char* name) {
    if (!object.contains("extensions")) return object;
    object["extensions"].erase(name);
    if (object["extensions"].empty()) object.erase("extensions");
    return object;
}

// Property tables refer to buffer views, which are not the same ones.
Json without_views(Json document) {
    for (Json* tables : {&document["extensions"]["EXT_structural_metadata"]["propertyTables"]})
        if (tables->is_array())
            for (Json& table : *tables)
                for (Json& property : table["properties"])
                    property = without(property, {"values", "arrayOffsets", "stringOffsets"});
    return document;
}

// Indices of accessors replaced by what they hold.
Json resolved(const GltfDocument& document, const Json& index) {
    const auto found = document.accessors.find(index.get<uint32_t>());
    if (found == document.accessors.end()) return "no data";
    const Json& accessor = document.json["accessors"][index.get<size_t>()];
    return {accessor["componentType"], accessor["type"], accessor["count"], sha256_hex(found->second)};
}

Json animations(const GltfDocument& document) {
    Json out = document.json.value("animations", Json::array());
    for (Json& animation : out)
        for (Json& sampler : animation["samplers"])
            for (const char* end : {"input", "output"}) sampler[end] = resolved(document, sampler[end]);
    return out;
}

Json skins(const GltfDocument& document) {
    Json out = document.json.value("skins", Json::array());
    for (Json& skin : out)
        if (skin.contains("inverseBindMatrices"))
            skin["inverseBindMatrices"] = resolved(document, skin["inverseBindMatrices"]);
    return out;
}

Json nodes(const GltfDocument& document) {
    Json out = document.json.value("nodes", Json::array());
    for (Json& node : out) node = without_extension(node, "EXT_mesh_gpu_instancing");
    return out;
}

Json meshes(const GltfDocument& document) {
    Json out = Json::array();
    for (const Json& mesh : document.json.value("meshes", Json::array()))
        out.push_back(without(mesh, {"primitives"}));
    return out;
}

// The corners' positions of every triangle with its material, sorted.
std::vector<std::array<float, 10>> triangles(const Mesh& mesh) {
    std::vector<std::array<float, 10>> out;
    for (size_t t = 0; t < mesh.triangle_count(); ++t) {
        std::array<float, 10> row{};
        const auto& material = mesh.slots[mesh.triangle_slot[t]].material;
        row[9] = material ? static_cast<float>(*material) : -1.0F;
        for (size_t c = 0; c < 3; ++c) {
            const Vec3f p = mesh.positions[mesh.corner_vertex(t, c)];
            row[3 * c] = p.x;
            row[3 * c + 1] = p.y;
            row[3 * c + 2] = p.z;
        }
        out.push_back(row);
    }
    std::sort(out.begin(), out.end());
    return out;
}

void expect_same_documents(const Scene& before, const Scene& after) {
    const GltfDocument& a = document_of(before);
    const GltfDocument& b = document_of(after);
    const auto rest = [](const GltfDocument& d) {
        return without(d.json, {"accessors", "bufferViews", "buffers", "meshes", "nodes", "animations",
                                "skins", "images", "extensionsUsed", "extensionsRequired"});
    };
    EXPECT_EQ(without_views(rest(a)), without_views(rest(b)));
    EXPECT_EQ(nodes(a), nodes(b));
    EXPECT_EQ(animations(a), animations(b));
    EXPECT_EQ(skins(a), skins(b));
    EXPECT_EQ(meshes(a), meshes(b));
    ASSERT_EQ(before.images.size(), after.images.size());
    for (size_t i = 0; i < before.images.size(); ++i) {
        EXPECT_EQ(before.images[i].bytes, after.images[i].bytes);
        EXPECT_EQ(before.images[i].name, after.images[i].name);
    }
}

void expect_same_scenes(const Scene& before, const Scene& after) {
    EXPECT_EQ(before.roots, after.roots);
    ASSERT_EQ(before.nodes.size(), after.nodes.size());
    for (size_t i = 0; i < before.nodes.size(); ++i) {
        EXPECT_EQ(before.nodes[i].mesh, after.nodes[i].mesh);
        EXPECT_EQ(before.nodes[i].batch, after.nodes[i].batch);
        EXPECT_EQ(before.nodes[i].local, after.nodes[i].local);
    }
    ASSERT_EQ(before.meshes.size(), after.meshes.size());
    for (size_t i = 0; i < before.meshes.size(); ++i) {
        EXPECT_EQ(triangles(before.meshes[i]), triangles(after.meshes[i])) << "mesh " << i;
        // A mesh of which no triangle is left has a placeholder.
        if (before.meshes[i].triangle_count() > 0) {
            EXPECT_EQ(before.meshes[i].wedge_count(), after.meshes[i].wedge_count()) << "mesh " << i;
        }
    }
}

void check(const std::string& file) {
    SCOPED_TRACE(file);
    const test::UploadedAsset asset = test::load_asset(file);
    Scene before;
    try {
        before = read_asset(asset.upload(), {}, {}).scene;
    } catch (const Error& error) {
        EXPECT_TRUE(refused.contains(file) || is_read_at_will(file))
            << error.where() << ": " << error.message();
        return;
    }
    EXPECT_FALSE(refused.contains(file)) << "is read now";
    const Bytes glb = write_glb(before, {}, {}).bytes;
    const Scene after = read_gltf(glb, {}, {}, {});
    expect_same_documents(before, after);
    expect_same_scenes(before, after);
    EXPECT_EQ(write_glb(before, {}, {}).bytes, glb);
}

class GltfRoundTrip : public ::testing::TestWithParam<const char*> {};

TEST_P(GltfRoundTrip, keeps_what_it_does_not_change) {
    if (!test::asset_folder()) GTEST_SKIP() << test::no_assets_message();
    for (const std::string& file : test::gltf2_files(GetParam())) check(file);
}

INSTANTIATE_TEST_SUITE_P(Assets, GltfRoundTrip,
                         ::testing::Values("instanced", "textured", "duplicates", "features"),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace

}  // namespace coppice
