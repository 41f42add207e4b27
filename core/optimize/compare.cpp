#include "core/optimize/compare.h"

#include <utility>

#include "core/base/error.h"
#include "core/optimize/summary.h"

namespace coppice {

namespace {

constexpr double read_ends = 0.1;

// An error in one of two assets is of no use without saying of which.
ReadAsset read_side(const Upload& upload, std::string_view side, const ReadLimits& limits,
                    const Watch& watch) {
    try {
        return read_asset(upload, limits, watch);
    } catch (const Error& error) {
        if (error.code() == ErrorCode::job_cancelled) throw;
        fail(error.code(), error.where(), fmt::format("the {}: {}", side, error.message()));
    }
}

Upload with_entry(Upload upload, const std::string& entry) {
    if (!entry.empty()) upload.entry = entry;
    return upload;
}

void add_warnings(const Scene& scene, std::string_view side, std::vector<Warning>& warnings) {
    for (Warning warning : scene.warnings) {
        warning.where = warning.where.empty() ? std::string(side) : fmt::format("{} {}", side, warning.where);
        warnings.push_back(std::move(warning));
    }
}

// Readers drop them, but the asset has them.
void count_dropped(const Scene& scene, Elements& elements) {
    for (const Warning& warning : scene.warnings) {
        if (warning.code == "repair.degenerate_triangles") elements.degenerate_triangles += warning.count;
        if (warning.code == "repair.duplicate_triangles") elements.duplicate_triangles += warning.count;
    }
}

}  // namespace

Comparison compare(const Upload& reference, const Upload& candidate, const CompareOptions& options,
                   const ReadLimits& limits, const Watch& watch) {
    validate(options);
    if (watch.stage) watch.stage("read");
    const ReadAsset a = read_side(with_entry(reference, options.reference_entry), "reference", limits,
                                  watch.part(0, read_ends / 2));
    const ReadAsset b = read_side(with_entry(candidate, options.candidate_entry), "candidate", limits,
                                  watch.part(read_ends / 2, read_ends));

    Comparison out;
    out.reference = summarize(a.scene, instances_per_mesh(a.scene), a.format, bytes_of(reference));
    out.candidate = summarize(b.scene, instances_per_mesh(b.scene), b.format, bytes_of(candidate));
    add_warnings(a.scene, "reference", out.warnings);
    add_warnings(b.scene, "candidate", out.warnings);

    if (watch.stage) watch.stage("compare");
    out.scenes = compare_scenes(a.scene, b.scene, options, limits.triangles, watch.part(read_ends, 1));
    count_dropped(a.scene, out.scenes.reference.elements);
    count_dropped(b.scene, out.scenes.candidate.elements);
    watch.report(1);
    return out;
}

}  // namespace coppice
