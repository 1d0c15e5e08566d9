#include "convex/normal_table.h"

#include "convex/climb.h"
#include "convex/polytope.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// Moves a point of the square away from its middle, along both axes: by the depth below the
/// octahedron's equator, that folds its lower half out; by minus that, back.
void fold(double& u, double& v, double by) {
    u += by * std::copysign(1.0, u);
    v += by * std::copysign(1.0, v);
}

} // namespace

NormalTable::NormalTable(const Polytope& polytope, std::uint32_t resolution)
    : resolution_(resolution), half_(0.5 * resolution) {
    vertices_.reserve(std::size_t{resolution} * resolution);
    const auto middle = [&](std::uint32_t i) { return (2 * i + 1.0) / resolution - 1; };
    std::uint32_t last = 0;
    for (std::uint32_t i = 0; i < resolution; ++i)
        for (std::uint32_t j = 0; j < resolution; ++j) {
            double u = middle(i), v = middle(j);
            const double z = 1 - std::abs(u) - std::abs(v);
            fold(u, v, std::min(z, 0.0));
            last = climb(polytope, {u, v, z}, last);
            vertices_.push_back(last);
        }
}

std::uint32_t NormalTable::vertex(const Vec3& d) const {
    const double size = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    if (!(size > 0) || vertices_.empty())
        return 0;
    const double share = 1 / size;
    double u = share * d.x, v = share * d.y;
    // The larger of -z and 0: a branch on which half it is would be a coin's.
    fold(u, v, 0.5 * share * (std::abs(d.z) - d.z));
    const auto cell = [&](double w) {
        return std::min(static_cast<std::uint32_t>(w * half_ + half_), resolution_ - 1);
    };
    return vertices_[cell(u) * resolution_ + cell(v)];
}

} // namespace abut
