// How far one scene is from another: the whole of the surface part of a comparison.
//
// Where both place the same meshes at the same places (find_correspondence), each unique mesh is measured
// once, in its own frame, and counts with its instances; so a scene of thousands costs what its few meshes
// cost. A distance is then that to the same mesh, never to another that happens to stand nearer. Angles,
// texture and colours are those in the mesh's frame: a transform that stretches would change the angles.
// Otherwise every instance is placed in the world, and the two scenes are measured as one surface each.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/compare/elements.h"
#include "core/compare/facing.h"
#include "core/compare/options.h"
#include "core/compare/self_intersections.h"
#include "core/scene/scene.h"

namespace coppice {

struct Spread {
    double largest = 0, mean = 0, root_mean_square = 0;
};

struct AngleSpread {
    double largest = 0, mean = 0, percentile_95 = 0;  // degrees
};

struct SurfaceComparison {
    Spread reference_to_candidate, candidate_to_reference;  // model units
    Spread symmetric;                                       // the larger of both
    // Over the matched points of both directions; none where not both have it.
    std::optional<AngleSpread> facets;          // between the triangles' own normals
    std::optional<AngleSpread> normals;         // between vertex normals
    std::optional<Spread> texture;              // texture units
    std::optional<Spread> texture_model_units;  // times what a texture unit is long on the reference
    std::optional<Spread> colors;               // linear RGBA, 0..1
    Flips flips;  // of the candidate; instances are not counted where each mesh was measured once
};

struct MeshComparison {
    std::string name;
    uint64_t instances = 0;
    double largest_scale = 0;   // of its instances
    SurfaceComparison surface;  // in the mesh's own frame
};

// Of one of the scenes, over its unique meshes, each in its own frame and once.
struct SceneElements {
    Elements elements;
    std::optional<SelfIntersections> self_intersections;  // where asked for
};

struct SceneComparison {
    double diagonal = 0;  // of the reference's box, model units
    SurfaceComparison surface;
    SceneElements reference, candidate;
    bool is_by_mesh = false;             // each unique mesh once; else the scenes were expanded
    std::vector<MeshComparison> meshes;  // where by mesh: those that have triangles and stand somewhere
};

// most_triangles: that may be compared where the scenes have to be expanded, of each. Throws asset_no_surface
// where one of them draws no triangle, asset_too_large over that limit. Bit-identical for any number of
// threads, and whatever the order of a mesh's triangles (but for the last digits of area and volume).
// Swapping the scenes swaps the two directions; the texture's scale and the diagonal are the reference's.
// Stops within 50 ms.
SceneComparison compare_scenes(const Scene& reference, const Scene& candidate, const CompareOptions& options,
                               uint64_t most_triangles, const Watch& watch);

// The same of two meshes that have triangles, in one frame.
SurfaceComparison compare_meshes(const Mesh& reference, const Mesh& candidate, const CompareOptions& options,
                                 const Watch& watch);

}  // namespace coppice
