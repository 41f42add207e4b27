// What the options mean for each mesh of a scene. For use inside core/optimize.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/optimize/options.h"
#include "core/scene/instance.h"
#include "core/simplify/algorithm.h"

namespace coppice {

// Which instances a scene draws, and of which mesh.
struct Placement {
    std::vector<Instance> instances;              // in scene order
    std::vector<std::vector<Transform>> of_mesh;  // per unique mesh: world transforms, in scene order
    std::vector<double>
        scales;           // per unique mesh: largest factor by which an instance stretches it; 1 if none
    double diagonal = 0;  // of the scene's box; where it draws nothing, of its meshes'

    std::vector<uint64_t> counts() const;  // instances of each unique mesh
};

Placement place(const Scene& scene, const Watch& watch = {});

// The target of each unique mesh. ratio and its default count each mesh's triangles (with stop=vertices: its
// vertices), triangles is split in proportion, error is turned from a fraction of the diagonal into model
// units at the instance that is scaled most.
std::vector<Target> plan_targets(const Scene& scene, const Placement& placement, const Algorithm& algorithm,
                                 const ParameterValues& parameters, const OptimizeOptions& options);

// The same for an algorithm that weighs meshes against each other: ratio counts what the scene draws,
// triangles what it stores.
SceneTarget plan_scene_target(const Scene& scene, const Placement& placement, const Algorithm& algorithm,
                              const OptimizeOptions& options);

// Splits `total` in proportion to `sizes` by largest remainders: parts sum to total, part <= size, and no
// part of a non-empty size is 0, unless total is too small or too large for that. Ties go to the lower index.
std::vector<uint64_t> split_in_proportion(uint64_t total, std::span<const uint64_t> sizes);

// Throws option_invalid for a format that is only read, option_conflict where the format cannot express the
// instancing.
void check_output(Format format, Instancing instancing);

}  // namespace coppice
