#include "deform/rest/near_rules.h"

#include <abut/error.h>

#include <cmath>
#include <string>

namespace abut {

void require_valid_near(double distance, bool is_one_surface, const NearVertices& vertices_b) {
    if (!(distance >= 0 && std::isfinite(distance)))
        throw Error(ErrorCode::bad_argument, "the distance must be a finite number of at least 0");
    if (is_one_surface && !(vertices_b.thickness.empty() && vertices_b.groups.empty() &&
                            vertices_b.masks.empty() && vertices_b.moved.empty()))
        throw Error(ErrorCode::bad_argument, "one surface has no vertices_b");
}

void require_valid_vertices(const NearVertices& vertices, const DeformableData& surface) {
    const auto check = [&](const char* name, std::size_t size) {
        if (size != 0 && size != surface.vertices.size())
            throw Error(ErrorCode::bad_argument,
                        std::string(name) + ": " + std::to_string(size) + " entries for " +
                            std::to_string(surface.vertices.size()) + " vertices");
    };
    check("thickness", vertices.thickness.size());
    check("groups", vertices.groups.size());
    check("masks", vertices.masks.size());
    check("moved", vertices.moved.size());
    for (const double each : vertices.thickness)
        if (!(each >= 0 && std::isfinite(each)))
            throw Error(ErrorCode::bad_argument,
                        "a thickness must be a finite number of at least 0");
}

} // namespace abut
