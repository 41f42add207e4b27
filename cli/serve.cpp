#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "cli/commands.h"
#include "server/app.h"
#include "server/config.h"

namespace coppice {

namespace {

struct ServeFlags {
    Pairs settings;
    bool print = false;
};

int serve(const ServeFlags& flags, const Terminal& terminal) {
    const Config config = load_config(flags.settings);
    if (!flags.print) return run_service(config);
    terminal.out << print_config(config);
    return 0;
}

// queue_length -> --queue-length
std::string flag_of(std::string setting) {
    std::replace(setting.begin(), setting.end(), '_', '-');
    return "--" + setting;
}

}  // namespace

Action add_serve(CLI::App& app, const Terminal& terminal) {
    auto flags = std::make_shared<ServeFlags>();
    CLI::App* command = app.add_subcommand("serve", "Runs the HTTP service until SIGTERM or SIGINT");
    const auto add = [&](const std::string& name, const std::string& help) {
        const auto keep = [flags, name](const std::vector<std::string>& values) {
            const bool is_bare = values.empty() || values.front().empty();
            flags->settings.emplace_back(name, is_bare ? "true" : values.front());
        };
        command->add_option_function<std::vector<std::string>>(flag_of(name), keep, help)
            ->expected(0, 1)
            ->type_name("")
            ->group("Settings");
    };
    for (const auto& [name, meaning, default_value] : describe_settings())
        add(name, fmt::format("{} [{}]", meaning, default_value));
    if (command->get_option_no_throw("--config") == nullptr) add("config", "a TOML file with settings");
    command->add_flag("--print-config", flags->print, "Prints the settings in effect as TOML, and ends");
    command->footer(
        "Defaults stand in brackets. Each setting is also an environment variable, COPPICE_ and its name in\n"
        "capitals.\n"
        "Example:\n"
        "  coppice serve --listen 127.0.0.1:8080 --data ./coppice-data");
    return [flags, &terminal] { return serve(*flags, terminal); };
}

}  // namespace coppice
