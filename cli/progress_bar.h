// A line on a terminal that shows how far the work is.
#pragma once

#include <chrono>
#include <string>

#include "cli/terminal.h"
#include "core/base/watch.h"

namespace coppice {

class ProgressBar {
  public:
    explicit ProgressBar(const Terminal& terminal) : terminal_(terminal) {}
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ~ProgressBar();  // clears the line

    // Reports to this bar, which must outlive it.
    Watch watch();

  private:
    void draw();

    const Terminal& terminal_;
    std::string stage_;
    double fraction_ = 0;
    std::chrono::steady_clock::time_point drawn_ = {};
    bool is_shown_ = false;
};

}  // namespace coppice
