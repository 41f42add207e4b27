#include <algorithm>
#include <cmath>
#include <limits>

#include "core/format/gltf/read_buffers.h"

namespace coppice::gltf {

namespace {

void check_sparse(const Accessor& accessor, const Pointer& where) {
    for (uint64_t i = 0; i < accessor.sparse.count; ++i) {
        const uint32_t index = accessor.sparse.indices[i];
        demand(index < accessor.count, where / "sparse" / "indices",
               "has {} at {}, but the accessor has {} elements", index, i, accessor.count);
        demand(i == 0 || index > accessor.sparse.indices[i - 1], where / "sparse" / "indices",
               "has {} at {} after {}; they must increase", index, i,
               i == 0 ? 0 : accessor.sparse.indices[i - 1]);
    }
}

struct Range {
    double min = std::numeric_limits<double>::infinity();
    double max = -std::numeric_limits<double>::infinity();
};

// Ranges of the finite values, per component; counts the others.
uint64_t find_ranges(const Accessor& accessor, std::vector<Range>& ranges, const Watch& watch) {
    constexpr uint64_t between_checks = 65536;
    ranges.assign(accessor.components(), {});
    uint64_t not_finite = 0;
    for (uint64_t begin = 0; begin < accessor.count; begin += between_checks) {
        watch.check();
        const uint64_t end = std::min(accessor.count, begin + between_checks);
        for (uint32_t c = 0; c < accessor.components(); ++c) {
            Range range = ranges[c];
            accessor.for_each_raw(begin, end, c, [&](double value) {
                if (!std::isfinite(value)) {
                    ++not_finite;
                    return;
                }
                range.min = std::min(range.min, value);
                range.max = std::max(range.max, value);
            });
            ranges[c] = range;
        }
    }
    return not_finite;
}

bool matches(const Json& declared, double actual, ComponentType type) {
    if (type == ComponentType::float32)
        return static_cast<float>(declared.get<double>()) == static_cast<float>(actual);
    return declared.get<double>() == actual;
}

Json number(double value, ComponentType type) {
    if (type == ComponentType::float32) return value;
    return static_cast<int64_t>(value);
}

void repair_bounds(Parsed& parsed, size_t index, const std::vector<Range>& ranges) {
    Json& json = parsed.json["accessors"][index];
    const ComponentType type = parsed.accessors[index].storage.type;
    bool wrong = false;
    for (size_t c = 0; c < ranges.size(); ++c) {
        if (ranges[c].min > ranges[c].max) continue;  // no finite value at all
        if (json.contains("min") && !matches(json["min"][c], ranges[c].min, type)) {
            json["min"][c] = number(ranges[c].min, type);
            wrong = true;
        }
        if (json.contains("max") && !matches(json["max"][c], ranges[c].max, type)) {
            json["max"][c] = number(ranges[c].max, type);
            wrong = true;
        }
    }
    if (wrong)
        parsed.warn(
            "repair.bounds",
            fmt::format("accessor {} declared a min or max that its values do not have; it was set to theirs",
                        index),
            pointer("accessors", index));
}

}  // namespace

void check_accessor_data(Parsed& parsed, const Watch& watch) {
    for (size_t i = 0; i < parsed.accessors.size(); ++i) {
        watch.check();
        const Accessor& accessor = parsed.accessors[i];
        const Pointer where = pointer("accessors", i);
        check_sparse(accessor, where);
        // Nothing to look at: what Draco compressed, or zeros.
        if (accessor.has_no_data()) continue;
        std::vector<Range> ranges;
        const uint64_t not_finite = find_ranges(accessor, ranges, watch);
        demand(not_finite == 0 || parsed.repairs[i].zero_non_finite, where,
               "has {} numbers that are infinite or not a number; all of them must be finite", not_finite);
        if (not_finite > 0)
            parsed.warn(
                "repair.non_finite",
                fmt::format("accessor {} has {} numbers that are infinite or not a number; they became 0", i,
                            not_finite),
                where);
        repair_bounds(parsed, i, ranges);
    }
}

}  // namespace coppice::gltf
