// The service as a process: signals and its exit code.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "server/app.h"
#include "tests/server/http_client.h"
#include "tests/server/service_fixture.h"
#include "tests/server/temporary_folder.h"

namespace coppice {
namespace {

// A child process that serves, and its log.
class ServiceProcess {
  public:
    // prepare: in the child, before it serves.
    explicit ServiceProcess(const Config& config, const std::function<void()>& prepare = {}) {
        std::array<int, 2> ends{};
        if (::pipe(ends.data()) != 0) throw std::runtime_error("pipe");
        child_ = ::fork();
        if (child_ == 0) {
            ::dup2(ends[1], STDERR_FILENO);
            ::close(ends[0]);
            if (prepare) prepare();
            ::_exit(run_service(config));
        }
        ::close(ends[1]);
        log_ = ::fdopen(ends[0], "r");
    }
    ~ServiceProcess() {
        if (child_ > 0) ::kill(child_, SIGKILL);
        std::fclose(log_);
    }
    ServiceProcess(const ServiceProcess&) = delete;
    ServiceProcess& operator=(const ServiceProcess&) = delete;

    int port() {
        std::array<char, 4096> line{};
        while (std::fgets(line.data(), line.size(), log_) != nullptr) {
            const std::string port = test::json_member(line.data(), "port");
            if (!port.empty()) return std::stoi(port);
        }
        return 0;
    }

    int end_with(int signal) {
        ::kill(child_, signal);
        int status = 0;
        ::waitpid(child_, &status, 0);
        child_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

  private:
    pid_t child_ = 0;
    std::FILE* log_ = nullptr;
};

TEST(RunService, serves_until_it_is_told_to_end_and_exits_with_0) {
    for (const int signal : {SIGTERM, SIGINT}) {
        const test::TemporaryFolder folder;
        Config config;
        config.listen = "127.0.0.1:0";
        config.data = folder.path();
        ServiceProcess process(config);
        const int port = process.port();
        ASSERT_GT(port, 0);
        EXPECT_EQ(test::request(port, "GET", "/readyz").status, 200);
        EXPECT_EQ(process.end_with(signal), 0);
    }
}

TEST(RunService, outlives_more_connections_than_it_has_descriptors) {
    const test::TemporaryFolder folder;
    Config config;
    config.listen = "127.0.0.1:0";
    config.data = folder.path();
    config.slots = 1;
    constexpr rlim_t descriptors = 40;
    ServiceProcess process(config, [] {
        const rlimit limit{descriptors, descriptors};
        ::setrlimit(RLIMIT_NOFILE, &limit);
    });
    const int port = process.port();
    ASSERT_GT(port, 0);
    std::vector<std::unique_ptr<test::Connection>> idle;
    for (rlim_t i = 0; i < descriptors; ++i) idle.push_back(std::make_unique<test::Connection>(port));
    idle.clear();
    // The service takes their descriptors back as it notices, each on a thread of its own; /readyz needs one
    // for a file.
    int status = 0;
    for (int asked = 0; status != 200 && asked < 1000; ++asked)
        status = test::request(port, "GET", "/readyz").status;
    EXPECT_EQ(status, 200);
    EXPECT_EQ(process.end_with(SIGTERM), 0);
}

}  // namespace
}  // namespace coppice
