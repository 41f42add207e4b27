#include "core/format/gltf/accessor.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace coppice::gltf {

namespace {

double load_component(const std::byte* at, ComponentType type) {
    switch (type) {
        case ComponentType::int8:
            return load<int8_t>(at);
        case ComponentType::uint8:
            return load<uint8_t>(at);
        case ComponentType::int16:
            return load<int16_t>(at);
        case ComponentType::uint16:
            return load<uint16_t>(at);
        case ComponentType::uint32:
            return load<uint32_t>(at);
        case ComponentType::float32:
            return load<float>(at);
    }
    return 0;
}

double largest(ComponentType type) {
    switch (type) {
        case ComponentType::int8:
            return std::numeric_limits<int8_t>::max();
        case ComponentType::uint8:
            return std::numeric_limits<uint8_t>::max();
        case ComponentType::int16:
            return std::numeric_limits<int16_t>::max();
        case ComponentType::uint16:
            return std::numeric_limits<uint16_t>::max();
        case ComponentType::uint32:
            return std::numeric_limits<uint32_t>::max();
        case ComponentType::float32:
            break;
    }
    return 1;
}

double smallest(ComponentType type) {
    const bool is_signed = type == ComponentType::int8 || type == ComponentType::int16;
    return is_signed ? -largest(type) - 1 : 0;
}

template <typename T>
void append_value(Bytes& out, double stored) {
    const T value = static_cast<T>(stored);
    append(out, std::as_bytes(std::span(&value, 1)));
}

}  // namespace

uint32_t size_of(ComponentType type) {
    switch (type) {
        case ComponentType::int8:
        case ComponentType::uint8:
            return 1;
        case ComponentType::int16:
        case ComponentType::uint16:
            return 2;
        case ComponentType::uint32:
        case ComponentType::float32:
            break;
    }
    return 4;
}

uint32_t IntegerView::operator[](uint64_t i) const {
    assert((i + 1) * size_of(type) <= bytes.size());
    return static_cast<uint32_t>(load_component(bytes.data() + i * size_of(type), type));
}

uint32_t Accessor::element_size() const {
    const uint32_t column = rows * size_of(storage.type);
    return columns == 1 ? column : (columns - 1) * ((column + 3) / 4 * 4) + column;
}

uint32_t Accessor::tight_stride() const {
    const uint32_t column = rows * size_of(storage.type);
    return columns == 1 ? column : columns * ((column + 3) / 4 * 4);
}

const std::byte* Accessor::locate(uint64_t element) const {
    assert(element < count);
    if (sparse.count > 0) {
        uint64_t low = 0;
        uint64_t high = sparse.count;
        while (low < high) {
            const uint64_t middle = low + (high - low) / 2;
            if (sparse.indices[middle] < element)
                low = middle + 1;
            else
                high = middle;
        }
        if (low < sparse.count && sparse.indices[low] == element)
            return sparse.values.data() + low * tight_stride();
    }
    if (bytes.empty()) return nullptr;
    assert(element * stride + element_size() <= bytes.size());
    return bytes.data() + element * stride;
}

double Accessor::raw(uint64_t element, uint32_t component) const {
    const std::byte* at = locate(element);
    if (at == nullptr) return 0;
    const uint32_t size = size_of(storage.type);
    if (columns == 1) return load_component(at + component * size, storage.type);
    const uint32_t column = (rows * size + 3) / 4 * 4;
    return load_component(at + component / rows * column + component % rows * size, storage.type);
}

float Accessor::value(uint64_t element, uint32_t component) const {
    return static_cast<float>(decoded(raw(element, component), storage));
}

bool fits(uint64_t count, uint64_t offset, uint64_t stride, uint64_t element_size, uint64_t length) {
    if (count == 0) return true;
    if (offset > length || element_size > length - offset || stride == 0) return false;
    return count - 1 <= (length - offset - element_size) / stride;
}

double decoded(double stored, Storage storage) {
    return storage.normalized ? std::max(stored / largest(storage.type), -1.0) : stored;
}

double encoded(double value, Storage storage) {
    if (storage.type == ComponentType::float32) return value;
    const double scaled = storage.normalized ? value * largest(storage.type) : value;
    return std::clamp(std::round(scaled), smallest(storage.type), largest(storage.type));
}

void append_component(Bytes& out, double stored, ComponentType type) {
    switch (type) {
        case ComponentType::int8:
            return append_value<int8_t>(out, stored);
        case ComponentType::uint8:
            return append_value<uint8_t>(out, stored);
        case ComponentType::int16:
            return append_value<int16_t>(out, stored);
        case ComponentType::uint16:
            return append_value<uint16_t>(out, stored);
        case ComponentType::uint32:
            return append_value<uint32_t>(out, stored);
        case ComponentType::float32:
            return append_value<float>(out, stored);
    }
}

}  // namespace coppice::gltf
