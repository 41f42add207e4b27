#include "server/store/job_store.h"

#include <sys/random.h>

#include <array>

#include "core/base/error.h"

namespace coppice {

std::vector<const StoredFile*> JobRecord::input_files() const {
    std::vector<const StoredFile*> files = {&asset};
    for (const StoredFile& resource : resources) files.push_back(&resource);
    if (candidate) {
        files.push_back(&candidate->asset);
        for (const StoredFile& resource : candidate->resources) files.push_back(&resource);
    }
    return files;
}

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
