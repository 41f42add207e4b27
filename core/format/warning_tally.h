// Many small repairs, told as one warning each.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.h"

namespace coppice {

class WarningTally {
  public:
    // The same code and message count up; where is that of the first. Beyond 200 different ones they are only
    // counted.
    void note(std::string_view code, std::string_view message, std::string_view where);
    void move_to(std::vector<Warning>& warnings);  // in order of first appearance

  private:
    struct Entry {
        Warning warning;
        uint64_t count = 0;
    };
    static constexpr size_t most_entries = 200;
    std::vector<Entry> entries_;
    uint64_t left_out_ = 0;  // notes beyond those
};

}  // namespace coppice
