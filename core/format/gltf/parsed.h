// A glTF file taken apart: its JSON and the bytes behind it. Filled step by step by read_gltf; each step's
// checks are what the next one relies on.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/format/gltf/accessor.h"
#include "core/format/gltf/json_text.h"
#include "core/format/gltf/pointer.h"
#include "core/scene/scene.h"

namespace coppice::gltf {

// What an accessor is read as; one thing only.
enum class Usage : uint8_t {
    none,
    indices,
    attribute,
    inverse_bind,
    animation_input,
    animation_output,
    instancing
};

// What a buffer view holds; one thing only. Its target says so, or its first use.
enum class ViewUsage : uint8_t { none, vertices, indices, inverse_bind, image, other };

// What is changed in an accessor's values when they are copied.
struct ValueRepair {
    bool zero_non_finite = false;
    bool unit_vector = false;  // the first three components
    bool unit_quaternion = false;
    bool cubic = false;  // only every third element, from the second on: the others are tangents
    bool any() const { return zero_non_finite || unit_vector || unit_quaternion; }
};

struct Parsed {
    Json json;  // repaired as reading goes on
    bool is_glb = false;
    std::optional<ByteView> binary;  // of a GLB
    std::vector<Bytes> owned;        // what the views below point to where it is not the upload
    std::vector<ByteView> buffers;
    std::vector<ByteView> views;         // decompressed where EXT_meshopt_compression is used
    std::vector<ViewUsage> view_usages;  // per view
    std::vector<Accessor> accessors;
    std::vector<Usage> usages;         // per accessor
    std::vector<ValueRepair> repairs;  // per accessor
    std::vector<Image> images;
    std::vector<Warning> warnings;

    void warn(std::string code, std::string message, const Pointer& where = {}) {
        warnings.push_back({std::move(code), std::move(message), where.text()});
    }
};

// A child that may be missing; the static empty array or object then.
const Json& list(const Json& object, std::string_view key);
const Json& member(const Json& object, std::string_view key);
const Json* extension(const Json& object, std::string_view name);  // null when there is none

// The schema has been checked, so these cannot fail.
std::optional<uint32_t> index_at(const Json& object, std::string_view key);
uint64_t unsigned_at(const Json& object, std::string_view key, uint64_t otherwise = 0);
double number_at(const Json& object, std::string_view key, double otherwise = 0);
std::string text_at(const Json& object, std::string_view key);

// As coppice::require, for places in the document.
template <typename... Args>
void require(bool condition, ErrorCode code, const Pointer& where, fmt::format_string<Args...> message,
             Args&&... args) {
    if (!condition) fail(code, where.text(), fmt::format(message, std::forward<Args>(args)...));
}

// What is there is wrong: the message goes on after the place.
template <typename... Args>
[[noreturn]] void refuse(const Pointer& where, fmt::format_string<Args...> message, Args&&... args) {
    fail(ErrorCode::asset_malformed, where.text(),
         fmt::format("{} {}", where.is_root() ? "the document" : where.text(),
                     fmt::format(message, std::forward<Args>(args)...)));
}

template <typename... Args>
void demand(bool condition, const Pointer& where, fmt::format_string<Args...> message, Args&&... args) {
    if (!condition) refuse(where, message, std::forward<Args>(args)...);
}

}  // namespace coppice::gltf
