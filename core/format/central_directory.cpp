#include "core/format/central_directory.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/base/error.h"

namespace coppice {

namespace {

constexpr auto malformed = ErrorCode::asset_malformed;
constexpr uint32_t end_signature = 0x06054b50, entry_signature = 0x02014b50, local_signature = 0x04034b50;
constexpr size_t end_size = 22, entry_size = 46, local_size = 30, longest_comment = 0xffff;
constexpr uint32_t in_zip64 = 0xffffffff;  // the value is in the zip64 extra field

struct Extent {
    uint64_t begin = 0, end = 0;
};

size_t find_end_record(ByteView zip) {
    require(zip.size() >= end_size, malformed, "", "the zip archive is cut off: {} bytes", zip.size());
    const size_t last = zip.size() - end_size;
    const size_t first = last > longest_comment ? last - longest_comment : 0;
    for (size_t at = last + 1; at-- > first;) {
        if (load_u32(zip, at) == end_signature) return at;
    }
    fail(malformed, "", "the zip archive has no end record: it is cut off");
}

// The packed size of a zip64 entry stands second in its extra field when the unpacked one is there too.
uint64_t zip64_packed_size(ByteView zip, size_t extra, size_t extra_size, bool after_unpacked) {
    for (size_t at = extra; at + 4 <= extra + extra_size;) {
        const size_t size = load_u16(zip, at + 2);
        const size_t value = at + 4 + (after_unpacked ? 8 : 0);
        if (load_u16(zip, at) == 1 && value + 8 <= std::min(at + 4 + size, extra + extra_size)) {
            return load_u32(zip, value) + (uint64_t{load_u32(zip, value + 4)} << 32);
        }
        at += 4 + size;
    }
    fail(malformed, fmt::format("byte {}", extra), "a zip64 entry of the archive lacks its sizes");
}

// Of one entry's local header, name, extra field and data.
Extent local_extent(ByteView zip, size_t entry, size_t directory) {
    const uint64_t local = load_u32(zip, entry + 42);
    require(local <= directory && directory - local >= local_size && load_u32(zip, local) == local_signature,
            malformed, fmt::format("byte {}", entry),
            "an entry of the zip points to byte {}, where no file is", local);
    uint64_t packed = load_u32(zip, entry + 20);
    if (packed == in_zip64) {
        const size_t extra = entry + entry_size + load_u16(zip, entry + 28);
        packed =
            zip64_packed_size(zip, extra, load_u16(zip, entry + 30), load_u32(zip, entry + 24) == in_zip64);
    }
    const uint64_t data = local + local_size + load_u16(zip, local + 26) + load_u16(zip, local + 28);
    require(data <= directory && packed <= directory - data, malformed, fmt::format("byte {}", local),
            "an entry of the zip runs into its directory");
    return {local, data + packed};
}

}  // namespace

void require_no_overlaps(ByteView zip) {
    const size_t end = find_end_record(zip);
    const size_t count = load_u16(zip, end + 10);
    const size_t directory = load_u32(zip, end + 16);
    require(directory <= end, malformed, fmt::format("byte {}", end),
            "the zip's directory lies behind its end");
    std::vector<Extent> extents;
    for (size_t i = 0, at = directory; i < count; ++i) {
        require(at <= end && end - at >= entry_size && load_u32(zip, at) == entry_signature, malformed,
                fmt::format("byte {}", at), "the zip's directory is cut off after {} of {} entries", i,
                count);
        const size_t size =
            entry_size + load_u16(zip, at + 28) + size_t{load_u16(zip, at + 30)} + load_u16(zip, at + 32);
        require(size <= end - at, malformed, fmt::format("byte {}", at), "entry {} of the zip is cut off", i);
        extents.push_back(local_extent(zip, at, directory));
        at += size;
    }
    std::sort(extents.begin(), extents.end(),
              [](const Extent& a, const Extent& b) { return a.begin < b.begin; });
    for (size_t i = 1; i < extents.size(); ++i) {
        require(extents[i - 1].end <= extents[i].begin, malformed, fmt::format("byte {}", extents[i].begin),
                "entries of the zip overlap at byte {}", extents[i].begin);
    }
}

}  // namespace coppice
