#include "cli/check_count.h"

#include <fmt/format.h>

#include "core/base/number.h"

namespace coppice {

std::string check_count(const std::string& text) {
    if (parse_whole_number(text)) return {};
    return fmt::format("is {}; it takes a whole number of at least 0", text);
}

}  // namespace coppice
