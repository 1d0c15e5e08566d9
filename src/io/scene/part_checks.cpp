#include "io/scene/part_checks.h"

#include <abut/error.h>

#include "math/predicates.h"
#include "math/transform.h"
#include "mesh/topology.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

namespace abut {

bool stays_finite(const Transform& transform) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    for (std::size_t row = 0; row < 3; ++row) {
        double reach = std::fabs(transform.m[row + 9]);
        for (std::size_t column = 0; column < 3; ++column)
            reach += std::fabs(transform.m[3 * column + row]) * kLargest;
        if (!std::isfinite(reach))
            return false;
    }
    return true;
}

bool has_area(const Mesh& mesh, const Transform& world_from_mesh) {
    const auto world = [&](std::uint32_t vertex) {
        return apply(world_from_mesh, mesh.positions[vertex]);
    };
    return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
        return !collinear(world(t[0]), world(t[1]), world(t[2]));
    });
}

const char* coordinate_fault(const Vec3& p) {
    constexpr double kLargestFloat = std::numeric_limits<float>::max();
    const double largest = std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    // Comparisons with NaN are false, and max may drop a NaN.
    if (largest <= kLargestCoordinate && !std::isnan(p.x + p.y + p.z))
        return nullptr;
    return largest <= kLargestFloat && !std::isnan(p.x + p.y + p.z)
               ? " has a coordinate beyond 1e18"
               : " has a coordinate that is not a finite number";
}

void make_ids_unique(std::vector<Part>& parts) {
    std::unordered_set<std::string> given;
    for (const Part& part : parts)
        given.insert(part.id);
    std::unordered_set<std::string> used;
    std::unordered_map<std::string, std::uint64_t> repeats;
    for (Part& part : parts) {
        if (!used.insert(part.id).second) {
            std::uint64_t& repeat = repeats.try_emplace(part.id, 1).first->second;
            std::string id;
            do
                id = part.id + "#" + std::to_string(++repeat);
            while (given.contains(id) || !used.insert(id).second);
            part.id = std::move(id);
        }
        if (part.name.empty())
            part.name = part.id;
    }
}

void find_bad_coordinate(const Mesh& mesh, std::uint64_t number, MeshFaults& faults) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        if (const char* const fault = coordinate_fault(mesh.positions[i])) {
            faults.emplace(number, "vertex " + std::to_string(i) + fault);
            return;
        }
}

void check_scene(const Scene& scene, const MeshFaults& faults) {
    bool any_triangle = false;
    for (const Part& part : scene.parts) {
        const auto fault = faults.find(part.mesh);
        if (fault != faults.end())
            throw Error(ErrorCode::bad_mesh, scene.file, "part " + part.id + ": " + fault->second);
        any_triangle = any_triangle || !scene.meshes[part.mesh].triangles.empty();
        if (!stays_finite(part.world_from_mesh))
            throw Error(ErrorCode::bad_mesh, scene.file,
                        "part " + part.id + ": its transform is not finite or too large");
    }
    if (!any_triangle)
        throw Error(ErrorCode::bad_mesh, scene.file, "holds no triangles");
    // In most files the first triangle has an area.
    const bool any_area =
        std::any_of(scene.parts.begin(), scene.parts.end(), [&](const Part& part) {
            return has_area(scene.meshes[part.mesh], part.world_from_mesh);
        });
    if (!any_area)
        throw Error(ErrorCode::bad_mesh, scene.file, "holds only degenerate triangles");
}

} // namespace abut
