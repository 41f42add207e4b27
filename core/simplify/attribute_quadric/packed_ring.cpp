#include "core/simplify/attribute_quadric/packed_ring.h"

#include <algorithm>
#include <cmath>

#include "core/simplify/deviation.h"

namespace coppice {

namespace {

// As in collapse_rules.cpp.
constexpr float least_cosine_at_once = 0.25F, least_cosine_to_facing = 0.25F;
constexpr float degenerate_aspect = 1e-6F;

bool is_degenerate(Vec3f a, Vec3f b, Vec3f c, Vec3f normal) {
    const float longest = std::max({squared_length(b - a), squared_length(c - b), squared_length(a - c)});
    return squared_length(normal) <= degenerate_aspect * degenerate_aspect * longest * longest;
}

// One corner of a triangle, and the sum of where the surface faced at all three.
struct Tip {
    Vec3f at, facing;
};

// Whether a triangle may have its corner elsewhere.
bool may_turn(const Tip& before, const Tip& after, Vec3f ahead, Vec3f behind) {
    const Vec3f old_normal = area_normal(before.at, ahead, behind),
                normal = area_normal(after.at, ahead, behind);
    const bool was_degenerate = is_degenerate(before.at, ahead, behind, old_normal);
    if (is_degenerate(after.at, ahead, behind, normal)) return was_degenerate;
    const float size = length(normal), old_size = length(old_normal);
    if (!was_degenerate && dot(normal, old_normal) < least_cosine_at_once * size * old_size) return false;
    const float agreement = dot(after.facing, normal);
    if (agreement >= 3 * least_cosine_to_facing * size) return true;
    // Where it faced away before, it may as long as that is no worse.
    return !was_degenerate && agreement * old_size >= dot(before.facing, old_normal) * size;
}

bool closes(const PackedRing& ring, const std::array<uint32_t, 2>& opposite) {
    for (uint32_t i = 0; i < ring.count; ++i) {
        if ((ring.next[i] == opposite[0] && ring.previous[i] == opposite[1]) ||
            (ring.next[i] == opposite[1] && ring.previous[i] == opposite[0])) {
            return true;
        }
    }
    return false;
}

}  // namespace

bool has_sound_link(const PackedRing& removed, const PackedRing& kept, uint32_t kept_vertex) {
    std::array<uint32_t, 2> opposite = {UINT32_MAX, UINT32_MAX};
    uint32_t at_edge = 0;
    for (uint32_t i = 0; i < removed.count; ++i) {
        const uint32_t next = removed.next[i], previous = removed.previous[i];
        if (next != kept_vertex && previous != kept_vertex) continue;
        if (at_edge == 2) return false;
        opposite[at_edge++] = next == kept_vertex ? previous : next;
    }
    if (at_edge == 2 && opposite[0] == opposite[1]) return false;  // sheets back to back
    uint32_t shared = 0;
    for (uint32_t i = 0; i < removed.neighbour_count; ++i) {
        const uint32_t* end = kept.neighbours.data() + kept.neighbour_count;
        shared += std::find(kept.neighbours.data(), end, removed.neighbours[i]) != end ? 1 : 0;
    }
    if (at_edge == 0 || shared != at_edge) return false;
    return !closes(removed, opposite) || !closes(kept, opposite);
}

void PackedFan::add(const PackedRing& ring, uint32_t place, const std::array<Vec3f, 2>& corners,
                    Vec3f facing) {
    next[count] = ring.next[place], previous[count] = ring.previous[place], spoke[count] = ring.spoke[place];
    Four& four = fours[count / lane_count];
    const uint32_t lane = count % lane_count;
    if (lane == 0) four = {};
    set_lane(four.ahead, lane, corners[0]);
    set_lane(four.behind, lane, corners[1]);
    set_lane(four.facing, lane, facing);
    ++count;
}

bool PackedFan::holds(uint32_t vertex) const {
    for (uint32_t i = 0; i < count; ++i)
        if (next[i] == vertex || previous[i] == vertex) return true;
    return false;
}

Vec3f PackedFan::outer() const {
    Vec3<Lanes> sum = {};
    for (uint32_t i = 0; i < four_count(); ++i) sum = sum + cross(fours[i].ahead, fours[i].behind);
    return {total(sum.x), total(sum.y), total(sum.z)};
}

double PackedFan::distance(Vec3d from, Vec3d moved_tip) const {
    double least = length(from - moved_tip);
    for (uint32_t i = 0; i < count; ++i) {
        const Four& four = fours[i / lane_count];
        const Vec3d ahead = to_double(lane_of(four.ahead, i % lane_count));
        const Vec3d behind = to_double(lane_of(four.behind, i % lane_count));
        least = std::min(least, distance_to_triangle(from, moved_tip, ahead, behind));
    }
    return least;
}

// Cosines are compared as squares, four at once; what fails is looked at again one by one.
bool keeps_orientation(const PackedFan& fan, Vec3f facing_before, Vec3f facing, Vec3f at) {
    const Vec3<Lanes> point = in_all_lanes(at), tip = in_all_lanes(fan.tip), own = in_all_lanes(facing);
    for (uint32_t i = 0; i < fan.count; i += lane_count) {
        const PackedFan::Four& four = fan.fours[i / lane_count];
        const Vec3<Lanes> a = four.ahead - point, b = four.behind - point;
        const Vec3<Lanes> after = cross(a, b), before = cross(four.ahead - tip, four.behind - tip);
        const Lanes squared = squared_length(after);
        const Lanes turned = dot(after, before), agreement = dot(own + four.facing, after);
        const Lanes sides = squared_length(a) + squared_length(b);
        const auto is_sound =
            (turned > 0) & (agreement > 0) &
            (turned * turned >
             least_cosine_at_once * least_cosine_at_once * squared * squared_length(before)) &
            (agreement * agreement > 9 * least_cosine_to_facing * least_cosine_to_facing * squared) &
            (squared > 4 * degenerate_aspect * degenerate_aspect * sides * sides);
        for (uint32_t lane = 0; lane < std::min(lane_count, fan.count - i); ++lane) {
            if (is_sound[lane] != 0) continue;
            const Vec3f others = lane_of(four.facing, lane);
            if (!may_turn({fan.tip, facing_before + others}, {at, facing + others}, lane_of(four.ahead, lane),
                          lane_of(four.behind, lane))) {
                return false;
            }
        }
    }
    return true;
}

}  // namespace coppice
