#include "proto/unknown_option.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <string>

#include "core/base/error.h"

namespace coppice {
namespace {

// Options that the contract foresees, so that nobody looks for a spelling mistake.
constexpr auto planned = std::to_array<std::string_view>({
    "budget",
    "objective",
    "discover_tolerance",
    "discover_parts",
    "view",
    "visibility",
    "preset",
    "compression",
    "quantize",
    "texture_size",
    "texture_format",
    "lods",
    "max_bytes",
    "delivery",
    "webhook",
    "source_url",
    "result_url",
});

// Levenshtein: how many letters must be changed, added or dropped.
size_t distance(std::string_view a, std::string_view b) {
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 0; i < a.size(); ++i) {
        size_t diagonal = row[0];
        row[0] = i + 1;
        for (size_t j = 0; j < b.size(); ++j) {
            const size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

std::string_view nearest(std::string_view name, const std::vector<std::string_view>& known) {
    std::string_view best;
    size_t best_distance = std::max<size_t>(2, name.size() / 3) + 1;
    for (const std::string_view candidate : known) {
        const size_t candidate_distance = distance(name, candidate);
        if (candidate_distance >= best_distance) continue;
        best = candidate;
        best_distance = candidate_distance;
    }
    return best;
}

std::string hint(std::string_view name, const std::vector<std::string_view>& known) {
    const std::string_view bare = name.substr(std::min(name.find_first_not_of('-'), name.size()));
    if (std::find(planned.begin(), planned.end(), bare) != planned.end()) return " in this version";
    const std::string_view meant = nearest(name, known);
    return meant.empty() ? std::string() : fmt::format("; did you mean {}?", meant);
}

}  // namespace

void fail_unknown_option(std::string_view name, const std::vector<std::string_view>& known) {
    constexpr size_t longest = 64;  // of any option; a longer name is cut, and not compared
    const std::string_view shown = name.empty() ? "\"\"" : name.substr(0, longest);
    fail(ErrorCode::option_unknown, std::string(name.substr(0, longest)),
         fmt::format("{} is not an option{} (options are {})", shown, hint(shown, known),
                     fmt::join(known, ", ")));
}

}  // namespace coppice
