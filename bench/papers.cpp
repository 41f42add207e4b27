// What the papers printed, beside what our algorithms do: tables in markdown.
//
//   build/release/bench/bench_papers          all tables
//   build/release/bench/bench_papers growth   how time grows, up to 4 million triangles; takes minutes
//
// Meshes of the papers are taken from the test assets where these are there, else drawn with as many
// triangles; the table says which.
#include <fmt/ranges.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "core/optimize/optimize.h"
#include "core/sample/sample.h"
#include "core/simplify/codebook_family.h"
#include "core/simplify/registry.h"
#include "tests/support/test_assets.h"

namespace coppice {
namespace {

constexpr int runs = 5;

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

// Of this thread alone: other programs on the machine count little.
double cpu_milliseconds(const std::function<void()>& work) {
    timespec before{}, after{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &before);
    work();
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &after);
    return 1e3 * static_cast<double>(after.tv_sec - before.tv_sec) +
           1e-6 * static_cast<double>(after.tv_nsec - before.tv_nsec);
}

struct Model {
    std::string name;
    Mesh mesh;
};

bool is_asset(const std::string& file) {
    return test::asset_folder() && std::filesystem::is_regular_file(*test::asset_folder() / file);
}

Model model(const std::string& file, uint32_t triangles) {
    if (is_asset(file)) {
        const test::UploadedAsset asset = test::load_asset(file);
        return {file, read_asset(asset.upload(), {}, {}).scene.meshes.front()};
    }
    return {fmt::format("a drawn mesh of {} triangles", triangles),
            make_sample("bunny13", {.copies = 1, .triangles = triangles}).meshes.front()};
}

// So many instances of the mesh in a row.
Bytes scene_of(const Model& model, uint32_t instances) {
    Scene scene;
    scene.meshes.push_back(model.mesh);
    scene.meshes.front().source_mesh.reset();
    scene.meshes.front().slots = {MaterialSlot{}};
    std::fill(scene.meshes.front().triangle_slot.begin(), scene.meshes.front().triangle_slot.end(), 0);
    const double step = 1.2 * bounds(model.mesh.positions).diagonal();
    for (uint32_t i = 0; i < instances; ++i) {
        Node node;
        node.name = fmt::format("{} {}", model.name, i);
        node.local = from_trs({step * i, 0, 0}, {0, 0, 0, 1}, {1, 1, 1});
        node.mesh = 0;
        scene.roots.push_back(i);
        scene.nodes.push_back(std::move(node));
    }
    return write_asset(scene, {}, {}).bytes;
}

Report optimized(const Bytes& scene, const OptimizeOptions& options) {
    return optimize({.asset = {.path = "scene.glb", .bytes = scene}}, options, {}, {}).report;
}

// Table 3 of the ITS paper: KB and milliseconds, on its authors' machine.
struct Printed {
    double removed;
    double kilobytes[4], milliseconds[4];  // quadric, gaps, ias, its
};

struct PaperScene {
    std::string name;
    Model model;
    uint32_t instances;
    std::vector<Printed> printed;
};

std::vector<PaperScene> its_scenes() {
    return {
        {"bunny",
         model("models/bunny-2503.obj", 4968),
         13,
         {{0.1, {6383, 6370, 4672, 4661}, {10140, 10517, 741, 774}},
          {0.2, {5928, 5915, 4147, 4142}, {12922, 12662, 910, 977}},
          {0.5, {4537, 4537, 2594, 2576}, {8125, 8151, 602, 621}}}},
        {"bear",
         model("", 1360),
         5,
         {{0.1, {565, 565, 470, 469}, {945, 895, 193, 185}},
          {0.2, {515, 515, 417, 415}, {1130, 1115, 223, 225}},
          {0.5, {385, 385, 268, 269}, {1690, 1565, 321, 287}}}},
        {"deer",
         model("", 1382),
         5,
         {{0.1, {550, 550, 467, 465}, {975, 2250, 199, 215}},
          {0.2, {505, 505, 414, 414}, {1175, 1195, 228, 238}},
          {0.5, {375, 375, 265, 264}, {1665, 1820, 341, 406}}}},
        {"wolf",
         model("", 1286),
         5,
         {{0.1, {505, 505, 427, 430}, {835, 1155, 192, 174}},
          {0.2, {465, 465, 383, 384}, {945, 1120, 203, 198}},
          {0.5, {345, 345, 248, 244}, {1445, 1475, 328, 322}}}},
    };
}

// In turns, so that whatever else the machine does falls on all alike.
void print_its_table_3() {
    const std::vector<std::pair<std::string, std::map<std::string, ParameterValue>>> algorithms = {
        {"quadric", {{"instances", "expand"}}},
        {"gaps", {{"instances", "expand"}}},
        {"ias", {}},
        {"its", {}}};
    fmt::print(
        "\n## ITS, Table 3\n\nprinted, then measured: KB of the result, ms of the simplify stage (one "
        "thread, medians of {}).\n\n",
        runs);
    fmt::print(
        "| scene | instances | removed | algorithm | triangles | vertices | KB printed | KB | ms printed | "
        "ms | "
        "ms / its, printed | ms / its |\n|---|---:|---:|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const PaperScene& scene : its_scenes()) {
        const Bytes bytes = scene_of(scene.model, scene.instances);
        for (const Printed& printed : scene.printed) {
            std::vector<Report> reports(algorithms.size());
            std::vector<std::vector<double>> times(algorithms.size());
            for (int run = 0; run < runs; ++run) {
                for (size_t a = 0; a < algorithms.size(); ++a) {
                    reports[a] = optimized(bytes, {.algorithm = algorithms[a].first,
                                                   .ratio = 1 - printed.removed,
                                                   .parameters = algorithms[a].second,
                                                   .threads = 1});
                    times[a].push_back(reports[a].timing_ms.simplify);
                }
            }
            for (size_t a = 0; a < algorithms.size(); ++a) {
                const double its = median(times.back());
                fmt::print(
                    "| {} ({}) | {} | {:.0f} % | {} | {} | {} | {} | {:.0f} | {} | {:.1f} | {:.2f} | {:.2f} "
                    "|\n",
                    scene.name, scene.model.name, scene.instances, 100 * printed.removed, algorithms[a].first,
                    reports[a].output.unique_triangles, reports[a].output.unique_vertices,
                    printed.kilobytes[a], static_cast<double>(reports[a].output.bytes) / 1000,
                    printed.milliseconds[a], median(times[a]),
                    printed.milliseconds[a] / printed.milliseconds[3], median(times[a]) / its);
            }
        }
    }
}

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
void print_gaea_table_1() {
    fmt::print(
        "\n## GAEA, Table 1\n\nTriangles left by one pass, printed and measured, the latter for each number "
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
void print_gaea_iterations() {
    fmt::print(
        "\n## GAEA, iterations\n\nTriangles left by one pass and by iterations from the same codebook to "
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

// OpenMesh's own decimater, nothing added: what the speed of others is measured by.
struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
};
using OpenMeshMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

void decimate_with_openmesh(const Mesh& mesh, size_t triangles) {
    OpenMeshMesh half_edges;
    for (const Vec3f p : mesh.positions)
        half_edges.add_vertex(OpenMesh::Vec3d(double{p.x}, double{p.y}, double{p.z}));
    for (size_t t = 0; t < mesh.triangle_count(); ++t) {
        const auto corner = [&](size_t k) { return half_edges.vertex_handle(mesh.corner_vertex(t, k)); };
        half_edges.add_face(corner(0), corner(1), corner(2));
    }
    half_edges.request_vertex_status();
    half_edges.request_edge_status();
    half_edges.request_face_status();
    half_edges.request_face_normals();
    half_edges.update_face_normals();
    OpenMesh::Decimater::DecimaterT<OpenMeshMesh> decimater(half_edges);
    OpenMesh::Decimater::ModQuadricT<OpenMeshMesh>::Handle quadric;
    decimater.add(quadric);
    decimater.module(quadric).unset_max_err();
    decimater.initialize();
    decimater.decimate_to_faces(0, triangles);
    half_edges.garbage_collection();
}

Simplified simplify(const Algorithm& algorithm, const Mesh& mesh, uint64_t triangles) {
    const ParameterValues values = ParameterValues::parse(algorithm.parameters, {});
    const Target target = {.triangles = triangles};
    if (algorithm.simplify_scene == nullptr) return algorithm.simplify(mesh, {}, target, values, {});
    const std::vector<std::vector<Transform>> one = {{Transform{}}};
    const SceneTarget scene = {.triangles = triangles, .of_mesh = {Target{}}};
    return algorithm.simplify_scene(std::span(&mesh, 1), one, scene, values, {}).meshes.front();
}

void print_speed() {
    const Model bunny = model("models/stanford-bunny.obj", 69451);
    const size_t half = bunny.mesh.triangle_count() / 2;
    std::vector<double> openmesh;
    std::vector<std::vector<double>> times(algorithms().size());
    std::vector<Simplified> results(algorithms().size());
    for (int run = 0; run < runs; ++run) {
        openmesh.push_back(cpu_milliseconds([&] { decimate_with_openmesh(bunny.mesh, half); }));
        for (size_t a = 0; a < algorithms().size(); ++a) {
            times[a].push_back(
                cpu_milliseconds([&] { results[a] = simplify(algorithms()[a], bunny.mesh, half); }));
        }
    }
    fmt::print(
        "\n## Speed\n\n{}, {} triangles to {}, CPU time of one thread, medians of {}. OpenMesh's decimater "
        "alone: {:.0f} ms.\n\n",
        bunny.name, bunny.mesh.triangle_count(), half, runs, median(openmesh));
    fmt::print("| algorithm | triangles | stopped for | ms | to OpenMesh |\n|---|---:|---|---:|---:|\n");
    for (size_t a = 0; a < algorithms().size(); ++a) {
        fmt::print("| {} | {} | {} | {:.0f} | {:.2f} |\n", algorithms()[a].id,
                   results[a].mesh.triangle_count(), name(results[a].stop_reason), median(times[a]),
                   median(times[a]) / median(openmesh));
    }
}

// time ~ triangles^exponent, between the smallest and the largest.
void print_growth() {
    const std::vector<uint32_t> sizes = {10'000, 100'000, 1'000'000, 4'000'000};
    std::vector<Mesh> meshes;
    for (const uint32_t size : sizes)
        meshes.push_back(make_sample("bunny13", {.copies = 1, .triangles = size}).meshes.front());
    fmt::print(
        "\n## Growth\n\nms of CPU time to 50 %, one run.\n\n| algorithm | 10 k | 100 k | 1 M | 4 M | "
        "exponent |\n|---|---:|---:|---:|---:|---:|\n");
    for (const Algorithm& algorithm : algorithms()) {
        std::vector<double> times;
        for (const Mesh& mesh : meshes)
            times.push_back(cpu_milliseconds([&] { simplify(algorithm, mesh, mesh.triangle_count() / 2); }));
        const double grown = static_cast<double>(meshes.back().triangle_count()) /
                             static_cast<double>(meshes.front().triangle_count());
        fmt::print("| {} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {:.2f} |\n", algorithm.id, times[0], times[1],
                   times[2], times[3], std::log(times.back() / times.front()) / std::log(grown));
    }
}

}  // namespace
}  // namespace coppice

int main(int count, char** arguments) {
    if (count > 1 && std::string(arguments[1]) == "growth") {
        coppice::print_growth();
        return 0;
    }
    coppice::print_its_table_3();
    coppice::print_gaea_table_1();
    coppice::print_gaea_iterations();
    coppice::print_speed();
    return 0;
}
