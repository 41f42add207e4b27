// Routes and contract, each against the other.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "proto/openapi.h"
#include "server/blobs/disk_blobs.h"
#include "server/routes/routes.h"
#include "server/store/memory_store.h"
#include "tests/server/temporary_folder.h"

namespace coppice {
namespace {

using Operations = std::set<std::pair<std::string, std::string>>;  // path, method

Operations routed() {
    const test::TemporaryFolder folder;
    MemoryStore store;
    DiskBlobs blobs(folder.path());
    Metrics metrics;
    Services services{store, blobs, metrics};
    Operations operations;
    const Router router = make_router(services);
    for (const Route& route : router.routes()) operations.emplace(route.pattern, route.method);
    return operations;
}

Operations promised() {
    Operations operations;
    const auto document = nlohmann::json::parse(openapi_json());
    for (const auto& [path, item] : document["paths"].items()) {
        for (const auto& [method, operation] : item.items()) {
            if (method == "parameters") continue;
            std::string upper = method;
            for (char& c : upper) c = static_cast<char>(std::toupper(c));
            operations.emplace(path, upper);
        }
    }
    return operations;
}

TEST(Contract, promises_exactly_the_operations_that_there_are) {
    EXPECT_EQ(promised(), routed());
}

}  // namespace
}  // namespace coppice
