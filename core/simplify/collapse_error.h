// What collapsing an edge costs, and where its ends are put: all that differs between algorithms that
// collapse edges.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/mesh/vec.h"
#include "core/simplify/attribute_cloud.h"
#include "core/simplify/collapse_mesh.h"
#include "core/simplify/projection.h"
#include "core/simplify/vertex_kind.h"

namespace coppice {

// Part of the squared length of an edge that is added to the mean squared distance of its planes: where these
// cannot tell edges apart, short ones go first, and elsewhere it is not seen.
inline constexpr double flat_preference = 1e-6;

// Where the vertex that stays may go.
enum class Freedom : uint8_t { end_point, segment, anywhere };

struct Placed {
    Vec3d at;
    double error = 0;
};

// What the error knows of the mesh. Lives as long as the collapse.
struct CollapseParts {
    const CollapseMesh& mesh;
    std::span<const FeatureEdge> features;
    AttributeClouds& clouds;
    Projection& projection;  // scratch
    bool joins = false;      // lines may end where parts are joined
};

class CollapseError {
  public:
    CollapseError() = default;
    virtual ~CollapseError() = default;
    CollapseError(const CollapseError&) = delete;
    CollapseError& operator=(const CollapseError&) = delete;

    // Where `removed` and `kept` are best merged, and what that costs; none beyond a limit of the error's
    // own. end_point: at `kept`. joins: no edge leads from one to the other; what holds the borders there may
    // end, so it says where, but costs nothing. wedge_map as WedgeMap gives it for the pair.
    virtual std::optional<Placed> place(uint32_t removed, uint32_t kept, Freedom freedom, bool joins,
                                        const std::vector<uint32_t>& wedge_map) const = 0;
    // To be called with every collapse, before the mesh changes; the clouds' values at `kept` are the new
    // ones.
    virtual void merge(uint32_t removed, uint32_t kept, const std::vector<uint32_t>& wedge_map) = 0;
    // To be called after a join, for each vertex whose lines it has changed, with those that are left there.
    virtual void set_lines(uint32_t /*vertex*/, std::span<const FeatureEdge> /*edges*/) {}
};

// For who ranks edges otherwise: the rules alone say which collapses there are.
class NoError final : public CollapseError {
  public:
    explicit NoError(const CollapseMesh& mesh) : mesh_(mesh) {}
    std::optional<Placed> place(uint32_t, uint32_t kept, Freedom, bool,
                                const std::vector<uint32_t>&) const override {
        return Placed{mesh_.position(kept), 0};
    }
    void merge(uint32_t, uint32_t, const std::vector<uint32_t>&) override {}

  private:
    const CollapseMesh& mesh_;
};

}  // namespace coppice
