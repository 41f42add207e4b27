#include "core/simplify/wedge_map.h"

#include <algorithm>
#include <limits>

namespace coppice {

namespace {

// A vertex where thousands of faceted triangles meet: looking at this many wedges is enough.
constexpr uint32_t most_wedges_tried = 64;

}  // namespace

bool WedgeMap::find(uint32_t removed, uint32_t kept) {
    first_ = mesh_.wedge_begin(removed);
    const uint32_t count = mesh_.wedge_end(removed) - first_;
    map_.assign(count, no_index);
    if (count == 1 && mesh_.wedge_end(kept) - mesh_.wedge_begin(kept) == 1) {
        map_[0] = mesh_.wedge_begin(kept);
        return true;
    }
    used_.assign(count, false);
    return pair_along_edge(removed, kept) && follow_charts();
}

bool WedgeMap::find_across(uint32_t removed, uint32_t kept, const WedgeValues& values) {
    first_ = mesh_.wedge_begin(removed);
    map_.assign(mesh_.wedge_end(removed) - first_, no_index);
    const uint32_t begin = mesh_.wedge_begin(kept), end = mesh_.wedge_end(kept);
    if (std::max<size_t>(map_.size(), end - begin) > most_wedges_tried) return false;
    for (uint32_t c = mesh_.first_corner(removed); c != no_index; c = mesh_.corner_after(c)) {
        const uint32_t from = mesh_.corner_wedge(c);
        uint32_t& best = map_[from - first_];
        if (best != no_index) continue;
        double least = std::numeric_limits<double>::infinity();
        for (uint32_t w = begin; w < end; ++w) {
            if (mesh_.wedge_slot(w) != mesh_.wedge_slot(from) || !values.same_chart(w, from)) continue;
            const double error = clouds_.squared_error(from, w);
            if (error < least) least = error, best = w;
        }
        if (best == no_index) return false;
    }
    return true;
}

bool WedgeMap::pair_along_edge(uint32_t removed, uint32_t kept) {
    for (uint32_t c = mesh_.first_corner(removed); c != no_index; c = mesh_.corner_after(c)) {
        used_[mesh_.corner_wedge(c) - first_] = true;
        const uint32_t next = CollapseMesh::next_corner(c), previous = CollapseMesh::previous_corner(c);
        const uint32_t other = mesh_.corner_vertex(next) == kept       ? next
                               : mesh_.corner_vertex(previous) == kept ? previous
                                                                       : no_index;
        if (other == no_index) continue;
        if (!pair(mesh_.corner_wedge(c), mesh_.corner_wedge(other))) return false;
    }
    return true;
}

bool WedgeMap::pair(uint32_t from, uint32_t to) {
    uint32_t& paired = map_[from - first_];
    // Another slot: the wedge's chart ends here. Another chart: the end of a seam, which would be torn open.
    if (mesh_.wedge_slot(from) != mesh_.wedge_slot(to)) return false;
    if (paired == no_index) {
        paired = to;
    } else if (paired != to) {
        if (mesh_.wedge_chart(paired) != mesh_.wedge_chart(to)) return false;
        if (clouds_.squared_error(from, to) < clouds_.squared_error(from, paired)) paired = to;
    }
    return true;
}

bool WedgeMap::follow_charts() {
    for (uint32_t i = 0; i < map_.size(); ++i) {
        if (map_[i] != no_index) continue;
        const uint32_t lead = chart_counterpart(first_ + i);
        if (lead != no_index) map_[i] = nearest(first_ + i, lead);
        if (lead == no_index && used_[i]) return false;
    }
    return true;
}

// Where a wedge of the same chart that the edge has paired goes to.
uint32_t WedgeMap::chart_counterpart(uint32_t wedge) const {
    const uint32_t chart = mesh_.wedge_chart(wedge);
    for (uint32_t w = chart; w < first_ + map_.size() && mesh_.wedge_chart(w) == chart; ++w) {
        if (map_[w - first_] != no_index) return map_[w - first_];
    }
    return no_index;
}

uint32_t WedgeMap::nearest(uint32_t from, uint32_t near_wedge) const {
    const uint32_t chart = mesh_.wedge_chart(near_wedge);
    uint32_t best = near_wedge;
    double least = clouds_.squared_error(from, near_wedge);
    for (uint32_t w = chart, tried = 0;
         w < mesh_.wedge_count() && mesh_.wedge_chart(w) == chart && tried < most_wedges_tried;
         ++w, ++tried) {
        const double error = clouds_.squared_error(from, w);
        if (error < least) {
            least = error;
            best = w;
        }
    }
    return best;
}

}  // namespace coppice
