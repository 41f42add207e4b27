#include "core/simplify/delaunay_flips.h"

#include <cmath>
#include <vector>

#include "core/base/watched_loop.h"
#include "core/simplify/neighbours.h"
#include "core/simplify/vertex_kind.h"

namespace coppice {

namespace {

constexpr double least_sine = 1.7e-8;  // of what the angles exceed 180 degrees by: 1e-6 degrees
constexpr double least_aspect = 1e-4;  // of a new triangle: twice its area to its longest edge squared
constexpr uint32_t longest_ring = 64;

class Flips {
  public:
    Flips(CollapseMesh& mesh, const UvGuard& uvs, const MayFlip& may_flip)
        : mesh_(mesh), uvs_(uvs), may_flip_(may_flip) {}

    uint64_t run(const Watch& watch) {
        watched_loop(3 * size_t{mesh_.triangle_count()}, watch, [&](size_t i) {
            const auto corner = static_cast<uint32_t>(i);
            if (mesh_.is_live_triangle(corner / 3) && is_obtuse(corner)) open_.push_back(corner);
        });
        const uint64_t most = 30 * uint64_t{mesh_.live_triangles()};
        uint64_t flips = 0;
        for (uint64_t looked = 0; looked < most && next_ < open_.size(); ++looked) {
            if (looked % 1024 == 0) watch.check();
            flips += try_flip(open_[next_++]);
        }
        return flips;
    }

  private:
    Vec3d at(uint32_t corner) const { return mesh_.position(mesh_.corner_vertex(corner)); }
    bool is_obtuse(uint32_t c) const {
        const Vec3d p = at(c);
        return dot(at(CollapseMesh::next_corner(c)) - p, at(CollapseMesh::previous_corner(c)) - p) < 0;
    }

    // An edge is named by a corner opposite to it: c of the triangle (c, a, b). One of the two is obtuse
    // where it flips, so an edge is only looked at from there.
    bool try_flip(uint32_t c) {
        if (!is_obtuse(c)) return false;
        const uint32_t a = CollapseMesh::next_corner(c), b = CollapseMesh::previous_corner(c);
        const uint32_t d = across(c);
        if (d == no_index || (may_flip_ && !may_flip_(c / 3, d / 3))) return false;
        const Vec3d pa = at(a), pb = at(b), pc = at(c), pd = at(d);
        const double dot_c = dot(pa - pc, pb - pc), dot_d = dot(pa - pd, pb - pd);
        const Vec3d n_c = area_normal(pc, pa, pb), n_d = area_normal(pd, pb, pa);
        const double size_c = length(n_c), size_d = length(n_d);
        // sin(c + d) times the four edges
        const double edges = std::sqrt(squared_length(pa - pc) * squared_length(pb - pc)) *
                             std::sqrt(squared_length(pa - pd) * squared_length(pb - pd));
        if (!(size_c * dot_d + size_d * dot_c < -least_sine * edges)) return false;
        if (dot(n_c, n_d) < crease_cosine * size_c * size_d) return false;
        const Vec3d sum = n_c + n_d;
        if (!is_sound(pa, pd, pc, sum) || !is_sound(pb, pc, pd, sum)) return false;
        // The edge's triangles in the other's order: (c, a, b) and (d, b', a').
        const uint32_t b2 = CollapseMesh::next_corner(d), a2 = CollapseMesh::previous_corner(d);
        const uint32_t wc = mesh_.corner_wedge(c), wd = mesh_.corner_wedge(d);
        const uint32_t wa = mesh_.corner_wedge(a), wb = mesh_.corner_wedge(b);
        if (wa != mesh_.corner_wedge(a2) || wb != mesh_.corner_wedge(b2)) return false;  // a seam
        if (uvs_.any() && (!uvs_.is_wound_well({wa, wd, wc}) || !uvs_.is_wound_well({wb, wc, wd})))
            return false;
        const uint32_t vc = mesh_.corner_vertex(c), vd = mesh_.corner_vertex(d);
        if (edge_uses(mesh_, vc, vd) > 0) return false;
        mesh_.set_corner(b, vd, wd);   // (c, a, d)
        mesh_.set_corner(a2, vc, wc);  // (d, b, c)
        for (const uint32_t corner : {c, a, b, d, a2, b2})
            if (is_obtuse(corner)) open_.push_back(corner);
        return true;
    }

    // The corner on the other side of the edge opposite to this one; none unless exactly two triangles meet.
    uint32_t across(uint32_t c) const {
        const uint32_t a = CollapseMesh::next_corner(c);
        const uint32_t vb = mesh_.corner_vertex(CollapseMesh::previous_corner(c));
        if (mesh_.valence(mesh_.corner_vertex(a)) > longest_ring) return no_index;
        uint32_t found = no_index;
        for (uint32_t x = mesh_.first_corner(mesh_.corner_vertex(a)); x != no_index;
             x = mesh_.corner_after(x)) {
            if (x == a) continue;
            const uint32_t next = CollapseMesh::next_corner(x), previous = CollapseMesh::previous_corner(x);
            if (mesh_.corner_vertex(next) == vb) return no_index;  // a third one
            if (mesh_.corner_vertex(previous) != vb) continue;
            if (found != no_index) return no_index;
            found = next;
        }
        return found;
    }

    static bool is_sound(Vec3d a, Vec3d b, Vec3d c, Vec3d facing) {
        const Vec3d normal = area_normal(a, b, c);
        const double longest =
            std::max({squared_length(b - a), squared_length(c - b), squared_length(a - c)});
        return length(normal) > least_aspect * longest &&
               dot(normal, facing) > crease_cosine * length(normal) * length(facing);
    }

    CollapseMesh& mesh_;
    const UvGuard& uvs_;
    const MayFlip& may_flip_;
    std::vector<uint32_t> open_;  // a queue
    size_t next_ = 0;
};

}  // namespace

uint64_t delaunay_flips(CollapseMesh& mesh, const UvGuard& uvs, const Watch& watch, const MayFlip& may_flip) {
    return Flips(mesh, uvs, may_flip).run(watch);
}

}  // namespace coppice
