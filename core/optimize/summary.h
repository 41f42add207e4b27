// Counts and sizes for reports. For use inside core/optimize.
#pragma once

#include <span>
#include <vector>

#include "core/format/asset.h"
#include "core/optimize/report.h"

namespace coppice {

// Of the asset and its resources; of the files beside it those that were read.
uint64_t bytes_of(const Upload& upload);

std::vector<uint64_t> instances_per_mesh(const Scene& scene, const Watch& watch = {});

// How many copies of its mesh a file holds: glTF every mesh once, instanced OBJ only those that stand
// somewhere, plain OBJ one per instance.
uint64_t stored_copies(Format format, uint64_t instances);

AssetSummary summarize(const Scene& scene, std::span<const uint64_t> instances_of_mesh, Format format,
                       uint64_t bytes);

// What instancing saves is computed from the bytes that each mesh's geometry takes in the file, once for each
// further instance; writing the expanded file to measure it would cost more than it tells.
Savings savings(uint64_t input_bytes, uint64_t output_bytes, std::span<const uint64_t> mesh_bytes,
                std::span<const uint64_t> instances_of_mesh);

}  // namespace coppice
