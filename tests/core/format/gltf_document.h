// glTF documents drawn for tests: a valid one to start from, and ways to spoil it.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/format/gltf/gltf.h"

namespace coppice::test {

using Json = nlohmann::json;

// A document under construction: accessors are added with their values.
struct GltfBuilder {
    Json json = {{"asset", {{"version", "2.0"}}}};
    Bytes buffer;

    // 5126 etc. and its C++ type; returns the accessor's index. Each has a buffer view of its own.
    template <typename T>
    size_t add(const std::vector<T>& values, int component_type, const std::string& type, size_t components,
               const Json& more = Json::object()) {
        buffer.resize((buffer.size() + 3) / 4 * 4);
        const size_t offset = buffer.size();
        append(buffer, std::as_bytes(std::span(values)));
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size() * sizeof(T)}});
        Json accessor = {{"bufferView", json["bufferViews"].size() - 1},
                         {"componentType", component_type},
                         {"count", values.size() / components},
                         {"type", type}};
        accessor.update(more);
        json["accessors"].push_back(accessor);
        return json["accessors"].size() - 1;
    }

    size_t add_positions(const std::vector<float>& values) {
        Json low = {1e30, 1e30, 1e30};
        Json high = {-1e30, -1e30, -1e30};
        for (size_t i = 0; i < values.size(); ++i) {
            if (values[i] < low[i % 3].get<double>()) low[i % 3] = values[i];
            if (values[i] > high[i % 3].get<double>()) high[i % 3] = values[i];
        }
        return add(values, 5126, "VEC3", 3, {{"min", low}, {"max", high}});
    }

    // The GLB of it.
    Bytes glb() const;
    // The JSON with its buffer as a data URI.
    std::string gltf() const;
};

// Two triangles that form a square in the xy plane, indexed, one node.
GltfBuilder square();

// read_gltf without resources.
Scene read(ByteView bytes);
Scene read(const GltfBuilder& builder);

// Writes as GLB and takes its JSON apart.
Json written_json(const Scene& scene, Instancing instancing = Instancing::automatic);
Scene read_again(const Scene& scene, Instancing instancing = Instancing::automatic);

// "CODE where: message" of what reading it throws; "no error" otherwise.
std::string error_of(const std::function<void()>& action);
std::string error_of(const GltfBuilder& builder);

std::vector<std::string> warning_codes(const Scene& scene);

}  // namespace coppice::test
