#include <abut/assembly.h>
#include <abut/error.h>

#include "arguments/interrupt.h"
#include "commands.h"
#include "motion/motion_summary.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace abut::command {

namespace {

struct MotionArguments {
    std::string assembly, csv, report, fail_on;
    MotionClashOptions options;
    ReadOptions read;
};

bool is_problem(const MotionReport& report, const std::string& fail_on) {
    return fail_on == "clearance"
               ? !report.clashes.empty()
               : fail_on == "contact" && std::ranges::any_of(report.clashes, [](const auto& clash) {
                     return clash.kind == MotionClashKind::contact;
                 });
}

int run(const MotionArguments& arguments, const CommonOptions& common) {
    Assembly assembly;
    MotionReport report;
    Stopwatch watch;
    double reading = 0;
    {
        ProgressBar bar(common.progress_style());
        const InterruptScope scope(OnInterrupt::ask);
        ReadOptions read = arguments.read;
        read.progress = bar.progress();
        assembly = read_assembly(arguments.assembly, read);
        throw_if_interrupted();
        reading = watch.seconds();
        MotionClashOptions options = arguments.options;
        options.progress = bar.progress();
        report = find_motion_clashes(assembly, options);
        throw_if_interrupted();
        bar.finish();
    }
    const double query = watch.seconds() - reading;
    if (!arguments.csv.empty())
        write_motion_csv(report, assembly, arguments.csv);
    if (!arguments.report.empty())
        write_motion_html(report, assembly, arguments.report);
    if (common.json) {
        nlohmann::ordered_json json = motion_json(report, assembly);
        json["seconds"] = {{"read", reading}, {"query", query}};
        print_json(dump(json));
    } else if (!common.quiet) {
        print_text(motion_text(report, assembly));
    }
    return is_problem(report, arguments.fail_on) ? kExitProblem : kExitDone;
}

} // namespace

Subcommand add_motion(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<MotionArguments>();
    CLI::App* app = add_subcommand(
        root, common,
        {"motion",
         kAssemblies,
         "Clashes over time between the parts of an assembly that moves",
         {{"abut motion engine.toml", "which parts meet while the crank turns, and when?"},
          {"abut motion engine.toml --clearance 5mm --report motion.html",
           "also pairs that come within 5 mm, with a chart over time"},
          {"abut motion engine.toml --csv motion.csv --fail-on contact",
           "a table of all contacts; exit status 1 if there is one"}},
         "a pair meets, or comes near (with --fail-on)"});
    app->add_option("SCENE", arguments->assembly,
                    "Assembly: a TOML or JSON file with parts, joints and keys")
        ->required();
    add_length(*app, "--clearance", arguments->options.clearance,
               "Also find the pairs that come at most this near");
    add_length(*app, "--tolerance", arguments->options.tolerance,
               "Parts at most this far apart count as in contact; 0.01 mm by default");
    app->add_option("--step", arguments->options.step,
                    "Seconds: shorter contacts and separations may be joined to one; default: a "
                    "thousandth of the duration")
        ->check(positive());
    app->add_flag("--joined", arguments->options.joined,
                  "Also test the pairs that a joint or a loop connects");
    app->add_flag("--allow-outside-files", arguments->read.allow_outside_files,
                  "Also read models and tables that are not in the assembly's folder");
    app->add_option("--csv", arguments->csv, "Write a row for each contact and approach")
        ->check(not_empty("FILE"));
    app->add_option("--report", arguments->report,
                    "Write an HTML page with a chart over time and tables")
        ->check(not_empty("FILE.html"));
    app->add_option("--fail-on", arguments->fail_on,
                    "Exit with status 1 if a pair meets (contact), or also if one comes within the "
                    "clearance (clearance)")
        ->check(CLI::IsMember({"contact", "clearance"}));
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
