#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/format/gltf/checks.h"

namespace coppice::gltf {

namespace {

constexpr double quaternion_tolerance = 0.00769;  // as Khronos' validator has it

// Accessors whose values were looked at, for whatever animation.
struct Seen {
    std::set<uint32_t> times;
    std::set<std::pair<uint32_t, bool>> quaternions;  // with: cubic
};

class AnimationCheck {
  public:
    AnimationCheck(Parsed& parsed, size_t index, Seen& seen, const Watch& watch)
        : parsed_(parsed),
          seen_(seen),
          watch_(watch),
          json_(parsed.json["animations"][index]),
          where_(pointer("animations", index)) {}

    void run() {
        const Json& samplers = json_["samplers"];
        for (size_t i = 0; i < samplers.size(); ++i) {
            watch_.check();
            sampler(samplers[i], where_ / "samplers" / i);
        }
        const Json& channels = json_["channels"];
        std::set<std::pair<uint32_t, std::string>> targets;
        for (size_t i = 0; i < channels.size(); ++i) {
            watch_.check();
            const Pointer where = where_ / "channels" / i;
            demand(unsigned_at(channels[i], "sampler") < samplers.size(), where / "sampler",
                   "is {}, but there are {} samplers", unsigned_at(channels[i], "sampler"), samplers.size());
            const Json& target = channels[i]["target"];
            if (const auto node = index_at(target, "node"))
                demand(targets.insert({*node, text_at(target, "path")}).second, where / "target",
                       "is the {} of node {}, which another channel animates already",
                       text_at(target, "path"), *node);
            channel(channels[i], where);
        }
    }

  private:
    static bool is_cubic(const Json& sampler) { return text_at(sampler, "interpolation") == "CUBICSPLINE"; }

    void use(const Json& sampler, const char* end, Usage usage, const Pointer& where) {
        const uint32_t index = *index_at(sampler, end);
        set_usage(parsed_, index, usage, where / end);
        const auto view = index_at(parsed_.json["accessors"][index], "bufferView");
        demand(!view || !parsed_.json["bufferViews"][*view].contains("byteStride"), where / end,
               "is accessor {}, whose buffer view has a byteStride; only vertex attributes may", index);
        if (view) set_view_usage(parsed_, *view, ViewUsage::other, where / end);
    }

    void sampler(const Json& sampler, const Pointer& where) {
        use(sampler, "input", Usage::animation_input, where);
        use(sampler, "output", Usage::animation_output, where);
        const uint32_t index = *index_at(sampler, "input");
        const Accessor& input = parsed_.accessors[index];
        demand(input.components() == 1 && input.storage.type == ComponentType::float32, where / "input",
               "is accessor {}, which must be SCALAR of 32-bit floats", index);
        const Json& json = parsed_.json["accessors"][index];
        demand(json.contains("min") && json.contains("max"), where / "input",
               "is accessor {}, which has no min and max; times must have them", index);
        demand(!is_cubic(sampler) || input.count >= 2, where / "input",
               "is accessor {} with {} times; CUBICSPLINE needs two", index, input.count);
        if (input.has_no_data() || !seen_.times.insert(index).second) return;
        for (uint64_t i = 0; i < input.count; ++i) {
            if (i % 65536 == 0) watch_.check();
            const double time = input.raw(i, 0);
            demand(time >= 0, where / "input", "is accessor {}, whose time {} is {}; it must not be negative",
                   index, i, time);
            demand(i == 0 || time > input.raw(i - 1, 0), where / "input",
                   "is accessor {}, whose time {} is {} after {}; times must increase", index, i, time,
                   i == 0 ? 0 : input.raw(i - 1, 0));
        }
    }

    void channel(const Json& channel, const Pointer& where) {
        const Json& target = channel["target"];
        const std::string path = text_at(target, "path");
        const auto node = index_at(target, "node");
        if (const Json* to = extension(target, "KHR_animation_pointer"); to != nullptr) {
            const Pointer at = where / "target" / "extensions" / "KHR_animation_pointer";
            demand(!node, at, "is there, so the target must have no node");
            demand(path == "pointer", at, "is there, so the target's path must be 'pointer', but is '{}'",
                   path);
            return;
        }
        uint64_t values_per_key = 1;
        if (node) values_per_key = target_node(*node, path, where / "target");
        const Json& sampler = json_["samplers"][channel["sampler"].get<size_t>()];
        const uint32_t index = *index_at(sampler, "output");
        const Accessor& output = parsed_.accessors[index];
        check_format(output, path, index, where);
        const uint64_t keys =
            parsed_.accessors[*index_at(sampler, "input")].count * (is_cubic(sampler) ? 3 : 1);
        if (path != "weights" || node)
            demand(output.count == keys * values_per_key, where / "sampler",
                   "has accessor {} with {} values as output; it must be {}", index, output.count,
                   keys * values_per_key);
        if (path == "rotation" && !output.has_no_data()) quaternions(output, index, is_cubic(sampler), where);
    }

    // Checks that the node can be animated so; how many numbers a key has.
    uint64_t target_node(uint32_t index, const std::string& path, const Pointer& where) {
        const Json& node = parsed_.json["nodes"][index];
        if (path == "translation" || path == "rotation" || path == "scale") {
            demand(!node.contains("matrix"), where, "is the {} of node {}, which has a matrix", path, index);
            return 1;
        }
        if (path != "weights") return 1;
        const auto mesh = index_at(node, "mesh");
        const size_t targets =
            mesh ? list(parsed_.json["meshes"][*mesh]["primitives"][0], "targets").size() : 0;
        demand(targets > 0, where, "is the weights of node {}, whose mesh has no morph targets", index);
        return targets;
    }

    static void check_format(const Accessor& output, const std::string& path, uint32_t index,
                             const Pointer& where) {
        const Storage& storage = output.storage;
        const bool is_float = storage.type == ComponentType::float32;
        const auto demand_format = [&](uint32_t components, bool may_be_normalized) {
            demand(output.columns == 1 && output.rows == components &&
                       (is_float || (may_be_normalized && storage.normalized)),
                   where / "sampler", "has accessor {} as output, which a {} cannot be", index, path);
        };
        if (path == "translation" || path == "scale") demand_format(3, false);
        if (path == "rotation") demand_format(4, true);
        if (path == "weights") demand_format(1, true);
    }

    void quaternions(const Accessor& output, uint32_t index, bool cubic, const Pointer& where) {
        if (!seen_.quaternions.insert({index, cubic}).second) return;
        uint64_t wrong = 0;
        for (uint64_t i = cubic ? 1 : 0; i < output.count; i += cubic ? 3 : 1) {
            watch_.check();
            double sum = 0;
            for (uint32_t c = 0; c < 4; ++c) {
                const double v = output.value(i, c);
                sum += v * v;
            }
            demand(sum > 1e-12, where / "sampler", "has accessor {} as output, whose quaternion {} is zero",
                   index, i);
            wrong += !(std::abs(std::sqrt(sum) - 1) <= quaternion_tolerance);
        }
        if (wrong == 0 || parsed_.repairs[index].unit_quaternion) return;
        parsed_.repairs[index].unit_quaternion = true;
        parsed_.repairs[index].cubic = cubic;
        parsed_.warn(
            "repair.rotation",
            fmt::format("{} quaternions of {} had not the length 1; they were given it", wrong, where),
            pointer("accessors", index));
    }

    Parsed& parsed_;
    Seen& seen_;
    const Watch& watch_;
    const Json& json_;
    Pointer where_;
};

}  // namespace

void check_animations(Parsed& parsed, const Watch& watch) {
    Seen seen;
    for (size_t i = 0; i < list(parsed.json, "animations").size(); ++i)
        AnimationCheck(parsed, i, seen, watch).run();
}

}  // namespace coppice::gltf
