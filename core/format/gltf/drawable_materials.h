// What glTF demands of materials and other formats do not.
#pragma once

#include <optional>
#include <vector>

#include "core/scene/scene.h"

namespace coppice::gltf {

// A scene that another format described, with what glTF could not hold left out: textures on triangles
// without the coordinates for them (these get a copy of the material without textures), and images that are
// no PNG or JPEG by their header. Null where nothing has to change, which is nearly always. Warnings:
// texture.no_coordinates, image.unreadable, image.unsupported.
std::optional<Scene> with_drawable_materials(const Scene& scene, std::vector<Warning>& warnings);

}  // namespace coppice::gltf
