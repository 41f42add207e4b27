#include "core/format/gltf/check_schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/format/gltf/parsed.h"
#include "core/format/gltf/schema.h"

namespace coppice::gltf {

namespace {

constexpr double largest_integer = 9007199254740991.0;  // 2^53 - 1: the largest that JSON carries safely

std::string shown(const Json& value) {
    std::string text = value.is_structured() ? std::string(value.type_name()) : print_json(value);
    if (text.size() > 60) text.replace(57, std::string::npos, "...");
    return text;
}

template <typename Value>
bool has_equal(std::vector<Value> values) {
    std::sort(values.begin(), values.end());
    return std::adjacent_find(values.begin(), values.end()) != values.end();
}

// Of whole numbers that are not negative, or of strings: it has passed the checks of its elements.
bool has_equal_elements(const Json& array, Kind kind) {
    if (kind != Kind::text) return has_equal(array.get<std::vector<uint64_t>>());
    std::vector<std::string_view> texts;
    for (const Json& item : array) texts.push_back(item.get_ref<const std::string&>());
    return has_equal(std::move(texts));
}

// Every value is looked at here, so nothing is made for a message before it is told: test, then refuse().
class SchemaCheck {
  public:
    SchemaCheck(Json& document, const Watch& watch) : document_(document), watch_(watch) {
        for (const Json& name : list(document, "extensionsUsed"))
            if (name.is_string()) used_.insert(name.get<std::string>());
    }

    void object(Json& value, const Schema& schema) {
        watch_.check();
        if (!value.is_object()) refuse("must be an object ({}), but is {}", schema.name, shown(value));
        for (const Property& property : schema.properties) {
            const auto found = value.find(property.name);
            if (found != value.end()) {
                where_.push(property.name);
                check(*found, property);
                where_.pop();
            } else if (property.required_) {
                refuse("has no '{}', which every {} must have", property.name, schema.name);
            }
        }
        extensions(value, schema.name);
    }

  private:
    template <typename... Args>
    [[noreturn]] void refuse(fmt::format_string<Args...> message, Args&&... args) const {
        gltf::refuse(where_, message, std::forward<Args>(args)...);
    }

    void check(Json& value, const Property& property) {
        if (!property.is_array) return element(value, property);
        if (!value.is_array()) refuse("must be an array, but is {}", shown(value));
        if (value.size() < property.min_items || value.size() > property.max_items)
            refuse("has {} elements; it must have {}{}", value.size(),
                   property.min_items == property.max_items ? "" : "at least ", property.min_items);
        for (size_t i = 0; i < value.size(); ++i) {
            where_.push(i);
            element(value[i], property);
            where_.pop();
        }
        if (property.is_unique && has_equal_elements(value, property.kind))
            refuse("has the same element twice");
    }

    void element(Json& value, const Property& property) {
        switch (property.kind) {
            case Kind::any:
                return;
            case Kind::boolean:
                if (!value.is_boolean()) refuse("must be true or false, but is {}", shown(value));
                return;
            case Kind::text:
                return text(value, property);
            case Kind::number:
                return number(value, property);
            case Kind::integer:
                return integer(value, property);
            case Kind::reference:
                return reference(value, property.of);
            case Kind::reference_map:
                return reference_map(value, property.of);
            case Kind::object:
                return object(value, *find_schema(property.of));
        }
    }

    void text(const Json& value, const Property& property) const {
        if (!value.is_string()) refuse("must be a string, but is {}", shown(value));
        const auto& allowed = property.texts;
        if (allowed.empty()) return;
        const auto& is = value.get_ref<const std::string&>();
        if (std::find(allowed.begin(), allowed.end(), is) == allowed.end())
            refuse("is {}; it must be one of {}", shown(value), fmt::join(allowed, ", "));
    }

    void range(const Json& value, double number, const Property& property) const {
        const bool above = property.above_min ? number > property.min : number >= property.min;
        if (above && number <= property.max) return;
        refuse("is {}; it must be {} {}{}", shown(value), property.above_min ? "above" : "at least",
               property.min,
               std::isinf(property.max) ? std::string() : fmt::format(" and at most {}", property.max));
    }

    void number(const Json& value, const Property& property) const {
        if (!value.is_number()) refuse("must be a number, but is {}", shown(value));
        if (!std::isfinite(value.get<double>())) refuse("must be finite, but is {}", shown(value));
        range(value, value.get<double>(), property);
    }

    void whole_number(Json& value) const {
        if (!value.is_number()) refuse("must be an integer, but is {}", shown(value));
        if (value.is_number_float()) {
            const double number = value.get<double>();
            if (number != std::floor(number) || std::abs(number) > largest_integer)
                refuse("must be an integer, but is {}", shown(value));
            if (number < 0)
                value = static_cast<int64_t>(number);
            else
                value = static_cast<uint64_t>(number);
        }
        if (value.is_number_unsigned() && value.get<uint64_t>() > static_cast<uint64_t>(largest_integer))
            refuse("is {}; a number may be at most {:.0f}", shown(value), largest_integer);
    }

    void integer(Json& value, const Property& property) const {
        whole_number(value);
        const auto& allowed = property.integers;
        const double number = value.get<double>();
        const auto is_it = [number](int64_t a) { return static_cast<double>(a) == number; };
        if (!allowed.empty() && std::none_of(allowed.begin(), allowed.end(), is_it))
            refuse("is {}; it must be one of {}", shown(value), fmt::join(allowed, ", "));
        range(value, number, property);
    }

    // of: an array of the root; empty: any index.
    void reference(Json& value, std::string_view of) const {
        whole_number(value);
        if (!value.is_number_unsigned() || value.get<uint64_t>() > UINT32_MAX)
            refuse("must be an index, but is {}", shown(value));
        if (of.empty()) return;
        const Json& array = list(document_, of);
        const size_t size = array.is_array() ? array.size() : 0;
        if (value.get<uint64_t>() >= size)
            refuse("refers to {} {}, but there are {}", of, shown(value), size);
    }

    void reference_map(Json& value, std::string_view of) {
        if (!value.is_object()) refuse("must be an object, but is {}", shown(value));
        if (value.empty()) refuse("is empty; it must name at least one accessor");
        for (auto& [key, item] : value.get_ref<Json::object_t&>()) {
            where_.push(key);
            reference(item, of);
            where_.pop();
        }
    }

    void extensions(Json& value, std::string_view schema) {
        const auto found = value.find("extensions");
        if (found == value.end()) return;
        where_.push("extensions");
        if (!found->is_object()) refuse("must be an object, but is {}", shown(*found));
        for (auto& [name, content] : found->get_ref<Json::object_t&>()) {
            where_.push(name);
            if (!content.is_object()) refuse("must be an object, but is {}", shown(content));
            if (!used_.contains(name)) refuse("is not declared in extensionsUsed");
            extension(name, content, schema);
            where_.pop();
        }
        where_.pop();
    }

    void extension(const std::string& name, Json& content, std::string_view on) {
        bool known = false;
        for (const ExtensionPlace& place : extension_places()) {
            if (place.extension != name) continue;
            known = true;
            if (place.on != on) continue;
            if (!place.schema.empty()) object(content, *find_schema(place.schema));
            return;
        }
        if (known) refuse("is at a place where this extension has no meaning (on a {})", on);
    }

    Json& document_;
    const Watch& watch_;
    std::set<std::string> used_;
    Pointer where_;
};

}  // namespace

void check_schema(Json& document, const Watch& watch) {
    SchemaCheck(document, watch).object(document, *find_schema("root"));
}

}  // namespace coppice::gltf
