#include "core/simplify/circumcentre.h"

#include <algorithm>

namespace coppice {

WeighedPoint circumcentre(Vec3d a, Vec3d b, Vec3d c, Circumcentre mode) {
    const std::array<Vec3d, 3> corners = {a, b, c};
    // Squared edges opposite to each corner; barycentric weights of the centre are a^2 (b^2 + c^2 - a^2).
    const std::array<double, 3> edge = {squared_length(c - b), squared_length(a - c), squared_length(b - a)};
    const auto longest = static_cast<size_t>(std::max_element(edge.begin(), edge.end()) - edge.begin());
    std::array<double, 3> weights = {};
    double sum = 0;
    for (size_t k = 0; k < 3; ++k) {
        weights[k] = edge[k] * (edge[(k + 1) % 3] + edge[(k + 2) % 3] - edge[k]);
        sum += weights[k];
    }
    const double flat = 1e-12 * edge[longest] * edge[longest];  // sum is 16 squared areas
    const bool outside = weights[longest] < 0 || !(sum > flat);
    WeighedPoint result;
    if (outside) {
        result.weights = {0.5, 0.5, 0.5};
        result.weights[longest] = 0;
    } else {
        for (size_t k = 0; k < 3; ++k) result.weights[k] = weights[k] / sum;
    }
    const bool as_printed = mode == Circumcentre::paper && sum > flat;
    for (size_t k = 0; k < 3; ++k)
        result.point = result.point + corners[k] * (as_printed ? weights[k] / sum : result.weights[k]);
    return result;
}

}  // namespace coppice
