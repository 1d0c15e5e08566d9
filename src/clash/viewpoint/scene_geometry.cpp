#include <abut/error.h>

#include "clash/viewpoint/mesh_runs.h"
#include "clash/viewpoint/view_geometry.h"
#include "core/arguments.h"
#include "core/parallel.h"
#include "math/transform.h"
#include "mesh/used_positions.h"

#include <mutex>

namespace abut {

namespace {

/// Models in memory. The runs of a mesh are found when a viewpoint needs them.
class SceneGeometry : public ViewGeometry {
public:
    explicit SceneGeometry(const std::vector<Scene>& models) : models_(models) {
        if (!models.empty())
            up = models.front().up;
        for (const Scene& scene : models) {
            first_part_.push_back(static_cast<std::uint32_t>(placed_.size()));
            Scene turned{scene.file, {}, scene.parts, scene.unit, scene.up};
            turn_up(turned, up);
            for (const Part& part : turned.parts)
                placed_.push_back({&scene, meshes_ + part.mesh, part.world_from_mesh});
            meshes_ += scene.meshes.size();
        }
        runs_ = std::vector<Runs>(meshes_);
        boxes.resize(placed_.size());
        parallel_for(placed_.size(), 16, [&](std::size_t i) {
            const Placed& part = placed_[i];
            boxes[i] = world_box(UsedPositions(mesh_of(i)).get(), part.world_from_mesh);
        });
    }

    void gather(std::uint32_t part, const Box3& box,
                std::vector<Triangle>& triangles) const override {
        const Placed& placed = placed_[part];
        const Mesh& mesh = mesh_of(part);
        Runs& runs = runs_[placed.mesh];
        std::call_once(runs.once, [&] { runs.runs = std::make_unique<MeshRuns>(mesh); });
        runs.runs->gather(mesh, placed.world_from_mesh, box, triangles);
    }
    [[nodiscard]] NamedPart name(std::uint32_t part) const override {
        const Scene& scene = *placed_[part].scene;
        return {scene.file, part_of(part).id};
    }
    [[nodiscard]] std::uint32_t number(const ReportPart& part) const override {
        require(part.model < models_.size() && part.part < models_[part.model].parts.size(),
                "a clash of the report refers to a part that the models lack");
        return first_part_[part.model] + part.part;
    }

private:
    struct Placed {
        const Scene* scene;
        std::size_t mesh; ///< number of the mesh among all
        Transform world_from_mesh;
    };
    struct Runs {
        std::once_flag once;
        std::unique_ptr<MeshRuns> runs;
    };

    [[nodiscard]] const Part& part_of(std::size_t part) const {
        const Scene& scene = *placed_[part].scene;
        const auto model = static_cast<std::size_t>(&scene - models_.data());
        return scene.parts[part - first_part_[model]];
    }
    [[nodiscard]] const Mesh& mesh_of(std::size_t part) const {
        return placed_[part].scene->meshes[part_of(part).mesh];
    }

    const std::vector<Scene>& models_;
    std::vector<std::uint32_t> first_part_; ///< by model
    std::vector<Placed> placed_;
    std::size_t meshes_ = 0;
    mutable std::vector<Runs> runs_;
};

} // namespace

std::unique_ptr<ViewGeometry> view_geometry(const std::vector<Scene>& models) {
    return std::make_unique<SceneGeometry>(models);
}

} // namespace abut
