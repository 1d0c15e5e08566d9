#pragma once

#include "math/vector.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace abut {

struct Polytope;

/// Moves a point of the square away from its centre along both axes. With `by` the depth below the
/// octahedron's equator it folds the lower half out; with the negative depth it folds it back.
inline void fold_octahedron(double& u, double& v, double by) {
    u += by * std::copysign(1.0, u);
    v += by * std::copysign(1.0, v);
}

/// A grid over all directions that holds for each cell the vertex farthest along the cell's middle
/// direction: where a climb begins.
///
/// The sphere is projected on the octahedron |x| + |y| + |z| = 1. Its lower half is folded out
/// around the upper one, so that both fill the square [-1, 1]^2.
///
/// Source      [Ehmann, Lin 2000] (SWIFT); the grid is that of [Meyer et al. 2010]'s unit vectors.
class NormalTable {
public:
    NormalTable() = default;
    /// A table of resolution^2 cells.
    NormalTable(const Polytope& polytope, std::uint32_t resolution);

    /// In          a direction of any length, zero included. An empty table returns 0.
    [[nodiscard]] std::uint32_t vertex(const Vec3& direction) const;
    /// One vertex for each cell, in the order of the cells.
    [[nodiscard]] const std::vector<std::uint32_t>& vertices() const { return vertices_; }

private:
    std::uint32_t resolution_ = 1;
    double half_ = 0.5; ///< half of the resolution
    std::vector<std::uint32_t> vertices_;
};

inline std::uint32_t NormalTable::vertex(const Vec3& d) const {
    const double size = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    if (!(size > 0) || vertices_.empty())
        return 0;
    const double share = 1 / size;
    double u = share * d.x, v = share * d.y;
    // `by` is max(-z, 0), without a branch: which half it is cannot be predicted.
    fold_octahedron(u, v, 0.5 * share * (std::abs(d.z) - d.z));
    const auto cell = [&](double w) {
        return std::min(static_cast<std::uint32_t>(w * half_ + half_), resolution_ - 1);
    };
    return vertices_[cell(u) * resolution_ + cell(v)];
}

} // namespace abut
