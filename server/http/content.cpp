#include "server/http/content.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

#include "core/base/bytes.h"

namespace coppice {
namespace {

std::span<std::byte> at_most(std::span<std::byte> into, uint64_t bytes) {
    return into.first(static_cast<size_t>(std::min<uint64_t>(into.size(), bytes)));
}

}  // namespace

Content content_of(std::string text) {
    const auto kept = std::make_shared<const std::string>(std::move(text));
    return {kept->size(), [kept](uint64_t offset, std::span<std::byte> into) {
                const ByteView rest = as_bytes(*kept).subspan(std::min<uint64_t>(offset, kept->size()));
                const auto filled = at_most(into, rest.size());
                std::copy_n(rest.begin(), filled.size(), filled.begin());
                return filled.size();
            }};
}

Content part_of(Content whole, const ByteRange& range) {
    return {range.bytes(), [read = std::move(whole.read), range](uint64_t offset, std::span<std::byte> into) {
                const uint64_t left = range.bytes() - std::min(offset, range.bytes());
                return read(range.first + offset, at_most(into, left));
            }};
}

Content join(std::vector<Content> pieces) {
    const uint64_t bytes =
        std::accumulate(pieces.begin(), pieces.end(), uint64_t{0},
                        [](uint64_t sum, const Content& piece) { return sum + piece.bytes; });
    return {bytes, [kept = std::move(pieces)](uint64_t offset, std::span<std::byte> into) {
                size_t filled = 0;
                for (const Content& piece : kept) {
                    if (offset < piece.bytes && filled < into.size()) {
                        const auto wanted = at_most(into.subspan(filled), piece.bytes - offset);
                        const size_t got = piece.read(offset, wanted);
                        filled += got;
                        if (got < wanted.size()) break;  // it is shorter than it said
                        offset += got;
                    }
                    offset -= std::min(offset, piece.bytes);
                }
                return filled;
            }};
}

}  // namespace coppice
