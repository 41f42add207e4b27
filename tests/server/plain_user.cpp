#include "tests/server/plain_user.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>

namespace coppice::test {
namespace {

constexpr uid_t plain_user = 65534;  // nobody

}  // namespace

void as_plain_user(const std::function<void()>& assertions) {
    const pid_t child = ::fork();
    if (child == 0) {
        if (::geteuid() == 0 && ::setuid(plain_user) != 0) ::_exit(2);
        try {
            assertions();
        } catch (const std::exception& exception) {
            ADD_FAILURE() << exception.what();
        }
        std::fflush(stdout);
        ::_exit(::testing::Test::HasFailure() ? 1 : 0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "as a plain user; see above";
}

}  // namespace coppice::test
