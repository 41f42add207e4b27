// gaps: C. Erikson, D. Manocha, "GAPS: General and automatic polygonal simplification", I3D 1999. Of the
// paper only the abstract could be had; formulas are those that the ITS paper (arXiv 2101.02570) prints of
// it.
//
// Idea: one error for geometry, normals, texture coordinates and colours (gaps_error.h), each in units of
// length; vertices are merged at the point of least quadric error, and attributes are interpolated on the
// surface there.
//
// Guarantees and complexity: those of quadric (garland_heckbert.h); each edge's error costs a projection onto
// the triangles around it.
//
// Departures:
//   - Scales of attributes: attribute_cloud.h; the paper's are not known.
//   - Only edges are pairs; the paper's threshold that joins what lies near each other, and its area test,
//   are not there yet.
//   - Gamma is sqrt(Q / S) with quadrics weighted by area, so that it is a length.
#pragma once

#include "core/simplify/algorithm.h"

namespace coppice {

Algorithm gaps();

}  // namespace coppice
