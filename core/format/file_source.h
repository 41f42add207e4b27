// Files that are only fetched when an asset names them.
#pragma once

#include <cstdint>
#include <string>

#include "core/base/bytes.h"

namespace coppice {

// A file of an upload. A view; whoever made the Resources keeps the bytes alive.
struct ResourceFile {
    std::string path;  // relative to the upload's root, separated by '/'
    ByteView bytes = {};
};

// The command line's folder is one; the service has none, and takes only what was uploaded.
class FileSource {
  public:
    FileSource() = default;
    FileSource(const FileSource&) = delete;
    FileSource& operator=(const FileSource&) = delete;
    virtual ~FileSource() = default;

    // path: relative to the asset's folder, checked to stay inside it. The file lives as long as the source;
    // null when there is none. Called by one thread at a time.
    virtual const ResourceFile* open(const std::string& path) = 0;

    virtual uint64_t opened_bytes() const = 0;  // of all files that were opened, each once
};

}  // namespace coppice
