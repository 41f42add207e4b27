// OBJ files as the simplest of programs reads them, for what papers counted with such programs.
#pragma once

#include <filesystem>

#include "core/mesh/mesh.h"

namespace coppice::test {

// Positions and faces alone. Vertices are numbered as the file has them and never welded; our own reader
// numbers them as faces use them, and algorithms that go by the number give other counts then. Faces of more
// than three corners are split as our reader splits them.
Mesh read_plain_obj(const std::filesystem::path& path);

}  // namespace coppice::test
