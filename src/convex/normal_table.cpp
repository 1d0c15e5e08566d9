#include "convex/normal_table.h"

#include "convex/polytope.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace abut {

NormalTable::NormalTable(const Polytope& polytope, std::uint32_t resolution)
    : resolution_(resolution) {
    vertices_.reserve(std::size_t{6} * resolution * resolution);
    const auto middle = [&](std::uint32_t i) { return (2 * i + 1.0) / resolution - 1; };
    std::uint32_t last = 0;
    // Two faces an axis, the positive one first.
    for (std::uint32_t face = 0; face < 6; ++face)
        for (std::uint32_t i = 0; i < resolution; ++i)
            for (std::uint32_t j = 0; j < resolution; ++j) {
                std::array<double, 3> d{};
                const std::size_t axis = face / 2;
                d[axis] = face % 2 == 0 ? 1 : -1;
                d[(axis + 1) % 3] = middle(i);
                d[(axis + 2) % 3] = middle(j);
                last = climb(polytope, {d[0], d[1], d[2]}, last);
                vertices_.push_back(last);
            }
}

std::uint32_t NormalTable::vertex(const Vec3& d) const {
    const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    if (vertices_.empty())
        return 0;
    if (x >= y && x >= z)
        return vertices_[cell(0, d.x, d.y, d.z)];
    if (y >= z)
        return vertices_[cell(1, d.y, d.z, d.x)];
    return vertices_[cell(2, d.z, d.x, d.y)];
}

/// `along`: the component by the axis, the largest; u and v: those by the two that follow it.
std::size_t NormalTable::cell(std::uint32_t axis, double along, double u, double v) const {
    const double half = 0.5 * resolution_, size = std::abs(along);
    const double scale = size > 0 ? half / size : 0;
    const auto index = [&](double w) {
        return std::min(static_cast<std::uint32_t>(w * scale + half), resolution_ - 1);
    };
    const std::uint32_t face = 2 * axis + (along < 0 ? 1 : 0);
    return (face * resolution_ + index(u)) * resolution_ + index(v);
}

} // namespace abut
