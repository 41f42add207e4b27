#include "cli/write_files.h"

#include <unistd.h>

#include <fstream>
#include <memory>
#include <system_error>

#include "core/base/error.h"

namespace coppice {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_writing(const fs::path& path, const std::string& why) {
    fail(ErrorCode::storage_failed, path.string(),
         fmt::format("{} cannot be written: {}", path.string(), why));
}

bool write_bytes(const fs::path& path, ByteView bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    file.close();
    return !file.fail();
}

// What a link points to in the end, whether that is there or not: as with a shell's >, the link stays and the
// file comes to be where it points.
fs::path target_of(const fs::path& path) {
    constexpr int most_links = 40;  // as in the kernel
    fs::path target = path;
    std::error_code error;
    for (int links = 0; fs::is_symlink(target, error); ++links) {
        if (links == most_links) fail_writing(path, "it is a link that leads back to itself");
        target = target.parent_path() / fs::read_symlink(target, error);
        if (error) fail_writing(path, error.message());
    }
    return target;
}

// A file that is written, and not yet in its place.
class Staged {
  public:
    explicit Staged(const NewFile& file) : file_(file), target_(target_of(file.path)) {
        std::error_code error;
        if (fs::is_directory(file.path, error)) fail_writing(file.path, "a folder has this name");
        replaces_ = fs::is_regular_file(file.path, error) || !fs::exists(file.path, error);
        if (!replaces_) return;  // a device: there is nothing to prepare
        partial_ = target_;
        partial_ += ".partial-" + std::to_string(getpid());
        if (write_bytes(partial_, file.bytes)) return;
        fs::remove(partial_, error);
        fail_writing(file.path, "is its folder there, and is there room?");
    }
    ~Staged() {
        std::error_code ignored;
        if (!partial_.empty()) fs::remove(partial_, ignored);
    }
    Staged(const Staged&) = delete;
    Staged& operator=(const Staged&) = delete;

    void put_in_place() {
        if (!replaces_) {
            if (!write_bytes(file_.path, file_.bytes)) fail_writing(file_.path, "it takes no bytes");
            return;
        }
        std::error_code error;
        fs::rename(partial_, target_, error);
        if (error) fail_writing(file_.path, error.message());
        partial_.clear();
    }

  private:
    const NewFile& file_;
    fs::path target_;   // what a link points to
    fs::path partial_;  // empty: nothing to remove
    bool replaces_ = true;
};

}  // namespace

void write_files(const std::vector<NewFile>& files) {
    std::vector<std::unique_ptr<Staged>> staged;
    for (const NewFile& file : files) staged.push_back(std::make_unique<Staged>(file));
    for (const auto& file : staged) file->put_in_place();
}

void write_file(const fs::path& path, ByteView bytes) {
    write_files({{path, bytes}});
}

}  // namespace coppice
