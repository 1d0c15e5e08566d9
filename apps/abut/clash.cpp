#include <abut/clash.h>
#include <abut/error.h>
#include <abut/scene.h>

#include "clash_summary.h"
#include "commands.h"
#include "interrupt.h"
#include "output_files.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace abut::command {

namespace {

struct ClashArguments {
    std::vector<std::string> files;
    ClashOptions options; ///< clearance, touch, self; the rest is filled by run()
    std::string rules, out, fail_on;
    double unit = 0;
};

/// A file against itself would report every part as a duplicate of itself.
void refuse_repeated(const std::vector<std::string>& files) {
    for (std::size_t i = 0; i < files.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            std::error_code missing; // a reader says that better
            if (files[i] == files[j] || std::filesystem::equivalent(files[i], files[j], missing))
                throw Error(ErrorCode::bad_argument, files[i], "is given twice");
        }
}

std::vector<ClashKind> parse_kinds(const std::string& text) {
    if (text.empty())
        return {};
    std::vector<std::string> known{"any"};
    for (const ClashKind kind : kClashKinds)
        known.emplace_back(abut::to_string(kind));
    const std::vector<std::string> words = parse_words("--fail-on", text, known);
    std::vector<ClashKind> kinds;
    for (const ClashKind kind : kClashKinds)
        for (const std::string& word : words)
            if (word == "any" || word == abut::to_string(kind))
                kinds.push_back(kind);
    return kinds;
}

void write_reports(OutputFiles& outputs, const ClashReport& report,
                   const std::vector<Scene>& models) {
    const InterruptScope scope(OnInterrupt::defer);
    using Writer = decltype(&write_clash_json);
    constexpr std::array<std::pair<const char*, Writer>, 3> kWriters{
        {{"report.html", write_clash_html},
         {"report.json", write_clash_json},
         {"report.csv", write_clash_csv}}};
    for (const auto& [name, writer] : kWriters) {
        throw_if_interrupted();
        outputs.stage(
            name, [&, write = writer](const std::string& path) { write(report, models, path); });
    }
    throw_if_interrupted();
    outputs.commit();
}

int run(const ClashArguments& arguments, const CommonOptions& common) {
    const Stopwatch watch;
    // Everything that can be refused without reading a model is refused first.
    refuse_repeated(arguments.files);
    const std::vector<ClashKind> fail_on = parse_kinds(arguments.fail_on);
    ClashOptions options = arguments.options;
    if (!arguments.rules.empty())
        options.rules = read_rules(arguments.rules);
    std::optional<OutputFiles> outputs;
    if (!arguments.out.empty())
        outputs.emplace(arguments.out,
                        std::vector<std::string>{"report.html", "report.json", "report.csv"});

    ProgressBar bar(common.progress_style());
    options.progress = bar.progress();
    std::vector<Scene> models;
    ClashReport report;
    {
        const InterruptScope scope(OnInterrupt::ask);
        models =
            read_scenes(arguments.files, {.unit = arguments.unit, .progress = options.progress});
        const double seconds_import = watch.seconds();
        report = find_clashes(models, options);
        report.seconds.import = seconds_import;
        report.seconds.total = watch.seconds();
    }
    bar.finish();
    throw_if_interrupted();

    if (outputs)
        write_reports(*outputs, report, models);
    if (common.json) {
        std::string text = abut::to_json(report, models);
        if (text.empty() || text.back() != '\n')
            text += '\n';
        print(text);
    } else if (!common.quiet) {
        std::string text = summary(report, models);
        if (outputs)
            text += fmt::format("\nreport      {}, .json, .csv\n", outputs->path("report.html"));
        print(text);
    }
    const bool problem = std::any_of(fail_on.begin(), fail_on.end(), [&](ClashKind kind) {
        return report.counts.at(static_cast<std::size_t>(kind)) > 0;
    });
    return problem ? kExitProblem : kExitDone;
}

} // namespace

Subcommand add_clash(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<ClashArguments>();
    CLI::App* app = add_subcommand(root, common, "clash",
                                   "Every clash and clearance between the parts of models");
    app->add_option("MODEL", arguments->files, "Models in one world frame")->required();
    app->add_option("--clearance", arguments->options.clearance,
                    "Report parts that are nearer than this, in metres (default 0: off)")
        ->check(not_negative());
    app->add_option("--touch", arguments->options.touch,
                    "Surfaces that meet no deeper than this only touch, in metres (default 0)")
        ->check(not_negative());
    app->add_flag("--self", arguments->options.self,
                  "With several models: also the pairs within each");
    app->add_option("--rules", arguments->rules, "JSON file that selects pairs (docs/clash.md)")
        ->check(not_empty("FILE"));
    app->add_option("--out", arguments->out, "Folder for report.html, report.json and report.csv")
        ->check(not_empty("FOLDER"));
    app->add_option("--fail-on", arguments->fail_on,
                    "Exit with status 1 if there is one of these kinds: hard, touch, contained, "
                    "duplicate, clearance (comma-separated), or any")
        ->check(not_empty("KINDS"));
    add_unit_option(*app, arguments->unit);
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
