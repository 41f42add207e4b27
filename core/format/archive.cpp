#include "core/format/archive.h"

#include <sys/stat.h>
#include <zip.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string_view>

#include "core/base/error.h"
#include "core/format/central_directory.h"
#include "core/format/resources.h"

namespace coppice {

namespace {

constexpr auto malformed = ErrorCode::asset_malformed;
constexpr uint64_t always_fine_bytes = 1 << 20;  // a small archive may be as repetitive as it likes
constexpr size_t chunk_bytes = 1 << 20;
constexpr uint16_t first_dos_day = (1 << 5) | 1;  // 1980-01-01, the earliest that zip can say

struct CloseZip {
    void operator()(zip_t* zip) const { zip_discard(zip); }
};
using Zip = std::unique_ptr<zip_t, CloseZip>;

struct CloseFile {
    void operator()(zip_file_t* file) const { zip_fclose(file); }
};
using ZipFile = std::unique_ptr<zip_file_t, CloseFile>;

struct FreeSource {
    void operator()(zip_source_t* source) const { zip_source_free(source); }
};
using ZipSource = std::unique_ptr<zip_source_t, FreeSource>;

struct Entry {
    std::string path;
    uint64_t index = 0;
    uint64_t bytes = 0;
};

std::string said(zip_error_t& error) {
    std::string text = zip_error_strerror(&error);
    zip_error_fini(&error);
    return text;
}

Zip open_zip(ByteView bytes) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    zip_t* zip = source ? zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error) : nullptr;
    if (!zip) {
        if (source) zip_source_free(source);
        fail(malformed, "", "the zip archive cannot be read: " + said(error));
    }
    zip_error_fini(&error);
    return Zip(zip);
}

bool is_folder(std::string_view path) {
    return path.ends_with('/');
}

// What macOS adds beside each file: no part of any asset.
bool is_shadow(std::string_view path) {
    return path.starts_with("__MACOSX/") || path.substr(path.rfind('/') + 1).starts_with("._") ||
           path.ends_with(".DS_Store");
}

void require_regular_file(zip_t* zip, uint64_t index, const std::string& path) {
    zip_uint8_t system = 0;
    zip_uint32_t attributes = 0;
    zip_file_get_external_attributes(zip, index, 0, &system, &attributes);
    if (system != ZIP_OPSYS_UNIX) return;
    const uint32_t type = (attributes >> 16) & S_IFMT;
    require(type == 0 || type == S_IFREG || type == S_IFDIR, ErrorCode::resource_forbidden, path,
            "zip entry \"{}\" is a {}; only plain files are read", path,
            type == S_IFLNK ? "symbolic link" : "special file");
}

Entry checked_entry(zip_t* zip, uint64_t index) {
    zip_stat_t stat;
    zip_stat_init(&stat);
    require(zip_stat_index(zip, index, 0, &stat) == 0 && (stat.valid & ZIP_STAT_NAME), malformed, "",
            "zip entry {} has no readable name", index);
    const std::string path = stat.name;
    constexpr auto needed = ZIP_STAT_SIZE | ZIP_STAT_COMP_METHOD | ZIP_STAT_ENCRYPTION_METHOD;
    require((stat.valid & needed) == needed, malformed, path, "zip entry \"{}\" does not tell its size",
            path);
    require_inside_upload(path, path);
    require_regular_file(zip, index, path);
    require(stat.encryption_method == ZIP_EM_NONE, ErrorCode::asset_unsupported, path,
            "zip entry \"{}\" is encrypted; only plain entries are read", path);
    require(stat.comp_method == ZIP_CM_STORE || stat.comp_method == ZIP_CM_DEFLATE,
            ErrorCode::asset_unsupported, path,
            "zip entry \"{}\" is packed with method {}; only store (0) and deflate (8) are read", path,
            stat.comp_method);
    return {path, index, stat.size};
}

// Every check that needs nothing unpacked.
std::vector<Entry> checked_entries(zip_t* zip, ByteView bytes, const ReadLimits& limits) {
    constexpr auto too_large = ErrorCode::asset_too_large;
    const auto count = static_cast<uint64_t>(zip_get_num_entries(zip, 0));
    require(count <= limits.zip_entries, too_large, "",
            "the zip has {} entries, over the limit zip_entries of {}", count, limits.zip_entries);
    require_no_overlaps(bytes);
    std::vector<Entry> entries;
    std::set<std::string> seen;
    uint64_t total = 0;
    for (uint64_t i = 0; i < count; ++i) {
        Entry entry = checked_entry(zip, i);
        require(seen.insert(entry.path).second, malformed, entry.path, "the zip has \"{}\" twice",
                entry.path);
        require(entry.bytes <= limits.zip_bytes && total + entry.bytes <= limits.zip_bytes, too_large,
                entry.path, "the zip unpacks to over {} bytes, the limit zip_bytes", limits.zip_bytes);
        total += entry.bytes;
        if (!is_folder(entry.path) && !is_shadow(entry.path)) entries.push_back(std::move(entry));
    }
    require(total <= always_fine_bytes || total / limits.zip_ratio <= bytes.size(), too_large, "asset",
            "the zip unpacks from {} to {} bytes, over the limit zip_ratio of {}:1", bytes.size(), total,
            limits.zip_ratio);
    return entries;
}

Bytes unpacked(zip_t* zip, const Entry& entry, const Watch& watch) {
    const ZipFile file(zip_fopen_index(zip, entry.index, 0));
    require(file != nullptr, malformed, entry.path, "zip entry \"{}\" cannot be opened: {}", entry.path,
            zip_strerror(zip));
    Bytes bytes(entry.bytes);
    size_t done = 0;
    std::byte beyond{};
    for (;;) {
        watch.check();
        const bool full = done == bytes.size();
        const zip_int64_t got =
            full ? zip_fread(file.get(), &beyond, 1)
                 : zip_fread(file.get(), bytes.data() + done, std::min(chunk_bytes, bytes.size() - done));
        require(got >= 0, malformed, entry.path, "zip entry \"{}\" does not unpack: {}", entry.path,
                zip_file_strerror(file.get()));
        if (got == 0) break;
        require(!full, malformed, entry.path,
                "zip entry \"{}\" unpacks to more than the {} bytes it declares", entry.path, entry.bytes);
        done += static_cast<size_t>(got);
    }
    require(done == bytes.size(), malformed, entry.path,
            "zip entry \"{}\" unpacks to {} bytes, but declares {}", entry.path, done, entry.bytes);
    return bytes;
}

bool is_packed_already(ByteView bytes) {
    return !image_mime_type(bytes).empty();
}

void add_file(zip_t* zip, const NamedFile& file) {
    zip_source_t* source = zip_source_buffer(zip, file.bytes.data(), file.bytes.size(), 0);
    require(source != nullptr, ErrorCode::internal, file.path, "zip: {}", zip_strerror(zip));
    const zip_int64_t index = zip_file_add(zip, file.path.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
        zip_source_free(source);
        fail(ErrorCode::internal, file.path, fmt::format("zip: {}", zip_strerror(zip)));
    }
    const auto at = static_cast<zip_uint64_t>(index);
    zip_file_set_dostime(zip, at, 0, first_dos_day, 0);
    zip_set_file_compression(zip, at, is_packed_already(file.bytes) ? ZIP_CM_STORE : ZIP_CM_DEFLATE, 0);
}

int is_stopped(zip_t*, void* watch) {
    return static_cast<const Watch*>(watch)->stop.stop_requested() ? 1 : 0;
}

Bytes contents(zip_source_t* source) {
    zip_stat_t stat;
    zip_stat_init(&stat);
    const bool opened = zip_source_stat(source, &stat) == 0 && zip_source_open(source) == 0;
    require(opened, ErrorCode::internal, "", "zip: the written archive cannot be read back");
    Bytes bytes(stat.size);
    const zip_int64_t got = zip_source_read(source, bytes.data(), bytes.size());
    zip_source_close(source);
    require(got == static_cast<zip_int64_t>(bytes.size()), ErrorCode::internal, "",
            "zip: the written archive ends early");
    return bytes;
}

}  // namespace

std::vector<NamedFile> read_zip(ByteView bytes, const ReadLimits& limits, const Watch& watch) {
    const Zip zip = open_zip(bytes);
    const std::vector<Entry> entries = checked_entries(zip.get(), bytes, limits);
    std::vector<NamedFile> files;
    files.reserve(entries.size());
    for (const Entry& entry : entries) files.push_back({entry.path, unpacked(zip.get(), entry, watch)});
    return files;
}

Bytes write_zip(const std::vector<NamedFile>& files, const Watch& watch) {
    zip_error_t error;
    zip_error_init(&error);
    const ZipSource archive(zip_source_buffer_create(nullptr, 0, 0, &error));
    require(archive != nullptr, ErrorCode::internal, "", "zip: {}", said(error));
    zip_source_keep(archive.get());  // one reference is the archive's, one ours
    Zip zip(zip_open_from_source(archive.get(), ZIP_TRUNCATE, &error));
    if (!zip) {
        zip_source_free(archive.get());
        fail(ErrorCode::internal, "", "zip: " + said(error));
    }
    zip_error_fini(&error);
    for (const NamedFile& file : files) add_file(zip.get(), file);
    // Closing is what packs.
    zip_register_cancel_callback_with_state(zip.get(), &is_stopped, nullptr, const_cast<Watch*>(&watch));
    if (zip_close(zip.get()) != 0) {
        watch.check();
        fail(ErrorCode::internal, "", fmt::format("zip: {}", zip_strerror(zip.get())));
    }
    static_cast<void>(zip.release());  // at once: closed is gone
    watch.check();
    return contents(archive.get());
}

}  // namespace coppice
