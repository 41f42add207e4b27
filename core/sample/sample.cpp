#include "core/sample/sample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/base/error.h"
#include "core/sample/scenes.h"

namespace coppice {

namespace {

struct Sample {
    SampleKind kind;
    Scene (*make)(const SampleSize&);
};

constexpr std::array samples = {
    Sample{{"forest", "four trees, placed hundreds of times on a hilly ground", 300, 3000}, make_forest},
    Sample{
        {"city", "six buildings of wall, glass and roof, placed hundreds of times along streets", 300, 4000},
        make_city},
    Sample{{"bunny13", "one organic mesh of the small bunny's size, placed thirteen times", 13, 5002},
           make_bunny},
    Sample{{"baked", "copies with their transforms baked in: a mesh each, nothing shared", 40, 800},
           make_baked},
    Sample{{"cad", "plates with holes, bolts in them, brackets left and right (mirrored)", 400, 1500},
           make_cad},
};

constexpr auto kinds = [] {
    std::array<SampleKind, samples.size()> out{};
    for (size_t i = 0; i < samples.size(); ++i) out[i] = samples[i].kind;
    return out;
}();

const Sample& find_sample(std::string_view name) {
    std::string known;
    for (const Sample& sample : samples) {
        if (sample.kind.name == name) return sample;
        known += (known.empty() ? "" : ", ") + std::string(sample.kind.name);
    }
    fail(ErrorCode::option_invalid, "sample",
         fmt::format("there is no sample '{}'; there are {}", name, known));
}

uint32_t scaled(uint32_t value, double scale, uint32_t least, uint32_t most) {
    return static_cast<uint32_t>(std::clamp(std::round(value * scale), double(least), double(most)));
}

constexpr uint32_t least_triangles = 60, most_triangles = 5'000'000, most_copies = 1'000'000;

SampleSize size_of(const SampleKind& kind, const SampleOptions& options) {
    require(options.scale > 0 && options.scale <= 1000, ErrorCode::option_invalid, "scale",
            "scale is {}; it must be above 0 and at most 1000", options.scale);
    const uint32_t copies = options.copies.value_or(scaled(kind.copies, options.scale, 1, most_copies));
    require(copies >= 1 && copies <= most_copies, ErrorCode::option_invalid, "copies",
            "copies is {}; it must be 1 to {}", copies, most_copies);
    const uint32_t triangles =
        options.triangles.value_or(scaled(kind.triangles, options.scale, least_triangles, most_triangles));
    require(triangles >= least_triangles && triangles <= most_triangles, ErrorCode::option_invalid,
            "triangles", "triangles is {}; it must be {} to {}", triangles, least_triangles, most_triangles);
    return {.seed = options.seed, .copies = copies, .triangles = triangles};
}

}  // namespace

std::span<const SampleKind> sample_kinds() {
    return kinds;
}

Scene make_sample(std::string_view name, const SampleOptions& options) {
    const Sample& sample = find_sample(name);
    Scene scene = sample.make(size_of(sample.kind, options));
    scene.name = name;
    turn_y_up(scene);
    return options.joined ? join(scene) : scene;
}

}  // namespace coppice
