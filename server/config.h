// The settings of the service: flags, then COPPICE_* environment variables, then a TOML file, then these
// defaults.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/format/limits.h"
#include "server/http/limits.h"

namespace coppice {

struct Config {
    std::string listen = "127.0.0.1:8080";  // ADDRESS:PORT, [IPv6]:PORT; port 0 takes a free one
    std::string data = "./coppice-data";
    unsigned slots = 0;                // jobs that run at the same time; 0: one per core
    std::string isolation = "thread";  // where a job runs
    bool allow_anonymous = false;      // listen on an address that is not loopback, though there are no keys
    size_t queue_length = 1000;
    std::chrono::seconds wait{30};  // of a client that does not say how long it waits
    std::chrono::seconds job_time{300};
    std::chrono::seconds drain_time{30};
    std::chrono::seconds keep_time{24 * 3600};  // finished jobs
    size_t keep_jobs = 1000;
    HttpLimits http = {};
    ReadLimits read = {};
};

using Pairs = std::vector<std::pair<std::string, std::string>>;
using Environment = std::function<std::optional<std::string>(const std::string& name)>;
Environment process_environment();

// flags: names without dashes, with '-' or '_' ("queue-length"); a flag without a value has the value "true".
// The flag config (or COPPICE_CONFIG) names a TOML file. Throws option_unknown, option_invalid with where =
// the setting.
Config load_config(const Pairs& flags, const Environment& environment = process_environment());

// The effective settings as TOML; what it prints loads back to the same.
std::string print_config(const Config& config);

// Every setting, for help.
struct SettingDescription {
    std::string name, meaning;
    std::string default_value;  // as it is typed after a flag
};
std::vector<SettingDescription> describe_settings();

struct ListenAddress {
    std::string host;
    int port = 0;
    bool loopback = false;
};

// Throws option_invalid.
ListenAddress parse_listen(const std::string& listen);

}  // namespace coppice
