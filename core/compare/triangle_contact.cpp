#include "core/compare/triangle_contact.h"

#include <cstddef>
#include <optional>

#include "core/compare/orientation.h"

namespace coppice {

namespace {

// A plane of two coordinates in which a triangle keeps an area, so that what lies in its plane can be looked
// at there.
class Projection {
  public:
    // None where the triangle is flat.
    static std::optional<Projection> of(const TriangleCorners& t) {
        for (size_t dropped = 0; dropped < 3; ++dropped) {
            const Projection along(dropped);
            if (orientation(along(t[0]), along(t[1]), along(t[2])) != 0) return along;
        }
        return {};
    }

    Point2f operator()(Vec3f p) const {
        return dropped_ == 0 ? Point2f{p.y, p.z} : (dropped_ == 1 ? Point2f{p.z, p.x} : Point2f{p.x, p.y});
    }

  private:
    explicit Projection(size_t dropped) : dropped_(dropped) {}

    size_t dropped_;
};

bool is_between(float x, float a, float b) {
    return (a <= x && x <= b) || (b <= x && x <= a);
}

// p is on the line through a and b.
bool is_on_segment(Point2f p, Point2f a, Point2f b) {
    return is_between(p.x, a.x, b.x) && is_between(p.y, a.y, b.y);
}

bool segments_meet(Point2f a, Point2f b, Point2f c, Point2f d) {
    const int abc = orientation(a, b, c), abd = orientation(a, b, d);
    const int cda = orientation(c, d, a), cdb = orientation(c, d, b);
    if (abc * abd < 0 && cda * cdb < 0) return true;
    return (abc == 0 && is_on_segment(c, a, b)) || (abd == 0 && is_on_segment(d, a, b)) ||
           (cda == 0 && is_on_segment(a, c, d)) || (cdb == 0 && is_on_segment(b, c, d));
}

bool is_inside(Point2f p, const std::array<Point2f, 3>& t) {
    const int a = orientation(t[0], t[1], p), b = orientation(t[1], t[2], p), c = orientation(t[2], t[0], p);
    return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

// All five points are in one plane.
bool meet_in_plane(Vec3f p, Vec3f q, const TriangleCorners& t) {
    const std::optional<Projection> onto = Projection::of(t);
    if (!onto) return false;
    const std::array<Point2f, 3> corners = {(*onto)(t[0]), (*onto)(t[1]), (*onto)(t[2])};
    const Point2f from = (*onto)(p), to = (*onto)(q);
    if (is_inside(from, corners) || is_inside(to, corners)) return true;
    return segments_meet(from, to, corners[0], corners[1]) ||
           segments_meet(from, to, corners[1], corners[2]) || segments_meet(from, to, corners[2], corners[0]);
}

bool segment_meets(Vec3f p, Vec3f q, const TriangleCorners& t) {
    const int side_p = orientation(t[0], t[1], t[2], p), side_q = orientation(t[0], t[1], t[2], q);
    if (side_p * side_q > 0) return false;
    if (side_p == 0 && side_q == 0) return meet_in_plane(p, q, t);
    // The line crosses the plane in one point: on which side of the three edges?
    const int a = orientation(p, q, t[0], t[1]), b = orientation(p, q, t[1], t[2]),
              c = orientation(p, q, t[2], t[0]);
    return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

// Rotated so that its corner number `first` is the first.
TriangleCorners from_corner(const TriangleCorners& t, size_t first) {
    return {t[first], t[(first + 1) % 3], t[(first + 2) % 3]};
}

// They share corner 0 of both: what else they have in common, the opposite edge of one of them has with the
// other.
bool meet_around_corner(const TriangleCorners& t, const TriangleCorners& u) {
    return segment_meets(t[1], t[2], u) || segment_meets(u[1], u[2], t);
}

// They share the edge opposite to corner 0 of both: else they meet where one is folded back onto the other.
bool meet_along_edge(const TriangleCorners& t, const TriangleCorners& u) {
    if (orientation(t[0], t[1], t[2], u[0]) != 0) return false;
    const std::optional<Projection> onto = Projection::of(t);
    if (!onto) return false;
    const Point2f a = (*onto)(t[1]), b = (*onto)(t[2]);
    return orientation(a, b, (*onto)(t[0])) == orientation(a, b, (*onto)(u[0]));
}

bool meet_apart(const TriangleCorners& t, const TriangleCorners& u) {
    for (size_t i = 0; i < 3; ++i) {
        if (segment_meets(t[i], t[(i + 1) % 3], u) || segment_meets(u[i], u[(i + 1) % 3], t)) return true;
    }
    return false;
}

bool is_one_sided(const TriangleCorners& t, const TriangleCorners& u) {
    const int first = orientation(t[0], t[1], t[2], u[0]);
    return first != 0 && orientation(t[0], t[1], t[2], u[1]) == first &&
           orientation(t[0], t[1], t[2], u[2]) == first;
}

}  // namespace

bool is_flat(const TriangleCorners& t) {
    return !Projection::of(t);
}

bool meet_elsewhere(const TriangleCorners& t, const TriangleCorners& u) {
    if (is_one_sided(t, u) || is_one_sided(u, t)) return false;
    // Which corners are shared: pairs of one of t and one of u.
    std::array<std::array<size_t, 2>, 3> shared{};
    size_t count = 0;
    for (size_t i = 0; i < 3; ++i) {
        for (size_t j = 0; j < 3; ++j) {
            if (t[i] == u[j]) shared[count++] = {i, j};
        }
    }
    switch (count) {
        case 0:
            return meet_apart(t, u);
        case 1:
            return meet_around_corner(from_corner(t, shared[0][0]), from_corner(u, shared[0][1]));
        case 2:
            return meet_along_edge(from_corner(t, 3 - shared[0][0] - shared[1][0]),
                                   from_corner(u, 3 - shared[0][1] - shared[1][1]));
        default:
            return false;
    }
}

}  // namespace coppice
