#include "tests/support/plain_obj.h"

#include <fstream>
#include <numeric>
#include <sstream>
#include <string>

#include "core/format/triangulate.h"

namespace coppice::test {

Mesh read_plain_obj(const std::filesystem::path& path) {
    Mesh mesh;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "v") {
            Vec3f p;
            words >> p.x >> p.y >> p.z;
            mesh.positions.push_back(p);
        } else if (word == "f") {
            std::vector<uint32_t> vertices, places;
            std::vector<Vec3d> points;
            while (words >> word) {  // "7//7": stoul stops at the slash
                vertices.push_back(static_cast<uint32_t>(std::stoul(word) - 1));
                points.push_back(to_double(mesh.positions.at(vertices.back())));
            }
            triangulate(points, places);
            for (const uint32_t place : places) mesh.triangles.push_back(vertices[place]);
        }
    }
    mesh.wedge_vertex.resize(mesh.vertex_count());
    std::iota(mesh.wedge_vertex.begin(), mesh.wedge_vertex.end(), 0U);
    mesh.slots = {MaterialSlot{}};
    mesh.triangle_slot.assign(mesh.triangles.size() / 3, 0);
    return mesh;
}

}  // namespace coppice::test
