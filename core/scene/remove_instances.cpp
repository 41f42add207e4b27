#include "core/scene/remove_instances.h"

namespace coppice {

namespace {

// of_node: all of one node, ascending in its batch.
void remove_from_batch(Node& node, std::span<const Instance> of_node) {
    std::vector<Transform> left;
    for (uint32_t i = 0; i < node.batch.size(); ++i) {
        if (!of_node.empty() && of_node.front().in_batch == i) {
            of_node = of_node.subspan(1);
        } else {
            left.push_back(node.batch[i]);
        }
    }
    node.batch = std::move(left);
}

}  // namespace

void remove_instances(Scene& scene, std::span<const Instance> gone) {
    for (size_t begin = 0, end = 0; begin < gone.size(); begin = end) {
        while (end < gone.size() && gone[end].node == gone[begin].node) ++end;
        Node& node = scene.nodes[gone[begin].node];
        if (!node.batch.empty()) remove_from_batch(node, gone.subspan(begin, end - begin));
        if (node.batch.empty()) node.mesh.reset();  // an empty batch would draw one
    }
}

}  // namespace coppice
