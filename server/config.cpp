#include "server/config.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "core/base/error.h"
#include "core/base/number.h"

namespace coppice {
namespace {

// A setting, as text to and from the struct.
struct Setting {
    std::string_view name;
    std::string_view help;
    std::function<void(Config&, const std::string&)> parse;
    std::function<std::string(const Config&)> print;  // a TOML value
};

[[noreturn]] void fail_invalid(std::string_view name, const std::string& value, const std::string& takes) {
    fail(ErrorCode::option_invalid, std::string(name),
         fmt::format("the setting {} is \"{}\"; it takes {}", name, value, takes));
}

uint64_t number_of(std::string_view name, const std::string& text, uint64_t least, uint64_t most) {
    const auto number = parse_whole_number(text, least, most);
    if (!number) fail_invalid(name, text, fmt::format("a whole number from {} to {}", least, most));
    return *number;
}

// member: a callable that gives the reference into a Config.
template <typename Member>
Setting number(std::string_view name, std::string_view help, uint64_t least, uint64_t most, Member member) {
    return {name, help,
            [=](Config& config, const std::string& text) {
                auto& value = member(config);
                value =
                    static_cast<std::remove_reference_t<decltype(value)>>(number_of(name, text, least, most));
            },
            [=](const Config& config) { return std::to_string(member(const_cast<Config&>(config))); }};
}

template <typename Member>
Setting duration(std::string_view name, std::string_view help, uint64_t least, uint64_t most, Member member) {
    return {
        name, help,
        [=](Config& config, const std::string& text) {
            auto& value = member(config);
            value = std::remove_reference_t<decltype(value)>(
                static_cast<int64_t>(number_of(name, text, least, most)));
        },
        [=](const Config& config) { return std::to_string(member(const_cast<Config&>(config)).count()); }};
}

template <typename Member>
Setting text(std::string_view name, std::string_view help, Member member) {
    return {name, help, [=](Config& config, const std::string& value) { member(config) = value; },
            [=](const Config& config) {
                std::ostringstream out;
                out << toml::value<std::string>(member(const_cast<Config&>(config)));
                return out.str();
            }};
}

template <typename Member>
Setting flag(std::string_view name, std::string_view help, Member member) {
    return {name, help,
            [=](Config& config, const std::string& value) {
                if (value != "true" && value != "false") fail_invalid(name, value, "true or false");
                member(config) = value == "true";
            },
            [=](const Config& config) { return member(const_cast<Config&>(config)) ? "true" : "false"; }};
}

#define COPPICE_MEMBER(member) ([](Config & config) -> auto& { return config.member; })

std::vector<Setting> make_settings() {
    constexpr uint64_t many = 1'000'000'000;
    constexpr uint64_t huge = 1ULL << 50;
    constexpr uint64_t day = 86'400;
    return {
        text("listen", "ADDRESS:PORT to listen on; port 0 takes a free one", COPPICE_MEMBER(listen)),
        text("data", "directory for uploads and results", COPPICE_MEMBER(data)),
        number("slots", "jobs that run at the same time; 0: one per core", 0, 1024, COPPICE_MEMBER(slots)),
        text("isolation", "where a job runs: thread", COPPICE_MEMBER(isolation)),
        flag("allow_anonymous", "listen on an address that is not loopback without keys",
             COPPICE_MEMBER(allow_anonymous)),
        number("queue_length", "jobs that may wait", 1, many, COPPICE_MEMBER(queue_length)),
        duration("wait_seconds", "wait of a client that does not say", 0, 55, COPPICE_MEMBER(wait)),
        duration("job_seconds", "longest time of one job", 1, day, COPPICE_MEMBER(job_time)),
        duration("drain_seconds", "time for running jobs to end at shutdown", 0, day,
                 COPPICE_MEMBER(drain_time)),
        duration("keep_seconds", "how long finished jobs are kept", 0, many, COPPICE_MEMBER(keep_time)),
        number("keep_jobs", "how many finished jobs are kept", 0, many, COPPICE_MEMBER(keep_jobs)),
        number("upload_bytes", "bytes of one request's body", 1, 2ULL << 30, COPPICE_MEMBER(http.body_bytes)),
        number("http_line_bytes", "bytes of a request line, and of a header line", 256, 64 << 10,
               COPPICE_MEMBER(http.line_bytes)),
        number("http_header_bytes", "bytes of all headers", 1024, 1 << 20, COPPICE_MEMBER(http.header_bytes)),
        number("http_headers", "headers of one request", 8, 1000, COPPICE_MEMBER(http.headers)),
        number("http_part_header_bytes", "bytes of the headers of a multipart part", 256, 64 << 10,
               COPPICE_MEMBER(http.part_header_bytes)),
        number("http_parts", "parts of a multipart body", 1, 10'000, COPPICE_MEMBER(http.parts)),
        duration("http_header_ms", "time for the headers of a request", 10, 600'000,
                 COPPICE_MEMBER(http.header_time)),
        duration("http_body_ms", "time for the body of a request", 10, 86'400'000,
                 COPPICE_MEMBER(http.body_time)),
        number("http_bytes_per_second", "slowest rate of a client, both ways", 1, many,
               COPPICE_MEMBER(http.bytes_per_second)),
        duration("http_slow_ms", "how long a client may be slower; ten times as long once it was fast", 10,
                 600'000, COPPICE_MEMBER(http.slow_time)),
        duration("http_idle_ms", "time between two requests of a connection", 10, 600'000,
                 COPPICE_MEMBER(http.idle_time)),
        number("http_connections", "connections at the same time", 1, 10'000,
               COPPICE_MEMBER(http.connections)),
        number("http_connections_per_address", "connections of one address", 1, 10'000,
               COPPICE_MEMBER(http.connections_per_address)),
        number("triangles", "stored triangles of an asset", 1, huge, COPPICE_MEMBER(read.triangles)),
        number("instances", "instances of an asset", 1, huge, COPPICE_MEMBER(read.instances)),
        number("rendered_triangles", "triangles of an asset after expansion", 1, huge,
               COPPICE_MEMBER(read.rendered_triangles)),
        number("vertices", "vertices of an asset", 1, huge, COPPICE_MEMBER(read.vertices)),
        number("json_bytes", "bytes of an asset's JSON", 1, huge, COPPICE_MEMBER(read.json_bytes)),
        number("json_values", "values in an asset's JSON", 1, huge, COPPICE_MEMBER(read.json_values)),
        number("json_depth", "depth of an asset's JSON", 1, 1000, COPPICE_MEMBER(read.json_depth)),
        number("nodes", "nodes of an asset", 1, many, COPPICE_MEMBER(read.nodes)),
        number("node_depth", "depth of an asset's nodes", 1, 100'000, COPPICE_MEMBER(read.node_depth)),
        number("meshes_and_primitives", "meshes and primitives of an asset", 1, many,
               COPPICE_MEMBER(read.meshes_and_primitives)),
        number("accessors", "accessors of an asset, and buffer views", 1, many,
               COPPICE_MEMBER(read.accessors)),
        number("objects", "materials, animations and so on of an asset, together", 1, many,
               COPPICE_MEMBER(read.objects)),
        number("attributes", "attributes of a mesh, with those of its morph targets", 1, 1'000'000,
               COPPICE_MEMBER(read.attributes)),
        number("attribute_bytes",
               "bytes of an asset's accessors, of its attributes as floats, and of what a Draco stream "
               "decodes to",
               1, huge, COPPICE_MEMBER(read.attribute_bytes)),
        number("images", "images of an asset", 1, many, COPPICE_MEMBER(read.images)),
        number("zip_entries", "files in a zip", 1, many, COPPICE_MEMBER(read.zip_entries)),
        number("zip_bytes", "bytes of a zip's files, unpacked", 1, huge, COPPICE_MEMBER(read.zip_bytes)),
        number("zip_ratio", "unpacked bytes for each packed one", 1, 100'000, COPPICE_MEMBER(read.zip_ratio)),
    };
}

#undef COPPICE_MEMBER

std::string with_underscores(std::string name) {
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

const Setting& find_setting(const std::vector<Setting>& settings, const std::string& name,
                            std::string_view where) {
    for (const Setting& setting : settings) {
        if (setting.name == name) return setting;
    }
    fail(ErrorCode::option_unknown, name, fmt::format("there is no setting \"{}\" ({})", name, where));
}

Pairs read_toml(const std::string& path) {
    Pairs pairs;
    try {
        const toml::table table = toml::parse_file(path);
        for (const auto& [key, node] : table) {
            std::string value;
            if (const auto string = node.value_exact<std::string>()) {
                value = *string;
            } else if (const auto boolean = node.value_exact<bool>()) {
                value = *boolean ? "true" : "false";
            } else if (const auto integer = node.value_exact<int64_t>()) {
                value = std::to_string(*integer);
            } else {
                fail(ErrorCode::option_invalid, std::string(key.str()),
                     fmt::format("the setting {} in {} is no string, whole number or boolean", key.str(),
                                 path));
            }
            pairs.emplace_back(key.str(), value);
        }
    } catch (const toml::parse_error& error) {
        fail(ErrorCode::option_invalid, "config",
             fmt::format("{}:{}: {}", path, error.source().begin.line, error.description()));
    }
    return pairs;
}

std::string upper(std::string_view name) {
    std::string result = "COPPICE_";
    for (const char c : name) result += static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
    return result;
}

void validate(const Config& config) {
    if (config.isolation != "thread") fail_invalid("isolation", config.isolation, "thread");
    const ListenAddress address = parse_listen(config.listen);
    require(
        address.loopback || config.allow_anonymous, ErrorCode::option_invalid, "listen",
        "{} is not a loopback address, and no keys are configured: whoever reaches it could use the service. "
        "Say --allow-anonymous if that is what you want",
        config.listen);
}

}  // namespace

Environment process_environment() {
    return [](const std::string& name) -> std::optional<std::string> {
        const char* const value = std::getenv(name.c_str());
        return value == nullptr ? std::nullopt : std::optional<std::string>(value);
    };
}

Config load_config(const Pairs& flags, const Environment& environment) {
    const auto settings = make_settings();
    Config config;
    std::optional<std::string> file = environment("COPPICE_CONFIG");
    for (const auto& [name, value] : flags) {
        if (name == "config") file = value;
    }
    if (file) {
        for (const auto& [name, value] : read_toml(*file))
            find_setting(settings, name, *file).parse(config, value);
    }
    for (const Setting& setting : settings) {
        if (const auto value = environment(upper(setting.name))) setting.parse(config, *value);
    }
    for (const auto& [name, value] : flags) {
        if (name != "config")
            find_setting(settings, with_underscores(name), "--" + name).parse(config, value);
    }
    validate(config);
    return config;
}

std::string print_config(const Config& config) {
    std::string text;
    for (const Setting& setting : make_settings()) {
        text += fmt::format("{} = {}\n", setting.name, setting.print(config));
    }
    return text;
}

std::vector<SettingDescription> describe_settings() {
    std::vector<SettingDescription> described;
    for (const Setting& setting : make_settings()) {
        const std::string value = setting.print({});
        const bool is_text = value.starts_with('"') || value.starts_with('\'');
        described.push_back({std::string(setting.name), std::string(setting.help),
                             is_text ? value.substr(1, value.size() - 2) : value});
    }
    return described;
}

ListenAddress parse_listen(const std::string& listen) {
    const auto colon = listen.rfind(':');
    if (colon == std::string::npos || colon == 0) fail_invalid("listen", listen, "ADDRESS:PORT");
    ListenAddress address;
    address.host = listen.substr(0, colon);
    address.port = static_cast<int>(number_of("listen", listen.substr(colon + 1), 0, 65'535));
    if (address.host.starts_with('[') && address.host.ends_with(']')) {
        address.host = address.host.substr(1, address.host.size() - 2);
    }
    address.loopback =
        address.host == "localhost" || address.host == "::1" || address.host.starts_with("127.");
    return address;
}

}  // namespace coppice
