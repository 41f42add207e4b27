// Whole optimizations of one scene, bytes to bytes, by the four algorithms of the ITS paper's Table 3.
#pragma once

#include <array>

#include "bench/papers/its_scenes.h"
#include "core/format/asset.h"
#include "core/optimize/report.h"

namespace coppice::papers {

struct SceneRun {
    Report report;
    double simplify_ms = 0, total_ms = 0;  // processor time, medians
};

using SceneRuns = std::array<SceneRun, count_contenders>;

// One thread; in turns, so that whatever else the machine does falls on all alike. quadric and gaps simplify
// a copy for each instance, as in the paper.
SceneRuns run_scene(const Upload& scene, double removed);

}  // namespace coppice::papers
