// A JSON pointer (RFC 6901) to a place in a document.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace coppice::gltf {

// Checks make one for all that they look at, and nearly none is ever told: so it is kept as its steps, which
// allocates nothing, and becomes text where an error or a warning is. Keys are views, of literals or of the
// document.
class Pointer {
  public:
    void push(std::string_view key) { add({key.data(), key.size()}); }
    void push(size_t index) { add({nullptr, index}); }
    void pop() { --depth_; }

    template <typename KeyOrIndex>
    Pointer operator/(const KeyOrIndex& step) const {
        Pointer longer = *this;
        longer.push(step);
        return longer;
    }

    bool is_root() const { return depth_ == 0; }
    std::string text() const;  // "/meshes/3/primitives/0"; long keys are cut

  private:
    struct Step {
        const char* key;  // null: an index
        size_t size_or_index;
    };
    void add(Step step);

    std::array<Step, 12> steps_;  // the schemas go no deeper
    size_t depth_ = 0;
};

// "/meshes/3", then "/meshes/3/primitives/0".
template <typename... Steps>
Pointer pointer(const Steps&... steps) {
    return (Pointer() / ... / steps);
}

}  // namespace coppice::gltf

template <>
struct fmt::formatter<coppice::gltf::Pointer> {
    constexpr auto parse(fmt::format_parse_context& context) { return context.begin(); }
    template <typename Context>
    auto format(const coppice::gltf::Pointer& pointer, Context& context) const {
        const std::string text = pointer.text();
        return std::copy(text.begin(), text.end(), context.out());
    }
};
