// Nodes, roots and materials.
#pragma once

#include "core/format/gltf/parsed.h"

namespace coppice::gltf {

std::vector<Node> read_nodes(const Parsed& parsed);

// Of the default scene; of the first one where none is named; every node without a parent where there is no
// scene.
std::vector<uint32_t> read_roots(const Json& document, const std::vector<Node>& nodes);

// From tinygltf's model of them.
std::vector<Material> read_materials(const Json& document);

}  // namespace coppice::gltf
