#include "convex/hull/normal_table.h"

#include "convex/hull/climb.h"
#include "convex/hull/polytope.h"

#include <algorithm>
#include <cmath>

namespace abut {

NormalTable::NormalTable(const Polytope& polytope, std::uint32_t resolution)
    : resolution_(resolution), half_(0.5 * resolution) {
    vertices_.reserve(std::size_t{resolution} * resolution);
    const auto middle = [&](std::uint32_t i) { return (2 * i + 1.0) / resolution - 1; };
    std::uint32_t last = 0;
    for (std::uint32_t i = 0; i < resolution; ++i)
        for (std::uint32_t j = 0; j < resolution; ++j) {
            double u = middle(i), v = middle(j);
            const double z = 1 - std::abs(u) - std::abs(v);
            fold_octahedron(u, v, std::min(z, 0.0));
            last = climb(polytope, {u, v, z}, last);
            vertices_.push_back(last);
        }
}

} // namespace abut
