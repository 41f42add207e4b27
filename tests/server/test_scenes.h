// Scenes as clients send them, drawn.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace coppice::test {

// A bumpy square of cells x cells quads, which stands three times.
std::string iobj_scene(size_t cells = 8);
std::string obj_scene(size_t cells = 8);  // the same once, with no #@ lines

// A GLB of this JSON and this binary chunk (left out where it is empty).
std::string glb(std::string json, std::string_view binary = {});

// A GLB with one mesh of cells x cells quads and three instances of it.
std::string glb_scene(size_t cells = 8);

// A GLB of one triangle; what is broken in tests is written in the JSON's place: "{accessor}", a JSON object
// for accessor 0 (three VEC3 floats in bufferView 0 unless told); "{more}" of the document's members.
struct OneTriangle {
    std::string positions =
        R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]})";
    std::string nodes = R"([{"mesh":0}])";
    std::string buffer_uri = {};  // empty: the binary chunk
    float first_x = 0;
    uint16_t last_index = 2;
};
std::string glb_of(const OneTriangle& triangle);

}  // namespace coppice::test
