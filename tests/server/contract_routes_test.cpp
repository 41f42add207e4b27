// The routes and the contract hold the same operations, and take no method but those; and the documentation
// holds every setting.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "proto/openapi.h"
#include "server/blobs/disk_blobs.h"
#include "server/config.h"
#include "server/routes/routes.h"
#include "server/store/memory_store.h"
#include "tests/server/service_fixture.h"
#include "tests/server/test_scenes.h"

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

// By path, with the id of a job that has finished.
std::map<std::string, std::set<std::string>> methods_of_the_routes(const std::string& job) {
    std::map<std::string, std::set<std::string>> methods;
    for (const std::string& operation : operations_of_the_routes()) {
        const size_t space = operation.find(' ');
        std::string path = operation.substr(space + 1);
        if (const size_t id = path.find("/v1/jobs/{id}"); id == 0) path.replace(0, 13, job);
        methods[path].insert(operation.substr(0, space));
    }
    return methods;
}

class Routes : public test::ServiceTest {
  protected:
    Routes() {
        start();
        job = submit(test::iobj_scene());
        wait_for_status(job, "succeeded");
    }

    std::string job;
};

TEST_F(Routes, that_take_no_options_refuse_them_by_name) {
    const std::set<std::string> with_options = {"POST /v1/optimize", "POST /v1/jobs", "GET /v1/jobs",
                                                "POST /v1/inspect", "POST /v1/compare"};
    for (const auto& [path, methods] : methods_of_the_routes(job)) {
        for (const std::string& method : methods) {
            if (with_options.contains(fmt::format("{} {}", method, path))) continue;
            const test::Answer answer = test::request(port, method, path + "?colour=red");
            EXPECT_THAT(answer, test::is_problem(400, "option.unknown")) << method << " " << path;
            EXPECT_EQ(test::json_member(answer.body, "where"), "\"colour\"") << answer.body;
        }
    }
    EXPECT_EQ(get(job).status, 200) << "a refused DELETE deletes nothing";
}

TEST_F(Routes, answer_head_as_get_without_the_content) {
    for (const auto& [path, methods] : methods_of_the_routes(job)) {
        if (!methods.contains("GET")) continue;
        test::Connection connection(port);
        const test::Answer get = connection.request("GET", path);
        const test::Answer head = connection.request("HEAD", path);
        EXPECT_EQ(head.status, 200) << path;
        EXPECT_EQ(head.body, "") << path;
        for (const char* name :
             {"content-type", "content-length", "etag", "cache-control", "accept-ranges"}) {
            if (path == "/metrics" && name == std::string("content-length"))
                continue;  // it counts the requests
            EXPECT_EQ(head.header(name), get.header(name)) << path << " " << name;
        }
        EXPECT_NE(head.header("content-length"), "") << path;
        // What came after the head would be taken for this answer.
        EXPECT_EQ(connection.request("GET", "/healthz").body, R"({"status":"ok"})") << path;
    }
}

TEST_F(Routes, refuse_every_other_method_and_say_which_they_take) {
    for (const auto& [path, methods] : methods_of_the_routes(job)) {
        std::set<std::string> taken = methods;
        if (methods.contains("GET")) taken.insert("HEAD");
        for (const char* method : {"GET", "HEAD", "POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE",
                                   "CONNECT", "BREW", "get"}) {
            if (taken.contains(method)) continue;
            test::Connection connection(port);
            const test::Answer answer = connection.request(method, path);
            EXPECT_EQ(answer.status, 405) << method << " " << path;
            EXPECT_EQ(answer.header("content-type"), "application/problem+json");
            std::istringstream allow(answer.header("allow"));
            std::set<std::string> allowed;
            for (std::string one; std::getline(allow >> std::ws, one, ',');) allowed.insert(one);
            EXPECT_EQ(allowed, taken) << method << " " << path;
            EXPECT_EQ(answer.body.empty(), std::string_view(method) == "HEAD") << method << " " << path;
            EXPECT_EQ(connection.request("GET", "/healthz").body, R"({"status":"ok"})")
                << method << " " << path;
        }
    }
}

TEST(Contract, has_exactly_the_operations_that_have_routes) {
    EXPECT_EQ(operations_of_the_contract(), operations_of_the_routes());
}

TEST(Documentation, explains_every_setting_and_tells_its_default) {
    std::ifstream file(COPPICE_SOURCE_DIR "/docs/operations.md");
    ASSERT_TRUE(file);
    std::stringstream text;
    text << file.rdbuf();
    for (const SettingDescription& setting : describe_settings()) {
        EXPECT_NE(text.str().find("| `" + setting.name + "` |"), std::string::npos)
            << setting.name << ": " << setting.meaning;
    }
    std::istringstream defaults(print_config({}));
    for (std::string line; std::getline(defaults, line);) {
        const size_t equals = line.find(" = ");
        std::string value = line.substr(equals + 3);
        if (value.front() == '"' || value.front() == '\'')
            value = "`" + value.substr(1, value.size() - 2) + "`";
        const std::string row = "| `" + line.substr(0, equals) + "` | " + value + " |";
        EXPECT_NE(text.str().find(row), std::string::npos) << row;
    }
}

}  // namespace
}  // namespace coppice
