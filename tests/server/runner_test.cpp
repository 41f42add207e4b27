// The pool of slots where the system has nothing left: no threads, no memory.
#include "server/jobs/runner.h"

#include <gtest/gtest.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/null_sink.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <fstream>

#include "server/blobs/disk_blobs.h"
#include "server/store/memory_store.h"
#include "tests/server/out_of_memory.h"
#include "tests/server/service_fixture.h"
#include "tests/server/temporary_folder.h"

namespace coppice::test {
namespace {

using namespace std::chrono_literals;

class RunnerTest : public ::testing::Test {
  protected:
    TemporaryFolder folder;
    DiskBlobs blobs{folder.path()};
    Log log{std::make_shared<spdlog::logger>("quiet", std::make_shared<spdlog::sinks::null_sink_mt>())};
    Metrics metrics;
    WorkFunction work = [](const JobRecord&, BlobStore& store, const Watch&) { return result_of(store); };
};

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // their shadows fill the address space
TEST_F(RunnerTest, that_cannot_have_all_its_threads_says_so_and_ends_those_it_has) {
    const pid_t child = ::fork();
    if (child == 0) {
        size_t pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        const rlim_t some = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + (256 << 20);
        const rlimit limit{some, some};  // room for the stacks of some threads, and not of a thousand
        ::setrlimit(RLIMIT_AS, &limit);
        int exit_code = 1;
        {
            MemoryStore store;
            Runner runner(store, blobs, work, {.slots = 1000}, log, metrics);
            try {
                runner.start();
            } catch (const std::exception&) {  // of the thread, or of what it needs
                exit_code = 0;
            }
        }  // a thread that still ran here would end the process otherwise
        ::_exit(exit_code);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), 0) << "it started";
}
#endif

// A job of a slot that failed before it began is nobody's: it has to be found again once its lease is over,
// and is not when the slot goes on to renew it.
TEST_F(RunnerTest, a_slot_that_finds_no_memory_lets_go_of_its_job) {
    for (size_t nth = 1; nth <= 4; ++nth) {
        const auto main_thread = std::this_thread::get_id();
        std::atomic<bool> is_armed{true};
        std::atomic<std::chrono::hours> later{0h};
        // The slot asks for the time when it claims.
        const auto now = [&] {
            const Time told = Time(24h * 365 * 50) + later.load();
            if (std::this_thread::get_id() != main_thread && is_armed.exchange(false)) {
                run_out_of_memory_at(nth);
                later = 1h;  // from then on
            }
            return told;
        };
        MemoryStore store({}, now);
        const std::string id = store.submit({}).id;
        Runner runner(store, blobs, work, {.slots = 1, .heartbeat = 1ms}, log, metrics);
        runner.start();
        store.wait_until_finished(id, {}, 20s);
        EXPECT_TRUE(is_finished(store.find(id).job.status)) << "allocation " << nth;
    }
}

}  // namespace
}  // namespace coppice::test
