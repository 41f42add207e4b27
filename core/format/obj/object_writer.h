// The text of one object after the other; indices run over the whole file.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/watch.h"
#include "core/mesh/mesh.h"

namespace coppice {

class ObjectWriter {
  public:
    // material_names: of Scene::materials; empty: no usemtl lines are written.
    ObjectWriter(std::string& out, std::span<const std::string> material_names)
        : out_(out), material_names_(material_names) {}

    // Numbers are the shortest that read back to the same float. Unused vertices and equal attributes are
    // left out. Throws when the watch is stopped.
    void write(const Mesh& mesh, std::string_view name, const Watch& watch);

  private:
    void use_material(const MaterialSlot& slot);

    std::string& out_;
    std::span<const std::string> material_names_;
    uint64_t vertices_ = 0, uvs_ = 0, normals_ = 0;  // written so far
    std::optional<std::string_view> material_;       // that the last usemtl line named
};

// The name of the material of faces that have none, where others have.
constexpr std::string_view obj_default_material = "default";

}  // namespace coppice
