#include "cli/run.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.h"
#include "core/base/error.h"
#include "core/optimize/engine.h"
#include "proto/unknown_option.h"

namespace coppice {

namespace {

constexpr int done = 0, failed = 1, wrong_usage = 2;

bool is_usage(ErrorCode code) {
    return code == ErrorCode::option_unknown || code == ErrorCode::option_invalid ||
           code == ErrorCode::option_conflict;
}

// The one place of the command line where exceptions end.
int guarded(const Action& action, const Terminal& terminal) {
    try {
        return action();
    } catch (const Error& error) {
        terminal.err << "coppice: " << name(error.code()) << ": " << error.message();
        if (!error.where().empty()) terminal.err << " (at " << error.where() << ")";
        terminal.err << "\n";
        return is_usage(error.code()) ? wrong_usage : failed;
    } catch (const std::bad_alloc&) {
        terminal.err << "coppice: " << name(ErrorCode::asset_too_large)
                     << ": there is not enough memory for this asset\n";
        return failed;
    } catch (const std::exception& exception) {
        terminal.err << "coppice: " << name(ErrorCode::internal) << ": " << exception.what() << "\n";
        return failed;
    }
}

std::optional<std::string> unknown_flag(const CLI::App& app) {
    for (const std::string& argument : app.remaining(true)) {
        if (argument.starts_with("--")) return argument.substr(0, argument.find('='));
    }
    return {};
}

// In the words that a request gets for an option that does not exist.
[[noreturn]] void refuse_flag(const CLI::App& app, const std::string& flag) {
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    const CLI::App& command = chosen.empty() ? app : *chosen.front();
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    fail_unknown_option(flag, {names.begin(), names.end()});
}

}  // namespace

int run(const std::vector<std::string>& arguments, const Terminal& terminal) {
    CLI::App app(
        "Makes instanced 3D scenes small: simplifies each unique mesh once, and keeps its instances.",
        "coppice");
    app.set_version_flag(
        "--version", "coppice " + std::string(engine_version()) + " (" + std::string(engine_build()) + ")");
    app.require_subcommand(1);
    app.footer(
        "Examples:\n"
        "  coppice sample forest -o forest.glb\n"
        "  coppice optimize forest.glb -o small.glb --ratio 0.5\n"
        "  coppice optimize scene.obj -o scene.iobj --error 0.001 --report -\n"
        "  coppice inspect small.glb\n"
        "  coppice compare forest.glb small.glb\n"
        "  coppice serve --listen 127.0.0.1:8080\n"
        "coppice COMMAND --help tells more.");
    const std::array<std::pair<const char*, Action>, 6> commands = {{
        {"optimize", add_optimize(app, terminal)},
        {"inspect", add_inspect(app, terminal)},
        {"compare", add_compare(app, terminal)},
        {"algorithms", add_algorithms(app, terminal)},
        {"sample", add_sample(app, terminal)},
        {"serve", add_serve(app, terminal)},
    }};
    try {
        std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // as CLI11 wants them
        app.parse(reversed);
    } catch (const CLI::ExtrasError& error) {
        const std::optional<std::string> flag = unknown_flag(app);
        if (flag) return guarded([&]() -> int { refuse_flag(app, *flag); }, terminal);
        app.exit(error, terminal.out, terminal.err);
        return wrong_usage;
    } catch (const CLI::ParseError& error) {
        return app.exit(error, terminal.out, terminal.err) == 0 ? done : wrong_usage;
    }
    for (const auto& [name, action] : commands) {
        if (app.got_subcommand(name)) return guarded(action, terminal);
    }
    return wrong_usage;
}

}  // namespace coppice
