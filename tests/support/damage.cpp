#include "tests/support/damage.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>

#include "core/base/error.h"
#include "core/scene/instance.h"

namespace coppice::test {
namespace {

using ::testing::AssertionFailure;
using ::testing::AssertionResult;
using ::testing::AssertionSuccess;

// Small, so that a damaged count is refused by a limit and not by the machine.
constexpr ReadLimits limits = {
    .triangles = 200'000, .rendered_triangles = 2'000'000, .vertices = 200'000, .zip_bytes = 16U << 20U};

std::optional<std::string> fault_of(const Mesh& mesh) {
    if (!is_consistent(mesh)) return "is not consistent";
    for (const Vec3f p : mesh.positions)
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            return "has a position that is not finite";
    for (const Attribute& attribute : mesh.attributes)
        for (const float value : attribute.values)
            if (!std::isfinite(value)) return "has a value of " + attribute.name + " that is not finite";
    return {};
}

std::optional<std::string> fault_of(const Scene& scene) {
    for (size_t i = 0; i < scene.meshes.size(); ++i)
        if (const auto fault = fault_of(scene.meshes[i])) return fmt::format("mesh {} {}", i, *fault);
    const auto in_range = [&](uint32_t node) { return node < scene.nodes.size(); };
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (!node.local.is_finite()) return fmt::format("node {} has a transform that is not finite", i);
        if (node.mesh && *node.mesh >= scene.meshes.size()) return fmt::format("node {} has no such mesh", i);
        if (node.parent && !in_range(*node.parent)) return fmt::format("node {} has no such parent", i);
        for (const uint32_t child : node.children)
            if (!in_range(child) || scene.nodes[child].parent != i)
                return fmt::format("node {} and its child {} disagree", i, child);
    }
    for (const uint32_t root : scene.roots)
        if (!in_range(root) || scene.nodes[root].parent) return fmt::format("root {} is none", root);
    for (const Mesh& mesh : scene.meshes)
        for (const MaterialSlot& slot : mesh.slots)
            if (slot.material && *slot.material >= scene.materials.size())
                return "a slot has no such material";
    return {};
}

// Null when the bytes are refused.
std::optional<Scene> read(const Upload& upload) {
    try {
        return read_asset(upload, limits, {}).scene;
    } catch (const Error&) {
        return {};
    }
}

Upload with_asset(const Upload& upload, ByteView bytes) {
    Upload changed = upload;
    changed.asset.bytes = bytes;
    return changed;
}

}  // namespace

AssertionResult reads_or_refuses(const Upload& upload) {
    try {
        const std::optional<Scene> scene = read(upload);
        if (!scene) return AssertionSuccess();
        if (const auto fault = fault_of(*scene)) return AssertionFailure() << *fault;
        scene_bounds(*scene);  // throws where they are not finite
        const WrittenAsset written = write_asset(*scene, {.format = Format::glb}, {});
        read_asset({.asset = {.path = "again.glb", .bytes = written.bytes}}, {}, {});
    } catch (const std::exception& error) {
        return AssertionFailure() << "threw " << error.what();
    }
    return AssertionSuccess();
}

AssertionResult survives_truncation(const Upload& upload, size_t count) {
    const ByteView whole = upload.asset.bytes;
    const size_t step = std::max<size_t>(1, whole.size() / count);
    for (size_t length = 0; length < whole.size(); length += whole.size() - length <= 32 + step ? 1 : step) {
        // A copy of its own size, so that a read beyond the end is one to AddressSanitizer too.
        const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
        if (AssertionResult result = reads_or_refuses(with_asset(upload, cut)); !result)
            return AssertionFailure()
                   << "cut to " << length << " of " << whole.size() << " bytes: " << result.message();
    }
    return AssertionSuccess();
}

AssertionResult survives_mutation(const Upload& upload, size_t count, uint64_t seed, size_t head) {
    std::mt19937_64 random(seed);
    constexpr std::string_view telling = "0123456789-.,{}[]\"\n /\xff";
    for (size_t i = 0; i < count; ++i) {
        Upload changed = upload;
        const size_t part = random() % (1 + upload.resources.size());
        UploadedFile& file = part == 0 ? changed.asset : changed.resources[part - 1];
        Bytes bytes(file.bytes.begin(), file.bytes.end());
        const size_t at = random() % (i % 2 == 0 ? std::min(head, bytes.size()) : bytes.size());
        const std::byte before = bytes[at];
        bytes[at] = i % 3 == 0   ? before ^ static_cast<std::byte>(1U << random() % 8)
                    : i % 3 == 1 ? static_cast<std::byte>(telling[random() % telling.size()])
                                 : static_cast<std::byte>(random() % 256);
        file.bytes = bytes;
        if (AssertionResult result = reads_or_refuses(changed); !result)
            return AssertionFailure() << "with byte " << at << " of " << file.path << " changed from "
                                      << static_cast<int>(before) << " to " << static_cast<int>(bytes[at])
                                      << ": " << result.message();
    }
    return AssertionSuccess();
}

}  // namespace coppice::test
