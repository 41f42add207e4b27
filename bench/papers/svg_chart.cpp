#include "bench/papers/svg_chart.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace coppice::papers {
namespace {

// Pixels.
constexpr double panel_width = 440, panel_height = 400, gap = 30, left = 64, top = 64, bottom = 52,
                 right = 16;
constexpr double radius = 4, letter = 7.2, line = 13;

struct Axis {
    double least = 0, most = 0;  // values
    double length = 0;           // pixels

    double at(double value) const { return length * std::log(value / least) / std::log(most / least); }
};

struct Axes {
    Axis x, y;
};

Axes axes_of(const Chart& chart) {
    Axes axes = {{1e300, 0, panel_width}, {1e300, 0, panel_height}};
    for (const ChartPanel& panel : chart.panels) {
        for (const ChartPoint& p : panel.points) {
            axes.x = {std::min(axes.x.least, p.x), std::max(axes.x.most, p.x), panel_width};
            axes.y = {std::min(axes.y.least, p.y), std::max(axes.y.most, p.y), panel_height};
        }
    }
    for (Axis* axis : {&axes.x, &axes.y}) {  // room around the outermost, on the right for a label
        axis->least /= 1.4;
        axis->most *= axis == &axes.x ? 2 : 1.4;
    }
    return axes;
}

// 1, 2, 5, 10, ...
std::vector<double> ticks(const Axis& axis) {
    std::vector<double> result;
    double decade = std::pow(10, std::floor(std::log10(axis.least)));
    while (decade < axis.most) {
        for (const double step : {1, 2, 5}) {
            if (decade * step >= axis.least && decade * step <= axis.most) result.push_back(decade * step);
        }
        decade *= 10;
    }
    return result;
}

struct Box {
    double x = 0, y = 0, width = 0, height = 0;

    bool overlaps(const Box& o) const {
        return x < o.x + o.width && o.x < x + width && y < o.y + o.height && o.y < y + height;
    }
    bool is_inside(const Axes& axes) const {
        return x >= 0 && y >= 0 && x + width <= axes.x.length && y + height <= axes.y.length;
    }
};

// Beside the point where that is free, else ever farther from it.
Box place_label(const Box& point, double width, const std::vector<Box>& taken, const Axes& axes) {
    const double x = point.x + point.width / 2, y = point.y + point.height / 2;
    for (int tried = 0; tried < 32; ++tried) {
        const double away = 8 + 6 * tried;
        for (const double turn :
             {0.0, 1.0, -0.25, 0.25, -0.75, 0.75, -0.5, 0.5}) {  // of half a circle, 0: right
            const double along = std::cos(turn * M_PI), up = std::sin(turn * M_PI);
            const Box box = {x + along * away -
                                 (along < -0.1  ? width
                                  : along > 0.1 ? 0
                                                : width / 2),
                             y + up * away - line / 2, width, line};
            const auto hits = [&](const Box& other) { return box.overlaps(other); };
            if (box.is_inside(axes) && std::none_of(taken.begin(), taken.end(), hits)) return box;
        }
    }
    return {x, y, width, line};
}

std::string grid(const Axes& axes, bool with_y_numbers) {
    std::string svg =
        fmt::format("<rect class=\"frame\" width=\"{}\" height=\"{}\"/>\n", panel_width, panel_height);
    for (const double value : ticks(axes.x)) {
        const double x = axes.x.at(value);
        svg += fmt::format(
            "<path class=\"grid\" d=\"M{:.1f} 0V{}\"/><text x=\"{:.1f}\" y=\"{}\" "
            "text-anchor=\"middle\">{:g}</text>\n",
            x, panel_height, x, panel_height + 16, value);
    }
    for (const double value : ticks(axes.y)) {
        const double y = panel_height - axes.y.at(value);
        svg += fmt::format("<path class=\"grid\" d=\"M0 {:.1f}H{}\"/>\n", y, panel_width);
        if (with_y_numbers)
            svg += fmt::format("<text x=\"-6\" y=\"{:.1f}\" text-anchor=\"end\">{:g}</text>\n", y + 4, value);
    }
    return svg;
}

std::string points(const ChartPanel& panel, const Axes& axes) {
    std::vector<Box> taken;
    for (const ChartPoint& p : panel.points)
        taken.push_back(
            {axes.x.at(p.x) - radius, panel_height - axes.y.at(p.y) - radius, 2 * radius, 2 * radius});
    std::string svg;
    for (size_t i = 0; i < panel.points.size(); ++i) {
        const double x = taken[i].x + radius, y = taken[i].y + radius;
        const std::string& text = panel.points[i].label;
        const Box label = place_label(taken[i], letter * static_cast<double>(text.size()), taken, axes);
        taken.push_back(label);
        const double near_x = std::clamp(x, label.x, label.x + label.width);
        const double near_y = std::clamp(y, label.y, label.y + label.height);
        if (std::hypot(near_x - x, near_y - y) > 2 * line)
            svg += fmt::format("<path class=\"leader\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>", x, y, near_x,
                               near_y);
        svg += fmt::format(
            "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"/><text class=\"label\" x=\"{:.1f}\" "
            "y=\"{:.1f}\">{}</text>\n",
            x, y, radius, label.x, label.y + 10, text);
    }
    return svg;
}

// Colours of its own ground, so that a page of either kind, whatever it tells its images, can be read.
constexpr const char* style =
    "text{font:11px system-ui,sans-serif;fill:#57606a}.label,.title{fill:#1f2328}.title{font-size:14px}\n"
    ".ground{fill:#fff}.frame{fill:none;stroke:#8c959f}.grid{stroke:#d8dee4}.leader{stroke:#8c959f}circle{"
    "fill:#0969da}\n"
    "@media(prefers-color-scheme:dark){text{fill:#9198a1}.label,.title{fill:#f0f6fc}.ground{fill:#0d1117}\n"
    ".frame{stroke:#656c76}.grid{stroke:#2a313c}.leader{stroke:#656c76}circle{fill:#4493f8}}\n";

}  // namespace

std::string to_svg(const Chart& chart) {
    const auto panels = static_cast<double>(chart.panels.size());
    const double width = left + panels * panel_width + (panels - 1) * gap + right;
    const double height = top + panel_height + bottom;
    const Axes axes = axes_of(chart);
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n"
        "<style>{}</style>\n<rect class=\"ground\" width=\"{}\" height=\"{}\"/>\n"
        "<text class=\"title\" x=\"{}\" y=\"24\">{}</text>\n"
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n"
        "<text transform=\"translate(18 {})rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        width, height, chart.title, style, width, height, left, chart.title, width / 2, height - 12,
        chart.x_title, top + panel_height / 2, chart.y_title);
    for (size_t i = 0; i < chart.panels.size(); ++i) {
        svg += fmt::format("<g transform=\"translate({} {})\">\n<text class=\"label\" y=\"-8\">{}</text>\n",
                           left + static_cast<double>(i) * (panel_width + gap), top, chart.panels[i].title);
        svg += grid(axes, i == 0) + points(chart.panels[i], axes) + "</g>\n";
    }
    return svg + "</svg>\n";
}

}  // namespace coppice::papers
