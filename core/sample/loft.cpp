#include "core/sample/loft.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coppice {

namespace {

struct Chart {
    uint32_t first_row, last_row, first_column, last_column;  // of the grid of corners
    UvBox box;
};

Chart chart_at(const Loft& loft, uint32_t row, uint32_t column) {
    const uint32_t rows = loft.rings + 1;
    const uint32_t r = row * loft.chart_rows / rows, c = column * loft.chart_columns / loft.segments;
    const auto first = [](uint32_t index, uint32_t total, uint32_t charts) {
        return (index * total + charts - 1) / charts;
    };
    const double margin = 0.02;  // between charts, so that filtering does not bleed from one into another
    const double width = (loft.atlas.u1 - loft.atlas.u0) / loft.chart_columns;
    const double height = (loft.atlas.v1 - loft.atlas.v0) / loft.chart_rows;
    const double u0 = loft.atlas.u0 + c * width, v0 = loft.atlas.v0 + r * height;
    return {
        first(r, rows, loft.chart_rows),
        first(r + 1, rows, loft.chart_rows),
        first(c, loft.segments, loft.chart_columns),
        first(c + 1, loft.segments, loft.chart_columns),
        {u0 + margin * width, v0 + margin * height, u0 + (1 - margin) * width, v0 + (1 - margin) * height}};
}

Corner corner_at(const Loft& loft, const Chart& chart, uint32_t row, uint32_t column) {
    const bool pole = row == 0 || row == loft.rings + 1;
    const double s = static_cast<double>(row) / (loft.rings + 1);
    const double t = pole ? 0 : static_cast<double>(column % loft.segments) / loft.segments;
    const double x =
        pole ? 0.5
             : static_cast<double>(column - chart.first_column) / (chart.last_column - chart.first_column);
    const double y = static_cast<double>(row - chart.first_row) / (chart.last_row - chart.first_row);
    return {.position = loft.shape(s, t),
            .u = chart.box.u0 + x * (chart.box.u1 - chart.box.u0),
            .v = chart.box.v0 + y * (chart.box.v1 - chart.box.v0),
            .smoothing = loft.smoothing};
}

}  // namespace

void add_loft(MeshBuilder& builder, const Loft& loft) {
    for (uint32_t row = 0; row <= loft.rings; ++row) {
        for (uint32_t column = 0; column < loft.segments; ++column) {
            if (loft.hole && loft.hole(row, column)) continue;
            const Chart chart = chart_at(loft, row, column);
            const auto at = [&](uint32_t r, uint32_t c) { return corner_at(loft, chart, r, c); };
            if (row == 0) {
                builder.triangle(loft.slot, at(0, column), at(1, column + 1), at(1, column));
            } else if (row == loft.rings) {
                builder.triangle(loft.slot, at(row, column), at(row, column + 1), at(row + 1, column));
            } else {
                builder.quad(loft.slot, at(row, column), at(row, column + 1), at(row + 1, column + 1),
                             at(row + 1, column));
            }
        }
    }
}

void fit_triangles(Loft& loft, double triangles, double aspect) {
    const double rings = std::sqrt(triangles * aspect / 2);
    loft.rings = static_cast<uint32_t>(std::max(std::lround(rings), 1L));
    loft.segments = static_cast<uint32_t>(std::max(std::lround(triangles / (2.0 * loft.rings)), 3L));
}

Vec3d sphere_point(double s, double t) {
    const double polar = std::numbers::pi * s, azimuth = 2 * std::numbers::pi * t;
    return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), -std::cos(polar)};
}

}  // namespace coppice
