#include "core/simplify/uv_guard.h"

#include <algorithm>
#include <cmath>

#include "core/base/watched_loop.h"

namespace coppice {

namespace {

// Twice the area below this part of the longest edge squared is none: its sign would be chance.
constexpr double degenerate_aspect = 1e-6;
constexpr int8_t unseen = 2;

bool is_uv_set(const Attribute& a) {
    return a.name.starts_with("TEXCOORD_") && a.components == 2;
}

// 1 or -1, 0 without area.
template <typename Uv>
int8_t winding(const std::array<Uv, 3>& uvs) {
    const auto [a, b, c] = uvs;
    const double abu = double{b.u} - double{a.u}, abv = double{b.v} - double{a.v};
    const double acu = double{c.u} - double{a.u}, acv = double{c.v} - double{a.v};
    const double bcu = acu - abu, bcv = acv - abv;
    const double longest = std::max({abu * abu + abv * abv, acu * acu + acv * acv, bcu * bcu + bcv * bcv});
    const double twice_area = abu * acv - abv * acu;
    if (std::abs(twice_area) <= degenerate_aspect * longest) return 0;
    return twice_area > 0 ? 1 : -1;
}

}  // namespace

UvGuard::UvGuard(const CollapseMesh& mesh, const Mesh& source, const Watch& watch) : mesh_(mesh) {
    std::vector<const Attribute*> sets;
    for (const Attribute& a : source.attributes) {
        if (is_uv_set(a)) sets.push_back(&a);
    }
    sets_ = static_cast<uint32_t>(sets.size());
    watched_resize(uvs_, size_t{mesh.wedge_count()} * sets_, watch);
    watched_resize(around_, uvs_.size(), watch, unseen);
    for (uint32_t set = 0; set < sets_; ++set) add_set(mesh, *sets[set], set, watch);
}

void UvGuard::add_set(const CollapseMesh& mesh, const Attribute& uvs, uint32_t set, const Watch& watch) {
    watched_loop(mesh.wedge_count(), watch, [&](size_t w) {
        const float* value = uvs.values.data() + 2 * size_t{mesh.wedge_source(static_cast<uint32_t>(w))};
        uvs_[w * sets_ + set] = {value[0], value[1]};
    });
    watched_loop(mesh.triangle_count(), watch, [&](size_t t) {
        const auto corner = static_cast<uint32_t>(3 * t);
        const Wedges wedges = {mesh.corner_wedge(corner), mesh.corner_wedge(corner + 1),
                               mesh.corner_wedge(corner + 2)};
        const int8_t wound = winding(uvs_of(wedges, set));
        for (const uint32_t wedge : wedges) {
            int8_t& around = around_[size_t{mesh.wedge_chart(wedge)} * sets_ + set];
            around = around == unseen || around == wound ? wound : int8_t{0};
        }
    });
}

bool UvGuard::may_collapse(uint32_t removed, uint32_t kept, const std::vector<uint32_t>& wedge_map) const {
    if (sets_ == 0) return true;
    const uint32_t first = mesh_.wedge_begin(removed);
    for (uint32_t c = mesh_.first_corner(removed); c != no_index; c = mesh_.corner_after(c)) {
        const uint32_t next = CollapseMesh::next_corner(c), previous = CollapseMesh::previous_corner(c);
        if (mesh_.corner_vertex(next) == kept || mesh_.corner_vertex(previous) == kept) continue;
        const Wedges before = {mesh_.corner_wedge(c), mesh_.corner_wedge(next), mesh_.corner_wedge(previous)};
        const Wedges after = {wedge_map[before[0] - first], before[1], before[2]};
        for (uint32_t set = 0; set < sets_; ++set) {
            const int8_t was = winding(uvs_of(before, set)), is = winding(uvs_of(after, set));
            if (!keeps_winding(was, is, after, set)) return false;
        }
    }
    return true;
}

bool UvGuard::may_blend(uint32_t corner, std::span<const WedgeShare> shares) const {
    const Wedges wedges = {mesh_.corner_wedge(corner), mesh_.corner_wedge(CollapseMesh::next_corner(corner)),
                           mesh_.corner_wedge(CollapseMesh::previous_corner(corner))};
    for (uint32_t set = 0; set < sets_; ++set) {
        Uvs uvs = uvs_of(wedges, set);
        const int8_t was = winding(uvs);
        uvs[0] = blended(shares, set);
        if (!keeps_winding(was, winding(uvs), wedges, set)) return false;
    }
    return true;
}

bool UvGuard::is_wound_well(const std::array<uint32_t, 3>& wedges) const {
    for (uint32_t set = 0; set < sets_; ++set) {
        int around = 0;
        for (const uint32_t wedge : wedges) around += around_[size_t{mesh_.wedge_chart(wedge)} * sets_ + set];
        const int8_t is = winding(uvs_of(wedges, set));
        if (is == 0 ? around != 0 : around * is < 0) return false;
    }
    return true;
}

void UvGuard::blend(std::span<const WedgeShare> shares, uint32_t into) {
    for (uint32_t set = 0; set < sets_; ++set) uvs_[size_t{into} * sets_ + set] = blended(shares, set);
}

bool UvGuard::keeps_winding(int8_t was, int8_t is, const Wedges& charts_of, uint32_t set) const {
    if (is == 0) return was == 0;
    if (is == -was) return false;
    int around = 0;
    for (const uint32_t wedge : charts_of) around += around_[size_t{mesh_.wedge_chart(wedge)} * sets_ + set];
    return around * is >= 0;
}

UvGuard::Uvs UvGuard::uvs_of(const Wedges& wedges, uint32_t set) const {
    return {uv(wedges[0], set), uv(wedges[1], set), uv(wedges[2], set)};
}

UvGuard::Uv UvGuard::blended(std::span<const WedgeShare> shares, uint32_t set) const {
    double u = 0, v = 0;
    for (const WedgeShare& share : shares) {
        u += share.weight * double{uv(share.wedge, set).u};
        v += share.weight * double{uv(share.wedge, set).v};
    }
    return {static_cast<float>(u), static_cast<float>(v)};
}

}  // namespace coppice
