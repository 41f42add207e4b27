// Options as they come over the wire: a query string's pairs, the CLI's flags, or a JSON object.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/optimize/options.h"

namespace coppice {

// Names as in the contract; parameters.NAME for the algorithm's own. Throws option_unknown, option_invalid,
// option_conflict with where = the option's name. Nothing is silently ignored. The result is validated.
OptimizeOptions parse_options(const std::vector<std::pair<std::string, std::string>>& pairs);
OptimizeOptions parse_options_json(std::string_view json);

// Canonical JSON: given options only, sorted, no white space. Equal options print equally; parses back to the
// same.
std::string print_options(const OptimizeOptions& options);

}  // namespace coppice
