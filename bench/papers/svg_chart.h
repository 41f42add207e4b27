// A chart of points with labels, on logarithmic axes: one panel for each set, side by side. SVG without
// scripts or fonts of its own, readable on light and dark pages.
#pragma once

#include <string>
#include <vector>

namespace coppice::papers {

struct ChartPoint {
    std::string label;
    double x = 1, y = 1;  // positive
};

struct ChartPanel {
    std::string title;
    std::vector<ChartPoint> points;
};

struct Chart {
    std::string title;
    std::string x_title, y_title;
    std::vector<ChartPanel> panels;  // with the same axes, wide enough for all points
};

std::string to_svg(const Chart& chart);

}  // namespace coppice::papers
