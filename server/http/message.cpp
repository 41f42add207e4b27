#include "server/http/message.h"

#include <algorithm>
#include <cassert>

#include "core/base/ascii.h"

namespace coppice {

void Headers::add(std::string_view name, std::string value) {
    fields_.emplace_back(lower(name), std::move(value));
}

std::optional<std::string_view> Headers::find(std::string_view name) const {
    for (const auto& [field, value] : fields_) {
        if (field == name) return value;
    }
    return std::nullopt;
}

std::string Headers::joined(std::string_view name) const {
    std::string all_values;
    for (const auto& [field, value] : fields_) {
        if (field != name) continue;
        if (!all_values.empty()) all_values += ", ";
        all_values += value;
    }
    return all_values;
}

size_t Headers::count(std::string_view name) const {
    return static_cast<size_t>(std::count_if(fields_.begin(), fields_.end(),
                                             [&](const auto& field) { return field.first == name; }));
}

const std::string& Request::path_parameter(std::string_view name) const {
    const auto found = path_parameters.find(name);
    assert(found != path_parameters.end());
    return found->second;
}

bool Response::has(std::string_view name) const {
    return std::any_of(headers.begin(), headers.end(),
                       [&](const auto& header) { return header.first == name; });
}

void Response::set(std::string name, std::string value) {
    std::erase_if(headers, [&](const auto& header) { return header.first == name; });
    headers.emplace_back(std::move(name), std::move(value));
}

void Response::json(int with_status, std::string text) {
    status = with_status;
    content_type = "application/json";
    body = std::move(text);
    content.reset();
}

}  // namespace coppice
