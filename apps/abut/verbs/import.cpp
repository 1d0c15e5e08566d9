#include <abut/error.h>
#include <abut/levels.h>
#include <abut/progress.h>
#include <abut/store.h>

#include "arguments/interrupt.h"
#include "commands.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace abut::command {

namespace {

/// Levels of detail take at least this memory.
constexpr std::uint64_t kLeastLevelMemory = std::uint64_t{64} << 20;

struct ImportArguments {
    std::vector<std::string> files; ///< model files, then the store
    std::string memory = "512M";
    ReadOptions read;
    bool remove = false;
    bool levels = false; ///< also builds levels of detail
};

nlohmann::ordered_json describe(const LevelReport& report) {
    return {{"built", report.built},
            {"chunks", report.chunks},
            {"new_chunks", report.new_chunks},
            {"triangles", report.triangles},
            {"stored_bytes", report.stored_bytes},
            {"geometry_bytes", report.geometry_bytes},
            {"seconds", report.seconds}};
}

std::string table(const LevelReport& report) {
    const double mib = 1024.0 * 1024.0;
    return fmt::format(
        "levels      {} chunks, {} new, {} triangles, {:.1f} MiB, meshes {:.1f} MiB, "
        "{:.2f} s\n",
        grouped(report.chunks), grouped(report.new_chunks), grouped(report.triangles),
        static_cast<double>(report.stored_bytes) / mib,
        static_cast<double>(report.geometry_bytes) / mib, report.seconds);
}

nlohmann::ordered_json describe(const ImportReport& report, const std::string& store) {
    nlohmann::ordered_json models = nlohmann::ordered_json::array();
    for (const ImportedModel& model : report.models)
        models.push_back({{"file", model.file},
                          {"outcome", to_string(model.outcome)},
                          {"streamed", model.streamed},
                          {"bytes", model.bytes},
                          {"parts", model.parts},
                          {"triangles", model.triangles},
                          {"unit", model.unit},
                          {"up", abut::to_string(model.up)},
                          {"notes", to_json(model.notes)},
                          {"added", model.added},
                          {"changed", model.changed},
                          {"removed", model.removed},
                          {"seconds", model.seconds}});
    return {{"store", store},
            {"models", std::move(models)},
            {"new_meshes", report.new_meshes},
            {"removed_meshes", report.removed_meshes},
            {"seconds", report.seconds},
            {"peak_rss_mib", peak_resident_mib()}};
}

std::string table(const ImportReport& report, const std::string& store) {
    std::size_t widest = 0;
    for (const ImportedModel& model : report.models)
        widest = std::max(widest, shown(model.file).size());
    std::string text;
    for (const ImportedModel& model : report.models) {
        text +=
            fmt::format("{:<{}}  {:>9} parts  {:>12} triangles  {}", shown(model.file), widest,
                        grouped(model.parts), grouped(model.triangles), to_string(model.outcome));
        if (model.outcome == ImportOutcome::changed)
            text += fmt::format(": {} added, {} changed, {} removed", grouped(model.added),
                                grouped(model.changed), grouped(model.removed));
        text += '\n' + in_words(model.notes, "  ");
    }
    return text + fmt::format("{}  {} new meshes, {} removed\n"
                              "seconds     {:.2f}\npeak memory {:.0f} MiB\n",
                              shown(store), grouped(report.new_meshes),
                              grouped(report.removed_meshes), report.seconds, peak_resident_mib());
}

int remove(const std::vector<std::string>& files, const std::string& store,
           const CommonOptions& common) {
    const RemovalReport report = remove_models(files, store);
    nlohmann::ordered_json models = nlohmann::ordered_json::array();
    std::string text;
    for (const RemovedModel& model : report.models) {
        models.push_back({{"file", model.file}, {"parts", model.parts}});
        text += fmt::format("{}  {} parts removed\n", shown(model.file), grouped(model.parts));
    }
    if (common.json)
        print_json(dump({{"store", store},
                         {"removed", std::move(models)},
                         {"removed_meshes", report.removed_meshes}}));
    else if (!common.quiet)
        print_text(text + fmt::format("{}  {} meshes removed\n", shown(store),
                                      grouped(report.removed_meshes)));
    return kExitDone;
}

int run(const ImportArguments& arguments, const CommonOptions& common) {
    if (arguments.files.size() < 2)
        throw Error(ErrorCode::bad_argument, "import needs a model and a store: MODEL... STORE");
    const std::vector<std::string> models(arguments.files.begin(), arguments.files.end() - 1);
    const std::string& store = arguments.files.back();
    if (arguments.remove)
        return remove(models, store, common);
    ProgressBar bar(common.progress_style());
    ImportReport report;
    std::optional<LevelReport> levels;
    {
        const InterruptScope scope(OnInterrupt::ask);
        const std::uint64_t memory = parse_bytes("--memory", arguments.memory);
        report = import_models(parse_model_paths(models), store,
                               {.memory = memory,
                                .unit = arguments.read.unit,
                                .up = arguments.read.up,
                                .spaces = arguments.read.spaces,
                                .map = arguments.read.map,
                                .allow_outside_files = arguments.read.allow_outside_files,
                                .progress = bar.progress()});
        if (arguments.levels)
            levels = build_levels(
                store, {.memory = std::max(memory, kLeastLevelMemory), .progress = bar.progress()});
    }
    bar.finish();
    throw_if_interrupted();
    if (common.json) {
        nlohmann::ordered_json described = describe(report, store);
        if (levels)
            described["levels"] = describe(*levels);
        print_json(dump(described));
    } else if (!common.quiet) {
        print_text(table(report, store) + (levels ? table(*levels) : ""));
    }
    return kExitDone;
}

} // namespace

Subcommand add_import(CLI::App& root, CommonOptions& common) {
    auto arguments = std::make_shared<ImportArguments>();
    CLI::App* app =
        add_subcommand(root, common,
                       {"import",
                        kModels,
                        "Import models into a store, for jobs on models larger than the memory",
                        {{"abut import design.glb pipes.glb site.abut",
                          "creates the store, or updates it with files that have changed"},
                         {"abut import --remove pipes.glb site.abut", "removes a model from it"}},
                        ""});
    app->add_option(
           "FILES", arguments->files,
           fmt::format("Models ({}), and last the store, which is created or updated", kModelHelp))
        ->required();
    app->add_option("--memory", arguments->memory,
                    "Limit of memory in bytes, with K, M or G (default 512M)")
        ->check(not_empty("BYTES"));
    add_read_options(*app, arguments->read);
    CLI::Option* remove =
        app->add_flag("--remove", arguments->remove,
                      "Remove the models from the store; their files need not exist");
    app->add_flag("--levels", arguments->levels,
                  "Also build levels of detail, which the viewer needs")
        ->excludes(remove);
    return {app, [arguments, &common] { return run(*arguments, common); }};
}

} // namespace abut::command
