// The paper of the surface angle (Li and Kim 2019).
#include <fmt/core.h>

#include <string>
#include <vector>

#include "bench/papers/models.h"
#include "bench/papers/tables.h"
#include "core/simplify/registry.h"
#include "tests/support/plain_obj.h"
#include "tests/support/test_assets.h"

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
    const Mesh monkey = test::read_plain_obj(*test::asset_folder() / file);
    const Mesh by_use = model(file, 0).mesh;
    const Algorithm& algorithm = find_algorithm("surface-angle");
    const auto left = [&algorithm](const Mesh& mesh, double angle) {
        const ParameterValues values = ParameterValues::parse(
            algorithm.parameters,
            {{"angle", angle}, {"pairs", "adjacent"}, {"stitch", "paper"}, {"borders", "remove"}});
        return algorithm.simplify(mesh, {}, {}, values, {}).mesh;
    };
    fmt::print(
        "{}: {} vertices, {} triangles; the paper prints 1521 and 2904, three times as many. "
        "`pairs=adjacent`, `stitch=paper`, `borders=remove`.\n\n"
        "| angle | triangles printed | a third | measured | off | vertices printed | lost, printed | "
        "vertices | "
        "lost | lost, times 3 | triangles, vertices numbered by use |\n"
        "|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n",
        file, monkey.vertex_count(), monkey.triangle_count());
    for (const Row& row : rows) {
        const Mesh mesh = left(monkey, row.angle);
        const size_t lost = monkey.vertex_count() - mesh.vertex_count();
        fmt::print("| {} | {} | {:.0f} | {} | {:+.0f} | {} | {} | {} | {} | {} | {} |\n", row.angle,
                   row.triangles, row.triangles / 3, mesh.triangle_count(),
                   static_cast<double>(mesh.triangle_count()) - row.triangles / 3, row.vertices,
                   1521 - row.vertices, mesh.vertex_count(), lost, 3 * lost,
                   left(by_use, row.angle).triangle_count());
    }
}

}  // namespace coppice::papers
