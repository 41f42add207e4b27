// Each algorithm's surface error and time beside the others, on one mesh at equal triangle counts: a table
// and a chart.
#include <fmt/core.h>

#include <string>
#include <vector>

#include "bench/papers/measure.h"
#include "bench/papers/models.h"
#include "bench/papers/svg_chart.h"
#include "bench/papers/tables.h"
#include "core/compare/compare_scenes.h"
#include "core/mesh/bounds.h"

namespace coppice::papers {
namespace {

struct Measured {
    std::string_view algorithm;
    Simplified result;
    double milliseconds = 0;
    SurfaceComparison surface;
};

struct Level {
    double kept;
    std::vector<Measured> all;
};

struct Errors {
    Model model;
    double diagonal = 0;
    std::vector<Level> levels;
};

std::vector<Measured> measure(const Mesh& mesh, uint64_t triangles) {
    std::vector<Measured> all(algorithms().size());
    std::vector<std::vector<double>> times(all.size());
    for (int run = 0; run < 3; ++run) {
        for (size_t a = 0; a < all.size(); ++a)
            times[a].push_back(
                cpu_milliseconds([&] { all[a].result = simplify(algorithms()[a], mesh, triangles); }));
    }
    for (size_t a = 0; a < all.size(); ++a) {
        all[a].algorithm = algorithms()[a].id;
        all[a].milliseconds = median(times[a]);
        all[a].surface = compare_meshes(mesh, all[a].result.mesh, {}, {});
    }
    return all;
}

Errors measure() {
    Errors errors = {model("models/stanford-bunny.obj", 69451), 0, {}};
    const Mesh& mesh = errors.model.mesh;
    errors.diagonal = bounds(mesh.positions).diagonal();
    for (const double kept : {0.5, 0.2})
        errors.levels.push_back(
            {kept, measure(mesh, static_cast<uint64_t>(kept * static_cast<double>(mesh.triangle_count())))});
    return errors;
}

}  // namespace

void print_errors() {
    const Errors errors = measure();
    fmt::print(
        "\n### Errors of all algorithms\n\n{}, {} triangles; surface distances (of the larger direction) in "
        "per mille "
        "of the diagonal, ms of processor time, medians of 3.\n\n"
        "| kept | algorithm | triangles | stopped for | root mean square | largest | facets, mean degrees | "
        "ms "
        "|\n|---:|---|---:|---|---:|---:|---:|---:|\n",
        errors.model.name, errors.model.mesh.triangle_count());
    for (const Level& level : errors.levels) {
        for (const Measured& m : level.all) {
            fmt::print("| {:.0f} % | {} | {} | {} | {:.4f} | {:.2f} | {:.2f} | {:.0f} |\n", 100 * level.kept,
                       m.algorithm, m.result.mesh.triangle_count(), name(m.result.stop_reason),
                       1000 * m.surface.symmetric.root_mean_square / errors.diagonal,
                       1000 * m.surface.symmetric.largest / errors.diagonal, m.surface.facets->mean,
                       m.milliseconds);
        }
    }
}

void print_chart() {
    const Errors errors = measure();
    Chart chart = {
        fmt::format("Surface error and time, bunny of {} triangles", errors.model.mesh.triangle_count()),
        "processor time, ms",
        "root mean square distance, per mille of the diagonal",
        {}};
    for (const Level& level : errors.levels) {
        ChartPanel panel = {fmt::format("{:.0f} % of the triangles kept", 100 * level.kept), {}};
        for (const Measured& m : level.all)
            panel.points.push_back({std::string(m.algorithm), m.milliseconds,
                                    1000 * m.surface.symmetric.root_mean_square / errors.diagonal});
        chart.panels.push_back(std::move(panel));
    }
    fmt::print("{}", to_svg(chart));
}

}  // namespace coppice::papers
