// Files that appear whole or not at all, several of them as one.
#pragma once

#include <filesystem>
#include <vector>

#include "core/base/bytes.h"

namespace coppice {

struct NewFile {
    std::filesystem::path path;
    ByteView bytes;
};

// Writes all of them beside their places, under temporary names, and only then moves each to its place, in
// this order: whatever fails before leaves what was there as it was. A link stays one, also where it points
// to nothing yet; a device or a pipe is written to. Throws storage_failed.
void write_files(const std::vector<NewFile>& files);

void write_file(const std::filesystem::path& path, ByteView bytes);

}  // namespace coppice
