// The paper of the surface angle (Li and Kim 2019).
#include <fmt/core.h>

#include <string>
#include <vector>

#include "bench/papers/models.h"
#include "bench/papers/tables.h"
#include "core/simplify/registry.h"

namespace coppice::papers {

// Table 1 of the surface angle paper. Its counts are three times those of its model: lengths of arrays.
void print_surface_angle() {
    struct Row {
        double angle;
        double vertices, triangles;  // as printed
    };
    const std::vector<Row> rows = {{30, 1329, 2562}, {60, 1373, 2574}, {120, 1430, 2691}, {150, 1486, 2832}};
    const std::string file = "models/suzanne.obj";
    fmt::print("\n### Surface angle, Table 1\n\n");
    if (!is_asset(file)) {
        fmt::print("{} is not there, and nothing can stand in for it.\n", file);
        return;
    }
    const Mesh monkey = model(file, 0).mesh;
    const Algorithm& algorithm = find_algorithm("surface-angle");
    fmt::print(
        "{}: {} triangles and {} vertices, since two of its 507 are equal to others and welded; the paper "
        "prints "
        "2904 and 1521, three times as many. `pairs=adjacent`, `stitch=paper`, `borders=remove`.\n\n"
        "| angle | triangles printed | a third | measured | off | vertices printed | lost, printed | "
        "vertices | "
        "lost | lost, times 3 |\n"
        "|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n",
        file, monkey.triangle_count(), monkey.vertex_count());
    for (const Row& row : rows) {
        const ParameterValues values = ParameterValues::parse(
            algorithm.parameters,
            {{"angle", row.angle}, {"pairs", "adjacent"}, {"stitch", "paper"}, {"borders", "remove"}});
        const Mesh mesh = algorithm.simplify(monkey, {}, {}, values, {}).mesh;
        const size_t lost = monkey.vertex_count() - mesh.vertex_count();
        fmt::print("| {} | {} | {:.0f} | {} | {:+.0f} | {} | {} | {} | {} | {} |\n", row.angle, row.triangles,
                   row.triangles / 3, mesh.triangle_count(),
                   static_cast<double>(mesh.triangle_count()) - row.triangles / 3, row.vertices,
                   1521 - row.vertices, mesh.vertex_count(), lost, 3 * lost);
    }
}

}  // namespace coppice::papers
