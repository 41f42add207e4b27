// Two assets, and how far the one is from the other.
#pragma once

#include "core/compare/compare_scenes.h"
#include "core/format/asset.h"
#include "core/optimize/report.h"

namespace coppice {

struct Comparison {
    AssetSummary reference, candidate;
    SceneComparison scenes;
    // What reading the assets repaired; `where` begins with "reference" or "candidate". Degenerate and
    // duplicate triangles that were dropped are in the elements of `scenes`, as if they were still there.
    std::vector<Warning> warnings;
};

// Reads both and compares them. Formats and instancing may differ. Throws Error, whose message says of which
// asset it speaks. Deterministic for any options.threads; honours watch.stop within 50 ms. Thread-safe.
Comparison compare(const Upload& reference, const Upload& candidate, const CompareOptions& options,
                   const ReadLimits& limits, const Watch& watch);

}  // namespace coppice
