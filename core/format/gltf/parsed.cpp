#include "core/format/gltf/parsed.h"

namespace coppice::gltf {

const Json& list(const Json& object, std::string_view key) {
    static const Json empty = Json::array();
    const auto found = object.find(key);
    return found == object.end() ? empty : *found;
}

const Json& member(const Json& object, std::string_view key) {
    static const Json empty = Json::object();
    const auto found = object.find(key);
    return found == object.end() ? empty : *found;
}

const Json* extension(const Json& object, std::string_view name) {
    const Json& extensions = member(object, "extensions");
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &*found;
}

std::optional<uint32_t> index_at(const Json& object, std::string_view key) {
    const auto found = object.find(key);
    if (found == object.end()) return std::nullopt;
    return found->get<uint32_t>();
}

uint64_t unsigned_at(const Json& object, std::string_view key, uint64_t otherwise) {
    const auto found = object.find(key);
    return found == object.end() ? otherwise : found->get<uint64_t>();
}

double number_at(const Json& object, std::string_view key, double otherwise) {
    const auto found = object.find(key);
    return found == object.end() ? otherwise : found->get<double>();
}

std::string text_at(const Json& object, std::string_view key) {
    const auto found = object.find(key);
    return found == object.end() ? std::string() : found->get<std::string>();
}

}  // namespace coppice::gltf
