#include "convex/normal_table.h"

#include "convex/polytope.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace abut {

namespace {

/// A face of the cube [-1, 1]^3: its axis, twice, and one more if it is the negative one.
std::uint32_t face_of(const std::array<double, 3>& d, std::size_t& axis) {
    const double x = std::abs(d[0]), y = std::abs(d[1]), z = std::abs(d[2]);
    axis = x >= y ? (x >= z ? 0 : 2) : (y >= z ? 1 : 2);
    return static_cast<std::uint32_t>(2 * axis + (d[axis] < 0 ? 1 : 0));
}

} // namespace

NormalTable::NormalTable(const Polytope& polytope, std::uint32_t resolution)
    : resolution_(resolution) {
    vertices_.reserve(std::size_t{6} * resolution * resolution);
    const auto middle = [&](std::uint32_t i) { return (2 * i + 1.0) / resolution - 1; };
    std::uint32_t last = 0;
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

std::uint32_t NormalTable::vertex(const Vec3& direction) const {
    const std::array<double, 3> d{direction.x, direction.y, direction.z};
    std::size_t axis = 0;
    const std::uint32_t face = face_of(d, axis);
    const double size = std::abs(d[axis]);
    if (!(size > 0) || vertices_.empty())
        return 0;
    const double half = 0.5 * resolution_, scale = half / size;
    const auto cell = [&](double v) {
        return std::min(static_cast<std::uint32_t>(v * scale + half), resolution_ - 1);
    };
    const std::uint32_t i = cell(d[(axis + 1) % 3]), j = cell(d[(axis + 2) % 3]);
    return vertices_[(face * resolution_ + i) * resolution_ + j];
}

} // namespace abut
