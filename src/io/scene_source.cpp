#include "io/scene_source.h"

#include <abut/error.h>

#include "io/fault.h"
#include "io/input_file.h"

namespace abut {

namespace {

/// A scene in memory.
class WholeScene : public SceneSource {
public:
    WholeScene(Scene scene, const std::string& folder)
        : SceneSource(folder), meshes_(std::move(scene.meshes)) {
        for (const Part& part : scene.parts)
            parts_.append(part);
        parts_.finish();
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

private:
    std::vector<Mesh> meshes_;
};

} // namespace

std::unique_ptr<SceneSource> open_scene_source(const std::string& path,
                                               const SourceOptions& options) {
    try {
        (void)readable_size(path);
        const std::string extension = lower_extension(path);
        std::unique_ptr<SceneSource> source;
        if (extension == ".glb")
            source = open_glb_source(path, options);
        else if (extension == ".obj")
            source = open_obj_source(path, options);
        else if (extension == ".ply")
            source = open_ply_source(path, options);
        else if (extension == ".stl")
            source = open_stl_source(path, options);
        if (source != nullptr)
            return source;
    } catch (const Fault& fault) {
        throw Error(fault.code(), path, fault.what());
    }
    return std::make_unique<WholeScene>(
        read_scene(path, {.unit = options.unit, .progress = options.progress}), options.folder);
}

} // namespace abut
