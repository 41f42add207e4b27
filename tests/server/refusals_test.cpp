#include "server/http/refusals.h"

#include <gmock/gmock.h>

#include <optional>
#include <vector>

namespace coppice {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;

class RefusalsTest : public ::testing::Test {
  protected:
    void refuse(int status, std::chrono::milliseconds at) {
        Exchange exchange;
        exchange.status = status;
        refusals->add(exchange, begin + at);
    }
    std::vector<uint64_t> counts() {
        std::vector<uint64_t> all;
        for (const Exchange& exchange : told) all.push_back(exchange.count);
        return all;
    }

    Refusals::Clock::time_point begin = Refusals::Clock::now();
    std::vector<Exchange> told;
    Observe observe = [this](const Exchange& exchange) { told.push_back(exchange); };
    std::optional<Refusals> refusals{observe};
};

TEST_F(RefusalsTest, the_first_is_told_at_once_and_further_ones_after_a_second_with_their_count) {
    for (const auto at : {0ms, 10ms, 20ms, 999ms}) refuse(429, at);
    EXPECT_THAT(counts(), ElementsAre(1));
    refusals->tell(begin + 1000ms);
    EXPECT_THAT(counts(), ElementsAre(1, 3));
    refusals->tell(begin + 5000ms);
    EXPECT_THAT(counts(), ElementsAre(1, 3));
    refuse(429, 5001ms);
    EXPECT_THAT(counts(), ElementsAre(1, 3, 1));
}

TEST_F(RefusalsTest, each_status_is_told_by_itself) {
    refuse(429, 0ms);
    refuse(503, 1ms);
    refuse(503, 2ms);
    EXPECT_THAT(counts(), ElementsAre(1, 1));
    EXPECT_EQ(told.back().status, 503);
}

TEST_F(RefusalsTest, what_is_left_is_told_at_the_end) {
    refuse(429, 0ms);
    refuse(429, 1ms);
    refusals.reset();
    EXPECT_THAT(counts(), ElementsAre(1, 1));
}

}  // namespace
}  // namespace coppice
