#include <abut/clash.h>
#include <abut/error.h>
#include <abut/scene.h>
#include <abut/store.h>
#include <abut/store_clash.h>

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
    std::optional<std::string> memory;
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

/// Appended to the report's members.
std::string out_of_core_member(const OutOfCoreCounters& c) {
    return fmt::format(",\n\"out_of_core\": {{\"units\": {}, \"meshes\": {}, \"mesh_loads\": {}, "
                       "\"blocks\": {}, \"block_loads\": {}, \"bytes_needed\": {}, \"bytes_read\": "
                       "{}, \"peak_model_bytes\": {}, \"kept\": {}, "
                       "\"recalled_pairs\": {}}}\n",
                       c.units, c.meshes, c.mesh_loads, c.blocks, c.block_loads, c.bytes_needed,
                       c.bytes_read, c.peak_bytes, c.kept, c.recalled_pairs);
}

std::string out_of_core_summary(const OutOfCoreCounters& c) {
    return fmt::format(
        "out of core {} units, {} meshes loaded for {} that are needed, {} bytes read "
        "for {}\n",
        grouped(c.units), grouped(c.mesh_loads), grouped(c.meshes), grouped(c.bytes_read),
        grouped(c.bytes_needed));
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

    const bool from_store = arguments.files.size() == 1 && is_store(arguments.files.front());
    if (arguments.memory && !from_store)
        throw Error(ErrorCode::bad_argument, "--memory",
                    "is for a store alone: bring the models into one with abut import");
    if (arguments.unit != 0 && from_store)
        throw Error(ErrorCode::bad_argument, "--unit",
                    "is for models alone: a store has the one of its import");
    ProgressBar bar(common.progress_style());
    options.progress = bar.progress();
    std::vector<Scene> models;
    ClashReport report;
    std::optional<OutOfCoreCounters> out_of_core;
    {
        const InterruptScope scope(OnInterrupt::ask);
        if (from_store) {
            OutOfCoreOptions limits;
            if (arguments.memory)
                limits.memory = parse_bytes("--memory", *arguments.memory);
            StoreClashReport found =
                find_clashes(open_store(arguments.files.front()), options, limits);
            report = std::move(found.report);
            models = std::move(found.models);
            out_of_core = found.counters;
        } else {
            models = read_scenes(arguments.files,
                                 {.unit = arguments.unit, .progress = options.progress});
            const double seconds_import = watch.seconds();
            report = find_clashes(models, options);
            report.seconds.import = seconds_import;
        }
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
        if (out_of_core)
            text.insert(text.rfind('}'), out_of_core_member(*out_of_core));
        print(text);
    } else if (!common.quiet) {
        std::string text = summary(report, models);
        if (out_of_core)
            text += out_of_core_summary(*out_of_core);
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
    app->add_option("MODEL", arguments->files,
                    "Models in one world frame, or a store of them (abut import)")
        ->required();
    app->add_option("--memory", arguments->memory,
                    "A store: bytes to keep to, with K, M or G (default 512M)")
        ->check(not_empty("BYTES"));
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
