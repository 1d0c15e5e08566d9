#include "clash/surface_parts.h"

#include "core/parallel.h"
#include "rigid/model/solid.h"

#include <cstdint>

namespace abut {

ClashReport::Surfaces surface_parts(const std::vector<Scene>& models, const PartInstances& parts) {
    std::vector<std::uint8_t> is_surface(parts.meshes.size());
    parallel_for(is_surface.size(), 1, [&](std::size_t i) {
        const Mesh& mesh = *parts.meshes[i];
        is_surface[i] = !mesh.triangles.empty() && !bounds_solid(mesh) ? 1 : 0;
    });
    ClashReport::Surfaces result;
    for (const PartInstance& instance : parts.parts) {
        if (is_surface[instance.mesh] == 0 || result.count++ >= kNamedSurfaces)
            continue;
        const Part& part = models[instance.model].parts[instance.part];
        result.first.push_back({instance.model, part.id, part.name, part.type});
    }
    return result;
}

} // namespace abut
