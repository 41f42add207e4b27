// Long work that can be stopped: loops over very many items, steps of uneven size, large arrays.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/watch.h"

namespace coppice {

// Items between two looks at the watch: a few milliseconds where an item is a triangle or a wedge.
inline constexpr size_t watched_stride = size_t{1} << 14;

// Bytes between two looks where memory is touched for the first time, which costs more than writing to it.
inline constexpr size_t watched_bytes = size_t{4} << 20;

// Calls body(i) for 0..count-1 in order, and watch.check() before the first and then once in a stride.
template <typename Body>
void watched_loop(size_t count, const Watch& watch, Body&& body) {
    watch.check();
    for (size_t begin = 0; begin < count;) {
        const size_t end = std::min(count, begin + watched_stride);
        for (size_t i = begin; i < end; ++i) body(i);
        begin = end;
        watch.check();
    }
}

// For items of uneven size, a vertex of six triangles or of a million: counts what was done rather than
// items, and looks at the watch once in a stride of that.
class WatchedSteps {
  public:
    explicit WatchedSteps(Watch watch) : watch_(std::move(watch)) {}

    // After so many steps, each about a look at one triangle.
    void add(size_t steps) {
        done_ += steps;
        if (done_ < watched_stride) return;
        done_ = 0;
        watch_.check();
    }

    // The same order, counted: for sorting very many.
    template <typename Order>
    auto counting(Order order) {
        return [this, order](const auto& a, const auto& b) {
            add(1);
            return order(a, b);
        };
    }

  private:
    Watch watch_;
    size_t done_ = 0;
};

// values.resize(count, value), looking at the watch in between.
template <typename T>
void watched_resize(std::vector<T>& values, size_t count, const Watch& watch, const T& value = T()) {
    constexpr size_t stride = std::max<size_t>(1, watched_bytes / sizeof(T));
    values.reserve(count);
    while (values.size() < count) {
        watch.check();
        values.resize(std::min(count, values.size() + stride), value);
    }
}

// std::vector<T>(count, value), likewise.
template <typename T>
std::vector<T> watched_vector(size_t count, const Watch& watch, const T& value = T()) {
    std::vector<T> values;
    watched_resize(values, count, watch, value);
    return values;
}

// Appends copies, likewise. Who knows how many will come makes room first.
template <typename T>
void watched_append(std::vector<T>& values, std::type_identity_t<std::span<const T>> from,
                    const Watch& watch) {
    constexpr size_t stride = std::max<size_t>(1, watched_bytes / sizeof(T));
    for (; !from.empty(); from = from.subspan(std::min(stride, from.size()))) {
        watch.check();
        const std::span<const T> piece = from.first(std::min(stride, from.size()));
        values.insert(values.end(), piece.begin(), piece.end());
    }
}

// A copy, likewise.
template <typename T>
std::vector<T> watched_copy(const std::vector<T>& from, const Watch& watch) {
    std::vector<T> values;
    values.reserve(from.size());
    watched_append(values, std::span(from), watch);
    return values;
}

}  // namespace coppice
