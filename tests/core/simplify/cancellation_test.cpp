// Every algorithm stops at the first look at the watch that tells it to, and looks the more often the larger
// the mesh is. How long it takes from one look to the next is measured by bench/cancellation.cpp.
#include <gtest/gtest.h>

#include <atomic>
#include <stop_token>
#include <string>

#include "core/base/error.h"
#include "tests/core/simplify/variants.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

Mesh sphere(uint32_t rings) {
    return shapes::sphere({.segments = 2 * rings, .rings = rings});
}

size_t count_looks(const test::Variant& variant, const Mesh& mesh) {
    std::atomic<size_t> looks = 0;
    test::simplify(variant, mesh, test::part_of(mesh, 0.5), {.checked = [&looks] { ++looks; }});
    return looks;
}

class Cancellation : public testing::TestWithParam<test::Variant> {};

TEST_P(Cancellation, comes_at_the_look_that_follows_the_request) {
    const Mesh mesh = sphere(80);
    const size_t looks = count_looks(GetParam(), mesh);
    for (const size_t last : {size_t{1}, looks / 4, looks / 2, looks - looks / 4, looks}) {
        SCOPED_TRACE(testing::Message() << "at look " << last << " of " << looks);
        std::stop_source stop;
        std::atomic<size_t> looked = 0, told_too_late = 0;
        const Watch watch = {.stop = stop.get_token(),
                             .progress = [&](double) { told_too_late += stop.stop_requested() ? 1 : 0; },
                             .checked =
                                 [&] {
                                     if (++looked == last) stop.request_stop();
                                 }};
        try {
            test::simplify(GetParam(), mesh, test::part_of(mesh, 0.5), watch);
            ADD_FAILURE() << "went on";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::job_cancelled);
        }
        EXPECT_EQ(looked, last);
        EXPECT_EQ(told_too_late, 0U);
    }
}

// Of nine times the triangles. How many rounds a search or a run takes varies by a factor of two and more.
TEST_P(Cancellation, is_looked_for_more_often_on_a_larger_mesh) {
    const Mesh small = sphere(80), large = sphere(240);
    const size_t of_small = count_looks(GetParam(), small), of_large = count_looks(GetParam(), large);
    EXPECT_GE(of_large, 3 * of_small) << large.triangle_count() << " triangles to " << small.triangle_count();
}

INSTANTIATE_TEST_SUITE_P(Registry, Cancellation, testing::ValuesIn(test::all_variants()),
                         [](const testing::TestParamInfo<test::Variant>& tested) {
                             return test::test_name(tested.param, "sphere");
                         });

}  // namespace
}  // namespace coppice
