#include "server/blobs/blob_store.h"

#include "core/base/error.h"

namespace coppice {

Bytes load_blob(const BlobStore& blobs, const BlobRef& blob) {
    const auto reader = blobs.open(blob.sha256);
    require(reader != nullptr && reader->bytes() == blob.bytes, ErrorCode::storage_failed, "",
            "the stored bytes {} are not there any more", blob.sha256);
    Bytes bytes(static_cast<size_t>(blob.bytes));
    const size_t got = reader->read(0, bytes);
    require(got == bytes.size(), ErrorCode::storage_failed, "", "the stored bytes {} are cut short",
            blob.sha256);
    return bytes;
}

}  // namespace coppice
