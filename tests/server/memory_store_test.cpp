#include "server/store/memory_store.h"

#include "tests/server/job_store_suite.h"

namespace coppice::test {

INSTANTIATE_TEST_SUITE_P(Memory, JobStoreSuite,
                         ::testing::Values(JobStoreFactory{
                             "memory", [](JobStoreLimits limits, NowFunction now) {
                                 return std::make_shared<MemoryStore>(limits, std::move(now));
                             }}));

}  // namespace coppice::test
