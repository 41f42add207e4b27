// Which wedges of several vertices become one when the vertices do.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/simplify/collapse_mesh.h"

namespace coppice {

// A triangle that vanishes holds two or three of the vertices: its corners there show which wedges lie on the
// same side of seams and hard edges, and these become one. A wedge that no such triangle holds stays what it
// is.
class WedgeGroups {
  public:
    explicit WedgeGroups(const CollapseMesh& mesh) : mesh_(mesh) {}

    // Per vertex its weight; those of an anchor (no_index: none) stay as they are and give the others their
    // values. `gone`: triangles that vanish. False when that would join charts: a seam ends or passes there.
    bool find(std::span<const uint32_t> vertices, std::span<const double> weights, uint32_t anchor,
              std::span<const uint32_t> gone);

    // After find: what the wedge that takes the place of this one is made of, and which one that is. The
    // wedge is used at one of the vertices.
    std::span<const WedgeShare> shares(uint32_t wedge) const {
        return groups_[group_of(wedge)].shares(*this);
    }
    uint32_t becomes(uint32_t wedge) const { return members_[groups_[group_of(wedge)].first].wedge; }

    template <typename Use>
    void for_each_blend(Use&& use) const {
        for (const Group& g : groups_)
            if (g.last - g.first > 1) use(g.shares(*this), members_[g.first].wedge);
    }

  private:
    struct Member {
        uint32_t wedge, vertex, root;
        double weight;
    };
    struct Group {
        uint32_t first, last;  // members, as they are in shares_
        std::span<const WedgeShare> shares(const WedgeGroups& all) const {
            return std::span(all.shares_).subspan(first, last - first);
        }
    };

    uint32_t member(uint32_t wedge) const;
    uint32_t root(uint32_t i);
    void gather(std::span<const uint32_t> vertices, std::span<const double> weights);
    void unite_along(std::span<const uint32_t> gone);
    bool fill_shares(uint32_t anchor);
    uint32_t group_of(uint32_t wedge) const;

    const CollapseMesh& mesh_;
    std::vector<Member> members_;
    std::vector<Group> groups_;
    std::vector<WedgeShare> shares_;  // one per member
};

}  // namespace coppice
