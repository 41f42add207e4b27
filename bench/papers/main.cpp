// What the papers printed, beside what our algorithms do: tables in markdown.
//
//   build/release/bench/bench_papers                 all tables but growth
//   build/release/bench/bench_papers NAME...         some of them
//   build/release/bench/bench_papers growth          how time grows, up to 4 million triangles; takes minutes
//   build/release/bench/bench_papers chart > FILE    errors, as SVG
//
// Meshes of the papers are taken from the test assets where these are there, else drawn with about as many
// triangles; the tables say which.
#include <fmt/core.h>

#include <string_view>

#include "bench/papers/tables.h"

namespace {

struct Table {
    std::string_view name;
    void (*print)();
    bool is_asked_for_by_name = false;
};

constexpr Table tables[] = {
    {"its", coppice::papers::print_its},
    {"its_instances", coppice::papers::print_its_instances},
    {"its_deviation", coppice::papers::print_its_deviation},
    {"gaea", coppice::papers::print_gaea},
    {"surface_angle", coppice::papers::print_surface_angle},
    {"li_kim", coppice::papers::print_li_kim},
    {"errors", coppice::papers::print_errors},
    {"speed", coppice::papers::print_speed},
    {"growth", coppice::papers::print_growth, true},
    {"chart", coppice::papers::print_chart, true},
};

bool print(std::string_view name) {
    for (const Table& table : tables) {
        if (table.name != name) continue;
        table.print();
        return true;
    }
    fmt::print(stderr, "{} is not a table; there are:", name);
    for (const Table& table : tables) fmt::print(stderr, " {}", table.name);
    fmt::print(stderr, "\n");
    return false;
}

}  // namespace

int main(int count, char** arguments) {
    for (int i = 1; i < count; ++i) {
        if (!print(arguments[i])) return 2;
    }
    if (count > 1) return 0;
    for (const Table& table : tables) {
        if (!table.is_asked_for_by_name) table.print();
    }
    return 0;
}
