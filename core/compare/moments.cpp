#include "core/compare/moments.h"

#include <algorithm>

namespace coppice {

void Angles::add(double degrees, double weight) {
    moments_.add(degrees, weight);
    bins_.resize(180 * bins_per_degree + 1);
    const double bin = std::ceil(degrees * static_cast<double>(bins_per_degree));
    bins_[std::min(static_cast<size_t>(bin), bins_.size() - 1)] += weight;
}

void Angles::add(const Angles& other, const InstanceWeight& by) {
    moments_.add_unscaled(other.moments_, by);
    if (other.bins_.empty()) return;
    bins_.resize(other.bins_.size());
    for (size_t i = 0; i < bins_.size(); ++i) bins_[i] += by.area * other.bins_[i];
}

double Angles::percentile(double fraction) const {
    double total = 0;
    for (const double weight : bins_) total += weight;
    double sum = 0;
    for (size_t i = 0; i < bins_.size(); ++i) {
        sum += bins_[i];
        if (sum >= fraction * total)
            return std::min(static_cast<double>(i) / static_cast<double>(bins_per_degree), largest());
    }
    return largest();
}

}  // namespace coppice
