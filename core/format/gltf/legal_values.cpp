#include "core/format/gltf/legal_values.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "core/base/watched_loop.h"
#include "core/format/gltf/accessor.h"
#include "core/format/gltf/semantics.h"

namespace coppice::gltf {

namespace {

constexpr double unit_tolerance = 0.0067;  // Khronos' validator: 0.00674

Vec3d vector_at(const Attribute& attribute, size_t wedge) {
    const float* v = &attribute.values[wedge * attribute.components];
    return {v[0], v[1], v[2]};
}

// What the value will be once it is stored, so that rounding is judged too.
Vec3d stored(Vec3d v, Storage storage) {
    return {decoded(encoded(v.x, storage), storage), decoded(encoded(v.y, storage), storage),
            decoded(encoded(v.z, storage), storage)};
}

bool is_unit(Vec3d v, Storage storage) {
    return std::abs(length(stored(v, storage)) - 1) <= unit_tolerance;
}

// Sums of the triangles' normals, weighted by area, per wedge.
std::vector<Vec3d> triangle_normals(const Mesh& mesh, const Watch& watch) {
    std::vector<Vec3d> normals = watched_vector<Vec3d>(mesh.wedge_count(), watch);
    watched_loop(mesh.triangle_count(), watch, [&](size_t t) {
        const Vec3d a = mesh.corner_position(t, 0);
        const Vec3d normal = cross(mesh.corner_position(t, 1) - a, mesh.corner_position(t, 2) - a);
        for (size_t c = 0; c < 3; ++c) {
            Vec3d& sum = normals[mesh.triangles[3 * t + c]];
            sum = sum + normal;
        }
    });
    return normals;
}

Vec3d perpendicular(Vec3d v) {
    return normalized(cross(v, std::abs(v.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}));
}

void make_unit(Mesh& mesh, Attribute& attribute, bool is_tangent, const Watch& watch) {
    std::vector<Vec3d> fallback;
    watched_loop(mesh.wedge_count(), watch, [&](size_t w) {
        float* v = &attribute.values[w * attribute.components];
        if (is_tangent && v[3] != 1 && v[3] != -1) v[3] = v[3] < 0 ? -1.0F : 1.0F;
        Vec3d direction = vector_at(attribute, w);
        if (is_unit(direction, attribute.storage)) return;
        direction = normalized(direction);
        if (!(squared_length(direction) > 0.5)) {
            if (fallback.empty()) fallback = triangle_normals(mesh, watch);
            direction = normalized(fallback[w]);
            if (!(squared_length(direction) > 0.5)) direction = {0, 0, 1};
            if (is_tangent) direction = perpendicular(direction);
        }
        v[0] = static_cast<float>(direction.x);
        v[1] = static_cast<float>(direction.y);
        v[2] = static_cast<float>(direction.z);
    });
}

// The sets of joints and weights of one vertex; glTF checks them all together.
struct Influences {
    std::vector<Attribute*> joints, weights;

    float& joint(size_t w, size_t i) { return joints[i / 4]->values[4 * w + i % 4]; }
    float& weight(size_t w, size_t i) { return weights[i / 4]->values[4 * w + i % 4]; }
    size_t count() const { return 4 * weights.size(); }
};

// The validator's own sum, in its order and in single precision.
bool is_legal(Influences& influences, size_t w) {
    std::set<float> used;
    float sum = 0;
    float tolerance = 0;
    for (size_t c = 0; c < 4; ++c)
        for (size_t set = 0; set < influences.weights.size(); ++set) {
            const float weight = influences.weight(w, 4 * set + c);
            if (weight == 0) continue;
            if (weight < 0 || !used.insert(influences.joint(w, 4 * set + c)).second) return false;
            sum += weight;
            tolerance += 2e-7F;
        }
    return std::abs(sum - 1) <= tolerance;
}

void normalize(Influences& influences, size_t w) {
    double sum = 0;
    size_t largest = 0;
    for (size_t i = 0; i < influences.count(); ++i) {
        float& weight = influences.weight(w, i);
        if (!(weight > 0)) weight = 0;
        for (size_t j = 0; j < i && weight > 0; ++j)
            if (influences.weight(w, j) > 0 && influences.joint(w, j) == influences.joint(w, i)) {
                influences.weight(w, j) += weight;
                weight = 0;
            }
        if (weight > influences.weight(w, largest)) largest = i;
    }
    for (size_t i = 0; i < influences.count(); ++i) sum += influences.weight(w, i);
    if (!(sum > 0)) {
        influences.weight(w, 0) = 1;
        return;
    }
    double others = 0;
    const Storage storage = influences.weights[0]->storage;
    for (size_t i = 0; i < influences.count(); ++i) {
        const double scaled = influences.weight(w, i) / sum;
        influences.weight(w, i) = static_cast<float>(decoded(encoded(scaled, storage), storage));
        if (i != largest) others += influences.weight(w, i);
    }
    // What rounding lost goes to the heaviest, in steps of the stored type.
    influences.weight(w, largest) = static_cast<float>(decoded(encoded(1 - others, storage), storage));
    for (size_t i = 0; i < influences.count(); ++i)
        if (influences.weight(w, i) == 0) influences.joint(w, i) = 0;
}

}  // namespace

void make_legal(Mesh& mesh, const Watch& watch) {
    Influences influences;
    for (Attribute& attribute : mesh.attributes) {
        const Semantic semantic = parse_attribute_name(attribute.name).semantic;
        if (semantic == Semantic::normal) make_unit(mesh, attribute, false, watch);
        if (semantic == Semantic::tangent && attribute.components == 4)
            make_unit(mesh, attribute, true, watch);
        if (semantic == Semantic::color)
            watched_loop(attribute.values.size(), watch, [&](size_t i) {
                attribute.values[i] = std::clamp(attribute.values[i], 0.0F, 1.0F);
            });
        if (semantic == Semantic::joints) influences.joints.push_back(&attribute);
        if (semantic == Semantic::weights) influences.weights.push_back(&attribute);
    }
    if (influences.weights.empty() || influences.joints.size() != influences.weights.size()) return;
    watched_loop(mesh.wedge_count(), watch, [&](size_t w) {
        if (!is_legal(influences, w)) normalize(influences, w);
    });
}

}  // namespace coppice::gltf
