// Where the commands write: data to files or out, words to err.
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>

namespace coppice {

struct Terminal {
    std::ostream& out;
    std::ostream& err;
    bool shows_progress = false;  // err is a terminal that someone watches
};

std::string print_bytes(uint64_t bytes);                                               // "12.3 MB"
std::string print_count(uint64_t count);                                               // "1,234,567"
std::string print_count(uint64_t count, std::string_view one, std::string_view many);  // "1 mesh", "2 meshes"

}  // namespace coppice
