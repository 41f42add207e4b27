// Bytes to Scene and back: the two functions that everything outside format/ uses.
#pragma once

#include <string>
#include <vector>

#include "core/base/bytes.h"
#include "core/base/watch.h"
#include "core/format/file_source.h"
#include "core/format/format.h"
#include "core/format/limits.h"
#include "core/scene/scene.h"

namespace coppice {

// A file of an upload. Views; the caller keeps the bytes alive until read_asset returns.
struct UploadedFile {
    std::string path;  // as the client named it; may be empty for a raw body
    std::string media_type =
        {};  // empty when not given (see api: octet-stream and the like count as not given)
    ByteView bytes = {};
};

struct Upload {
    UploadedFile asset;  // a model file, or a zip of one with its resources
    std::vector<UploadedFile> resources =
        {};                        // buffers, textures, .mtl: matched by relative path, then base name
    std::string entry = {};        // which file of a zip is the asset, when it holds several
    FileSource* beside = nullptr;  // asked for what is not among the resources; null: nothing else exists
};

struct ReadAsset {
    Scene scene;
    Format format = Format::glb;
};

// Recognises the format (content first, then media type, then file name), resolves resources inside the
// upload alone, checks every bound, and reads. Throws Error with asset_*, resource_* codes and where.
ReadAsset read_asset(const Upload& upload, const ReadLimits& limits, const Watch& watch);

enum class Instancing { automatic, nodes, expand };

struct WriteOptions {
    Format format = Format::glb;
    Instancing instancing = Instancing::automatic;
    std::string base_name = "scene";  // of the files inside a zip
};

struct WrittenAsset {
    Bytes bytes;
    std::string media_type;      // application/zip where files go along
    std::string file_extension;  // "glb", "zip", ...
    std::vector<uint64_t>
        mesh_bytes;                 // per unique mesh: bytes of its stored geometry, for the report's savings
    std::vector<Warning> warnings;  // what the format could not hold
};

// Throws option_conflict where format and instancing exclude each other.
WrittenAsset write_asset(const Scene& scene, const WriteOptions& options, const Watch& watch);

}  // namespace coppice
