// Where an asset goes: which format a file's name asks for, and the files that are written under it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "core/format/asset.h"

namespace coppice {

// The ending decides: .glb, .gltf, .obj and .iobj are what they say, and a .zip holds a gltf with its
// resources unless it is told to hold an obj or iobj. Any other name gets what is told. Throws option_invalid
// for a name that asks for nothing that is written, option_conflict where name and told format contradict
// each other.
Format output_format(const std::filesystem::path& path, std::optional<Format> told);

// The same where nothing can be told.
Format output_format(const std::filesystem::path& path);

// Writes the asset, in the format of output_format(). Under the ending of a format its resources are laid out
// beside it, and all are replaced as one; one of them that would replace a different file is refused with
// storage_failed. A .zip is one, and any other name gets the bytes as they are. Returns how many files were
// written.
size_t write_asset_file(const WrittenAsset& asset, const std::filesystem::path& path);

}  // namespace coppice
