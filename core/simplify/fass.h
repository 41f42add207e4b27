// FASS: face angle spherical scanning. H. Li, S. Kim, Mesh simplification algorithms for rendering
// performance, IJERT 2020.
//
// Idea: fad, then ss. A round of fad.h takes vertices out of what is flat, which no ball could tell from
// tips; ss.h merges what then still lies close.
//
// The first stage is one round, at the angle given or 150 degrees; a vertex at which any angle is smaller (a
// tip, a crease) never goes in it. The second has the radius given, 0.8 mean edges of the original without
// any target, or the one that meets it, found by search. threshold_used is that of the stage that came last:
// the radius, or the angle where the target was met before. Guarantees: those of both: no new non-manifold
// edge, no flipped, degenerate or duplicate triangle; borders, seams and the box stay; attributes as in ss.h.
// Where the original has texture beside what has none, the second stage may mirror a sliver: how the texture
// is wound it knows from what the first left. With neighborhood=euclidean the second stage is unguarded, as
// printed. The estimates of the error add up.
//
// Complexity: O(F log F) time, about 200 bytes per triangle.
#pragma once

#include "core/simplify/algorithm.h"

namespace coppice {

Algorithm fass();

}  // namespace coppice
