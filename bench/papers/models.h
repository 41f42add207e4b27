// The meshes of the papers, or what stands in for them.
#pragma once

#include <cstdint>
#include <string>

#include "core/scene/scene.h"

namespace coppice::papers {

struct Model {
    std::string name;  // the file, or what was drawn
    Mesh mesh;
};

bool is_asset(const std::string& file);
// The first mesh of a test asset; where that is not there, a drawn one of about so many triangles.
Model model(const std::string& file, uint32_t triangles);
// With normals, texture coordinates and seams, and four small holes like the bunny's.
Model drawn_model(uint32_t triangles);

// A GLB of so many placements of the mesh, each turned, scaled and moved.
Bytes scene_of(const Model& model, uint32_t instances);

}  // namespace coppice::papers
