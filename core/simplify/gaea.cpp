#include "core/simplify/gaea.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <memory>

#include "core/simplify/codebook_family.h"
#include "core/simplify/patch_collapse.h"
#include "core/simplify/target.h"
#include "core/simplify/threshold_search.h"

namespace coppice {

namespace {

constexpr double finest_searched = 32;
constexpr double least_progress = 0.002;  // of the triangles, for a pass to be worth another one

// By the target that keeps more.
double vertices_to_go(const Target& target, const CollapseMesh& mesh) {
    double least = std::numeric_limits<double>::infinity();
    if (target.triangles) least = (mesh.live_triangles() - static_cast<double>(*target.triangles)) / 2;
    if (target.vertices)
        least = std::min(least, mesh.live_vertices() - static_cast<double>(*target.vertices));
    return least;
}

class Run {
  public:
    Run(EdgeCollapse& work, const Target& target, const CodebookFamily& family, const PatchOptions& options,
        const Watch& watch)
        : work_(work), target_(target), family_(family), options_(options), watch_(watch) {}

    void pass(const CodebookSizes& sizes) { pass(PatchCollapse(work_, options_, watch_), sizes); }

    // A pass with the finest codebook whose patches have as many vertices inside as are to go; with the
    // coarsest that is allowed where none has.
    void pass_by_search() {
        PatchCollapse patches(work_, options_, watch_);
        constexpr double collapsed = 0.97;  // of them; rules refuse the others
        const ThresholdFound found =
            search(collapsed, [&](const CodebookSizes& sizes) { return patches.count_inside(sizes); });
        pass(std::move(patches), family_.sizes(1 / found.threshold));
    }

    // Passes until the target is met, each by search, or all with the usual codebook, which also takes what
    // it can where none meets the target at once. A pass that is not worth another one makes it smaller.
    void iterate(bool by_search) {
        CodebookSizes usual = family_.sizes(family_.start());
        while (!work_.done()) {
            PatchCollapse patches(work_, options_, watch_);
            CodebookSizes sizes = usual;
            if (by_search) {
                constexpr double collapsed = 0.9;  // of those that refining leaves, about
                const ThresholdFound found =
                    search(collapsed, [&](const CodebookSizes& s) { return patches.estimate_inside(s); });
                if (found.reached) sizes = family_.sizes(1 / found.threshold);
            }
            if (pass(std::move(patches), sizes)) continue;
            if (usual == CodebookSizes{1, 1, 1}) return;
            for (uint32_t& n : usual) n = std::max(n, 2U) - 1;
        }
    }

    double threshold_used() const { return threshold_; }  // the smallest

  private:
    // Thresholds of the search are 1 / size, so that more go as they grow.
    template <typename CountInside>
    ThresholdFound search(double collapsed, CountInside count_inside) const {
        const double live = work_.mesh().live_vertices();
        std::map<CodebookSizes, double> counts;
        const auto count = [&](double threshold) {
            const CodebookSizes sizes = family_.sizes(1 / threshold);
            const auto [known, is_new] = counts.try_emplace(sizes, live);
            if (is_new) known->second -= count_inside(sizes);
            return known->second;
        };
        const double coarsest = family_.is_given() ? family_.start() : 1;
        return search_threshold({.least = 1 / std::max(coarsest, finest_searched),
                                 .most = 1 / coarsest,
                                 .target = live - vertices_to_go(target_, work_.mesh()) / collapsed},
                                count);
    }

    // Whether it was worth another one.
    bool pass(PatchCollapse&& patches, const CodebookSizes& sizes) {
        watch_.report(work_.fraction());
        const double before = work_.mesh().live_triangles();
        patches.run(sizes);
        threshold_ = std::min(threshold_, family_.threshold(sizes));
        return work_.mesh().live_triangles() < (1 - least_progress) * before;
    }

    EdgeCollapse& work_;
    const Target& target_;
    const CodebookFamily& family_;
    PatchOptions options_;
    const Watch& watch_;
    double threshold_ = std::numeric_limits<double>::infinity();
};

std::span<const Parameter> parameters() {
    static constexpr std::array<std::string_view, 2> schemas = {"uniform", "xyz"}, warps = {"flat", "tan"},
                                                     remeshes = {"collapse", "triangulate"};
    using Kind = Parameter::Kind;
    static const std::array<Parameter, 8> list = {{
        {.id = "schema",
         .title = "how code-vectors are spread: uniform, as many along each axis; xyz, apart for x, y and z",
         .kind = Kind::choice,
         .default_value = "uniform",
         .choices = schemas},
        {.id = "n",
         .title = "schema=uniform: 6 n^2 code-vectors; with a target found by search, not below the given "
                  "one; else 5 unless given",
         .kind = Kind::integer,
         .minimum = 1,
         .maximum = 64,
         .ends_run = true},
        {.id = "xyz",
         .title = "schema=xyz: 2 (xy + yz + zx) code-vectors, by x, y and z",
         .kind = Kind::text,
         .pattern = "([1-9]|[1-5][0-9]|6[0-4])(-([1-9]|[1-5][0-9]|6[0-4])){2}",
         .form = "three whole numbers from 1 to 64, as 5-4-3",
         .ends_run = true},
        {.id = "codebook_size",
         .title = "schema=xyz: at most so many code-vectors, x, y and z in proportion to the bounding box; "
                  "with a target found by search, not below the given one; else 150 unless given",
         .kind = Kind::integer,
         .minimum = 6,
         .maximum = 6 * 64 * 64,
         .ends_run = true},
        {.id = "iterate",
         .title = "false: one pass; true: passes with the same codebook while they pay, then with smaller "
                  "ones down to 1-1-1; unless given, one, or as many as a target takes",
         .kind = Kind::boolean,
         .ends_run = true},
        {.id = "warp",
         .title = "where the codebook's grid has its lines: flat, at even steps, as printed; tan, at even "
                  "angles",
         .kind = Kind::choice,
         .default_value = "flat",
         .choices = warps},
        {.id = "refine",
         .title = "how often patches are formed anew around the mean normals of the ones before",
         .kind = Kind::integer,
         .default_value = 2.0,
         .minimum = 0,
         .maximum = 3},
        {.id = "remesh",
         .title =
             "how patches are flattened: collapse, as printed; triangulate: to their Delaunay triangulation",
         .kind = Kind::choice,
         .default_value = "collapse",
         .choices = remeshes},
    }};
    return list;
}

Simplified simplify(const Mesh& source, std::span<const Transform> /*instances*/, const Target& target,
                    const ParameterValues& values, const Watch& watch) {
    watch.check();
    if (is_small_enough(source, target)) return already_smaller(source, watch);
    EdgeCollapse work(
        source, target, {.freedom = Freedom::end_point},
        [](const CollapseParts& parts) { return std::make_unique<NoError>(parts.mesh); }, watch);
    const CodebookFamily family(values, work.mesh().box());
    const PatchOptions options = {.warp = values.text("warp") == "tan" ? Warp::tan : Warp::flat,
                                  .refinements = static_cast<uint32_t>(*values.number("refine")),
                                  .triangulate = values.text("remesh") == "triangulate"};
    Run run(work, target, family, options, watch);
    const bool counts = target.triangles || target.vertices;
    const bool seeks = (counts || target.error_model_units) && !family.is_given();
    const bool iterates = values.all().contains("iterate") ? values.boolean("iterate") : seeks;
    if (iterates) {
        run.iterate(counts && !values.boolean("iterate"));
    } else if (counts) {
        run.pass_by_search();
    } else {
        run.pass(family.sizes(family.start()));
    }
    watch.report(1.0);
    Simplified result = work.finish(work.done() ? StopReason::target : work.reason_for_refusals(), watch);
    result.threshold_used = run.threshold_used();
    return result;
}

}  // namespace

Algorithm gaea() {
    return {.id = "gaea",
            .title = "Patches of quantized normals",
            .citation =
                "G. Subramaniam, K. Ong: Mesh simplification using ellipsoidal schema for isotropic "
                "quantization of face-normal vectors. Asia Pacific Symposium on Information "
                "Visualisation 2006",
            .parameters = parameters(),
            .keeps_values = true,
            .bytes_per_triangle = 280,
            .simplify = simplify};
}

}  // namespace coppice
