#include "server/blobs/disk_blobs.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "core/base/error.h"
#include "core/base/hash.h"

namespace coppice {
namespace {

[[noreturn]] void fail_with_errno(std::string_view what) {
    const int number = errno;
    const bool full = number == ENOSPC || number == EDQUOT;
    fail(full ? ErrorCode::storage_full : ErrorCode::storage_failed, "",
         fmt::format("cannot {}: {}", what, std::generic_category().message(number)));
}

Descriptor open_file(const std::filesystem::path& path, int flags, std::string_view what) {
    Descriptor file(::open(path.c_str(), flags | O_CLOEXEC, 0600));
    if (!file.is_open()) fail_with_errno(what);
    return file;
}

void sync(const Descriptor& file) {
    if (::fsync(file.number()) != 0) fail_with_errno("sync the stored bytes");
}

void sync_folder(const std::filesystem::path& folder) {
    sync(open_file(folder, O_RDONLY | O_DIRECTORY, "open the data directory"));
}

// What is new in a folder that cannot be synced is taken back: else the next who finds it would take it for
// safe.
template <typename TakeBack>
void sync_folder_or(const std::filesystem::path& folder, const TakeBack& take_back) {
    try {
        sync_folder(folder);
    } catch (...) {
        take_back();
        throw;
    }
}

bool is_blob_name(std::string_view name) {
    return name.size() == 64 && std::all_of(name.begin(), name.end(), [](char c) {
               return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
           });
}

class DiskReader final : public BlobReader {
  public:
    DiskReader(Descriptor file, uint64_t bytes) : file_(std::move(file)), bytes_(bytes) {}

    uint64_t bytes() const override { return bytes_; }

    size_t read(uint64_t offset, std::span<std::byte> into) const override {
        size_t filled = 0;
        while (filled < into.size()) {
            const ssize_t got = ::pread(file_.number(), into.data() + filled, into.size() - filled,
                                        static_cast<off_t>(offset + filled));
            if (got == 0) break;
            if (got < 0 && errno == EINTR) continue;
            if (got < 0) fail_with_errno("read the stored bytes");
            filled += static_cast<size_t>(got);
        }
        return filled;
    }

  private:
    Descriptor file_;
    uint64_t bytes_;
};

}  // namespace

class DiskBlobs::Writer final : public BlobWriter {
  public:
    Writer(DiskBlobs& store, std::filesystem::path incoming)
        : store_(store),
          incoming_(std::move(incoming)),
          file_(open_file(incoming_, O_WRONLY | O_CREAT | O_EXCL, "store the bytes")) {}

    ~Writer() override {
        if (!committed_.empty()) store_.release(committed_);
        ::unlink(incoming_.c_str());  // where it was not renamed
    }

    void write(ByteView bytes) override {
        hash_.update(bytes);
        written_ += bytes.size();
        while (!bytes.empty()) {
            const ssize_t put = ::write(file_.number(), bytes.data(), bytes.size());
            if (put < 0 && errno == EINTR) continue;
            if (put < 0) fail_with_errno("store the bytes");
            bytes = bytes.subspan(static_cast<size_t>(put));
        }
    }

    BlobRef commit() override {
        sync(file_);
        const std::string sha256 = hash_.finish_hex();
        store_.publish(incoming_, sha256);
        committed_ = sha256;
        file_ = Descriptor();  // a form may hold hundreds of committed writers
        return {sha256, written_};
    }

  private:
    DiskBlobs& store_;
    std::filesystem::path incoming_;
    Descriptor file_;
    Sha256 hash_;
    uint64_t written_ = 0;
    std::string committed_;
};

namespace {

// Files only, and only those named by a number, as create() names them: the folder may be somebody's own by
// mistake.
void drop_half_written(const std::filesystem::path& incoming) {
    for (const auto& entry : std::filesystem::directory_iterator(incoming)) {
        const std::string file = entry.path().filename().string();
        const bool is_number = file.find_first_not_of("0123456789") == std::string::npos;
        if (is_number && entry.is_regular_file()) std::filesystem::remove(entry.path());
    }
}

}  // namespace

DiskBlobs::DiskBlobs(std::filesystem::path folder) : folder_(std::move(folder)) {
    try {
        std::filesystem::create_directories(folder_ / "blobs");
        lock_ = open_file(folder_ / "lock", O_RDWR | O_CREAT, "open the lock of the data directory");
        require(::flock(lock_.number(), LOCK_EX | LOCK_NB) == 0, ErrorCode::storage_failed, "data",
                "the data directory {} is used by another process", folder_.string());
        std::filesystem::create_directories(folder_ / "incoming");
        drop_half_written(folder_ / "incoming");
    } catch (const std::filesystem::filesystem_error& error) {
        fail(
            ErrorCode::storage_failed, "data",
            fmt::format("cannot use {} as the data directory: {}", folder_.string(), error.code().message()));
    }
}

std::filesystem::path DiskBlobs::path_of(const std::string& sha256) const {
    return folder_ / "blobs" / sha256.substr(0, 2) / sha256.substr(2);
}

std::unique_ptr<BlobWriter> DiskBlobs::create() {
    uint64_t number = 0;
    {
        const std::scoped_lock lock(mutex_);
        number = next_incoming_++;
    }
    return std::make_unique<Writer>(*this, folder_ / "incoming" / std::to_string(number));
}

void DiskBlobs::publish(const std::filesystem::path& incoming, const std::string& sha256) {
    const std::scoped_lock lock(mutex_);
    const auto path = path_of(sha256);
    if (::access(path.c_str(), F_OK) != 0) {
        if (::mkdir(path.parent_path().c_str(), 0700) == 0) {
            sync_folder_or(folder_ / "blobs", [&] { ::rmdir(path.parent_path().c_str()); });
        } else if (errno != EEXIST) {
            fail_with_errno("make a folder for the stored bytes");
        }
        if (::rename(incoming.c_str(), path.c_str()) != 0) fail_with_errno("store the bytes");
        sync_folder_or(path.parent_path(), [&] { ::unlink(path.c_str()); });
    }
    ++held_[sha256];
}

void DiskBlobs::release(const std::string& sha256) {
    const std::scoped_lock lock(mutex_);
    if (--held_[sha256] == 0) held_.erase(sha256);
}

std::unique_ptr<BlobReader> DiskBlobs::open(const std::string& sha256) const {
    if (!is_blob_name(sha256)) return nullptr;
    Descriptor file(::open(path_of(sha256).c_str(), O_RDONLY | O_CLOEXEC));
    if (!file.is_open() && errno == ENOENT) return nullptr;
    struct stat status {};
    if (!file.is_open() || ::fstat(file.number(), &status) != 0) fail_with_errno("open the stored bytes");
    return std::make_unique<DiskReader>(std::move(file), static_cast<uint64_t>(status.st_size));
}

bool DiskBlobs::remove(const std::string& sha256, const std::function<bool()>& is_needed) {
    if (!is_blob_name(sha256)) return true;
    const std::scoped_lock lock(mutex_);
    if (held_.contains(sha256) || is_needed()) return false;
    if (::unlink(path_of(sha256).c_str()) != 0 && errno != ENOENT) fail_with_errno("remove the stored bytes");
    return true;
}

std::vector<std::string> DiskBlobs::list() const {
    std::vector<std::string> names;
    std::error_code error;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / "blobs", error)) {
        std::string name = entry.path().parent_path().filename().string() + entry.path().filename().string();
        if (is_blob_name(name)) names.push_back(std::move(name));
    }
    return names;
}

void DiskBlobs::check_writable() {
    const auto probe = folder_ / "incoming" / "probe";
    const std::scoped_lock lock(mutex_);
    const Descriptor file = open_file(probe, O_WRONLY | O_CREAT | O_TRUNC, "write to the data directory");
    const ssize_t put = ::write(file.number(), "probe", 5);
    const int write_error = errno;
    ::unlink(probe.c_str());
    errno = write_error;
    if (put != 5) fail_with_errno("write to the data directory");
}

}  // namespace coppice
