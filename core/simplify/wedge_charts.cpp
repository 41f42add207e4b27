#include "core/simplify/wedge_charts.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <tuple>
#include <utility>

#include "core/base/watched_loop.h"

namespace coppice {

namespace {

// Orders wedges by what must not be merged: equal wedges form a chart. Values are compared as bits: any order
// will do, and NaN has none.
class HardValues {
  public:
    explicit HardValues(const Mesh& mesh) {
        for (const Attribute& a : mesh.attributes) add(a);
        for (const MorphTarget& target : mesh.morph_targets) {
            for (const Attribute& delta : target.deltas) add(delta);
        }
    }

    bool empty() const { return streams_.empty(); }

    int compare(uint32_t a, uint32_t b) const {
        for (const Stream& s : streams_) {
            const float* values = s.attribute->values.data();
            const size_t n = s.attribute->components;
            if (const int order = std::memcmp(values + a * n + s.first, values + b * n + s.first,
                                              (n - s.first) * sizeof(float))) {
                return order;
            }
        }
        return 0;
    }

  private:
    struct Stream {
        const Attribute* attribute;
        size_t first;  // components before it may differ
    };

    void add(const Attribute& a) {
        const size_t first = first_hard_component(a);
        if (first < a.components) streams_.push_back({&a, first});
    }

    std::vector<Stream> streams_;
};

struct SlotWedge {
    uint32_t wedge, slot;
};

// The distinct (wedge, slot) pairs that corners use. Nearly all wedges have one slot, so only the others are
// sorted.
std::vector<SlotWedge> used_pairs(const Mesh& mesh, const Watch& watch) {
    constexpr uint32_t unused = UINT32_MAX;
    std::vector<uint32_t> first_slot = watched_vector(mesh.wedge_count(), watch, unused);
    std::vector<std::pair<uint32_t, uint32_t>> more;
    watched_loop(mesh.triangles.size(), watch, [&](size_t corner) {
        const uint32_t wedge = mesh.triangles[corner];
        const uint32_t slot = mesh.triangle_slot[corner / 3];
        if (first_slot[wedge] == unused) first_slot[wedge] = slot;
        if (first_slot[wedge] != slot) more.emplace_back(wedge, slot);
    });
    WatchedSteps steps(watch);
    std::sort(more.begin(), more.end(), steps.counting(std::less<>()));
    more.erase(std::unique(more.begin(), more.end()), more.end());
    std::vector<SlotWedge> pairs;
    pairs.reserve(first_slot.size() + more.size());
    watched_loop(first_slot.size(), watch, [&](size_t wedge) {
        if (first_slot[wedge] != unused) pairs.push_back({static_cast<uint32_t>(wedge), first_slot[wedge]});
    });
    for (const auto& [wedge, slot] : more) pairs.push_back({wedge, slot});
    return pairs;
}

// Counting sort by vertex; fills begin.
std::vector<SlotWedge> by_vertex(const Mesh& mesh, const std::vector<SlotWedge>& pairs,
                                 std::vector<uint32_t>& begin, const Watch& watch) {
    begin = watched_vector<uint32_t>(mesh.vertex_count() + 1, watch);
    watched_loop(pairs.size(), watch, [&](size_t i) { ++begin[mesh.wedge_vertex[pairs[i].wedge] + 1]; });
    watched_loop(mesh.vertex_count(), watch, [&](size_t v) { begin[v + 1] += begin[v]; });
    std::vector<uint32_t> next = watched_copy(begin, watch);
    std::vector<SlotWedge> sorted = watched_vector<SlotWedge>(pairs.size(), watch);
    watched_loop(pairs.size(), watch,
                 [&](size_t i) { sorted[next[mesh.wedge_vertex[pairs[i].wedge]]++] = pairs[i]; });
    return sorted;
}

// Sorts the wedges of every vertex into charts and names each chart by its first wedge.
std::vector<uint32_t> find_charts(const Mesh& mesh, const std::vector<uint32_t>& begin,
                                  std::vector<SlotWedge>& wedges, const Watch& watch) {
    const HardValues hard(mesh);
    const auto order = [&hard](const SlotWedge& a, const SlotWedge& b) {
        if (a.slot != b.slot) return a.slot < b.slot ? -1 : 1;
        return hard.compare(a.wedge, b.wedge);
    };
    std::vector<uint32_t> chart = watched_vector<uint32_t>(wedges.size(), watch);
    WatchedSteps steps(watch);
    watched_loop(mesh.vertex_count(), watch, [&](size_t v) {
        std::sort(wedges.begin() + begin[v], wedges.begin() + begin[v + 1],
                  steps.counting([&order](const SlotWedge& a, const SlotWedge& b) {
                      const int difference = order(a, b);
                      return difference != 0 ? difference < 0 : a.wedge < b.wedge;
                  }));
        for (uint32_t w = begin[v]; w < begin[v + 1]; ++w) {
            const bool same = w > begin[v] && order(wedges[w - 1], wedges[w]) == 0;
            chart[w] = same ? chart[w - 1] : w;
        }
    });
    return chart;
}

// Back from corners to wedges: nearly all wedges of the source are one here; those that several slots use are
// looked up, as a hostile mesh may have a million of them at one vertex.
std::vector<uint32_t> corner_wedges(const Mesh& mesh, const WedgeCharts& charts, const Watch& watch) {
    constexpr uint32_t unused = UINT32_MAX;
    std::vector<uint32_t> last = watched_vector(mesh.wedge_count(), watch, unused);  // by the source's wedge
    std::vector<std::tuple<uint32_t, uint32_t, uint32_t>> others;                    // source, slot, wedge
    watched_loop(charts.source.size(), watch, [&](size_t w) {
        uint32_t& known = last[charts.source[w]];
        if (known != unused) others.emplace_back(charts.source[w], charts.slot[known], known);
        known = static_cast<uint32_t>(w);
    });
    WatchedSteps steps(watch);
    std::sort(others.begin(), others.end(), steps.counting(std::less<>()));
    std::vector<uint32_t> corners = watched_vector<uint32_t>(mesh.triangles.size(), watch);
    watched_loop(corners.size(), watch, [&](size_t corner) {
        const uint32_t source = mesh.triangles[corner];
        const uint32_t slot = mesh.triangle_slot[corner / 3];
        const uint32_t w = last[source];
        corners[corner] =
            charts.slot[w] == slot
                ? w
                : std::get<2>(*std::lower_bound(others.begin(), others.end(), std::tuple(source, slot, 0U)));
    });
    return corners;
}

}  // namespace

size_t first_hard_component(const Attribute& attribute) {
    if (attribute.name == "NORMAL" || attribute.name.starts_with("COLOR_")) return attribute.components;
    return attribute.name == "TANGENT" ? 3 : 0;
}

WedgeCharts wedge_charts(const Mesh& mesh, const Watch& watch) {
    WedgeCharts charts;
    std::vector<SlotWedge> wedges = by_vertex(mesh, used_pairs(mesh, watch), charts.begin, watch);
    charts.chart = find_charts(mesh, charts.begin, wedges, watch);
    charts.source.reserve(wedges.size());
    charts.slot.reserve(wedges.size());
    watched_loop(wedges.size(), watch, [&](size_t w) {
        charts.source.push_back(wedges[w].wedge);
        charts.slot.push_back(wedges[w].slot);
    });
    charts.corner_wedge = corner_wedges(mesh, charts, watch);
    return charts;
}

}  // namespace coppice
