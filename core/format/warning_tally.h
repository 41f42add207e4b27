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
    // The same code and message count up; where is that of the first.
    void note(std::string_view code, std::string_view message, std::string_view where);
    void move_to(std::vector<Warning>& warnings);  // in order of first appearance

  private:
    struct Entry {
        Warning warning;
        uint64_t count = 0;
    };
    std::vector<Entry> entries_;
};

}  // namespace coppice
