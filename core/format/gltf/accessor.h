// The only reader of glTF numbers. An Accessor is a checked window into bytes: making one proves that every
// element lies inside its buffer view, so reading needs no further check.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "core/base/bytes.h"
#include "core/mesh/mesh.h"

namespace coppice::gltf {

uint32_t size_of(ComponentType type);  // bytes

// Integers of one type, side by side.
struct IntegerView {
    ComponentType type = ComponentType::uint32;
    ByteView bytes = {};

    uint32_t operator[](uint64_t i) const;
};

struct Accessor {
    Storage storage = {};
    uint32_t rows = 1;     // of a matrix; components of a vector
    uint32_t columns = 1;  // of a matrix; 1 for vectors
    uint64_t count = 0;
    ByteView bytes = {};  // from the first element on; empty: all zeros
    uint64_t stride = 0;

    struct Sparse {
        uint64_t count = 0;
        IntegerView indices = {};  // strictly increasing once check_accessor_data has passed
        ByteView values = {};      // tightly packed elements
    } sparse = {};

    // A placeholder that an extension fills, or one that is meant to be zeros: no byte of it is in the file.
    bool has_no_data() const { return bytes.empty() && sparse.count == 0; }

    uint32_t components() const { return rows * columns; }
    // Columns of matrices begin at multiples of 4 bytes; the last one is not padded here.
    uint32_t element_size() const;
    // Distance of elements that stand tightly: element_size, with the last column padded too.
    uint32_t tight_stride() const;

    // The stored number; normalized integers as they are. element < count, component < components().
    double raw(uint64_t element, uint32_t component) const;
    // visit(raw) for the elements begin..end, in order: the type is looked at once, not for each of them.
    template <typename Visit>
    void for_each_raw(uint64_t begin, uint64_t end, uint32_t component, const Visit& visit) const;
    // The same with normalized integers mapped to [-1, 1] or [0, 1].
    float value(uint64_t element, uint32_t component) const;
    // For indices and joints.
    uint32_t integer(uint64_t element) const { return static_cast<uint32_t>(raw(element, 0)); }

  private:
    const std::byte* locate(uint64_t element) const;  // null: zeros
};

template <typename T>
T load(const std::byte* at) {
    T value{};
    std::memcpy(&value, at, sizeof(T));
    return value;
}

template <typename Visit>
void Accessor::for_each_raw(uint64_t begin, uint64_t end, uint32_t component, const Visit& visit) const {
    const auto visit_all_as = [&]<typename T>(T) {
        const std::byte* at = bytes.data() + begin * stride + component * sizeof(T);
        for (uint64_t i = begin; i < end; ++i, at += stride) visit(static_cast<double>(load<T>(at)));
    };
    if (begin == end) return;
    if (sparse.count > 0 || columns > 1 || bytes.empty()) {
        for (uint64_t i = begin; i < end; ++i) visit(raw(i, component));
        return;
    }
    switch (storage.type) {
        case ComponentType::int8:
            return visit_all_as(int8_t{});
        case ComponentType::uint8:
            return visit_all_as(uint8_t{});
        case ComponentType::int16:
            return visit_all_as(int16_t{});
        case ComponentType::uint16:
            return visit_all_as(uint16_t{});
        case ComponentType::uint32:
            return visit_all_as(uint32_t{});
        case ComponentType::float32:
            return visit_all_as(float{});
    }
}

// count elements of element_size bytes, stride apart, fit behind offset. Cannot overflow.
bool fits(uint64_t count, uint64_t offset, uint64_t stride, uint64_t element_size, uint64_t length);

// A stored integer as the number it stands for, and back to the nearest one. value must be finite.
double decoded(double stored, Storage storage);
double encoded(double value, Storage storage);
void append_component(Bytes& out, double stored, ComponentType type);

}  // namespace coppice::gltf
