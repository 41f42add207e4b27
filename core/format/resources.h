// The files that came with an asset, and how its URIs find them. Nothing outside the upload is ever reached.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/bytes.h"
#include "core/format/file_source.h"

namespace coppice {

// Remembers what was found, so that it takes one thread at a time.
class Resources {
  public:
    Resources() = default;
    // folder: that of the asset inside the upload ("" at the root, else without a slash at its end); URIs are
    // relative to it.
    // beside: is asked for what the upload itself does not have; may be null.
    explicit Resources(std::vector<ResourceFile> files, std::string folder = {},
                       FileSource* beside = nullptr);

    // The bytes that a URI of the asset names: percent-decoded once, then as path() finds it.
    // where: the place in the asset that holds the URI, for errors.
    // Throws resource_forbidden for URIs that are absolute, climb with "..", hold a backslash, NUL or scheme;
    // resource_missing for what the upload does not have, naming what it has.
    ByteView find(std::string_view uri, std::string_view where) const;

    // The same for a plain path, which is not percent-decoded. Null when the upload has no such file: first
    // the exact path relative to the asset's folder, then to the upload's root, then the base name if it is
    // unique. Throws resource_forbidden as find does.
    const ResourceFile* find_path(std::string_view path, std::string_view where) const;

    // "; the upload has a.png, b.bin and 3 more", for messages.
    std::string listing() const;

    const std::vector<ResourceFile>& files() const { return files_; }
    bool was_found(size_t file) const { return found_[file]; }  // by the asset, under any of its URIs

  private:
    const ResourceFile* find_own(const std::string& wanted, const std::string& from_root) const;

    std::vector<ResourceFile> files_;
    mutable std::vector<bool> found_;
    std::string folder_;
    FileSource* beside_ = nullptr;
};

// %41 -> A, once. Throws resource_forbidden on a malformed escape.
std::string percent_decoded(std::string_view uri, std::string_view where);

// Throws resource_forbidden unless the path is relative and stays inside: no scheme, no leading slash, no
// "..", no backslash, no NUL.
void require_inside_upload(std::string_view path, std::string_view where);

// By the first bytes; empty when it is none of png, jpeg, webp, ktx2, gif, bmp, dds.
std::string_view image_mime_type(ByteView bytes);

}  // namespace coppice
