// Blobs in a directory: FOLDER/blobs/ab/cdef..., written to FOLDER/incoming first, synced, renamed, and the
// directory synced, so that after a power loss a blob is there whole or not at all. One process per folder,
// held by a lock file.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>

#include "core/base/descriptor.h"
#include "server/blobs/blob_store.h"

namespace coppice {

class DiskBlobs final : public BlobStore {
  public:
    // Makes the folder where it is missing, and drops what an earlier process left half-written. Throws
    // storage_failed when it cannot, or when another process holds the folder.
    explicit DiskBlobs(std::filesystem::path folder);

    std::unique_ptr<BlobWriter> create() override;
    std::unique_ptr<BlobReader> open(const std::string& sha256) const override;
    bool remove(const std::string& sha256, const std::function<bool()>& is_needed) override;
    std::vector<std::string> list() const override;
    void check_writable() override;

  private:
    class Writer;

    std::filesystem::path path_of(const std::string& sha256) const;
    void publish(const std::filesystem::path& incoming, const std::string& sha256);
    void release(const std::string& sha256);

    std::filesystem::path folder_;
    Descriptor lock_;
    std::mutex mutex_;  // held over publish and remove, so that neither sees the other half done
    std::map<std::string, int> held_;  // by writers: how many
    uint64_t next_incoming_ = 0;
};

}  // namespace coppice
