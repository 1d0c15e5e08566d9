#include "io/scene/scene_source.h"

#include <abut/error.h>

#include "io/file/fault.h"
#include "io/file/file_kind.h"
#include "io/file/input_file.h"
#include "io/file/read_watch.h"

#include <atomic>

namespace abut {

namespace {

/// A scene that is completely in memory.
class WholeScene : public SceneSource {
public:
    WholeScene(Scene scene, const SourceOptions& options)
        : SceneSource(ModelFrame{scene.unit, scene.up}, options), meshes_(std::move(scene.meshes)) {
        for (Part& part : scene.parts)
            append(std::move(part));
        finish();
        notes_ = std::move(scene.notes);
        properties_ = std::move(scene.properties);
        facts_ = {std::move(scene.relations), std::move(scene.project), scene.map_from_project,
                  scene.precision};
    }
    [[nodiscard]] std::uint32_t meshes() const override {
        return static_cast<std::uint32_t>(meshes_.size());
    }
    [[nodiscard]] Size size(std::uint32_t mesh) const override {
        return {meshes_[mesh].positions.size(), meshes_[mesh].triangles.size()};
    }
    void read(std::uint32_t mesh, MeshSink& sink) const override {
        sink.vertices(meshes_[mesh].positions);
        sink.triangles(meshes_[mesh].triangles);
    }
    [[nodiscard]] bool streams() const override { return false; }

protected:
    [[nodiscard]] const Properties* property_table() const override { return &properties_; }

private:
    std::vector<Mesh> meshes_;
    Properties properties_;
};

} // namespace

std::vector<PartProperty> SceneSource::PropertyCursor::of(std::uint64_t part) {
    if (table_ == nullptr)
        return spool_.properties(part);
    std::vector<PartProperty> properties;
    for (const auto& [name, value] : table_->of(static_cast<std::uint32_t>(part)))
        properties.push_back({table_->names[name], table_->values[value]});
    return properties;
}

std::unique_ptr<SceneSource> open_own_source(const ModelPath& path, const SourceOptions& options) {
    const std::string extension = lower_extension(path.path);
    if (extension == ".glb" || extension == ".gltf")
        return open_glb_source(path, options);
    if (extension == ".obj")
        return open_obj_source(path, options);
    if (extension == ".ply")
        return open_ply_source(path, options);
    if (extension == ".stl")
        return open_stl_source(path, options);
    return nullptr;
}

std::unique_ptr<SceneSource> open_scene_source(const ModelPath& path,
                                               const SourceOptions& options) {
    try {
        check_file_kind(path.path, lower_extension(path.path));
        SourceOptions watched = options;
        const std::atomic<bool>* const stop = options.read.progress.stop;
        watched.watch =
            std::make_shared<const ReadWatch>(path.path, ReadOptions{.time_limit = 0},
                                              [stop] { return stop != nullptr && stop->load(); });
        if (auto source = open_own_source(path, watched))
            return source;
    } catch (const Fault& fault) {
        throw Error(fault.code(), path.path, fault.what());
    }
    return std::make_unique<WholeScene>(read_scene(path, options.read), options);
}

} // namespace abut
