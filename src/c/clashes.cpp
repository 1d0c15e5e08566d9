#include <abut/clash.h>
#include <abut/store.h>
#include <abut/store_clash.h>

#include "c/guard.h"

#include <atomic>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

/// The result of a search, with the models that its writers need.
struct abut_report { // NOLINT(readability-identifier-naming)
    abut::ClashReport report;
    std::vector<abut::Scene> models;
    std::string json;
};

namespace abut {

namespace {

/// Passes progress on to a function in C, and stops when it asks for that.
class ProgressInC {
public:
    explicit ProgressInC(const abut_clash_options* options) {
        if (options == nullptr || options->progress == nullptr)
            return;
        progress_.stop = &stop_;
        progress_.report = [this, call = options->progress,
                            user = options->user](std::string_view stage, double fraction) {
            if (call(user, std::string(stage).c_str(), fraction) != 0)
                stop_ = true;
        };
    }
    ProgressInC(const ProgressInC&) = delete;
    ProgressInC& operator=(const ProgressInC&) = delete;

    [[nodiscard]] const Progress& progress() const { return progress_; }

    /// Throws Error{interrupted} if the function has asked to stop, even in its last call.
    void require_going_on() const {
        if (stop_)
            throw Error(ErrorCode::interrupted, "interrupted");
    }

private:
    std::atomic<bool> stop_{false};
    Progress progress_;
};

/// Copies scenes. Throws Error{bad_argument} if two have the same name: in a report, nothing would
/// tell their parts apart, and a scene that is given twice would be its own duplicate.
std::vector<Scene> scenes_from_c(std::span<const abut_scene* const> scenes) {
    std::vector<Scene> result;
    std::unordered_set<std::string> names;
    for (const abut_scene* scene : scenes) {
        const Scene& model = needed(scene, "a scene").scene;
        if (!names.insert(model.file).second)
            throw Error(ErrorCode::bad_argument, model.file, "is given twice");
        result.push_back(model);
    }
    return result;
}

ClashOptions options_from_c(const abut_clash_options* options, const Progress& progress) {
    ClashOptions result;
    result.progress = progress;
    if (options == nullptr)
        return result;
    result.clearance = options->clearance;
    if (options->touch_tolerance != ABUT_TOUCH_OF_FILES)
        result.touch_tolerance = options->touch_tolerance;
    result.self = options->self != 0;
    if (options->rules != nullptr)
        result.rules = read_rules(options->rules);
    return result;
}

void write_report_in_c(const abut_report& report, const std::string& path) {
    const std::string_view text = path;
    if (text.ends_with(".json"))
        write_clash_json(report.report, report.models, path);
    else if (text.ends_with(".csv"))
        write_clash_csv(report.report, report.models, path);
    else if (text.ends_with(".html"))
        write_clash_html(report.report, report.models, path);
    else
        throw Error(ErrorCode::bad_argument, path, "a report ends in .json, .csv or .html");
}

} // namespace

} // namespace abut

extern "C" {

abut_status abut_scene_from_file(const char* path, abut_scene** scene) {
    return abut::guarded([&] {
        abut_scene*& result = abut::needed(scene, "scene");
        result =
            new abut_scene{abut::read_scene(abut::parse_model_path(&abut::needed(path, "path")))};
    });
}

abut_status abut_scene_new(const char* name, abut_scene** scene) {
    return abut::guarded([&] {
        abut_scene*& result = abut::needed(scene, "scene");
        abut::Scene empty;
        empty.file = &abut::needed(name, "name");
        empty.up = abut::UpAxis::z;
        result = new abut_scene{std::move(empty)};
    });
}

abut_status abut_scene_add_mesh(abut_scene* scene, const double* vertices, size_t vertex_count,
                                const uint32_t* triangles, size_t triangle_count, uint32_t* mesh) {
    return abut::guarded([&] {
        std::vector<abut::Mesh>& meshes = abut::needed(scene, "scene").scene.meshes;
        std::uint32_t& number = abut::needed(mesh, "mesh");
        meshes.push_back(
            abut::mesh_from_c(abut::needed(vertices, vertex_count, "vertices", 3),
                              abut::needed(triangles, triangle_count, "triangles", 3)));
        number = static_cast<std::uint32_t>(meshes.size() - 1);
    });
}

abut_status abut_scene_add_part(abut_scene* scene, const char* name, const char* type,
                                uint32_t mesh, const abut_transform* world_from_part) {
    return abut::guarded([&] {
        abut::Scene& parts = abut::needed(scene, "scene").scene;
        if (mesh >= parts.meshes.size())
            throw abut::Error(abut::ErrorCode::bad_argument, "there is no such mesh");
        abut::Part part;
        part.name = &abut::needed(name, "name");
        part.id = part.name;
        if (type != nullptr)
            part.type = type;
        part.mesh = mesh;
        part.world_from_mesh = abut::from_c(world_from_part, "world_from_part");
        if (!scene->ids.insert(part.id).second)
            throw abut::Error(abut::ErrorCode::bad_argument,
                              "there is already a part '" + part.id + "' in the scene");
        parts.parts.push_back(std::move(part));
    });
}

size_t abut_scene_part_count(const abut_scene* scene) {
    return scene == nullptr ? 0 : scene->scene.parts.size();
}

void abut_scene_free(abut_scene* scene) {
    delete scene;
}

abut_status abut_find_clashes(const abut_scene* const* scenes, size_t count,
                              const abut_clash_options* options, abut_report** report) {
    return abut::guarded([&] {
        abut_report*& result = abut::needed(report, "report");
        std::vector<abut::Scene> models =
            abut::scenes_from_c(abut::needed(scenes, count, "scenes"));
        const abut::ProgressInC progress(options);
        abut::ClashReport found =
            find_clashes(models, abut::options_from_c(options, progress.progress()));
        progress.require_going_on();
        std::string json = to_json(found, models);
        result = new abut_report{std::move(found), std::move(models), std::move(json)};
    });
}

abut_status abut_find_clashes_in_store(const char* store, const abut_clash_options* options,
                                       uint64_t memory, abut_report** report) {
    return abut::guarded([&] {
        abut_report*& result = abut::needed(report, "report");
        const abut::ProgressInC progress(options);
        abut::OutOfCoreOptions out_of_core;
        if (memory != 0)
            out_of_core.memory = memory;
        abut::StoreClashReport found =
            find_clashes(abut::open_store(&abut::needed(store, "store"), {.read_only = false}),
                         abut::options_from_c(options, progress.progress()), out_of_core);
        progress.require_going_on();
        std::string json = to_json(found);
        result = new abut_report{std::move(found.report), std::move(found.models), std::move(json)};
    });
}

abut_status abut_import(const char* const* paths, size_t count, const char* store) {
    return abut::guarded([&] {
        std::vector<abut::ModelPath> files;
        for (const char* path : abut::needed(paths, count, "paths"))
            files.push_back(abut::parse_model_path(&abut::needed(path, "a path")));
        import_models(files, &abut::needed(store, "store"));
    });
}

const char* abut_report_json(const abut_report* report) {
    return report == nullptr ? "" : report->json.c_str();
}

size_t abut_report_clash_count(const abut_report* report) {
    return report == nullptr ? 0 : report->report.clashes.size();
}

abut_status abut_report_write(const abut_report* report, const char* path) {
    return abut::guarded([&] {
        abut::write_report_in_c(abut::needed(report, "report"), &abut::needed(path, "path"));
    });
}

void abut_report_free(abut_report* report) {
    delete report;
}

} // extern "C"
