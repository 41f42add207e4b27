// The options of one comparison, parsed and typed. Text and JSON become these in proto/.
#pragma once

#include <cstdint>
#include <string>

namespace coppice {

struct CompareOptions {
    double samples = 10;               // on each surface, for each triangle of the finer one; 1000 at least
    uint64_t seed = 1;                 // of where they lie
    bool self_intersections = false;   // looks for them too, which takes time
    std::string reference_entry = {};  // which file of a zip is the asset, when it holds several
    std::string candidate_entry = {};
    unsigned threads = 0;  // 0: one per core; never changes the result
};

// Throws option_invalid. Called before anything is read.
void validate(const CompareOptions& options);

}  // namespace coppice
