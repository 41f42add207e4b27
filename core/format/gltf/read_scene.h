// Nodes, materials and roots, from tinygltf's model.
#pragma once

#include "core/format/gltf/parsed.h"
#include "core/format/gltf/tiny_gltf_model.h"

namespace coppice::gltf {

std::vector<Node> read_nodes(const Parsed& parsed, const tinygltf::Model& model);
std::vector<Material> read_materials(const Parsed& parsed, const tinygltf::Model& model);

// Of the default scene; of the first one where none is named; every node without a parent where there is no
// scene.
std::vector<uint32_t> read_roots(const std::vector<Node>& nodes, const tinygltf::Model& model);

}  // namespace coppice::gltf
