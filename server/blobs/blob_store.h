// Where bytes of assets live: uploads and results, named by the SHA-256 of what they hold. The interface that
// every implementation keeps; tests/server/blob_store_suite.h holds them to it. Thread-safe.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/bytes.h"

namespace coppice {

struct BlobRef {
    std::string sha256;  // 64 lower-case hex digits
    uint64_t bytes = 0;

    friend bool operator==(const BlobRef&, const BlobRef&) = default;
};

// Takes bytes in a stream. What is not committed leaves nothing behind. One thread.
class BlobWriter {
  public:
    BlobWriter() = default;
    virtual ~BlobWriter() = default;
    BlobWriter(const BlobWriter&) = delete;
    BlobWriter& operator=(const BlobWriter&) = delete;

    // Throws storage_full, storage_failed.
    virtual void write(ByteView bytes) = 0;

    // Makes the blob durable and visible, once. It cannot be removed before this writer is destroyed, so that
    // a job that names it can be stored first. Throws storage_full, storage_failed.
    virtual BlobRef commit() = 0;
};

// An open blob stays readable though it is removed. Thread-safe.
class BlobReader {
  public:
    BlobReader() = default;
    virtual ~BlobReader() = default;
    BlobReader(const BlobReader&) = delete;
    BlobReader& operator=(const BlobReader&) = delete;

    virtual uint64_t bytes() const = 0;
    // Fewer bytes than asked for only at the end. Throws storage_failed.
    virtual size_t read(uint64_t offset, std::span<std::byte> into) const = 0;
};

class BlobStore {
  public:
    BlobStore() = default;
    virtual ~BlobStore() = default;
    BlobStore(const BlobStore&) = delete;
    BlobStore& operator=(const BlobStore&) = delete;

    virtual std::unique_ptr<BlobWriter> create() = 0;

    // Null when there is no such blob.
    virtual std::unique_ptr<BlobReader> open(const std::string& sha256) const = 0;

    // Removes the blob unless a writer still holds it or is_needed() says that something refers to it; no
    // blob is committed between that question and the removal. True when it is gone (or was never there).
    virtual bool remove(const std::string& sha256, const std::function<bool()>& is_needed) = 0;

    // Every blob there is, in no order.
    virtual std::vector<std::string> list() const = 0;

    // Writes, reads and removes a probe. Throws storage_full, storage_failed.
    virtual void check_writable() = 0;
};

// The whole blob in memory. Throws storage_failed when there is none.
Bytes load_blob(const BlobStore& blobs, const BlobRef& blob);

}  // namespace coppice
