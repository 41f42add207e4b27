#include "core/format/gltf/pointer.h"

#include <cassert>

namespace coppice::gltf {

void Pointer::add(Step step) {
    assert(depth_ < steps_.size());
    steps_[depth_++] = step;
}

std::string Pointer::text() const {
    constexpr size_t longest_key = 200;
    std::string out;
    for (size_t i = 0; i < depth_; ++i) {
        out += '/';
        const auto [key, size_or_index] = steps_[i];
        if (key == nullptr) {
            out += std::to_string(size_or_index);
            continue;
        }
        for (const char c : std::string_view(key, std::min(size_or_index, longest_key)))
            out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    }
    return out;
}

}  // namespace coppice::gltf
