#include "cli/progress_bar.h"

#include <fmt/format.h>

namespace coppice {

ProgressBar::~ProgressBar() {
    if (is_shown_) terminal_.err << "\r\033[K" << std::flush;
}

Watch ProgressBar::watch() {
    Watch watch;
    if (!terminal_.shows_progress) return watch;
    watch.stage = [this](std::string_view stage) {
        stage_ = stage;
        draw();
    };
    watch.progress = [this](double fraction) {
        fraction_ = fraction;
        if (std::chrono::steady_clock::now() - drawn_ > std::chrono::milliseconds(50)) draw();
    };
    return watch;
}

void ProgressBar::draw() {
    constexpr int width = 40;
    const auto full = static_cast<int>(fraction_ * width);
    terminal_.err << fmt::format("\r{:<10} [{:=<{}}{:{}}] {:3.0f} %\033[K", stage_, "", full, "",
                                 width - full, 100 * fraction_)
                  << std::flush;
    drawn_ = std::chrono::steady_clock::now();
    is_shown_ = true;
}

}  // namespace coppice
