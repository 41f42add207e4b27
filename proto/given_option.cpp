#include "proto/given_option.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/number.h"
#include "proto/json.h"

namespace coppice {

Given given_in_text(const std::string& name, const std::string& value) {
    return {
        .name = name, .value = value, .is_json = false, .shown = value.empty() ? "empty" : shorten(value)};
}

// Not from_json: nlohmann 3.11.3 (Debian 13) looks that name up for every type and stumbles over this one.
Given given_in_json(const std::string& name, const nlohmann::json& value) {
    Given given = {.name = name, .value = {}, .is_json = true, .shown = shorten(print_json(value))};
    if (value.is_boolean()) {
        given.value = value.get<bool>();
    } else if (value.is_number()) {
        given.value = value.get<double>();
    } else if (value.is_string()) {
        given.value = value.get<std::string>();
    } else {
        refuse(given, "one value: a number, a text, true or false");
    }
    return given;
}

void refuse(const Given& given, std::string_view takes) {
    fail(ErrorCode::option_invalid, given.name,
         fmt::format("{} is {}; it takes {}", given.name, given.shown, takes));
}

bool boolean(const Given& given, std::string_view takes) {
    if (const auto* value = std::get_if<bool>(&given.value)) return *value;
    const auto* text = std::get_if<std::string>(&given.value);
    if (text == nullptr || given.is_json || (*text != "true" && *text != "false")) refuse(given, takes);
    return *text == "true";
}

double number(const Given& given, std::string_view takes) {
    if (const auto* value = std::get_if<double>(&given.value)) return *value;
    const auto* text = std::get_if<std::string>(&given.value);
    if (text == nullptr || given.is_json) refuse(given, takes);
    const auto value = parse_number(*text);
    if (!value) refuse(given, takes);
    return *value;
}

uint64_t whole_number(const Given& given, std::string_view takes) {
    // Above 2^53 a double no longer tells neighbours apart; no scene comes near.
    constexpr double largest = 9007199254740992.0;
    const double value = number(given, takes);
    if (value < 0 || value > largest || std::floor(value) != value) refuse(given, takes);
    return static_cast<uint64_t>(value);
}

const std::string& text(const Given& given, std::string_view takes) {
    const auto* value = std::get_if<std::string>(&given.value);
    if (value == nullptr || value->empty()) refuse(given, takes);
    return *value;
}

std::string shorten(std::string value) {
    constexpr size_t most = 80;
    if (value.size() > most) value = value.substr(0, most) + "...";
    return value;
}

}  // namespace coppice
