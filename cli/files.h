// Assets on disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "core/format/asset.h"
#include "core/format/file_source.h"

namespace coppice {

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

// The format that a file's name asks for; none for .zip. Throws option_invalid for a name that no format
// writes.
std::optional<Format> output_format_of(const std::filesystem::path& path);

// Writes the asset. Where it is a zip and the path does not end with .zip, its files are laid out beside the
// path, the asset itself under the path's name. Files appear whole or not at all; one of the zip's other
// files that would replace a different file is refused with storage_failed. Returns how many files were
// written.
size_t write_asset_file(const WrittenAsset& asset, const std::filesystem::path& path);

void write_file(const std::filesystem::path& path, ByteView bytes);

}  // namespace coppice
