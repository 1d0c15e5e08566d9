#include <abut/clash.h>
#include <abut/clash_groups.h>
#include <abut/crew.h>
#include <abut/error.h>
#include <abut/scene.h>
#include <abut/store.h>
#include <abut/store_clash.h>

#include "arguments/fail_on.h"
#include "arguments/interrupt.h"
#include "arguments/output_files.h"
#include "arguments/selection.h"
#include "commands.h"
#include "text/clash_summary.h"
#include "verbs/bcf_output.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <set>

namespace abut::command {

namespace {

struct ClashArguments {
    std::vector<std::string> files;
    ClashOptions options; ///< clearance, touch, self; run() fills in the rest
    SelectionArguments selection;
    std::string out, fail_on, group = to_string(GroupOptions().by);
    GroupOptions grouping; ///< the reach; run() fills in the rest
    std::optional<std::string> memory, page_geometry;
    bool no_hierarchies = false;
    BcfArguments bcf;
    ReadOptions read;
};

/// Refuses files that are given twice. A file against itself would report each part as its own
/// duplicate.
void refuse_repeated(const std::vector<ModelPath>& files) {
    for (std::size_t i = 0; i < files.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            std::error_code missing; // ignored: the reader reports it better
            if (files[i].path == files[j].path ||
                std::filesystem::equivalent(files[i].path, files[j].path, missing))
                throw Error(ErrorCode::bad_argument, files[i].path, "is given twice");
        }
}

/// Writes the reports. In          store: path of the store that `found` is about; empty for models.
void write_reports(OutputFiles& outputs, const StoreClashReport& found, const std::string& store,
                   const ClashPageOptions& page) {
    const InterruptScope scope(OnInterrupt::defer);
    const ClashReport& report = found.report;
    const std::vector<Scene>& models = found.models;
    throw_if_interrupted();
    outputs.stage("report.html", [&](const std::string& path) {
        if (!store.empty())
            write_clash_html(found, open_store(store), path, page);
        else
            write_clash_html(report, models, path, page);
    });
    using Writer = decltype(&write_clash_json);
    constexpr std::array<std::pair<const char*, Writer>, 2> kWriters{
        {{"report.json", write_clash_json}, {"report.csv", write_clash_csv}}};
    for (const auto& [name, writer] : kWriters) {
        throw_if_interrupted();
        outputs.stage(
            name, [&, write = writer](const std::string& path) { write(report, models, path); });
    }
    throw_if_interrupted();
    outputs.commit();
}

std::string out_of_core_summary(const OutOfCoreCounters& c) {
    return fmt::format(
        "out of core {} units, {} meshes loaded for {} that are needed, {} bytes read "
        "for {}\n",
        grouped(c.units), grouped(c.mesh_loads), grouped(c.meshes), grouped(c.bytes_read),
        grouped(c.bytes_needed));
}

/// Says which clashes are the problem that --fail-on names.
std::string problems_text(const ClashReport& report, const std::vector<std::uint32_t>& problems) {
    if (problems.empty())
        return "\nfails       no clash that --fail-on names\n";
    const std::vector<const ClashGroup*> group_of = groups_of_clashes(report);
    std::set<const ClashGroup*> groups;
    for (const std::uint32_t i : problems)
        groups.insert(group_of[i]);
    groups.erase(nullptr);
    std::string text =
        fmt::format("\nfails       {} {} that --fail-on names", grouped(problems.size()),
                    problems.size() == 1 ? "clash" : "clashes");
    if (!groups.empty())
        text += fmt::format(", in {} {}", grouped(groups.size()),
                            groups.size() == 1 ? "group" : "groups");
    return text + "\n";
}

/// Returns whether a rule, or a cell of a matrix, has a clearance of its own.
bool rules_have_clearances(const ClashOptions& options) {
    const auto has_one = [](const ClashRule& rule) { return rule.clearance.has_value(); };
    return std::ranges::any_of(options.rules, has_one) ||
           std::ranges::any_of(options.matrix.cells, [&](const ClashMatrix::Cell& cell) {
               return cell.examined && has_one(cell.terms);
           });
}

std::string text_of(const StoreClashReport& found, const ClashOptions& options, bool from_store,
                    const std::optional<std::vector<std::uint32_t>>& problems,
                    const std::optional<OutputFiles>& outputs,
                    const std::optional<BcfOutput>& bcf) {
    std::string text = summary(found.report, found.models, rules_have_clearances(options));
    if (from_store)
        text += out_of_core_summary(found.counters);
    if (problems)
        text += problems_text(found.report, *problems);
    if (outputs)
        text += fmt::format("\nreport      {}, .json, .csv\n", shown(outputs->path("report.html")));
    else if (!found.report.clashes.empty())
        text += "\nlist        --out FOLDER writes all of them: a page, JSON and CSV\n";
    if (bcf)
        text += fmt::format("{}bcf         {}: {} {}\n", outputs ? "" : "\n", shown(bcf->path()),
                            grouped(bcf->topics()), bcf->topics() == 1 ? "topic" : "topics");
    return text;
}

void print_result(const StoreClashReport& found, const ClashOptions& options, bool from_store,
                  const std::optional<std::vector<std::uint32_t>>& problems,
                  const std::optional<OutputFiles>& outputs, const std::optional<BcfOutput>& bcf,
                  const CommonOptions& common) {
    if (common.json)
        print_json(from_store ? abut::to_json(found) : abut::to_json(found.report, found.models));
    else if (!common.quiet)
        print_text(text_of(found, options, from_store, problems, outputs, bcf));
}

/// Runs a helper, that is a process other than the first one that mpirun started. It works and
/// prints nothing.
int help(const ClashArguments& arguments, Crew& crew) {
    const InterruptScope scope(OnInterrupt::ask);
    help_find_clashes(arguments.files.front(), crew, {.report = {}, .stop = &interrupt_flag()});
    return kExitDone;
}

/// Refuses options that are only for a store, or only for models.
void refuse_misplaced(const ClashArguments& arguments, bool from_store, bool has_crew) {
    if (has_crew && !from_store)
        throw Error(ErrorCode::bad_argument, arguments.files.front(),
                    "is not a store: several processes can work only on a store");
    if (arguments.no_hierarchies && !from_store)
        throw Error(ErrorCode::bad_argument, "--no-keep-hierarchies",
                    "applies only to a store: without one, nothing is kept");
    if (arguments.memory && !from_store)
        throw Error(ErrorCode::bad_argument, "--memory",
                    "applies only to a store: import the models with abut import");
    if (arguments.read.up != ReadOptions().up && from_store)
        throw Error(ErrorCode::bad_argument, "--up",
                    "applies only to models: a store has the axes of its first import");
    if (arguments.read.spaces && from_store)
        throw Error(ErrorCode::bad_argument, "--spaces",
                    "applies only to models: a store has the spaces of its import");
    if (!arguments.read.map && from_store)
        throw Error(ErrorCode::bad_argument, "--no-map",
                    "applies only to models: a store has the coordinates of its import");
    if (arguments.read.unit != 0 && from_store)
        throw Error(ErrorCode::bad_argument, "--unit",
                    "applies only to models: a store has the units of its import");
}

/// The options of the groups; no criterion if the clashes are not to be grouped.
GroupOptions grouping_of(const ClashArguments& arguments) {
    GroupOptions options = arguments.grouping;
    options.by.clear();
    if (arguments.group != "none")
        options.by = parse_grouping(arguments.group);
    return options;
}

void group(StoreClashReport& found, const std::string& store, const GroupOptions& options) {
    if (options.by.empty())
        return;
    if (!store.empty())
        return group_clashes(open_store(store), found, options);
    found.report.groups = group_clashes(found.report, found.models, options);
    found.report.grouping = options.by;
}

OutOfCoreOptions limits_of(const ClashArguments& arguments, Crew* crew) {
    OutOfCoreOptions limits;
    if (arguments.memory)
        limits.memory = parse_bytes("--memory", *arguments.memory);
    limits.keep_hierarchies = !arguments.no_hierarchies;
    limits.crew = crew;
    return limits;
}

void write_bcf_of(BcfOutput& bcf, const ClashArguments& arguments, bool from_store,
                  StoreClashReport& found, const Progress& progress) {
    throw_if_interrupted();
    const InterruptScope scope(OnInterrupt::ask);
    std::optional<Store> store;
    if (from_store)
        store = open_store(arguments.files.front());
    bcf.write(found, store, progress, found.report.warnings);
}

ClashPageOptions page_options_of(const ClashArguments& arguments) {
    ClashPageOptions page;
    if (arguments.page_geometry)
        page.building_bytes = parse_bytes("--page-geometry", *arguments.page_geometry);
    page.progress.stop = &interrupt_flag();
    return page;
}

int run(const ClashArguments& arguments, const CommonOptions& common) {
    const Stopwatch watch;
    std::unique_ptr<Crew> crew = join_crew();
    if (crew && common.threads == 0)
        set_threads(crew->threads());
    if (crew && crew->rank() > 0)
        return help(arguments, *crew);
    // Arguments that can be refused without reading a model are refused first.
    const std::vector<ModelPath> files = parse_model_paths(arguments.files);
    refuse_repeated(files);
    const bool from_store = arguments.files.size() == 1 && is_store(arguments.files.front());
    const GroupOptions grouping = grouping_of(arguments);
    const FailOn fail_on(arguments.fail_on, {from_store, !grouping.by.empty()});
    ClashOptions options = arguments.options;
    read_selection(arguments.selection, options);
    options.asked_later = fail_on.query();
    std::optional<OutputFiles> outputs;
    if (!arguments.out.empty())
        outputs.emplace(arguments.out,
                        std::vector<std::string>{"report.html", "report.json", "report.csv"});
    std::optional<BcfOutput> bcf;
    if (!arguments.bcf.out.empty())
        bcf.emplace(arguments.bcf);
    refuse_misplaced(arguments, from_store, crew != nullptr);
    const ClashPageOptions page = page_options_of(arguments);
    ProgressBar bar(common.progress_style());
    options.progress = bar.progress();
    StoreClashReport found; // `counters` is filled in for a store only
    ClashReport& report = found.report;
    std::vector<Scene>& models = found.models;
    {
        const InterruptScope scope(OnInterrupt::ask);
        if (from_store) {
            found = find_clashes(open_store(arguments.files.front()), options,
                                 limits_of(arguments, crew.get()));
            crew.reset(); // the helpers need not wait for the reports
        } else {
            ReadOptions read = arguments.read;
            read.progress = options.progress;
            models = read_scenes(files, read);
            const double seconds_import = watch.seconds();
            report = find_clashes(models, options);
            report.seconds.import = seconds_import;
        }
        group(found, from_store ? arguments.files.front() : "", grouping);
        report.seconds.total = watch.seconds();
    }
    if (bcf)
        write_bcf_of(*bcf, arguments, from_store, found, options.progress);
    bar.finish();
    throw_if_interrupted();
    if (outputs)
        write_reports(*outputs, found, from_store ? arguments.files.front() : "", page);
    std::optional<std::vector<std::uint32_t>> problems;
    if (!fail_on.empty())
        problems = fail_on.problems(report, models);
    print_result(found, options, from_store, problems, outputs, bcf, common);
    return problems && !problems->empty() ? kExitProblem : kExitDone;
}

} // namespace

Subcommand add_clash(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<ClashArguments>();
    CLI::App* app = add_subcommand(
        root, common,
        {"clash",
         kClashes,
         "Every clash and clearance between the parts of models",
         {{"abut clash design.glb pipes.glb --clearance 50mm --out report",
           "between two models: report/report.html, report.json and report.csv"},
          {"abut clash model.glb --fail-on hard,contained",
           "within one model; exit status 1 if a part penetrates or contains another"},
          {"mpirun -n 2 abut clash site.abut --memory 1G",
           "on a store, with two processes of at most a gigabyte each (as root, mpirun needs "
           "--allow-run-as-root)"}},
         "a clash that --fail-on names was found"});
    app->add_option("MODEL", arguments->files,
                    fmt::format("Models ({}), or a store of them (abut import)", kModelHelp))
        ->required();
    app->add_option("--memory", arguments->memory,
                    "For a store: limit of memory in bytes, with K, M or G (default 512M)")
        ->check(not_empty("BYTES"));
    app->add_flag("--no-keep-hierarchies", arguments->no_hierarchies,
                  "For a store: do not keep the hierarchies that are built");
    add_length(*app, "--clearance", arguments->options.clearance,
               "Report parts that are nearer than this (default 0: off)");
    add_length(
        *app, "--touch", arguments->options.touch_tolerance,
        "Surfaces that meet no deeper than this only touch (default: what the files tell apart; "
        "0: exact)");
    app->add_flag("--self", arguments->options.self,
                  "With several models: also test the pairs within each");
    add_selection(*app, arguments->selection);
    app->add_option("--group", arguments->group,
                    "Criteria of the groups of clashes, outermost first: part, place, storey, "
                    "system, types, discipline (comma-separated), or none")
        ->check(not_empty("CRITERIA"))
        ->capture_default_str();
    add_length(*app, "--group-reach", arguments->grouping.reach,
               "Largest distance of a clash from the centre of its place (default 6m)");
    app->add_option("--out", arguments->out, "Folder for report.html, report.json and report.csv")
        ->check(not_empty("FOLDER"));
    app->add_option("--page-geometry", arguments->page_geometry,
                    "Bytes of report.html for the building in 3D, with K, M or G (default 16M; "
                    "0: no 3D view)")
        ->check(not_empty("BYTES"));
    app->add_option(
           "--fail-on", arguments->fail_on,
           "Exit with status 1 if there is a clash of these kinds: hard, touch, contained, "
           "duplicate, clearance, undecided (comma-separated), or any; for a store, one that is "
           "not approved, "
           "or has one of these statuses: new, active, reviewed, approved. Or a condition: "
           "'hard and storey = L2', 'severity = high and group.change = new' "
           "(docs/selecting.md)")
        ->check(not_empty("WORDS"));
    add_bcf_options(*app, "--bcf", arguments->bcf);
    add_read_options(*app, arguments->read);
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
