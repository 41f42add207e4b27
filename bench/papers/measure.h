// What the tables share: medians, processor time, and one simplification of one mesh.
#pragma once

#include <algorithm>
#include <ctime>
#include <functional>
#include <vector>

#include "bench/median.h"
#include "core/simplify/registry.h"

namespace coppice::papers {

constexpr int runs = 5;

// Of this process, over all its threads: other programs on the machine count little.
inline double cpu_now_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

inline double cpu_milliseconds(const std::function<void()>& work) {
    const double before = cpu_now_ms();
    work();
    return cpu_now_ms() - before;
}

inline Simplified simplify(const Algorithm& algorithm, const Mesh& mesh, uint64_t triangles,
                           const std::map<std::string, ParameterValue>& parameters = {}) {
    const ParameterValues values = ParameterValues::parse(algorithm.parameters, parameters);
    const Target target = {.triangles = triangles};
    if (algorithm.simplify_scene == nullptr) return algorithm.simplify(mesh, {}, target, values, {});
    const std::vector<std::vector<Transform>> one = {{Transform{}}};
    const SceneTarget scene = {.triangles = triangles, .of_mesh = {Target{}}};
    return algorithm.simplify_scene(std::span(&mesh, 1), one, scene, values, {}).meshes.front();
}

}  // namespace coppice::papers
