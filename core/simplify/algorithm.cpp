#include "core/simplify/algorithm.h"

namespace coppice {

std::string_view name(StopReason reason) {
    switch (reason) {
        case StopReason::target:
            return "target";
        case StopReason::error_limit:
            return "error_limit";
        case StopReason::threshold:
            return "threshold";
        case StopReason::topology:
            return "topology";
        case StopReason::bounds:
            return "bounds";
        case StopReason::locked:
            return "locked";
        case StopReason::already_smaller:
            return "already_smaller";
        case StopReason::cancelled:
            return "cancelled";
    }
    return "";
}

}  // namespace coppice
