// Zip archives, in memory.
#pragma once

#include <string>
#include <vector>

#include "core/base/bytes.h"
#include "core/base/watch.h"
#include "core/format/limits.h"

namespace coppice {

// A file that is written or was unpacked.
struct NamedFile {
    std::string path;  // relative, separated by '/'
    Bytes bytes;
};

// Every file of an archive, in its order; folders are left out. Everything is checked in the central
// directory before anything is unpacked, and again while unpacking: number of entries, unpacked size, ratio,
// paths that leave the archive, links, encryption, overlapping entries, duplicate names. Throws
// asset_malformed, asset_unsupported (encryption, methods other than store and deflate), asset_too_large,
// resource_forbidden.
std::vector<NamedFile> read_zip(ByteView bytes, const ReadLimits& limits, const Watch& watch);

// The same files give the same bytes: no clock, no user. Images are stored, the rest is deflated.
Bytes write_zip(const std::vector<NamedFile>& files, const Watch& watch);

}  // namespace coppice
