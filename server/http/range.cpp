#include "server/http/range.h"

#include <algorithm>

#include "core/base/ascii.h"
#include "core/base/error.h"
#include "core/base/number.h"

namespace coppice {

std::optional<ByteRange> parse_range(std::string_view header, uint64_t size_bytes) {
    constexpr std::string_view unit = "bytes=";
    if (!equal_ignoring_case(header.substr(0, unit.size()), unit)) return std::nullopt;
    header.remove_prefix(unit.size());
    require(header.find(',') == std::string_view::npos, ErrorCode::range_not_satisfiable, "Range",
            "one range is sent per request; ask for each by itself");
    const auto dash = header.find('-');
    if (dash == std::string_view::npos) return std::nullopt;
    const auto first = parse_whole_number(header.substr(0, dash));
    const auto last = parse_whole_number(header.substr(dash + 1));
    if ((!first && dash > 0) || (!last && dash + 1 < header.size()) || (!first && !last)) return std::nullopt;
    if (first && last && *last < *first) return std::nullopt;

    const auto satisfiable = [&](bool yes) {
        require(yes, ErrorCode::range_not_satisfiable, "Range", "the range {} lies outside of the {} bytes",
                header, size_bytes);
    };
    if (!first) {  // the last *last bytes
        satisfiable(*last > 0 && size_bytes > 0);
        return ByteRange{size_bytes - std::min(*last, size_bytes), size_bytes - 1};
    }
    satisfiable(*first < size_bytes);
    return ByteRange{*first, std::min(last.value_or(size_bytes - 1), size_bytes - 1)};
}

}  // namespace coppice
