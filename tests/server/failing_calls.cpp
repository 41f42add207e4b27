#include "tests/server/failing_calls.h"

#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>

namespace coppice::test {
namespace {

struct Plan {
    std::atomic<int> left{0};
    std::atomic<int> error{0};
};
std::array<Plan, 2> plans;

Plan& plan_of(FailingCalls::Call call) {
    return plans.at(static_cast<size_t>(call));
}

bool fails(FailingCalls::Call call) {
    Plan& plan = plan_of(call);
    int left = plan.left;
    while (left > 0 && !plan.left.compare_exchange_weak(left, left - 1)) {
    }
    if (left <= 0) return false;
    errno = plan.error;
    return true;
}

}  // namespace

FailingCalls::FailingCalls(Call call, int error, int times) : call_(call) {
    plan_of(call).error = error;
    plan_of(call).left = times;
}

FailingCalls::~FailingCalls() {
    plan_of(call_).left = 0;
}

int FailingCalls::left() const {
    return plan_of(call_).left;
}

}  // namespace coppice::test

using coppice::test::FailingCalls;

extern "C" int accept4(int socket, sockaddr* address, socklen_t* bytes, int flags) {
    if (coppice::test::fails(FailingCalls::Call::accept4)) return -1;
    return static_cast<int>(::syscall(SYS_accept4, socket, address, bytes, flags));
}

extern "C" int fsync(int file) {
    if (coppice::test::fails(FailingCalls::Call::fsync)) return -1;
    return static_cast<int>(::syscall(SYS_fsync, file));
}
