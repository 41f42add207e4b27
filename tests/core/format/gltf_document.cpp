#include "tests/core/format/gltf_document.h"

#include "core/format/gltf/glb.h"

namespace coppice::test {

namespace {

std::string base64(ByteView bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t three = 0;
        for (size_t j = 0; j < 3; ++j)
            three = three << 8 | (i + j < bytes.size() ? static_cast<uint32_t>(bytes[i + j]) : 0);
        for (size_t j = 0; j < 4; ++j)
            out += i + j > bytes.size() ? '=' : digits[three >> (6 * (3 - j)) & 63];
    }
    return out;
}

}  // namespace

Bytes GltfBuilder::glb() const {
    Json copy = json;
    if (!buffer.empty()) copy["buffers"] = {{{"byteLength", buffer.size()}}};
    return gltf::print_glb(copy.dump(), buffer);
}

std::string GltfBuilder::gltf() const {
    Json copy = json;
    if (!buffer.empty())
        copy["buffers"] = {{{"byteLength", buffer.size()},
                            {"uri", "data:application/octet-stream;base64," + base64(buffer)}}};
    return copy.dump();
}

GltfBuilder square() {
    GltfBuilder out;
    const size_t positions = out.add_positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    const size_t indices = out.add<uint16_t>({0, 1, 2, 0, 2, 3}, 5123, "SCALAR", 1);
    out.json["meshes"] = {
        {{"name", "square"},
         {"primitives", {{{"attributes", {{"POSITION", positions}}}, {"indices", indices}}}}}};
    out.json["nodes"] = {{{"mesh", 0}}};
    out.json["scenes"] = {{{"nodes", {0}}}};
    out.json["scene"] = 0;
    return out;
}

Scene read(ByteView bytes) {
    return read_gltf(bytes, Resources(), ReadLimits(), Watch());
}

Scene read(const GltfBuilder& builder) {
    return read(builder.glb());
}

Json written_json(const Scene& scene, Instancing instancing) {
    const WrittenAsset written = write_glb(scene, {.instancing = instancing}, Watch());
    return Json::parse(as_text(gltf::parse_glb(written.bytes).json));
}

Scene read_again(const Scene& scene, Instancing instancing) {
    return read(write_glb(scene, {.instancing = instancing}, Watch()).bytes);
}

std::string error_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return fmt::format("{} {}: {}", name(error.code()), error.where(), error.message());
    }
    return "no error";
}

std::string error_of(const GltfBuilder& builder) {
    const Bytes bytes = builder.glb();
    return error_of([&] { read(bytes); });
}

std::vector<std::string> warning_codes(const Scene& scene) {
    std::vector<std::string> codes;
    for (const Warning& warning : scene.warnings) codes.push_back(warning.code);
    return codes;
}

}  // namespace coppice::test
