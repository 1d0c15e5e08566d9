#include "verbs/info_store.h"

#include <abut/clash_review.h>
#include <abut/error.h>
#include <abut/store.h>

#include "arguments/interrupt.h"
#include "text/properties_text.h"

#include <fmt/format.h>
#include <utility>

namespace abut::command {

namespace {

nlohmann::ordered_json describe_frame(const StoreSummary& summary) {
    return summary.models.empty() ? nlohmann::ordered_json()
                                  : command::describe_frame(summary.up, summary.models[0].file);
}

nlohmann::ordered_json describe(const StoreSummary& summary, bool verified) {
    nlohmann::ordered_json models = nlohmann::ordered_json::array();
    for (const StoreSummary::Model& model : summary.models)
        models.push_back({{"file", model.file},
                          {"complete", model.complete},
                          {"parts", model.parts},
                          {"triangles", model.triangles},
                          {"generation", model.generation},
                          {"unit", model.unit},
                          {"up", abut::to_string(model.up)},
                          {"notes", to_json(model.notes)},
                          {"project", model.project},
                          {"map_from_project", model.map_from_project.m}});
    nlohmann::ordered_json store{{"store", summary.path},
                                 {"version", summary.version},
                                 {"complete", summary.complete},
                                 {"generation", summary.generation},
                                 {"frame", describe_frame(summary)},
                                 {"models", std::move(models)},
                                 {"parts", summary.parts},
                                 {"triangles", summary.triangles},
                                 {"properties", summary.properties.size()},
                                 {"relations", summary.relations},
                                 {"meshes", summary.meshes},
                                 {"stored_triangles", summary.stored_triangles},
                                 {"blocks", summary.blocks},
                                 {"raw_bytes", summary.raw_bytes},
                                 {"stored_bytes", summary.stored_bytes},
                                 {"hierarchies", summary.hierarchies},
                                 {"hierarchy_bytes", summary.hierarchy_bytes},
                                 {"levels", summary.levels},
                                 {"level_chunks", summary.level_chunks},
                                 {"level_bytes", summary.level_bytes},
                                 {"file_bytes", summary.file_bytes},
                                 {"unused_bytes", summary.unused_bytes}};
    // An empty store has infinite bounds, which JSON cannot express.
    if (summary.bounds.lower.x <= summary.bounds.upper.x)
        store["bounds"] = {{"lower", to_json(summary.bounds.lower)},
                           {"upper", to_json(summary.bounds.upper)}};
    if (verified)
        store["verified"] = true;
    return store;
}

std::string table(const StoreSummary& summary, bool verified) {
    std::string text =
        fmt::format("{}\n"
                    "  store       {:>14}  version, generation {}, {}\n",
                    shown(summary.path), summary.version, summary.generation,
                    summary.complete ? "complete" : "incomplete: import again to continue");
    for (const StoreSummary::Model& model : summary.models)
        text += fmt::format("  model       {:>14}  parts, {} triangles, {}, {} m a unit, {} up{}\n",
                            grouped(model.parts), grouped(model.triangles), shown(model.file),
                            number(model.unit), abut::to_string(model.up),
                            model.complete ? "" : " (import not finished)") +
                in_words(model.notes, "    ");
    if (!summary.models.empty())
        text += fmt::format("  frame       {:>14}  up; metres\n", abut::to_string(summary.up));
    text += fmt::format(
        "  parts       {:>14}  {} triangles\n"
        "  properties  {:>14}  names, {} relations between parts\n"
        "  meshes      {:>14}  {} triangles in {} blocks\n"
        "  geometry    {:>14}  bytes, {} before compression\n"
        "  hierarchies {:>14}  bytes, of {} blocks\n"
        "  levels      {:>14}  bytes in {} chunks{}\n"
        "  file        {:>14}  bytes, {} of them unused\n",
        grouped(summary.parts), grouped(summary.triangles), grouped(summary.properties.size()),
        grouped(summary.relations), grouped(summary.meshes), grouped(summary.stored_triangles),
        grouped(summary.blocks), grouped(summary.stored_bytes), grouped(summary.raw_bytes),
        grouped(summary.hierarchy_bytes), grouped(summary.hierarchies),
        grouped(summary.level_bytes), grouped(summary.level_chunks),
        summary.levels              ? ""
        : summary.level_chunks == 0 ? ": none"
                                    : ": incomplete or outdated",
        grouped(summary.file_bytes), grouped(summary.unused_bytes));
    const Vec3 &lower = summary.bounds.lower, &upper = summary.bounds.upper;
    if (lower.x <= upper.x)
        text += fmt::format("  bounds      {}\n", box_text(lower, upper, 0));
    return text + (verified ? "  verified    all pages, rows and blocks\n" : "");
}

nlohmann::ordered_json part_list(const Scene& scene) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
        const Part& part = scene.parts[i];
        rows.push_back({{"id", part.id},
                        {"name", part.name},
                        {"type", part.type},
                        {"properties", properties_json(scene, i)}});
    }
    return rows;
}

std::string part_table(const Scene& scene) {
    std::string text = "\n  parts of " + shown(scene.file) + "\n";
    for (const Part& part : scene.parts)
        text += fmt::format("  {}  {}{}{}\n", shown(part.id), shown(part.name),
                            part.type.empty() ? "" : "  ", shown(part.type));
    return text;
}

/// Adds what --parts and --properties ask for, to the text or to the store's JSON.
void add_details(const Store& store, std::size_t models, const StoreDetails& details,
                 nlohmann::ordered_json* json, std::string& text) {
    std::vector<Scene> scenes;
    for (std::size_t i = 0; i < models; ++i) {
        Scene scene = read_parts(store, i);
        if (details.parts && json != nullptr) {
            (*json)["models"][i]["part_list"] = part_list(scene);
            (*json)["models"][i]["relations"] = relations_json(scene);
        } else if (details.parts) {
            text += part_table(scene);
        }
        if (details.properties)
            scenes.push_back(std::move(scene));
    }
    if (details.properties && json != nullptr)
        (*json)["property_list"] = to_json(property_uses(scenes));
    else if (details.properties)
        text += command::table(property_uses(scenes));
}

} // namespace

bool looks_like_store(const std::string& file) {
    return is_store(file) || file.ends_with(".abut");
}

int describe_stores(const std::vector<std::string>& files, const StoreDetails& details,
                    const CommonOptions& common) {
    nlohmann::ordered_json stores = nlohmann::ordered_json::array();
    std::string text;
    for (const std::string& file : files) {
        const Store store = open_store(file);
        if (details.verify) {
            ProgressBar bar(common.progress_style());
            const InterruptScope scope(OnInterrupt::ask);
            abut::verify(store, bar.progress());
            abut::verify_jobs(store);
        }
        throw_if_interrupted();
        const StoreSummary found = summary(store);
        if (common.json)
            stores.push_back(describe(found, details.verify));
        else
            text += (text.empty() ? "" : "\n") + table(found, details.verify);
        if (details.parts || details.properties)
            add_details(store, found.models.size(), details, common.json ? &stores.back() : nullptr,
                        text);
    }
    if (common.json)
        print_json(dump({{"stores", std::move(stores)}}));
    else if (!common.quiet)
        print_text(text);
    return kExitDone;
}

} // namespace abut::command
