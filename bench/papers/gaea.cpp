// The paper of GAEA: its Table 1, and what its Table 2 was about.
#include <fmt/ranges.h>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "bench/papers/models.h"
#include "bench/papers/tables.h"
#include "core/simplify/codebook_family.h"
#include "core/simplify/registry.h"

namespace coppice::papers {
namespace {

// Table 1 of the GAEA paper: triangles that are left.
struct GaeaMesh {
    std::string name, file;
    uint32_t triangles;
    std::array<uint32_t, 3> printed;  // with n = 1, 3, 5
};

const std::vector<GaeaMesh>& gaea_meshes() {
    static const std::vector<GaeaMesh> list = {
        {"apple", "models/apple.ply", 1704, {1216, 1548, 1672}},
        {"cow", "models/cow.obj", 5804, {3074, 5274, 5614}},
        {"bunny", "models/stanford-bunny.obj", 69451, {17993, 37660, 48229}},
        {"dragon", "models/dragon.ply", 871414, {265776, 435814, 550340}},
    };
    return list;
}

constexpr std::array<double, 3> gaea_sizes = {1, 3, 5};

size_t gaea_leaves(const Mesh& mesh, const std::map<std::string, ParameterValue>& parameters) {
    const Algorithm& gaea = find_algorithm("gaea");
    return gaea.simplify(mesh, {}, {}, ParameterValues::parse(gaea.parameters, parameters), {})
        .mesh.triangle_count();
}

// Of meshes that are not there nothing is drawn instead: the counts say something of these meshes alone.
void print_table_1() {
    fmt::print(
        "\n### GAEA, Table 1\n\nTriangles left by one pass, printed and measured, the latter for each number "
        "of "
        "refinements (2 is the default).\n\n| mesh | triangles | n | code-vectors | printed | refine=2 | to "
        "printed | refine=0 | refine=1 | refine=3 |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const GaeaMesh& m : gaea_meshes()) {
        for (size_t i = 0; i < gaea_sizes.size(); ++i) {
            const auto n = static_cast<uint32_t>(gaea_sizes[i]);
            const size_t vectors = Codebook({n, n, n}, Warp::flat, 0).vectors().size();
            fmt::print("| {} | {} | {} | {} | {} |", m.name, m.triangles, n, vectors, m.printed[i]);
            if (!is_asset(m.file)) {
                fmt::print(" no such mesh in the assets | | | | |\n");
                continue;
            }
            const Mesh mesh = model(m.file, m.triangles).mesh;
            std::array<size_t, 4> left{};
            for (size_t refine = 0; refine < left.size(); ++refine)
                left[refine] =
                    gaea_leaves(mesh, {{"n", gaea_sizes[i]}, {"refine", static_cast<double>(refine)}});
            const double to_printed = static_cast<double>(left[2]) / m.printed[i] - 1;
            fmt::print(" {} | {:+.1f} % | {} | {} | {} |\n", left[2], 100 * to_printed, left[0], left[1],
                       left[3]);
        }
    }
}

// What stood in its Table 2, an image that is lost: iterations, and codebooks in proportion to the box.
void print_iterations() {
    fmt::print(
        "\n### GAEA, iterations\n\nTriangles left by one pass and by iterations from the same codebook to "
        "1-1-1; xyz "
        "has at most as many code-vectors as uniform.\n\n| mesh | n | uniform, code-vectors | one pass | "
        "iterated | xyz, code-vectors | one pass | iterated |\n|---|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const GaeaMesh& m : gaea_meshes()) {
        if (!is_asset(m.file)) continue;
        const Mesh mesh = model(m.file, m.triangles).mesh;
        for (const double n : gaea_sizes) {
            const std::map<std::string, ParameterValue> uniform = {{"n", n}},
                                                        xyz = {{"schema", "xyz"},
                                                               {"codebook_size", 6 * n * n}};
            const auto iterated = [](std::map<std::string, ParameterValue> parameters) {
                parameters["iterate"] = true;
                return parameters;
            };
            const CodebookFamily family(ParameterValues::parse(find_algorithm("gaea").parameters, xyz),
                                        bounds(mesh.positions));
            fmt::print("| {} | {} | {} | {} | {} | {} ({}) | {} | {} |\n", m.name, n, 6 * n * n,
                       gaea_leaves(mesh, uniform), gaea_leaves(mesh, iterated(uniform)),
                       code_vector_count(family.sizes(family.start())),
                       fmt::join(family.sizes(family.start()), "-"), gaea_leaves(mesh, xyz),
                       gaea_leaves(mesh, iterated(xyz)));
        }
    }
}

}  // namespace

void print_gaea() {
    print_table_1();
    print_iterations();
}

}  // namespace coppice::papers
