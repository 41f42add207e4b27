#include "core/simplify/mean_edge.h"

namespace coppice {

double mean_edge(const Mesh& mesh) {
    double sum = 0;
    for (size_t t = 0; t < mesh.triangle_count(); ++t) {
        for (size_t k = 0; k < 3; ++k)
            sum += length(mesh.corner_position(t, (k + 1) % 3) - mesh.corner_position(t, k));
    }
    return mesh.triangle_count() > 0 ? sum / static_cast<double>(3 * mesh.triangle_count()) : 0;
}

}  // namespace coppice
