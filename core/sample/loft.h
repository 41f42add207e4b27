// Closed organic shapes: rings around a spine, drawn together to a pole at either end.
#pragma once

#include <cstdint>
#include <functional>

#include "core/sample/builder.h"

namespace coppice {

struct UvBox {
    double u0 = 0, v0 = 0, u1 = 1, v1 = 1;
};

struct Loft {
    uint32_t rings = 3;     // between the poles, at least 1
    uint32_t segments = 6;  // around, at least 3
    uint32_t slot = 0;
    uint32_t smoothing = 0;
    UvBox atlas = {};  // where the charts go
    uint32_t chart_rows = 1,
             chart_columns = 1;  // charts are cut along rings and segments: these are the seams

    // s: 0 at the first pole to 1 at the last; t: around, 0..1, counter-clockwise seen from the last pole's
    // side. Must not depend on t at the poles.
    std::function<Vec3d(double s, double t)> shape = {};
    // Where true, the quad (row 0..rings, column) is left out. Optional.
    std::function<bool(uint32_t row, uint32_t column)> hole = {};
};

// 2 * rings * segments triangles on rings * segments + 2 vertices.
void add_loft(MeshBuilder& builder, const Loft& loft);

// Rings and segments for about this many triangles, the loft being `aspect` times as long as it is around.
void fit_triangles(Loft& loft, double triangles, double aspect);

// A point on a sphere: the poles are at z = -1 and 1.
Vec3d sphere_point(double s, double t);

}  // namespace coppice
