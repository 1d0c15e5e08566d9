#include "io/part_checks.h"

#include "math/predicates.h"
#include "math/transform.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

} // namespace abut
