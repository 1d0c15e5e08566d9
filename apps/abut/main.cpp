#include <abut/crew.h>
#include <abut/error.h>
#include <abut/progress.h>

#include "arguments/command_line.h"
#include "arguments/interrupt.h"
#include "commands.h"
#include "help/help.h"

#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <string_view>

namespace {

using namespace abut::command;

/// Returns whether this process must stay silent. Of several processes that mpirun started for one
/// job, only the first prints.
bool is_spoken_for(const std::vector<std::string>& arguments) {
    return std::ranges::find(arguments, "clash") != arguments.end() && abut::is_helper();
}

/// Prints an error as one line on standard error unless silent. Line breaks in messages of other
/// libraries or in file names are escaped.
int fail(bool silent, int status, std::string_view message) {
    if (!silent)
        print_error(message);
    return status;
}

int help(const CLI::App& root, const std::string& verb_name) {
    const std::vector<const Verb*> verbs = verbs_of(root);
    const auto verb = std::ranges::find_if(
        verbs, [&](const Verb* each) { return each->get_name() == verb_name; });
    print_text(verb == verbs.end() ? general_help(root) : help_of(**verb));
    return kExitDone;
}

/// Parses the arguments and runs the command. The parser takes arguments in reverse order.
int run(CLI::App& root, const std::vector<Subcommand>& commands, const CommonOptions& common,
        std::vector<std::string> arguments) {
    arguments = arranged(root, std::move(arguments));
    const std::string first = arguments.empty() ? "" : arguments.front();
    if (first.empty())
        return help(root, "");
    std::ranges::reverse(arguments);
    try {
        root.parse(std::move(arguments));
    } catch (const CLI::CallForHelp&) {
        return help(root, first);
    } catch (const CLI::CallForVersion&) {
        print_text("abut " ABUT_VERSION "\n");
        return kExitDone;
    } catch (const CLI::ParseError& error) {
        throw abut::Error(abut::ErrorCode::bad_argument, error.what());
    }
    const auto command =
        std::ranges::find_if(commands, [](const Subcommand& c) { return c.app->parsed(); });
    abut::set_threads(common.threads);
    return command->run();
}

} // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): declaring options throws for mistakes of ours only.
int main(int argc, char** argv) {
    const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
    const bool silent = is_spoken_for(arguments);
    install_interrupt_handlers(silent);
    CLI::App root("Proximity queries on triangle models: clashes, contacts, distances", "abut");
    root.set_version_flag("--version", "abut " ABUT_VERSION, "Print the version and exit");
    root.require_subcommand(1);
    CommonOptions common;
    const std::vector<Subcommand> commands{
        add_info(root, common),        add_import(root, common),
        add_picture(root, common),     add_collide(root, common),
        add_distance(root, common),    add_within(root, common),
        add_penetration(root, common), add_time_of_impact(root, common),
        add_nearest(root, common),     add_ray(root, common),
        add_overlap(root, common),     add_contains(root, common),
        add_clash(root, common),       add_review(root, common),
        add_graph(root, common),       add_ccd(root, common),
        add_ccd_query(root, common),   add_robot(root, common),
        add_motion(root, common),      add_scene(root, common),
        add_generate(root, common)};
    try {
        return run(root, commands, common, arguments);
    } catch (const abut::Error& error) {
        const bool interrupted = error.code() == abut::ErrorCode::interrupted;
        return fail(silent, interrupted ? kExitInterrupted : kExitBadInput, error.what());
    } catch (const std::bad_alloc&) {
        return fail(silent, kExitBadInput, "out of memory");
    } catch (const std::exception& error) {
        return fail(silent, kExitBadInput, error.what());
    }
}
