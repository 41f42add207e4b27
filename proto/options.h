// Options as they come over the wire: a query string's pairs, the CLI's flags, or a JSON object.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "proto/job.h"

namespace coppice {

// Names as in the contract; parameters.NAME for the algorithm's own. Throws option_unknown, option_invalid,
// option_conflict with where = the option's name. Nothing is silently ignored: an inspection takes the option
// `entry` and no other. The result is validated.
OptimizeOptions parse_options(const std::vector<std::pair<std::string, std::string>>& pairs,
                              JobKind kind = JobKind::optimize);
OptimizeOptions parse_options_json(std::string_view json, JobKind kind = JobKind::optimize);

// Every option but the algorithm's own parameters, for help texts: what it is called and what it takes.
struct OptionDescription {
    std::string_view name;
    std::string_view takes;
};
std::vector<OptionDescription> describe_options();

// Canonical JSON: given options only, sorted, no white space. Equal options print equally; parses back to the
// same.
std::string print_options(const OptimizeOptions& options);

}  // namespace coppice
