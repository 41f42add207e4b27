// Assets that are read from disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "core/format/asset.h"
#include "core/format/file_source.h"

namespace coppice {

// None where it is no file that can be read.
std::optional<Bytes> read_file(const std::filesystem::path& path);

// An asset's file, and the folder that its buffers, textures and material files are taken from as it names
// them.
class AssetFile : private FileSource {
  public:
    // Throws request_malformed when the file cannot be read.
    explicit AssetFile(const std::filesystem::path& path);

    // Valid as long as this lives and stays where it is.
    Upload upload();

  private:
    const ResourceFile* open(const std::string& path) override;
    uint64_t opened_bytes() const override;

    std::filesystem::path path_;
    Bytes bytes_;
    struct Opened {
        Bytes bytes;
        ResourceFile file;
    };
    std::map<std::string, Opened> opened_;
};

// What the command line reads is its user's own: far looser than the service's.
ReadLimits generous_limits();

}  // namespace coppice
