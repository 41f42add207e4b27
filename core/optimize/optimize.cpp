#include "core/optimize/optimize.h"

#include <algorithm>
#include <chrono>

#include "core/base/error.h"
#include "core/optimize/check.h"
#include "core/optimize/drop_instances.h"
#include "core/optimize/engine.h"
#include "core/optimize/plan.h"
#include "core/optimize/simplify_meshes.h"
#include "core/optimize/summary.h"
#include "core/scene/expand.h"
#include "core/simplify/registry.h"

namespace coppice {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Tells the listener which stage it is, runs it, and notes how long it took.
template <typename Body>
auto timed(const Watch& watch, std::string_view stage, double& milliseconds, Body&& body) {
    watch.check();
    if (watch.stage) watch.stage(stage);
    const Clock::time_point start = Clock::now();
    auto result = body();
    milliseconds = milliseconds_since(start);
    return result;
}

// Where each stage's part of the progress ends.
constexpr double read_ends = 0.15, simplify_ends = 0.85;

Upload with_entry(Upload upload, const OptimizeOptions& options) {
    if (upload.entry.empty()) upload.entry = options.entry;
    return upload;
}

Format output_format(const OptimizeOptions& options, Format input) {
    if (options.format) return *options.format;
    return input == Format::obj || input == Format::iobj ? Format::iobj : Format::glb;
}

std::vector<MeshReport> mesh_reports(const Scene& scene, const Placement& placement,
                                     const std::vector<Simplified>& simplified) {
    std::vector<MeshReport> reports;
    for (size_t i = 0; i < simplified.size(); ++i) {
        const double world_error = simplified[i].error_model_units * placement.scales[i];
        reports.push_back(
            {.name = scene.meshes[i].name,
             .instances = placement.of_mesh[i].size(),
             .triangles_in = scene.meshes[i].triangle_count(),
             .triangles_out = simplified[i].mesh.triangle_count(),
             .error_model_units = simplified[i].error_model_units,
             .error_diagonal_fraction = placement.diagonal > 0 ? world_error / placement.diagonal : 0,
             .certified = simplified[i].certified,
             .stop_reason = simplified[i].stop_reason});
    }
    return reports;
}

// The input's instances but for the pruned ones, in their order, against the ones that are written.
std::vector<InstanceMapping> map_instances(const std::vector<Instance>& before,
                                           std::span<const PrunedInstance> pruned, const Scene& written,
                                           bool flattened, const Watch& watch) {
    const std::vector<Instance> after = flattened ? std::vector<Instance>{} : instances(written, watch);
    std::vector<InstanceMapping> map;
    for (const Instance& instance : before) {
        if (!pruned.empty() && pruned.front() == PrunedInstance{instance.node, instance.in_batch}) {
            pruned = pruned.subspan(1);
            continue;
        }
        const size_t i = map.size();
        if (flattened) {
            map.push_back({instance.node, static_cast<uint32_t>(i), 0});
        } else {
            map.push_back({instance.node, after[i].mesh, after[i].in_batch});
        }
    }
    return map;
}

std::vector<std::optional<double>> thresholds(const std::vector<Simplified>& simplified) {
    std::vector<std::optional<double>> used;
    for (const Simplified& s : simplified) used.push_back(s.threshold_used);
    const bool any = std::any_of(used.begin(), used.end(), [](const auto& t) { return t.has_value(); });
    return any ? used : std::vector<std::optional<double>>{};
}

void append(std::vector<Warning>& warnings, std::vector<Warning> more) {
    warnings.insert(warnings.end(), std::make_move_iterator(more.begin()),
                    std::make_move_iterator(more.end()));
}

void describe(Report& report, const Algorithm& algorithm, const OptimizeOptions& options) {
    report.algorithm = algorithm.id;
    report.parameters = ParameterValues::parse(algorithm.parameters, options.parameters);
    report.engine_version = engine_version();
    report.engine_build = engine_build();
}

// Replaces each of the scene's meshes by its simplified self.
std::vector<MeshReport> simplify(Scene& scene, const Placement& placement, const Algorithm& algorithm,
                                 const OptimizeOptions& options, const Watch& watch, Report& report) {
    std::vector<Target> targets;
    SimplifiedScene simplified;
    if (algorithm.simplify_scene != nullptr) {
        const SceneTarget target = plan_scene_target(scene, placement, algorithm, options);
        simplified =
            algorithm.simplify_scene(scene.meshes, placement.of_mesh, target, report.parameters, watch);
        targets = target.of_mesh;
    } else {
        targets = plan_targets(scene, placement, algorithm, report.parameters, options);
        simplified.meshes = simplify_meshes(scene.meshes, placement, targets, algorithm, report.parameters,
                                            options.threads, watch);
    }
    std::vector<MeshReport> reports = mesh_reports(scene, placement, simplified.meshes);
    report.thresholds_used = thresholds(simplified.meshes);
    append(report.warnings, check_result(scene, placement, targets, simplified.meshes, options));
    for (size_t i = 0; i < scene.meshes.size(); ++i) scene.meshes[i] = std::move(simplified.meshes[i].mesh);
    report.instancing.pruned = drop_instances(scene, placement, simplified.dropped_instances);
    if (report.instancing.pruned.empty()) return reports;
    report.warnings.push_back(pruned_warning(report.instancing.pruned.size(), placement.instances.size()));
    for (size_t i = 0; i < reports.size(); ++i)
        reports[i].instances -= simplified.dropped_instances[i].size();
    return reports;
}

// With instances=expand every instance becomes a mesh of its own before it is simplified.
bool wants_copies(const Report& report) {
    return report.parameters.text("instances") == "expand";
}

// Plain OBJ stores a copy per instance whatever is asked; the writer makes them.
WrittenAsset write(Scene& scene, const Placement& placement, const WriteOptions& output, const Watch& watch,
                   Report& report) {
    const bool flattened = output.format == Format::obj;
    if (output.instancing == Instancing::expand && !flattened) scene = expand_meshes(scene);
    WrittenAsset asset = write_asset(scene, output, watch);

    const std::vector<uint64_t> counts = instances_per_mesh(scene, watch);
    append(report.warnings, asset.warnings);
    report.output = summarize(scene, counts, output.format, asset.bytes.size());
    report.savings = savings(report.input.bytes, report.output.bytes, asset.mesh_bytes,
                             flattened ? std::vector<uint64_t>{} : counts);
    report.instancing.given = placement.instances.size();
    report.instancing.unique = report.output.meshes;
    report.instancing.map =
        map_instances(placement.instances, report.instancing.pruned, scene, flattened, watch);
    return asset;
}

}  // namespace

Optimized optimize(const Upload& upload, const OptimizeOptions& options, const ReadLimits& limits,
                   const Watch& watch) {
    const Clock::time_point start = Clock::now();
    validate(options);
    const Algorithm& algorithm =
        options.algorithm.empty() ? default_algorithm() : find_algorithm(options.algorithm);
    Optimized result;
    Report& report = result.report;
    StageTimes& times = report.timing_ms;
    describe(report, algorithm, options);

    ReadAsset input = timed(watch, "read", times.read, [&] {
        return read_asset(with_entry(upload, options), limits, watch.part(0, read_ends));
    });
    const Format format = output_format(options, input.format);
    check_output(format, options.instancing);

    const Placement placement =
        timed(watch, "discover", times.discover, [&] { return place(input.scene, watch); });
    report.input = summarize(input.scene, placement.counts(), input.format, bytes_of(upload));
    append(report.warnings, std::move(input.scene.warnings));

    report.meshes = timed(watch, "simplify", times.simplify, [&] {
        const Watch own = watch.part(read_ends, simplify_ends);
        if (!wants_copies(report)) return simplify(input.scene, placement, algorithm, options, own, report);
        input.scene = expand_meshes(input.scene);
        return simplify(input.scene, place(input.scene), algorithm, options, own, report);
    });

    result.asset = timed(watch, "write", times.write, [&] {
        const WriteOptions output = {format, options.instancing, options.base_name};
        return write(input.scene, placement, output, watch.part(simplify_ends, 1), report);
    });
    watch.report(1);
    times.total = milliseconds_since(start);
    return result;
}

}  // namespace coppice
