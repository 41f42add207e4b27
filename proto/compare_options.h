// The options of a comparison as they come over the wire.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/compare/options.h"
#include "proto/options.h"

namespace coppice {

// Names as in the contract. Throws option_unknown, option_invalid, option_conflict with where = the option's
// name. The result is validated.
CompareOptions parse_compare_options(const std::vector<std::pair<std::string, std::string>>& pairs);
CompareOptions parse_compare_options_json(std::string_view json);

// Every option, for help texts.
std::vector<OptionDescription> describe_compare_options();

// Canonical JSON: what differs from the defaults, no white space.
std::string print_compare_options(const CompareOptions& options);

}  // namespace coppice
