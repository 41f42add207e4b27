// gaps: C. Erikson, D. Manocha, "GAPS: General and automatic polygonal simplification", I3D 1999. Of the
// paper only the abstract could be had; formulas are those that the ITS paper (arXiv 2101.02570) prints of
// it.
//
// Idea: one error for geometry, normals, texture coordinates and colours (gaps_error.h), each in units of
// length; vertices are merged at the point of least quadric error, and attributes are interpolated on the
// surface there. What is not connected is joined where it lies near each other, nearer than a threshold that
// grows.
//
// Guarantees and complexity: those of quadric (garland_heckbert.h); each edge's error costs a projection onto
// the triangles around it.
//
// Departures:
//   - Scales of attributes: attribute_cloud.h; the paper's are not known.
//   - Pairs without an edge are vertices of open borders alone, see quadric; what the paper says of where its
//   threshold starts and of its area test is not known. The threshold doubles once nothing is left to merge,
//   until that saves less than a triangle in fifty; by what ITS says of it, it grows with the error, too, but
//   what lies on one plane is then joined over any distance before edges are, and ends with more triangles. A
//   merge without an edge may change the area around it by area_tolerance of itself, and by no more than a
//   disc of the pair distance.
//   - Gamma is sqrt(Q / S) with quadrics weighted by area, so that it is a length.
#pragma once

#include "core/simplify/algorithm.h"

namespace coppice {

Algorithm gaps();

}  // namespace coppice
