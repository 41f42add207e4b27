// The one recipe: bytes -> read -> simplify each unique mesh once -> write -> bytes and a report.
#pragma once

#include "core/optimize/options.h"
#include "core/optimize/report.h"

namespace coppice {

struct Optimized {
    WrittenAsset asset;
    Report report;
};

// Deterministic for any options.threads: same upload, options and engine, same bytes. Throws Error; honours
// watch.stop within 50 ms. Thread-safe.
Optimized optimize(const Upload& upload, const OptimizeOptions& options, const ReadLimits& limits,
                   const Watch& watch);

}  // namespace coppice
