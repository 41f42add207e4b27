// The routes and the contract hold the same operations; and the documentation holds every setting.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "proto/openapi.h"
#include "server/blobs/disk_blobs.h"
#include "server/config.h"
#include "server/routes/routes.h"
#include "server/store/memory_store.h"
#include "tests/server/temporary_folder.h"

namespace coppice {
namespace {

std::set<std::string> operations_of_the_contract() {
    std::set<std::string> operations;
    const auto document = nlohmann::json::parse(openapi_json());
    for (const auto& [path, item] : document["paths"].items()) {
        for (const auto& [method, operation] : item.items()) {
            if (method == "parameters") continue;
            std::string name = method;
            std::transform(name.begin(), name.end(), name.begin(),
                           [](char c) { return static_cast<char>(c - 'a' + 'A'); });
            operations.insert(name.append(" ").append(path));
        }
    }
    return operations;
}

std::set<std::string> operations_of_the_routes() {
    const test::TemporaryFolder folder;
    MemoryStore store;
    DiskBlobs blobs(folder.path());
    Metrics metrics;
    Services services{store, blobs, metrics};
    std::set<std::string> operations;
    const Router router = make_router(services);
    for (const Route& route : router.routes()) operations.insert(route.method + " " + route.pattern);
    return operations;
}

TEST(Contract, has_exactly_the_operations_that_have_routes) {
    EXPECT_EQ(operations_of_the_contract(), operations_of_the_routes());
}

TEST(Documentation, explains_every_setting) {
    std::ifstream file(COPPICE_SOURCE_DIR "/docs/operations.md");
    ASSERT_TRUE(file);
    std::stringstream text;
    text << file.rdbuf();
    for (const auto& [name, meaning] : describe_settings()) {
        EXPECT_NE(text.str().find("| `" + name + "` |"), std::string::npos) << name << ": " << meaning;
    }
}

}  // namespace
}  // namespace coppice
