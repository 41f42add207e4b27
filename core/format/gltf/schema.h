// What properties glTF objects have, of which type and range: the part of the specification that is a table.
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

namespace coppice::gltf {

enum class Kind : uint8_t { integer, number, boolean, text, reference, object, reference_map, any };

// One property of an object. Arrays hold `kind` elements; numbers and integers lie in [min, max].
struct Property {
    std::string_view name;
    Kind kind = Kind::any;
    std::string_view of = {};  // reference: array at the root; object: its schema
    bool required_ = false;
    bool is_array = false;
    bool is_unique = false;  // of the elements
    bool above_min = false;  // min itself is out of range
    size_t min_items = 1;
    size_t max_items = std::numeric_limits<size_t>::max();
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    std::vector<int64_t> integers = {};        // the only ones allowed; empty: any
    std::vector<std::string_view> texts = {};  // the only ones allowed; empty: any

    Property required() const;
    Property at_least(double value) const;
    Property above(double value) const;
    Property between(double low, double high) const;
    Property items(size_t at_least, size_t at_most = std::numeric_limits<size_t>::max()) const;
    Property unique() const;
};

struct Schema {
    std::string_view name;
    std::vector<Property> properties;
};

// Never null for the names that schemas mention; "root" is the whole document.
const Schema* find_schema(std::string_view name);

// Where an extension's object may stand, and its schema there.
struct ExtensionPlace {
    std::string_view extension;
    std::string_view on;  // schema of the object that has it; empty: nowhere, the extension has no objects
    std::string_view schema;  // of the extension's object; empty: anything
};

const std::vector<ExtensionPlace>& extension_places();

}  // namespace coppice::gltf
