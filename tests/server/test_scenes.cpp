#include "tests/server/test_scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>

namespace coppice::test {
namespace {

double height(size_t x, size_t y) {
    return 0.3 * std::sin(static_cast<double>(x)) * std::cos(0.7 * static_cast<double>(y));
}

std::string obj_body(size_t cells) {
    std::string text = "o square\n";
    for (size_t y = 0; y <= cells; ++y) {
        for (size_t x = 0; x <= cells; ++x) text += fmt::format("v {} {} {:.6f}\n", x, y, height(x, y));
    }
    for (size_t y = 0; y < cells; ++y) {
        for (size_t x = 0; x < cells; ++x) {
            const size_t first = y * (cells + 1) + x + 1;
            text += fmt::format("f {} {} {} {}\n", first, first + 1, first + cells + 2, first + cells + 1);
        }
    }
    return text;
}

template <typename T>
void append_raw(std::string& out, T value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    out.append(bytes, sizeof value);
}

}  // namespace

std::string obj_scene(size_t cells) {
    return obj_body(cells);
}

std::string iobj_scene(size_t cells) {
    std::string text = "#@iobj 1.0\n" + obj_body(cells);
    for (int i = 0; i < 3; ++i) {
        text += fmt::format("#@instance square copy-{} 1 0 0 {} 0 1 0 0 0 0 1 0 0 0 0 1\n", i, i * 100);
    }
    return text;
}

std::string glb(std::string json, std::string_view binary) {
    while (json.size() % 4 != 0) json += ' ';
    std::string padded(binary);
    while (padded.size() % 4 != 0) padded += '\0';
    std::string file = "glTF";
    append_raw<uint32_t>(file, 2);
    append_raw(file, static_cast<uint32_t>(12 + 8 + json.size() + (padded.empty() ? 0 : 8 + padded.size())));
    append_raw(file, static_cast<uint32_t>(json.size()));
    file += "JSON" + json;
    if (padded.empty()) return file;
    append_raw(file, static_cast<uint32_t>(padded.size()));
    file += std::string("BIN\0", 4) + padded;
    return file;
}

std::string glb_scene(size_t cells) {
    std::string binary;
    const size_t row = cells + 1;
    double low = 0;
    double high = 0;
    for (size_t y = 0; y < row; ++y) {
        for (size_t x = 0; x < row; ++x) {
            const auto z = static_cast<float>(height(x, y));
            low = std::min<double>(low, z);
            high = std::max<double>(high, z);
            append_raw(binary, static_cast<float>(x));
            append_raw(binary, static_cast<float>(y));
            append_raw(binary, z);
        }
    }
    const size_t position_bytes = binary.size();
    for (size_t y = 0; y < cells; ++y) {
        for (size_t x = 0; x < cells; ++x) {
            const auto a = static_cast<uint32_t>(y * row + x);
            const auto c = static_cast<uint32_t>(a + row);
            for (const uint32_t index : {a, a + 1, c + 1, a, c + 1, c}) append_raw(binary, index);
        }
    }
    return glb(
        fmt::format(
            R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0,1,2]}}],)"
            R"("nodes":[{{"mesh":0}},{{"mesh":0,"translation":[100,0,0]}},{{"mesh":0,"translation":[200,0,0]}}],)"
            R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],)"
            R"("accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3","min":[0,0,{}],"max":[{},{},{}]}},)"
            R"({{"bufferView":1,"componentType":5125,"count":{},"type":"SCALAR"}}],)"
            R"("bufferViews":[{{"buffer":0,"byteLength":{}}},{{"buffer":0,"byteOffset":{},"byteLength":{}}}],)"
            R"("buffers":[{{"byteLength":{}}}]}})",
            row * row, low, cells, cells, high, cells * cells * 6, position_bytes, position_bytes,
            binary.size() - position_bytes, binary.size()),
        binary);
}

std::string glb_of(const OneTriangle& triangle) {
    std::string binary;
    for (const float value : {triangle.first_x, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F})
        append_raw(binary, value);
    for (const int index : {0, 1, int{triangle.last_index}}) append_raw(binary, static_cast<uint16_t>(index));
    const std::string uri = triangle.buffer_uri.empty() ? "" : R"("uri":")" + triangle.buffer_uri + R"(",)";
    return glb(
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + triangle.nodes +
            R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[)" +
            triangle.positions +
            R"(,{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],)"
            R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],)"
            R"("buffers":[{)" +
            uri + R"("byteLength":42}]})",
        triangle.buffer_uri.empty() ? binary : "");
}

}  // namespace coppice::test
