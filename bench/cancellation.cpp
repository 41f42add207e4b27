// How long a job goes on after it was told to stop, at worst: the longest processor time between two looks at
// the stop, for each stage of whole optimizations (bytes to bytes, one thread) and for every algorithm.
//
//   build/release/bench/bench_cancellation [FILE | TRIANGLES]...
//
// A number is a generated sphere of about so many triangles. Without arguments: one of 4,000,000.
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <string_view>

#include "core/format/format.h"
#include "core/optimize/optimize.h"
#include "core/simplify/registry.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

// Of this process, which does nothing else: what else the machine does must not count.
double milliseconds() {
    return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Stage {
    double longest_ms = 0;
    size_t checks = 0;
};

class Observer {
  public:
    Watch watch() {
        return {.stage = [this](std::string_view stage) { current_ = stage; }, .checked = [this] { note(); }};
    }
    void note() {
        const double now = milliseconds();
        Stage& stage = stages_[current_];
        stage.longest_ms = std::max(stage.longest_ms, now - last_);
        ++stage.checks;
        last_ = now;
    }
    const std::map<std::string, Stage>& stages() const { return stages_; }

  private:
    double last_ = milliseconds();
    std::string current_ = "read";
    std::map<std::string, Stage> stages_;
};

Bytes read_whole(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    return to_bytes(text);
}

Bytes sphere(size_t triangles) {
    const auto rings = static_cast<uint32_t>(std::lround(std::sqrt(static_cast<double>(triangles) / 4)));
    Scene scene;
    scene.meshes.push_back(shapes::sphere({.segments = 2 * rings, .rings = rings}));
    scene.materials.resize(scene.meshes[0].slots.size());
    Node node;
    node.mesh = 0;
    scene.nodes.push_back(node);
    scene.roots.push_back(0);
    return write_asset(scene, {}, {}).bytes;
}

std::map<std::string, Stage> observe(const Upload& upload, std::string_view algorithm) {
    Observer observer;
    optimize(upload, {.algorithm = std::string(algorithm), .ratio = 0.5, .threads = 1}, {}, observer.watch());
    observer.note();
    return observer.stages();
}

// Reading, discovering and writing are the same for all algorithms: told once.
void measure(const std::string& what) {
    size_t triangles = 0;
    const bool is_number =
        std::from_chars(what.data(), what.data() + what.size(), triangles).ec == std::errc();
    const Bytes bytes = is_number ? sphere(triangles) : read_whole(what);
    const Upload upload = {.asset = {.path = is_number ? "sphere.glb" : what, .bytes = bytes}};
    const auto print = [&what](const std::string& stage, const Stage& observed) {
        fmt::print("| {} | {} | {} | {:.1f} |\n", what, stage, observed.checks, observed.longest_ms);
        std::fflush(stdout);
    };
    for (const Algorithm& algorithm : algorithms()) {
        for (const auto& [stage, observed] : observe(upload, algorithm.id)) {
            if (stage == "simplify")
                print(fmt::format("{} with {}", stage, algorithm.id), observed);
            else if (algorithm.id == default_algorithm().id)
                print(stage, observed);
        }
    }
}

}  // namespace
}  // namespace coppice

int main(int count, char** arguments) {
    fmt::print("| asset | stage | looks | longest between two, ms |\n|---|---|---:|---:|\n");
    if (count == 1) coppice::measure("4000000");
    for (int i = 1; i < count; ++i) coppice::measure(arguments[i]);
    return 0;
}
