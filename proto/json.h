// JSON from strangers, read strictly, and JSON for them. For the .cpp files of proto/ only: typed structs
// cross its border, never a JSON value.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace coppice {

struct JsonLimits {
    size_t bytes = 64 << 10;
    size_t depth = 8;  // of nested objects and arrays
};

// Refuses what nlohmann-json would let pass: deep nesting (its copies recurse), and keys given twice, of
// which it would silently keep the last. Throws request_malformed, or option_conflict for a key given twice;
// `what` names the text in messages ("options").
nlohmann::json parse_json(std::string_view text, const JsonLimits& limits, std::string_view what);

// No white space; bytes that are not UTF-8 become U+FFFD, since names come from files.
std::string print_json(const nlohmann::json& json);
std::string print_json(const nlohmann::ordered_json& json);

}  // namespace coppice
