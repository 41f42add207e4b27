// A small zip that would unpack to far more than it has any right to.
#pragma once

#include <string>

namespace coppice::test {

std::string zip_bomb();  // scene.obj: 20 MB of spaces in 20 KB

}  // namespace coppice::test
