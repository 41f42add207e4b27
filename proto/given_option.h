// One option as it was given, on its way to a typed one. For the .cpp files of proto/ only.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <variant>

namespace coppice {

// Text of a query or a flag stands for a number or a boolean; a JSON string does not.
struct Given {
    std::string name;
    std::variant<bool, double, std::string> value;
    bool is_json = false;
    std::string shown;  // the value as messages show it
};

Given given_in_text(const std::string& name, const std::string& value);
// Throws option_invalid for anything but a number, a text, true or false.
Given given_in_json(const std::string& name, const nlohmann::json& value);

// Each throws option_invalid with what the option takes where the value is none of the kind.
[[noreturn]] void refuse(const Given& given, std::string_view takes);
bool boolean(const Given& given, std::string_view takes);
double number(const Given& given, std::string_view takes);
uint64_t whole_number(const Given& given, std::string_view takes);
const std::string& text(const Given& given, std::string_view takes);  // not empty

// Long values are cut, so that a message stays one.
std::string shorten(std::string value);

}  // namespace coppice
