#include "core/simplify/wedge_groups.h"

#include <algorithm>

namespace coppice {

bool WedgeGroups::find(std::span<const uint32_t> vertices, std::span<const double> weights, uint32_t anchor,
                       std::span<const uint32_t> gone) {
    gather(vertices, weights);
    unite_along(gone);
    return fill_shares(anchor);
}

void WedgeGroups::gather(std::span<const uint32_t> vertices, std::span<const double> weights) {
    members_.clear();
    for (size_t i = 0; i < vertices.size(); ++i) {
        const auto mine = static_cast<std::ptrdiff_t>(members_.size());
        uint32_t last = no_index;
        for (uint32_t c = mesh_.first_corner(vertices[i]); c != no_index; c = mesh_.corner_after(c)) {
            const uint32_t wedge = mesh_.corner_wedge(c);
            if (wedge == last) continue;  // as nearly always
            last = wedge;
            const auto known = std::find_if(members_.begin() + mine, members_.end(),
                                            [wedge](const Member& m) { return m.wedge == wedge; });
            if (known != members_.end()) continue;
            members_.push_back({wedge, vertices[i], static_cast<uint32_t>(members_.size()), weights[i]});
        }
    }
}

uint32_t WedgeGroups::member(uint32_t wedge) const {
    for (uint32_t i = 0; i < members_.size(); ++i)
        if (members_[i].wedge == wedge) return i;
    return no_index;
}

uint32_t WedgeGroups::root(uint32_t i) {
    while (members_[i].root != i) i = members_[i].root = members_[members_[i].root].root;
    return i;
}

void WedgeGroups::unite_along(std::span<const uint32_t> gone) {
    for (const uint32_t triangle : gone) {
        uint32_t first = no_index;
        for (uint32_t c = 3 * triangle; c < 3 * triangle + 3; ++c) {
            const uint32_t found = member(mesh_.corner_wedge(c));
            if (found == no_index) continue;
            if (first == no_index) first = found;
            const uint32_t a = root(first), b = root(found);
            members_[std::max(a, b)].root = std::min(a, b);
        }
    }
}

// Groups one after another, the anchor's wedges first in each.
bool WedgeGroups::fill_shares(uint32_t anchor) {
    for (uint32_t i = 0; i < members_.size(); ++i) members_[i].root = root(i);
    std::stable_sort(members_.begin(), members_.end(), [anchor](const Member& a, const Member& b) {
        if (a.root != b.root) return a.root < b.root;
        return (a.vertex == anchor) > (b.vertex == anchor);
    });
    groups_.clear();
    shares_.clear();
    for (uint32_t first = 0, last = 0; first < members_.size(); first = last) {
        const bool anchored = members_[first].vertex == anchor;
        double total = 0;
        for (; last < members_.size() && members_[last].root == members_[first].root; ++last) {
            Member& m = members_[last];
            if (anchored) {
                if (m.vertex == anchor &&
                    mesh_.wedge_chart(m.wedge) != mesh_.wedge_chart(members_[first].wedge))
                    return false;
                m.weight = last == first ? 1 : 0;
            }
            if (mesh_.wedge_slot(m.wedge) != mesh_.wedge_slot(members_[first].wedge)) return false;
            total += m.weight;
        }
        for (uint32_t i = first; i < last; ++i)
            shares_.push_back(
                {members_[i].wedge, total > 0 ? members_[i].weight / total : 1.0 / (last - first)});
        groups_.push_back({first, last});
    }
    return true;
}

uint32_t WedgeGroups::group_of(uint32_t wedge) const {
    const uint32_t at = member(wedge);
    uint32_t group = 0;
    while (groups_[group].last <= at) ++group;
    return group;
}

}  // namespace coppice
