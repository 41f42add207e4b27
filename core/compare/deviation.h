// How far a surface is from another, in place and in looks: one direction of a comparison.
//
// Distances are Metro's (Cignoni, Rocchini, Scopigno 1998): from points of one surface to the nearest point
// of the other. Mean and root mean square are over area-uniform samples; vertices and samples along edges,
// where the largest distances often are, count for the largest alone. The largest found is a lower bound of
// the true one; distance_bounds() has an upper bound too.
//
// Looks are compared at the same matched points:
// - normals: the angle between the two interpolated vertex normals, and between the triangles' own;
// - texture: the length of the difference of TEXCOORD_0;
// - colours: that of the difference of COLOR_0, linear RGBA in 0..1.
// Points of the other surface that are as near as the nearest one (to 1e-6 of its diagonal) match as well,
// and the best of them counts: where sheets coincide, or at an edge, which of them comes first means nothing.
// Where a texture has a seam, the nearest point may lie beyond it, in another chart; then the nearest one on
// this side is meant. It is found as the point that is least far when distance counts several times as much
// as texture times its scale, within a hundredth of the diagonal: crossing a chart costs more than the way
// around the seam, but sliding along the surface never pays.
#pragma once

#include "core/compare/bvh.h"
#include "core/compare/moments.h"
#include "core/compare/surface_samples.h"

namespace coppice {

struct Deviation {
    Moments distance;  // model units
    Angles facets;     // degrees, between the triangles
    Angles normals;    // degrees, between vertex normals; empty where not both surfaces have them
    Moments texture;   // texture units; empty as above
    Moments colors;    // empty as above

    void add(const Deviation& other);
};

struct SearchedSurface {
    const Surface& surface;
    const Bvh& bvh;
    double diagonal = 0;
};

// Sampling of one surface; see surface_samples.h.
struct Sampling {
    uint64_t count = 0;  // of area-uniform points; a fifth as many go along the edges
    uint64_t seed = 1;
};

// texture_scale: model units of one texture unit, for finding the right side of a seam. Both surfaces have
// triangles. Bit-identical for any number of threads. O(samples log triangles).
Deviation measure_deviation(const Surface& from, const SearchedSurface& to, double texture_scale,
                            const Sampling& sampling, unsigned threads, const Watch& watch);

// sqrt(area / area in the texture), over the triangles with texture coordinates; 0 where there is none.
double texture_scale(const Surface& surface, const Watch& watch);

}  // namespace coppice
