#include "core/base/watch.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/error.h"

namespace coppice {
namespace {

TEST(Watch, throws_job_cancelled_once_stop_was_requested) {
    std::stop_source source;
    const Watch watch = {.stop = source.get_token()};
    EXPECT_NO_THROW(watch.check());
    source.request_stop();
    try {
        watch.check();
        FAIL() << "check passed although stop was requested";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::job_cancelled);
    }
}

TEST(Watch, a_part_maps_its_progress_into_the_whole) {
    std::vector<double> seen;
    const Watch watch = {.progress = [&](double fraction) { seen.push_back(fraction); }};
    const Watch second_half = watch.part(0.5, 1);
    second_half.report(0);
    second_half.part(0, 0.5).report(1);
    second_half.report(1);
    EXPECT_EQ(seen, (std::vector<double>{0.5, 0.75, 1}));
}

TEST(Watch, without_callbacks_does_nothing) {
    EXPECT_NO_THROW(Watch{}.part(0, 0.5).report(1));
}

}  // namespace
}  // namespace coppice
