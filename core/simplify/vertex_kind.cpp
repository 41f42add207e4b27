#include "core/simplify/vertex_kind.h"

#include <array>

#include "core/base/watched_loop.h"
#include "core/simplify/neighbours.h"

namespace coppice {

namespace {

// The triangles at an edge that have the same third vertex: one, or several that lie on each other (a decal
// of another material, two sheets back to back).
struct Side {
    uint32_t opposite = no_index;
    uint32_t triangle = 0;  // the first
    uint32_t layers = 0;
    uint64_t charts = 0;  // at both ends of the edge, summed over the layers
};

// One edge from the vertex in question, as its triangles show it.
struct Spoke {
    uint32_t neighbour = 0;
    std::array<Side, 2> sides = {};
    bool crowded = false;  // more than two sides
    uint32_t fan = 0;      // union-find parent, index of a spoke

    bool is_border() const { return !crowded && sides[1].layers == 0; }
    // Charts break, or a layer ends.
    bool is_seam() const {
        return !crowded && sides[1].layers > 0 &&
               (sides[0].layers != sides[1].layers || sides[0].charts != sides[1].charts);
    }
};

class Classifier {
  public:
    Classifier(const CollapseMesh& mesh, const Watch& watch)
        : mesh_(mesh), steps_(watch), neighbours_(mesh.vertex_count(), watch) {}

    VertexKind classify(uint32_t vertex) {
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

    // Edges are reported from their lower vertex.
    void append_features(uint32_t vertex, std::vector<FeatureEdge>& edges) const {
        for (const Spoke& s : spokes_) {
            if (s.neighbour < vertex || !(s.is_border() || s.is_seam())) continue;
            for (const Side& side : s.sides) {
                if (side.layers > 0) edges.push_back({vertex, s.neighbour, side.triangle, s.is_border()});
            }
        }
    }

  private:
    // Whether the vertex is what nearly all are: a closed ring of few triangles around it, all of one chart
    // at each end of each spoke.
    bool is_plain(uint32_t vertex) const {
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

    void gather_spokes(uint32_t vertex) {
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

    uint32_t use(uint32_t near, uint32_t far) {
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

    // So that sums over several pairs are as good as never equal by chance.
    static uint64_t pair_number(uint32_t near_chart, uint32_t far_chart) {
        const uint64_t pair = (uint64_t{near_chart} << 32 | far_chart) * 0x9e3779b97f4a7c15ULL;
        return (pair ^ (pair >> 32)) * 0xd6e8feb86659fd93ULL;  // both steps can be undone
    }

    uint32_t root(uint32_t i) {
        while (spokes_[i].fan != i) i = spokes_[i].fan = spokes_[spokes_[i].fan].fan;
        return i;
    }
    void unite(uint32_t a, uint32_t b) {
        a = root(a), b = root(b);
        spokes_[a < b ? b : a].fan = a < b ? a : b;
    }

    const CollapseMesh& mesh_;
    WatchedSteps steps_;
    Neighbours neighbours_;
    std::vector<Spoke> spokes_;
};

}  // namespace

void lock_sharp_borders(const CollapseMesh& mesh, Features& features) {
    // Unit vectors to both neighbours: they cancel where the border is straight; at 60 degrees their sum has
    // length 1.
    std::vector<Vec3d> turns(mesh.vertex_count());
    for (const FeatureEdge& f : features.edges) {
        if (!f.is_border) continue;
        const Vec3d along = normalized(mesh.position(f.b) - mesh.position(f.a));
        turns[f.a] = turns[f.a] + along;
        turns[f.b] = turns[f.b] - along;
    }
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        if (features.kinds[v] == VertexKind::border && squared_length(turns[v]) > 1) {
            features.kinds[v] = VertexKind::corner;
        }
    }
}

void lock_borders(Features& features) {
    for (const FeatureEdge& f : features.edges)
        if (f.is_border) features.kinds[f.a] = features.kinds[f.b] = VertexKind::corner;
}

Features find_features(const CollapseMesh& mesh, const Watch& watch) {
    Features features;
    features.kinds = watched_vector(mesh.vertex_count(), watch, VertexKind::corner);
    Classifier classifier(mesh, watch);
    watched_loop(mesh.vertex_count(), watch, [&](size_t i) {
        const auto v = static_cast<uint32_t>(i);
        if (!mesh.is_live_vertex(v)) return;
        features.kinds[v] = classifier.classify(v);
        classifier.append_features(v, features.edges);
    });
    return features;
}

}  // namespace coppice
