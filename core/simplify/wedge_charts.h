// Splits wedges by slot, orders them by vertex and finds charts. The part of CollapseMesh that reads
// attributes.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/watch.h"
#include "core/mesh/mesh.h"

namespace coppice {

struct WedgeCharts {
    std::vector<uint32_t> source;        // per wedge: the source's wedge
    std::vector<uint32_t> slot;          // per wedge
    std::vector<uint32_t> chart;         // per wedge: the first wedge of its chart
    std::vector<uint32_t> begin;         // per vertex + 1: its wedges
    std::vector<uint32_t> corner_wedge;  // per corner
};

// What must be alike within a chart: an attribute's components from this one on. All of it but normals and
// colours, and of a tangent the handedness (its direction follows the normal, its handedness the UV map).
size_t first_hard_component(const Attribute& attribute);

// O(wedges log wedges of a vertex).
WedgeCharts wedge_charts(const Mesh& mesh, const Watch& watch);

}  // namespace coppice
