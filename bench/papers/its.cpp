// The ITS paper: Tables 1 to 3, and Figures 3 to 8 as figures of numbers. Figure 2 is in its_deviation.cpp.
#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "bench/papers/its_scenes.h"
#include "bench/papers/measure.h"
#include "bench/papers/scene_runs.h"
#include "bench/papers/tables.h"

namespace coppice::papers {
namespace {

struct Level {
    double removed;
    const Printed* printed;  // null where the paper has nothing
    SceneRuns runs;

    double kilobytes(size_t c) const { return static_cast<double>(runs[c].report.output.bytes) / 1000; }
    double slower(size_t a, size_t b) const { return runs[a].simplify_ms / runs[b].simplify_ms; }
};

struct Measured {
    const PaperScene& scene;
    std::vector<Level> levels;
};

std::string title(const PaperScene& scene) {
    return fmt::format("{} ({})", scene.name, scene.model.name);
}

std::string or_none(double printed, int digits) {
    return printed > 0 ? fmt::format("{:.{}f}", printed, digits) : "-";
}

std::vector<Measured> measure(const std::vector<PaperScene>& scenes) {
    std::vector<Measured> result;
    for (const PaperScene& scene : scenes) {
        const Bytes bytes = scene_of(scene.model, scene.instances);
        const Upload upload = {.asset = {.path = "scene.glb", .bytes = bytes}};
        Measured measured = {scene, {}};
        for (const Printed& printed : scene.printed)
            measured.levels.push_back({printed.removed, &printed, run_scene(upload, printed.removed)});
        measured.levels.push_back({0.7, nullptr, run_scene(upload, 0.7)});
        result.push_back(std::move(measured));
    }
    return result;
}

void print_table_1(const std::vector<PaperScene>& scenes) {
    fmt::print(
        "\n### ITS, Table 1\n\nThe models, printed and ours; drawn: a mesh made by `coppice sample bunny13` "
        "stands in. "
        "Texture "
        "coordinates and normals of ours are distinct pairs of both.\n\n"
        "| model | vertices | ours | texture coordinates | normals | ours | triangles | ours | instances | "
        "KB an "
        "instance | ours |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const PaperScene& s : scenes) {
        const Mesh& mesh = s.model.mesh;
        fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.0f} |\n", title(s), s.vertices,
                   mesh.vertex_count(), s.texture_coordinates, s.normals,
                   mesh.attributes.empty() ? 0 : mesh.wedge_count(), s.triangles, mesh.triangle_count(),
                   s.instances, s.kilobytes_of_instance,
                   static_cast<double>(scene_of(s.model, 1).size()) / 1000);
    }
}

Simplified its_to_vertices(const Mesh& mesh, const char* mode, double removed) {
    const Algorithm& algorithm = find_algorithm("its");
    const auto keep = static_cast<uint64_t>((1 - removed) * static_cast<double>(mesh.vertex_count()));
    return algorithm.simplify(mesh, {}, {.vertices = keep},
                              ParameterValues::parse(algorithm.parameters, {{"mode", mode}}), {});
}

// Of meshes that stand in, what is left of their own counts is set against what is left of the printed ones.
double to_printed(double left, double before, double printed_left, double printed_before) {
    return 100 * (left / before / (printed_left / printed_before) - 1);
}

void print_table_2(const std::vector<PaperScene>& scenes) {
    fmt::print(
        "\n### ITS, Table 2\n\nVertices and triangles that `its` leaves when it stops on vertices. The share "
        "left of "
        "our mesh against the printed share: within 2 % of vertices, 6 % of triangles.\n\n"
        "| model | removed | vertices printed | full | faithful | full to printed | triangles printed | full "
        "| "
        "faithful | full to printed | faithful |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const PaperScene& s : scenes) {
        const auto v = static_cast<double>(s.model.mesh.vertex_count());
        const auto t = static_cast<double>(s.model.mesh.triangle_count());
        for (const Printed& p : s.printed) {
            const Mesh full = its_to_vertices(s.model.mesh, "full", p.removed).mesh;
            const Mesh faithful = its_to_vertices(s.model.mesh, "faithful", p.removed).mesh;
            const auto of_triangles = [&](const Mesh& left) {
                return to_printed(static_cast<double>(left.triangle_count()), t, p.triangles, s.triangles);
            };
            fmt::print(
                "| {} | {:.0f} % | {} | {} | {} | {:+.1f} % | {} | {} | {} | {:+.1f} % | {:+.1f} % |\n",
                title(s), 100 * p.removed, p.vertices, full.vertex_count(), faithful.vertex_count(),
                to_printed(static_cast<double>(full.vertex_count()), v, p.vertices, s.vertices), p.triangles,
                full.triangle_count(), faithful.triangle_count(), of_triangles(full), of_triangles(faithful));
        }
    }
}

void print_table_3(const std::vector<Measured>& all) {
    fmt::print(
        "\n### ITS, Table 3\n\nPrinted, then measured: KB of the result, ms of the simplify stage (processor "
        "time of "
        "one thread, medians of {}). Vertices and triangles are those stored. `quadric` and `gaps` run with "
        "`instances=expand`.\n\n"
        "| scene | instances | removed | algorithm | triangles | vertices | KB printed | KB | ms printed | "
        "ms | ms / "
        "its, printed | ms / its |\n|---|---:|---:|---|---:|---:|---:|---:|---:|---:|---:|---:|\n",
        runs);
    for (const Measured& m : all) {
        for (const Level& l : m.levels) {
            for (size_t c = 0; c < count_contenders; ++c) {
                const AssetSummary& left = l.runs[c].report.output;
                const Printed* p = l.printed;
                fmt::print(
                    "| {} | {} | {:.0f} % | {} | {} | {} | {} | {:.0f} | {} | {:.1f} | {} | {:.2f} |\n",
                    title(m.scene), m.scene.instances, 100 * l.removed, contender_names[c],
                    left.unique_triangles, left.unique_vertices, or_none(p ? p->kilobytes[c] : 0, 0),
                    l.kilobytes(c), or_none(p ? p->milliseconds[c] : 0, 0), l.runs[c].simplify_ms,
                    or_none(p ? p->milliseconds[c] / p->milliseconds[its] : 0, 2), l.slower(c, its));
            }
        }
    }
}

void print_figures_3_to_6(const std::vector<Measured>& all) {
    fmt::print(
        "\n### ITS, Figures 3 to 6\n\nThe scenes that they show, by `its`: every placement drawn. Printed "
        "are the "
        "seconds in "
        "text and captions (which contradict Table 3); ours are those from file to file, processor time.\n\n"
        "| figure | scene | placements | removed | vertices drawn | triangles drawn | KB | seconds printed | "
        "seconds "
        "|\n|---|---|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const Measured& m : all) {
        for (const Level& l : m.levels) {
            const Report& report = l.runs[its].report;
            fmt::print("| {} | {} | {} | {:.0f} % | {} | {} | {:.0f} | {} | {:.4f} |\n", m.scene.figure,
                       title(m.scene), report.output.instances, 100 * l.removed,
                       report.output.unique_vertices * report.output.instances,
                       report.output.rendered_triangles, l.kilobytes(its),
                       or_none(l.printed ? l.printed->figure_seconds : 0, 2), l.runs[its].total_ms / 1000);
        }
    }
}

// The mean over some scenes.
template <typename Value>
double mean(const std::vector<const Measured*>& scenes, Value value) {
    double sum = 0;
    for (const Measured* m : scenes) sum += value(*m);
    return sum / static_cast<double>(scenes.size());
}

void print_bars(const std::vector<const Measured*>& scenes) {
    fmt::print(
        "| removed | algorithm | ms printed | ms | KB printed | KB | ms / its, printed | ms / its | KB / "
        "its, printed "
        "| KB / its |\n|---:|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (size_t i = 0; i < scenes.front()->scene.printed.size(); ++i) {
        const auto bars = [&](size_t c) {
            return std::array<double, 4>{
                mean(scenes, [&](const Measured& m) { return m.levels[i].printed->milliseconds[c]; }),
                mean(scenes, [&](const Measured& m) { return m.levels[i].runs[c].simplify_ms; }),
                mean(scenes, [&](const Measured& m) { return m.levels[i].printed->kilobytes[c]; }),
                mean(scenes, [&](const Measured& m) { return m.levels[i].kilobytes(c); })};
        };
        const auto of_its = bars(its);
        for (size_t c = 0; c < count_contenders; ++c) {
            const auto b = bars(c);
            fmt::print(
                "| {:.0f} % | {} | {:.0f} | {:.1f} | {:.0f} | {:.0f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n",
                100 * scenes.front()->levels[i].removed, contender_names[c], b[0], b[1], b[2], b[3],
                b[0] / of_its[0], b[1] / of_its[1], b[2] / of_its[2], b[3] / of_its[3]);
        }
    }
}

void print_figures_7_and_8(const std::vector<Measured>& all) {
    std::vector<const Measured*> four;  // the bunny once: the one with attributes, as in the paper
    for (size_t i = 1; i < all.size(); ++i) four.push_back(&all[i]);
    fmt::print(
        "\n### ITS, Figure 7\n\nThe bars are the bunny's numbers of Table 3; ours is the drawn one.\n\n");
    print_bars({four.front()});
    fmt::print("\n### ITS, Figure 8\n\nMeans over bunny, bear, deer and wolf of Table 3.\n\n");
    print_bars(four);
}

struct Goal {
    std::string what;
    double bound;
    bool is_least;  // else most
    double worst = -1;
    std::string where = {};

    void see(double value, const std::string& at) {
        if (worst >= 0 && (is_least ? value >= worst : value <= worst)) return;
        worst = value;
        where = at;
    }
    bool is_met() const { return is_least ? worst >= bound : worst <= bound; }
};

void print_goals(const std::vector<Measured>& all) {
    std::vector<Goal> goals = {{"time of gaps / (its x instances)", 0.8, true},
                               {"time of quadric / (ias x instances)", 0.8, true},
                               {"time of its / ias", 1.2, false},
                               {"bytes of its / the smaller of gaps and quadric", 1, false},
                               {"bytes of its / gaps, bunny at 10 %", 0.73, false},
                               {"bytes of its / gaps, bunny at 50 %", 0.57, false}};
    for (const Measured& m : all) {
        for (const Level& l : m.levels) {
            const std::string at = fmt::format("{}, {:.0f} %", title(m.scene), 100 * l.removed);
            goals[0].see(l.slower(gaps, its) / m.scene.instances, at);
            goals[1].see(l.slower(quadric, ias) / m.scene.instances, at);
            goals[2].see(l.slower(its, ias), at);
            goals[3].see(l.kilobytes(its) / std::min(l.kilobytes(gaps), l.kilobytes(quadric)), at);
            if (m.scene.name != "bunny") continue;
            if (l.removed == 0.1) goals[4].see(l.kilobytes(its) / l.kilobytes(gaps), at);
            if (l.removed == 0.5) goals[5].see(l.kilobytes(its) / l.kilobytes(gaps), at);
        }
    }
    fmt::print(
        "\n### ITS, goals\n\nThe worst of the scenes above.\n\n| | bound | worst | where | "
        "|\n|---|---:|---:|---|---|\n");
    for (const Goal& g : goals) {
        fmt::print("| {} | at {} {} | {:.2f} | {} | {} |\n", g.what, g.is_least ? "least" : "most", g.bound,
                   g.worst, g.where, g.is_met() ? "met" : "missed");
    }
}

}  // namespace

void print_its() {
    const std::vector<PaperScene> scenes = its_scenes();
    print_table_1(scenes);
    print_table_2(scenes);
    const std::vector<Measured> measured = measure(scenes);
    print_table_3(measured);
    print_figures_3_to_6(measured);
    print_figures_7_and_8(measured);
    print_goals(measured);
}

}  // namespace coppice::papers
