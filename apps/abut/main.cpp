#include <abut/crew.h>
#include <abut/error.h>
#include <abut/progress.h>

#include "commands.h"
#include "interrupt.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <fmt/format.h>
#include <new>
#include <string_view>

namespace {

using namespace abut::command;

/// Of several processes that mpirun started for one job, the first speaks for all.
bool is_spoken_for(int argc, char** argv) {
    return argc > 1 && std::string_view(argv[1]) == "clash" && abut::is_helper();
}

/// One line on standard error, unless silent, whatever a third-party message or a file's name holds.
int fail(bool silent, int status, std::string message) {
    std::replace_if(
        message.begin(), message.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
    if (!silent)
        fmt::print(stderr, "abut: {}\n", message);
    return status;
}

int run(const Subcommand& command, const CommonOptions& common, bool silent) {
    try {
        abut::set_threads(common.threads);
        return command.run();
    } catch (const abut::Error& error) {
        const bool interrupted = error.code() == abut::ErrorCode::interrupted;
        return fail(silent, interrupted ? kExitInterrupted : kExitBadInput, error.what());
    } catch (const std::bad_alloc&) {
        return fail(silent, kExitBadInput, "out of memory");
    } catch (const std::exception& error) {
        return fail(silent, kExitBadInput, error.what());
    }
}

} // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): declaring options throws for mistakes of ours only.
int main(int argc, char** argv) {
    const bool silent = is_spoken_for(argc, argv);
    install_interrupt_handlers(silent);
    CLI::App root("Proximity queries on triangle models: clashes, contacts, distances", "abut");
    root.set_version_flag("--version", "abut " ABUT_VERSION);
    root.require_subcommand(1);
    CommonOptions common;
    const std::array commands{
        add_info(root, common),           add_import(root, common),   add_collide(root, common),
        add_distance(root, common),       add_within(root, common),   add_penetration(root, common),
        add_time_of_impact(root, common), add_nearest(root, common),  add_ray(root, common),
        add_overlap(root, common),        add_contains(root, common), add_clash(root, common),
        add_review(root, common),         add_graph(root, common),    add_ccd(root, common),
        add_ccd_query(root, common),      add_scene(root, common)};
    const bool known = std::any_of(commands.begin(), commands.end(), [&](const Subcommand& c) {
        return argc > 1 && c.app->get_name() == argv[1];
    });
    if (argc > 1 && argv[1][0] != '-' && !known)
        return fail(silent, kExitBadInput,
                    fmt::format("unknown subcommand '{}' (see abut --help)", argv[1]));
    try {
        root.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success))
            return root.exit(error); // --help, --version
        return fail(silent, kExitBadInput, error.what());
    }
    const auto* command = std::find_if(commands.begin(), commands.end(),
                                       [](const Subcommand& c) { return c.app->parsed(); });
    return run(*command, common, silent);
}
