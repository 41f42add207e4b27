// GAEA, sections 2.2 and 2.3: patches of triangles that face about the same way lose the vertices inside.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/watch.h"
#include "core/simplify/cheapest_first.h"
#include "core/simplify/codebook.h"
#include "core/simplify/edge_collapse.h"
#include "core/simplify/normal_patches.h"

namespace coppice {

struct PatchOptions {
    Warp warp = Warp::flat;
    uint32_t refinements = 2;  // of the codebook, see NormalPatches::group
    bool triangulate = false;  // patches get the Delaunay triangulation of what is left of them
};

class PatchCollapse {
  public:
    // Keeps references. Patches are those of the mesh as it is now, for one run.
    PatchCollapse(EdgeCollapse& work, const PatchOptions& options, const Watch& watch);

    // Vertices inside patches, for a search.
    uint32_t count_inside(const CodebookSizes& sizes);
    // The same before patches are refined, by a sample: about, and quick.
    double estimate_inside(const CodebookSizes& sizes) const;

    // Collapses them into those at the edge of their patch, which never move: the shortest edge first, until
    // none is left or the work is done.
    void run(const CodebookSizes& sizes);

    // As CheapestFirst asks; vertices inside own the edges to those at the edge of their patch.
    const CollapseMesh& mesh() const { return mesh_; }
    bool done() const { return work_.done(); }
    double fraction() const { return work_.fraction(); }
    void forget_refusals() { work_.forget_refusals(); }
    Candidate next_candidate(uint32_t owner, std::optional<Candidate> after);
    std::optional<double> cost(uint32_t owner, uint32_t other) const;
    std::optional<Collapsed> try_collapse(uint32_t owner, uint32_t other) {
        return work_.try_collapse(owner, other);
    }
    void ring(uint32_t vertex, std::vector<uint32_t>& out) { work_.ring(vertex, out); }

  private:
    void group(const CodebookSizes& sizes);
    void seed_closed_patches();
    bool is_removable(uint32_t vertex) const;
    double edge_length(uint32_t a, uint32_t b) const;

    EdgeCollapse& work_;
    const CollapseMesh& mesh_;
    PatchOptions options_;
    const Watch& watch_;
    NormalPatches patches_;
    std::vector<bool> inside_;  // per vertex
    std::vector<uint32_t> ring_;
};

}  // namespace coppice
