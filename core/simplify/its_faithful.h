// The order in which mode=faithful of ITS collapses edges.
#pragma once

#include <optional>

#include "core/base/watch.h"
#include "core/simplify/edge_collapse.h"

namespace coppice {

// Least unified error among the few edges under the paper's threshold, until the collapse is done, or nothing
// is left to collapse. first_threshold: in mesh units, > 0; unset: a quarter of the mean edge.
void collapse_under_threshold(EdgeCollapse& work, std::optional<double> first_threshold, const Watch& watch);

}  // namespace coppice
