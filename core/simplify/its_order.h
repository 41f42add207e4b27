// The two orders in which ITS collapses edges. Both run until the collapse is done, or nothing is left to
// collapse.
#pragma once

#include <optional>

#include "core/base/watch.h"
#include "core/simplify/end_point_collapse.h"

namespace coppice {

// All edges, least unified error first.
void collapse_cheapest_first(EndPointCollapse& work, const Watch& watch);

// Least unified error among the few edges under the paper's threshold. first_threshold: in mesh units, > 0;
// unset: a quarter of the mean edge.
void collapse_under_threshold(EndPointCollapse& work, std::optional<double> first_threshold,
                              const Watch& watch);

}  // namespace coppice
