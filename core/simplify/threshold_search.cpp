#include "core/simplify/threshold_search.h"

#include <algorithm>

namespace coppice {

ThresholdFound search_threshold(const ThresholdSearch& search, const std::function<double(double)>& count) {
    double low = search.least, high = search.most;
    double at_high = count(high);
    if (at_high > search.target) return {high, at_high, false};
    double at_low = std::max(count(low), search.target);
    for (uint32_t run = 2; run < search.runs && at_high < search.target * (1 - search.tolerance); ++run) {
        // By interpolation, which needs few runs where the count is smooth; every third time the middle,
        // which needs not many where it is not.
        const double part = (at_low - search.target * (1 - search.tolerance / 2)) / (at_low - at_high);
        const double middle = low + (high - low) * (run % 3 == 2 ? 0.5 : std::clamp(part, 0.02, 0.98));
        if (!(middle > low && middle < high)) break;
        const double at_middle = count(middle);
        if (at_middle <= search.target) {
            high = middle, at_high = at_middle;
        } else {
            low = middle, at_low = at_middle;
        }
    }
    return {high, at_high, true};
}

}  // namespace coppice
