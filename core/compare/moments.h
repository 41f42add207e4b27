// Sums over samples of a surface, from which mean, root mean square, largest value and percentile are read.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace coppice {

// How much a surface counts where it stands several times, and is scaled there. Sums over the instances; see
// instance_weight().
struct InstanceWeight {
    double area = 1;                // of their share of the area
    double area_scale = 1;          // of area times scale
    double area_squared_scale = 1;  // of area times squared scale
    double largest_scale = 1;
};

struct Moments {
    double weight = 0;  // of all samples: area
    double sum = 0, squared_sum = 0;
    double largest = 0;

    void add(double value, double with_weight) {
        weight += with_weight;
        sum += with_weight * value;
        squared_sum += with_weight * value * value;
        if (value > largest) largest = value;
    }
    void add_largest(double value) {
        if (value > largest) largest = value;
    }
    void add(const Moments& other) { add_scaled(other, {}); }
    // Values that grow with the instances' scale: lengths.
    void add_scaled(const Moments& other, const InstanceWeight& by) {
        weight += by.area * other.weight;
        sum += by.area_scale * other.sum;
        squared_sum += by.area_squared_scale * other.squared_sum;
        add_largest(by.largest_scale * other.largest);
    }
    // Values that do not: angles, colours.
    void add_unscaled(const Moments& other, const InstanceWeight& by) {
        add_scaled(other, {by.area, by.area, by.area, 1});
    }

    bool empty() const { return !(weight > 0); }
    double mean() const { return empty() ? 0 : sum / weight; }
    double root_mean_square() const { return empty() ? 0 : std::sqrt(squared_sum / weight); }
};

// Angles of 0 to 180 degrees.
class Angles {
  public:
    void add(double degrees, double weight);
    void add(const Angles& other, const InstanceWeight& by = {});

    bool empty() const { return moments_.empty(); }
    double mean() const { return moments_.mean(); }
    double largest() const { return moments_.largest; }
    // The angle that `fraction` of the surface does not exceed, rounded up to a twentieth of a degree, but
    // never over the largest.
    double percentile(double fraction) const;

  private:
    static constexpr size_t bins_per_degree = 20;

    Moments moments_;
    std::vector<double> bins_;  // weight by angle; empty until something was added
};

}  // namespace coppice
