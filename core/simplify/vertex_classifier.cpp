#include "core/simplify/vertex_classifier.h"

namespace coppice {

namespace {

// So that sums over several pairs are as good as never equal by chance.
uint64_t pair_number(uint32_t near_chart, uint32_t far_chart) {
    const uint64_t pair = (uint64_t{near_chart} << 32 | far_chart) * 0x9e3779b97f4a7c15ULL;
    return (pair ^ (pair >> 32)) * 0xd6e8feb86659fd93ULL;  // both steps can be undone
}

}  // namespace

VertexKind VertexClassifier::classify(uint32_t vertex) {
    spokes_.clear();
    if (is_plain(vertex)) return VertexKind::manifold;
    gather_spokes(vertex);
    uint32_t borders = 0, seams = 0, fans = 0;
    bool crowded = false;
    for (uint32_t i = 0; i < spokes_.size(); ++i) {
        borders += spokes_[i].is_border();
        seams += spokes_[i].is_seam();
        crowded |= spokes_[i].crowded;
        fans += root(i) == i;
    }
    if (crowded || fans > 1) return VertexKind::complex;
    if (borders == 0 && seams == 0) return VertexKind::manifold;
    if (borders == 2 && seams == 0) return VertexKind::border;
    if (borders == 0 && seams == 2) return VertexKind::seam;
    return VertexKind::corner;
}

void VertexClassifier::append_line(uint32_t vertex, const Spoke& spoke,
                                   std::vector<FeatureEdge>& edges) const {
    if (!spoke.is_border() && !spoke.is_seam()) return;
    for (const Side& side : spoke.sides)
        if (side.layers > 0) edges.push_back({vertex, spoke.neighbour, side.triangle, spoke.is_border()});
}

void VertexClassifier::append_features(uint32_t vertex, std::vector<FeatureEdge>& edges) const {
    for (const Spoke& s : spokes_)
        if (s.neighbour > vertex) append_line(vertex, s, edges);
}

void VertexClassifier::append_lines(uint32_t vertex, std::vector<FeatureEdge>& edges) const {
    for (const Spoke& s : spokes_) append_line(vertex, s, edges);
}

std::vector<uint32_t> VertexClassifier::line_neighbours() const {
    std::vector<uint32_t> ends;
    for (const Spoke& s : spokes_)
        if (s.is_border() || s.is_seam()) ends.push_back(s.neighbour);
    return ends;
}

// Whether the vertex is what nearly all are: a closed ring of few triangles around it, all of one chart
// at each end of each spoke.
bool VertexClassifier::is_plain(uint32_t vertex) const {
    struct End {
        uint32_t vertex, chart;
        bool operator==(const End&) const = default;
    };
    constexpr uint32_t most = 12;
    std::array<End, most> ahead{}, behind{};
    const uint32_t count = mesh_.valence(vertex);
    if (count < 3 || count > most) return false;
    const auto end_at = [this](uint32_t corner) {
        return End{mesh_.corner_vertex(corner), mesh_.wedge_chart(mesh_.corner_wedge(corner))};
    };
    const uint32_t chart = mesh_.wedge_chart(mesh_.corner_wedge(mesh_.first_corner(vertex)));
    uint32_t i = 0;
    for (uint32_t c = mesh_.first_corner(vertex); c != no_index; c = mesh_.corner_after(c), ++i) {
        if (mesh_.wedge_chart(mesh_.corner_wedge(c)) != chart) return false;
        ahead[i] = end_at(CollapseMesh::next_corner(c));
        behind[i] = end_at(CollapseMesh::previous_corner(c));
    }
    uint32_t at = 0;
    for (uint32_t step = 1; step <= count; ++step) {
        uint32_t next = 0;
        while (next < count && !(ahead[next] == behind[at])) ++next;
        if (next == count || (next == 0) != (step == count)) return false;
        at = next;
    }
    return true;
}

void VertexClassifier::gather_spokes(uint32_t vertex) {
    neighbours_.gather(mesh_, vertex, steps_);
    spokes_.clear();
    for (const uint32_t neighbour : neighbours_.all()) {
        steps_.add(1);
        spokes_.push_back({.neighbour = neighbour, .fan = static_cast<uint32_t>(spokes_.size())});
    }
    for (uint32_t c = mesh_.first_corner(vertex); c != no_index; c = mesh_.corner_after(c)) {
        steps_.add(1);
        const uint32_t a = use(c, CollapseMesh::next_corner(c));
        const uint32_t b = use(c, CollapseMesh::previous_corner(c));
        unite(a, b);
    }
}

uint32_t VertexClassifier::use(uint32_t near, uint32_t far) {
    const uint32_t i = neighbours_.find(mesh_.corner_vertex(far));
    Spoke& s = spokes_[i];
    const uint32_t third = 9 * (near / 3) + 3 - near - far;  // the corners' sum less these two
    const uint32_t opposite = mesh_.corner_vertex(third);
    for (Side& side : s.sides) {
        if (side.layers > 0 && side.opposite != opposite) continue;
        if (side.layers == 0) side = {opposite, near / 3};
        ++side.layers;
        side.charts += pair_number(mesh_.wedge_chart(mesh_.corner_wedge(near)),
                                   mesh_.wedge_chart(mesh_.corner_wedge(far)));
        return i;
    }
    s.crowded = true;
    return i;
}

uint32_t VertexClassifier::root(uint32_t i) {
    while (spokes_[i].fan != i) i = spokes_[i].fan = spokes_[spokes_[i].fan].fan;
    return i;
}

void VertexClassifier::unite(uint32_t a, uint32_t b) {
    a = root(a), b = root(b);
    spokes_[a < b ? b : a].fan = a < b ? a : b;
}

}  // namespace coppice
