#include "server/config.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "tests/server/fails_with.h"
#include "tests/server/temporary_folder.h"

namespace coppice {
namespace {

using test::fails_with;

Environment environment(std::map<std::string, std::string> variables) {
    return [variables = std::move(variables)](const std::string& name) -> std::optional<std::string> {
        const auto found = variables.find(name);
        return found == variables.end() ? std::nullopt : std::optional(found->second);
    };
}

TEST(Config, has_the_documented_defaults) {
    const Config config = load_config({}, environment({}));
    EXPECT_EQ(config.listen, "127.0.0.1:8080");
    EXPECT_EQ(config.data, "./coppice-data");
    EXPECT_EQ(config.http.body_bytes, 512U << 20);
    EXPECT_EQ(config.queue_length, 1000U);
    EXPECT_EQ(config.wait, std::chrono::seconds(30));
}

TEST(Config, flags_go_before_the_environment_and_that_before_the_file) {
    const test::TemporaryFolder folder;
    const std::string file = folder.path() / "coppice.toml";
    std::ofstream(file) << "slots = 1\nqueue_length = 1\nwait_seconds = 1\ndata = \"/file\"\n";
    const Config config = load_config({{"config", file}, {"slots", "3"}},
                                      environment({{"COPPICE_SLOTS", "2"}, {"COPPICE_QUEUE_LENGTH", "2"}}));
    EXPECT_EQ(config.slots, 3U);
    EXPECT_EQ(config.queue_length, 2U);
    EXPECT_EQ(config.wait, std::chrono::seconds(1));
    EXPECT_EQ(config.data, "/file");
}

TEST(Config, what_is_printed_loads_back_to_the_same) {
    const Config config = load_config({{"data", "/a \"b\"\\"}, {"upload-bytes", "77"}}, environment({}));
    const test::TemporaryFolder folder;
    const std::string file = folder.path() / "coppice.toml";
    std::ofstream(file) << print_config(config);
    const Config again = load_config({}, environment({{"COPPICE_CONFIG", file}}));
    EXPECT_EQ(again.data, config.data);
    EXPECT_EQ(again.http.body_bytes, 77U);
    EXPECT_EQ(print_config(again), print_config(config));
}

TEST(Config, an_unknown_or_impossible_setting_is_named) {
    EXPECT_THAT(
        [] {
            load_config({{"colour", "red"}}, environment({}));
        },
        fails_with(ErrorCode::option_unknown, "colour"));
    EXPECT_THAT(
        [] {
            load_config({}, environment({{"COPPICE_SLOTS", "many"}}));
        },
        fails_with(ErrorCode::option_invalid, "slots"));
    EXPECT_THAT(
        [] {
            load_config({{"wait-seconds", "56"}}, environment({}));
        },
        fails_with(ErrorCode::option_invalid, "0 to 55"));
    EXPECT_THAT(
        [] {
            load_config({{"config", "/nowhere.toml"}}, environment({}));
        },
        fails_with(ErrorCode::option_invalid, "/nowhere.toml"));
    EXPECT_THAT(
        [] {
            load_config({{"listen", "8080"}}, environment({}));
        },
        fails_with(ErrorCode::option_invalid, "ADDRESS:PORT"));
}

TEST(Config, listening_to_the_world_without_keys_has_to_be_asked_for_by_name) {
    EXPECT_THAT(
        [] {
            load_config({{"listen", "0.0.0.0:8080"}}, environment({}));
        },
        fails_with(ErrorCode::option_invalid, "--allow-anonymous"));
    EXPECT_NO_THROW(load_config({{"listen", "0.0.0.0:8080"}, {"allow-anonymous", "true"}}, environment({})));
    for (const char* loopback : {"127.0.0.1:0", "localhost:80", "[::1]:80"}) {
        EXPECT_NO_THROW(load_config({{"listen", loopback}}, environment({}))) << loopback;
    }
}

}  // namespace
}  // namespace coppice
