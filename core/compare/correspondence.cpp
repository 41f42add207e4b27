#include "core/compare/correspondence.h"

#include <algorithm>
#include <cmath>

namespace coppice {

namespace {

// Formats store transforms as floats or in a few digits.
constexpr double tolerance = 1e-6;

bool are_alike(const Transform& a, const Transform& b, double diagonal) {
    double largest = 0;
    for (size_t i = 0; i < 12; ++i) {
        if (i % 4 != 3) largest = std::max(largest, std::abs(a.m[i]));
    }
    for (size_t i = 0; i < 12; ++i) {
        const double size = i % 4 == 3 ? std::max(diagonal, std::abs(a.m[i])) : largest;
        if (!(std::abs(a.m[i] - b.m[i]) <= tolerance * size)) return false;
    }
    return true;
}

}  // namespace

void add_instance(InstanceWeight& weight, const Transform& world) {
    const double scale = largest_scale(world);
    const double area = std::pow(std::abs(determinant(world)), 2.0 / 3);
    weight.area += area;
    weight.area_scale += area * scale;
    weight.area_squared_scale += area * scale * scale;
    weight.largest_scale = std::max(weight.largest_scale, scale);
}

std::optional<Correspondence> find_correspondence(const Scene& reference,
                                                  const std::vector<Instance>& of_reference,
                                                  const Scene& candidate,
                                                  const std::vector<Instance>& of_candidate,
                                                  const Watch& watch) {
    const size_t meshes = reference.meshes.size();
    if (candidate.meshes.size() != meshes || of_candidate.size() != of_reference.size()) return {};
    for (size_t i = 0; i < meshes; ++i) {
        if ((reference.meshes[i].triangle_count() == 0) != (candidate.meshes[i].triangle_count() == 0))
            return {};
    }
    const double diagonal = scene_bounds(reference, of_reference).diagonal();
    Correspondence found = {std::vector<InstanceWeight>(meshes, {0, 0, 0, 0}),
                            std::vector<uint64_t>(meshes, 0)};
    for (size_t k = 0; k < of_reference.size(); ++k) {
        if (k % 1024 == 0) watch.check();
        const Instance &a = of_reference[k], &b = of_candidate[k];
        if (a.mesh != b.mesh || !are_alike(a.world, b.world, diagonal)) return {};
        add_instance(found.weights[a.mesh], a.world);
        ++found.counts[a.mesh];
    }
    return found;
}

}  // namespace coppice
