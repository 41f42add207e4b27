// Four floats that are computed with as one: what is done for one edge or triangle is done for four at once,
// with the same bits as one by one. Vec3<Lanes> and CentredQuadric<Lanes> hold four of theirs.
#pragma once

#include <array>
#include <cstdint>

#include "core/simplify/attribute_quadric/centred_quadric.h"

namespace coppice {

inline constexpr uint32_t lane_count = 4;

// Vector extensions of GCC and Clang; comparisons give masks, `mask ? a : b` chooses lane by lane.
using Lanes [[gnu::vector_size(lane_count * sizeof(float))]] = float;

inline float total(Lanes lanes) {
    return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

inline Vec3f lane_of(const Vec3<Lanes>& v, uint32_t lane) {
    return {v.x[lane], v.y[lane], v.z[lane]};
}
inline void set_lane(Vec3<Lanes>& v, uint32_t lane, Vec3f value) {
    v.x[lane] = value.x, v.y[lane] = value.y, v.z[lane] = value.z;
}
inline Vec3<Lanes> in_all_lanes(Vec3f v) {
    return {Lanes{} + v.x, Lanes{} + v.y, Lanes{} + v.z};
}

// Four quadrics as one of four.
inline BasicQuadric<Lanes> together(const std::array<CentredQuadric, lane_count>& quadrics) {
    BasicQuadric<Lanes> q;
    for (uint32_t i = 0; i < lane_count; ++i) {
        const CentredQuadric& from = quadrics[i];
        q.xx[i] = from.xx, q.yy[i] = from.yy, q.zz[i] = from.zz;
        q.xy[i] = from.xy, q.xz[i] = from.xz, q.yz[i] = from.yz;
        q.b.x[i] = from.b.x, q.b.y[i] = from.b.y, q.b.z[i] = from.b.z;
        q.c[i] = from.c, q.weight[i] = from.weight;
    }
    return q;
}
}  // namespace coppice
