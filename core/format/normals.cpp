#include "core/format/normals.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace coppice {

namespace {

constexpr double text_rounding = 0.02;    // normals printed with two digits are off by that, and meant well
constexpr double exact_enough = 0.00005;  // readers of glTF accept ten times that

// Area-weighted normals of the triangles around each of these wedges.
void replace_by_triangle_normals(Mesh& mesh, Attribute& normals, const std::vector<uint32_t>& wedges) {
    std::map<uint32_t, Vec3d> sums;
    for (const uint32_t wedge : wedges) sums[wedge] = {};
    for (size_t t = 0; t < mesh.triangle_count(); ++t) {
        const Vec3d a = mesh.corner_position(t, 0);
        const Vec3d area = cross(mesh.corner_position(t, 1) - a, mesh.corner_position(t, 2) - a);
        for (size_t c = 0; c < 3; ++c) {
            if (const auto at = sums.find(mesh.triangles[3 * t + c]); at != sums.end())
                at->second = at->second + area;
        }
    }
    for (const auto& [wedge, sum] : sums) {
        const Vec3d n = squared_length(sum) > 0 ? normalized(sum) : Vec3d{0, 0, 1};
        float* value = normals.values.data() + size_t{3} * wedge;
        value[0] = static_cast<float>(n.x);
        value[1] = static_cast<float>(n.y);
        value[2] = static_cast<float>(n.z);
    }
}

// By wedge: whether a triangle whose slot has the attribute uses it.
std::vector<bool> wedges_with(const Mesh& mesh, size_t attribute) {
    std::vector<bool> with(mesh.wedge_count());
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        const MaterialSlot& slot = mesh.slots[mesh.triangle_slot[i / 3]];
        if (slot.has(attribute)) with[mesh.triangles[i]] = true;
    }
    return with;
}

}  // namespace

void repair_normals(Mesh& mesh, WarningTally& tally) {
    const auto found = std::find_if(mesh.attributes.begin(), mesh.attributes.end(),
                                    [](const Attribute& a) { return a.name == "NORMAL"; });
    if (found == mesh.attributes.end()) return;
    const std::vector<bool> with = wedges_with(mesh, static_cast<size_t>(found - mesh.attributes.begin()));
    std::vector<uint32_t> without_direction;
    for (uint32_t wedge = 0; wedge < mesh.wedge_count(); ++wedge) {
        if (!with[wedge]) continue;
        float* value = found->values.data() + size_t{3} * wedge;
        const double size = length(Vec3d{value[0], value[1], value[2]});
        if (!std::isfinite(size) || size == 0) {
            without_direction.push_back(wedge);
            continue;
        }
        if (std::abs(size - 1) > text_rounding) {
            tally.note("repair.normals", "normals that are not unit length were made so", mesh.name);
        }
        if (std::abs(size - 1) <= exact_enough) continue;
        for (size_t i = 0; i < 3; ++i) value[i] = static_cast<float>(value[i] / size);
    }
    if (without_direction.empty()) return;
    tally.note("repair.normals",
               "normals that are zero or not finite were replaced by those of their triangles", mesh.name);
    replace_by_triangle_normals(mesh, *found, without_direction);
}

}  // namespace coppice
