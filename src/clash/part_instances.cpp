#include "clash/part_instances.h"

#include <abut/error.h>

#include "clash/rules/pair_precision.h"
#include "core/parallel.h"
#include "io/scene/model_frame.h"
#include "math/transform.h"
#include "mesh/topology.h"
#include "mesh/used_positions.h"

namespace abut {

PartInstances gather_parts(const std::vector<Scene>& models) {
    PartInstances result;
    std::vector<std::uint32_t> model_of_mesh;
    for (std::uint32_t m = 0; m < models.size(); ++m) {
        const auto first = static_cast<std::uint32_t>(result.meshes.size());
        for (const Mesh& mesh : models[m].meshes) {
            result.meshes.push_back(&mesh);
            model_of_mesh.push_back(m);
        }
        for (std::uint32_t p = 0; p < models[m].parts.size(); ++p) {
            const Part& part = models[m].parts[p];
            if (part.mesh >= models[m].meshes.size())
                throw Error(ErrorCode::bad_mesh, models[m].file,
                            "part " + part.id + " has no mesh");
            result.parts.push_back({m,
                                    p,
                                    first + part.mesh,
                                    turned(part.world_from_mesh, models[m].up, models.front().up),
                                    {},
                                    0});
        }
    }
    std::vector<std::vector<std::uint32_t>> parts_of_mesh(result.meshes.size());
    for (std::uint32_t i = 0; i < result.parts.size(); ++i)
        parts_of_mesh[result.parts[i].mesh].push_back(i);
    parallel_for(result.meshes.size(), 16, [&](std::size_t k) {
        const std::string& file = models[model_of_mesh[k]].file;
        try {
            require_valid(*result.meshes[k]);
            const UsedPositions used(*result.meshes[k]);
            const Vec3 reach = reach_of(world_box(used.get(), {}));
            const ModelPrecision& precision = models[model_of_mesh[k]].precision;
            for (const std::uint32_t i : parts_of_mesh[k]) {
                PartInstance& part = result.parts[i];
                require_finite(part.world_from_mesh, "a part's transform");
                part.box = world_box(used.get(), part.world_from_mesh);
                part.rounding = single_rounding(precision, reach, part.world_from_mesh);
            }
        } catch (const Error& error) {
            throw Error(ErrorCode::bad_mesh, file, error.what());
        }
    });
    return result;
}

} // namespace abut
