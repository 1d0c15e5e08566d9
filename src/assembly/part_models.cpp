#include "assembly/part_models.h"

#include <abut/error.h>
#include <abut/store.h>

#include "store/database/store_file.h"

#include <filesystem>
#include <utility>

namespace abut {

/// The parts of a file, with their meshes.
class PartModels::Source {
public:
    explicit Source(Scene scene) : scenes_{std::move(scene)} {}
    virtual ~Source() = default;
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;

    [[nodiscard]] const std::vector<Scene>& scenes() const { return scenes_; }
    /// Returns the mesh of a part. The part's mesh number is ignored.
    virtual Mesh mesh(std::size_t scene, std::size_t part) {
        return scenes_[scene].meshes.at(scenes_[scene].parts[part].mesh);
    }

protected:
    explicit Source(std::vector<Scene> scenes) : scenes_(std::move(scenes)) {}

private:
    std::vector<Scene> scenes_;
};

/// The parts of a store. Meshes are read when they are needed.
class PartModels::StoreSource : public Source {
public:
    StoreSource(const Store& store, UpAxis up) : Source(scenes_of(store, up)), store_(store) {
        StoreFile& file = store_.file();
        for (const ModelRow& model : file.models()) {
            meshes_.emplace_back();
            file.for_each_part(model,
                               [&](const PartRow& part) { meshes_.back().push_back(part.mesh); });
        }
    }
    Mesh mesh(std::size_t scene, std::size_t part) override {
        return store_.file().read_mesh(meshes_.at(scene).at(part));
    }

private:
    static std::vector<Scene> scenes_of(const Store& store, UpAxis up) {
        std::vector<Scene> scenes;
        const std::size_t count = store.file().models().size();
        for (std::size_t i = 0; i < count; ++i) {
            scenes.push_back(read_parts(store, i));
            turn_up(scenes.back(), up);
        }
        return scenes;
    }

    Store store_;
    std::vector<std::vector<std::int64_t>> meshes_; ///< of each model's parts
};

PartModels::PartModels(ReadOptions options, UpAxis up) : options_(std::move(options)), up_(up) {}

PartModels::~PartModels() = default;

PartModels::Source& PartModels::source(const ModelPath& path) {
    const std::string key =
        path.path + ":" + std::to_string(path.unit) + (path.up ? to_string(*path.up) : "");
    std::unique_ptr<Source>& source = sources_[key];
    if (source)
        return *source;
    if (is_store(path.path)) {
        source = std::make_unique<StoreSource>(open_store(path.path), up_);
    } else {
        Scene scene = read_scene(path, options_);
        turn_up(scene, up_);
        source = std::make_unique<Source>(std::move(scene));
    }
    return *source;
}

std::vector<PartModels::Selected> PartModels::select(const ModelPath& path, const PartQuery& query,
                                                     bool each) {
    Source& from = source(path);
    std::vector<Selected> found;
    Scene joined;
    joined.file = path.path;
    for (std::size_t s = 0; s < from.scenes().size(); ++s) {
        const Scene& scene = from.scenes()[s];
        for (std::uint32_t p = 0; p < scene.parts.size(); ++p) {
            if (!query.matches(scene, p))
                continue;
            Part part = scene.parts[p];
            part.mesh = static_cast<std::uint32_t>(joined.meshes.size());
            joined.meshes.push_back(from.mesh(s, p));
            joined.parts.push_back(part);
            if (each) {
                found.push_back({part.id, to_mesh(joined)});
                joined.meshes.clear();
                joined.parts.clear();
            }
        }
    }
    if (!each && !joined.parts.empty())
        found.push_back({{}, to_mesh(joined)});
    return found;
}

ModelPath model_beside(const std::string& text, const std::string& file, bool allow_outside) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::absolute(file).parent_path();
    ModelPath model = parse_model_path((folder / text).string());
    std::error_code failure;
    const fs::path real = fs::canonical(model.path, failure);
    if (failure)
        throw Error(ErrorCode::file_not_found, "the model '" + text + "' does not exist");
    const fs::path relative = real.lexically_relative(fs::canonical(folder, failure));
    if (!allow_outside && (relative.empty() || *relative.begin() == ".."))
        throw Error(ErrorCode::unreadable,
                    "the model '" + text +
                        "' is outside of the file's folder (see --allow-outside-files)");
    return model;
}

} // namespace abut
