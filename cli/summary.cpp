#include "cli/summary.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "cli/terminal.h"

namespace coppice {

std::string print_meshes(const AssetSummary& summary) {
    return fmt::format("{}, {}", print_count(summary.meshes, "unique mesh", "unique meshes"),
                       print_count(summary.instances, "instance", "instances"));
}

std::string print_triangles(const AssetSummary& summary) {
    return fmt::format("{} stored, {} drawn", print_count(summary.unique_triangles),
                       print_count(summary.rendered_triangles));
}

void print_warnings(const std::vector<Warning>& warnings, std::ostream& err) {
    for (const Warning& warning : warnings) {
        fmt::print(err, "warning {}: {}{}\n", warning.code, warning.message,
                   warning.where.empty() ? "" : " (at " + warning.where + ")");
    }
}

}  // namespace coppice
