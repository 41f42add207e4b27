#include "server/store/job_store.h"

#include <sys/random.h>

#include <array>

#include "core/base/error.h"

namespace coppice {

Time system_now() {
    return std::chrono::floor<std::chrono::milliseconds>(std::chrono::system_clock::now());
}

std::string make_job_id() {
    std::array<uint64_t, 2> random{};
    require(::getrandom(random.data(), sizeof random, 0) == static_cast<ssize_t>(sizeof random),
            ErrorCode::internal, "", "the system gives no random numbers");
    return fmt::format("{:016x}{:016x}", random[0], random[1]);
}

}  // namespace coppice
