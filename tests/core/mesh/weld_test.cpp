#include "core/mesh/weld.h"

#include <gmock/gmock.h>

#include "core/base/error.h"

namespace coppice {
namespace {

using testing::ElementsAre;

// Two triangles of a unit square as a file without indices stores them: six vertices, each with its own
// wedge.
Mesh unindexed_square() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.wedge_vertex = {0, 1, 2, 3, 4, 5};
    mesh.triangles = {0, 1, 2, 3, 4, 5};
    mesh.triangle_slot = {0, 0};
    mesh.slots.resize(1);
    return mesh;
}

TEST(Weld, merges_equal_positions_and_their_equal_wedges) {
    Mesh mesh = unindexed_square();
    weld(mesh);
    EXPECT_TRUE(is_consistent(mesh));
    EXPECT_EQ(mesh.vertex_count(), 4);
    EXPECT_THAT(mesh.triangles, ElementsAre(0, 1, 2, 0, 2, 3));
}

TEST(Weld, keeps_apart_what_slots_with_other_attributes_use) {
    Mesh mesh;
    constexpr uint32_t slots = 16;
    constexpr size_t bits = 3;
    mesh.attributes.assign(bits, {.name = "_A", .components = 1, .values = std::vector<float>(3 * slots)});
    for (uint32_t s = 0; s < slots; ++s) {
        for (const float x : {0.0F, 1.0F, 2.0F}) mesh.positions.push_back({x, 0, x * x});
        for (uint32_t c = 0; c < 3; ++c) {
            mesh.wedge_vertex.push_back(3 * s + c);
            mesh.triangles.push_back(3 * s + c);
        }
        mesh.triangle_slot.push_back(s);
        mesh.slots.emplace_back();
        for (size_t bit = 0; bit < bits; ++bit) mesh.slots[s].has_attribute.push_back((s >> bit & 1) != 0);
    }
    weld(mesh);
    EXPECT_EQ(mesh.vertex_count(), 3U);
    EXPECT_EQ(mesh.wedge_count(), 3U << bits);  // each set of attributes has two slots, which share
}

TEST(Weld, takes_minus_zero_for_zero) {
    Mesh mesh = unindexed_square();
    mesh.positions[3] = {-0.0F, 0, -0.0F};
    weld(mesh);
    EXPECT_EQ(mesh.vertex_count(), 4);
}

TEST(Weld, keeps_wedges_apart_whose_texture_coordinates_differ) {
    Mesh mesh = unindexed_square();
    mesh.attributes = {
        {.name = "TEXCOORD_0", .components = 2, .values = {0, 0, 1, 0, 1, 1, .5F, 0, 1, 1, 0, 1}}};
    weld(mesh);
    EXPECT_EQ(mesh.vertex_count(), 4);
    EXPECT_EQ(mesh.wedge_count(), 5) << "the corner at the origin has two texture coordinates";
    EXPECT_THAT(mesh.triangles, ElementsAre(0, 1, 2, 3, 2, 4));
}

TEST(Weld, keeps_wedges_apart_whose_morph_deltas_differ) {
    Mesh mesh = unindexed_square();
    Attribute delta = {.name = "POSITION", .components = 3, .values = std::vector<float>(18, 0)};
    delta.values[9] = 1;  // the second use of the origin moves, the first does not
    mesh.morph_targets = {{.deltas = {delta}}};
    weld(mesh);
    EXPECT_EQ(mesh.wedge_count(), 5);
}

TEST(Weld, keeps_wedges_apart_whose_slots_have_other_attributes) {
    Mesh mesh = unindexed_square();
    mesh.attributes = {{.name = "TEXCOORD_0", .components = 2, .values = std::vector<float>(12, 0)}};
    mesh.slots = {{.has_attribute = {true}}, {.has_attribute = {false}}};
    mesh.triangle_slot = {0, 1};
    weld(mesh);
    EXPECT_EQ(mesh.vertex_count(), 4);
    EXPECT_EQ(mesh.wedge_count(), 6)
        << "zeros that are values and zeros that stand for nothing are not the same";
}

TEST(Weld, merges_wedges_of_slots_that_have_all_attributes_however_they_say_so) {
    Mesh mesh = unindexed_square();
    mesh.attributes = {{.name = "TEXCOORD_0", .components = 2, .values = std::vector<float>(12, 0)}};
    mesh.slots = {{}, {.has_attribute = {true}}};
    mesh.triangle_slot = {0, 1};
    weld(mesh);
    EXPECT_EQ(mesh.wedge_count(), 4);
}

TEST(DropUnused, leaves_only_what_triangles_use) {
    Mesh mesh = unindexed_square();
    mesh.attributes = {{.name = "COLOR_0", .components = 1, .values = {0, 1, 2, 3, 4, 5}}};
    mesh.triangles = {3, 4, 5};
    mesh.triangle_slot = {0};
    drop_unused(mesh);
    EXPECT_TRUE(is_consistent(mesh));
    EXPECT_EQ(mesh.vertex_count(), 3);
    EXPECT_THAT(mesh.triangles, ElementsAre(0, 1, 2));
    EXPECT_THAT(mesh.attributes[0].values, ElementsAre(3, 4, 5));
}

TEST(DropDegenerateAndDuplicate, removes_both_and_counts_them) {
    Mesh mesh = unindexed_square();
    weld(mesh);
    mesh.positions.push_back({0.5F, 0, 0});  // on the edge between vertices 0 and 1
    mesh.wedge_vertex.push_back(4);
    mesh.triangles = {0, 1, 2, 0, 0, 1, /* a rotation of the first: */ 1, 2, 0, /* zero area: */ 0,
                      4, 1, 0, 2, 3};
    mesh.triangle_slot = {0, 0, 0, 0, 0};
    const CleanedTriangles cleaned = drop_degenerate_and_duplicate(mesh);
    EXPECT_EQ(cleaned.degenerate, 2);
    EXPECT_EQ(cleaned.duplicate, 1);
    EXPECT_THAT(mesh.triangles, ElementsAre(0, 1, 2, 0, 2, 3));
}

TEST(DropDegenerateAndDuplicate, keeps_the_back_side_of_a_double_sided_triangle) {
    Mesh mesh = unindexed_square();
    weld(mesh);
    mesh.triangles = {0, 1, 2, 2, 1, 0};
    EXPECT_EQ(drop_degenerate_and_duplicate(mesh).duplicate, 0);
}

// A triangle, and what lies on the same three vertices.
Mesh two_on_each_other() {
    Mesh mesh = unindexed_square();
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
    return mesh;
}

TEST(DropDegenerateAndDuplicate, keeps_a_decal_of_another_material) {
    Mesh mesh = two_on_each_other();
    mesh.slots.resize(2);
    mesh.triangle_slot = {0, 1};
    weld(mesh);
    EXPECT_EQ(drop_degenerate_and_duplicate(mesh).duplicate, 0);
    EXPECT_EQ(mesh.triangle_count(), 2);
}

TEST(DropDegenerateAndDuplicate, keeps_a_second_triangle_that_has_other_attributes) {
    Mesh mesh = two_on_each_other();
    mesh.attributes = {
        {.name = "TEXCOORD_0", .components = 2, .values = {0, 0, 1, 0, 1, 1, 0, 0, 1, 0, 1, .5F}}};
    weld(mesh);
    EXPECT_EQ(drop_degenerate_and_duplicate(mesh).duplicate, 0);
    mesh.attributes[0].values[7] = 1;  // of the wedge that differed
    weld(mesh);
    EXPECT_EQ(drop_degenerate_and_duplicate(mesh).duplicate, 1);
}

TEST(DropDegenerateAndDuplicate, keeps_what_is_flat_until_a_morph_target_opens_it) {
    Mesh mesh = unindexed_square();
    for (Vec3f& p : mesh.positions) p.y = 0;
    mesh.positions[1].x = 0.5F;
    mesh.positions[5].x = 0.5F;
    Attribute delta = {.name = "POSITION", .components = 3, .values = std::vector<float>(18, 0)};
    delta.values[3 * 1 + 1] = 1;  // lifts the middle corner of the first triangle
    mesh.morph_targets = {{.deltas = {delta}}};
    weld(mesh);
    const CleanedTriangles cleaned = drop_degenerate_and_duplicate(mesh);
    EXPECT_EQ(cleaned.degenerate, 1) << "the second stays flat";
    EXPECT_EQ(mesh.triangle_count(), 1);
    EXPECT_FLOAT_EQ(mesh.morph_targets[0].deltas[0].values[3 * mesh.triangles[1] + 1], 1);
}

TEST(Weld, and_what_cleans_after_it_stop_when_they_are_told_to) {
    std::stop_source stop;
    stop.request_stop();
    const Watch stopped = {.stop = stop.get_token()};
    Mesh mesh = unindexed_square();
    EXPECT_THROW(weld(mesh, stopped), Error);
    EXPECT_THROW(drop_unused(mesh, stopped), Error);
    EXPECT_THROW(drop_degenerate_and_duplicate(mesh, stopped), Error);
}

}  // namespace
}  // namespace coppice
