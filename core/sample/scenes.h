// The samples, and how they put things into a scene. For use inside core/sample.
#pragma once

#include <optional>
#include <string>

#include "core/sample/sample.h"

namespace coppice {

// Options with the sample's defaults and scale applied.
struct SampleSize {
    uint64_t seed = 1;
    uint32_t copies = 1;
    uint32_t triangles = 100;
};

Scene make_forest(const SampleSize& size);
Scene make_city(const SampleSize& size);
Scene make_bunny(const SampleSize& size);
Scene make_baked(const SampleSize& size);
Scene make_cad(const SampleSize& size);

// One mesh that looks like the whole scene; materials become slots, instances are baked.
Scene join(const Scene& scene);

uint32_t add_mesh(Scene& scene, Mesh mesh);  // -> its index
// -> the node's index; without a parent it becomes a root.
uint32_t add_node(Scene& scene, std::string name, const Transform& local, std::optional<uint32_t> mesh = {},
                  std::optional<uint32_t> parent = {});

// From z up, as the samples are drawn, to y up, as glTF has it and viewers of OBJ take it.
void turn_y_up(Scene& scene);

Transform translation(Vec3d by);
Transform scaling(Vec3d by);
Transform rotation(Vec3d axis, double radians);  // axis of unit length

}  // namespace coppice
