// Keeps borders and seams where they are: however many of its vertices go, a line stays within a tolerance of
// where it was at the start.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/simplify/collapse_mesh.h"
#include "core/simplify/vertex_kind.h"

namespace coppice {

// Borders and seams may move by 5 % of the diagonal; rounding in writers needs a little of that.
inline constexpr double line_tolerance_of_diagonal = 0.049;

// What quadrics weigh against everything else, this limits: a target that can only be met by cutting the
// corner off a square sheet, or off a box with a seam around it, is not met.
class LineGuard {
  public:
    // tolerance in mesh units.
    LineGuard(const CollapseMesh& mesh, const Features& features, double tolerance, const Watch& watch = {});

    // Cosine of the angle by which its line turns at a vertex; 1 off lines.
    double turn_cosine(uint32_t vertex) const;

    // Whether the line of `removed`, drawn straight from `kept` to its other neighbour, is near enough. True
    // for vertices of no line.
    bool may_remove(uint32_t removed, uint32_t kept) const;
    void remove(uint32_t removed, uint32_t kept);

    // The same for several vertices, two or more of them on a line or at its end, that become one at a point
    // of their stretch of it. They must be neighbours along one line, and not all of it.
    bool may_merge(std::span<const uint32_t> vertices, Vec3d point) const;
    void merge(std::span<const uint32_t> vertices, uint32_t kept, Vec3d point);

    // The same for vertices of several lines, or of none, that become one anywhere. What goes through the
    // vertex that stays is to be told then, and for all other vertices whose edges became one: the two
    // neighbours along the line, or none where no line goes through it any more.
    bool may_join(std::span<const uint32_t> vertices, Vec3d point) const {
        return away_joined(vertices, point) <= tolerance_;
    }
    void join(std::span<const uint32_t> vertices, uint32_t kept, Vec3d point);
    void set_line(uint32_t vertex, std::span<const uint32_t> neighbours);

  private:
    // Where the line goes from a vertex, and a bound on how far that edge is from the original line.
    struct Next {
        uint32_t vertex = no_index;
        double away = 0;
    };
    using Both = std::array<Next, 2>;

    // Neighbours along a line, with where the line goes on at both ends; no vertex where it ends among them.
    struct Stretch {
        std::array<uint32_t, 2> outermost = {no_index, no_index};
        Both beyond = {};
        double away = 0;  // once they are one
    };
    std::optional<Stretch> stretch(std::span<const uint32_t> vertices, Vec3d point) const;

    // The neighbours of `removed` with `kept` first; none where they are no neighbours on a line.
    std::optional<Both> along(uint32_t removed, uint32_t kept) const;
    double away_without(uint32_t removed, const Both& ends) const;
    double away_joined(std::span<const uint32_t> vertices, Vec3d point) const;
    void relink(uint32_t vertex, uint32_t from, Next to);

    const CollapseMesh& mesh_;
    double tolerance_;
    std::vector<bool> on_line_;  // per vertex: a border or a seam passes through it
    std::vector<Both> next_;     // per vertex; of those alone, but `away` of any
};

}  // namespace coppice
