#include "core/format/gltf/check_schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/error.h"
#include "core/format/gltf/schema.h"

namespace coppice::gltf {

namespace {

constexpr double largest_integer = 9007199254740991.0;  // 2^53 - 1: the largest that JSON carries safely

std::string escaped(std::string_view key) {
    std::string out;
    for (const char c : key.substr(0, 200)) out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    return out;
}

std::string shown(const Json& value) {
    std::string text = value.is_structured() ? std::string(value.type_name()) : print_json(value);
    return text.size() > 60 ? text.substr(0, 57) + "..." : text;
}

class SchemaCheck {
  public:
    explicit SchemaCheck(Json& document) : document_(document) {
        for (const char* list : {"extensionsUsed"})
            if (document.contains(list) && document[list].is_array())
                for (const Json& name : document[list])
                    if (name.is_string()) used_.insert(name.get<std::string>());
    }

    void object(Json& value, const Schema& schema) {
        demand(value.is_object(), "must be an object ({}), but is {}", schema.name, shown(value));
        for (const Property& property : schema.properties) {
            const auto found = value.find(property.name);
            if (found == value.end()) {
                demand(!property.required_, "has no '{}', which every {} must have", property.name,
                       schema.name);
                continue;
            }
            const size_t length = push(property.name);
            check(*found, property);
            pointer_.resize(length);
        }
        extensions(value, schema.name);
    }

  private:
    template <typename... Args>
    void demand(bool condition, fmt::format_string<Args...> message, Args&&... args) const {
        if (!condition)
            fail(ErrorCode::asset_malformed, pointer_,
                 fmt::format("{} {}", pointer_.empty() ? "the document" : pointer_,
                             fmt::format(message, std::forward<Args>(args)...)));
    }

    size_t push(std::string_view key) {
        const size_t length = pointer_.size();
        pointer_ += '/';
        pointer_ += escaped(key);
        return length;
    }

    void check(Json& value, const Property& property) {
        if (!property.is_array) return element(value, property);
        demand(value.is_array(), "must be an array, but is {}", shown(value));
        demand(value.size() >= property.min_items && value.size() <= property.max_items,
               "has {} elements; {}", value.size(),
               property.min_items == property.max_items
                   ? fmt::format("it must have {}", property.min_items)
                   : fmt::format("it must have at least {}", property.min_items));
        for (size_t i = 0; i < value.size(); ++i) {
            const size_t length = push(std::to_string(i));
            element(value[i], property);
            pointer_.resize(length);
        }
        if (property.is_unique) {
            std::set<Json> seen(value.begin(), value.end());
            demand(seen.size() == value.size(), "has the same element twice");
        }
    }

    void element(Json& value, const Property& property) {
        switch (property.kind) {
            case Kind::any:
                return;
            case Kind::boolean:
                return demand(value.is_boolean(), "must be true or false, but is {}", shown(value));
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
        demand(value.is_string(), "must be a string, but is {}", shown(value));
        const auto& allowed = property.texts;
        if (allowed.empty()) return;
        demand(
            std::find(allowed.begin(), allowed.end(), value.get_ref<const std::string&>()) != allowed.end(),
            "is {}; it must be one of {}", shown(value), fmt::join(allowed, ", "));
    }

    void range(const Json& value, double number, const Property& property) const {
        const bool inside = number >= property.min && number <= property.max &&
                            !(property.above_min && number == property.min);
        demand(inside, "is {}; it must be {} {}{}", shown(value), property.above_min ? "above" : "at least",
               property.min,
               std::isinf(property.max) ? std::string() : fmt::format(" and at most {}", property.max));
    }

    void number(const Json& value, const Property& property) const {
        demand(value.is_number(), "must be a number, but is {}", shown(value));
        demand(std::isfinite(value.get<double>()), "must be finite, but is {}", shown(value));
        if (!std::isinf(property.min) || !std::isinf(property.max))
            range(value, value.get<double>(), property);
    }

    void whole_number(Json& value) const {
        demand(value.is_number(), "must be an integer, but is {}", shown(value));
        if (value.is_number_float()) {
            const double number = value.get<double>();
            demand(number == std::floor(number) && std::abs(number) <= largest_integer,
                   "must be an integer, but is {}", shown(value));
            if (number < 0)
                value = static_cast<int64_t>(number);
            else
                value = static_cast<uint64_t>(number);
        }
        if (value.is_number_unsigned())
            demand(value.get<uint64_t>() <= static_cast<uint64_t>(largest_integer),
                   "is {}; a number may be at most {:.0f}", shown(value), largest_integer);
    }

    void integer(Json& value, const Property& property) const {
        whole_number(value);
        const auto& allowed = property.integers;
        const double number = value.get<double>();
        if (!allowed.empty())
            demand(std::any_of(allowed.begin(), allowed.end(),
                               [&](int64_t a) { return static_cast<double>(a) == number; }),
                   "is {}; it must be one of {}", shown(value), fmt::join(allowed, ", "));
        range(value, number, property);
    }

    // of: an array of the root; empty: any index.
    void reference(Json& value, std::string_view of) const {
        whole_number(value);
        demand(value.is_number_unsigned() && value.get<uint64_t>() <= UINT32_MAX,
               "must be an index, but is {}", shown(value));
        if (of.empty()) return;
        const auto array = document_.find(of);
        const size_t size = array != document_.end() && array->is_array() ? array->size() : 0;
        demand(value.get<uint64_t>() < size, "refers to {} {}, but there are {}", of, shown(value), size);
    }

    void reference_map(Json& value, std::string_view of) {
        demand(value.is_object(), "must be an object, but is {}", shown(value));
        demand(!value.empty(), "is empty; it must name at least one accessor");
        for (auto& [key, item] : value.items()) {
            const size_t length = push(key);
            reference(item, of);
            pointer_.resize(length);
        }
    }

    void extensions(Json& value, std::string_view schema) {
        const auto found = value.find("extensions");
        if (found == value.end()) return;
        const size_t outer = push("extensions");
        demand(found->is_object(), "must be an object, but is {}", shown(*found));
        for (auto& [name, content] : found->items()) {
            const size_t length = push(name);
            demand(content.is_object(), "must be an object, but is {}", shown(content));
            demand(used_.contains(name), "is not declared in extensionsUsed");
            extension(name, content, schema);
            pointer_.resize(length);
        }
        pointer_.resize(outer);
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
        demand(!known, "is at a place where this extension has no meaning (on a {})", on);
    }

    Json& document_;
    std::set<std::string> used_;
    std::string pointer_;
};

}  // namespace

void check_schema(Json& document) {
    SchemaCheck(document).object(document, *find_schema("root"));
}

}  // namespace coppice::gltf
