#pragma once

#include "math/vector.h"

#include <cstdint>
#include <vector>

namespace abut {

struct Polytope;

/// For each cell of a grid over all directions the vertex that is farthest along the cell's middle:
/// where to begin to climb.
///
/// The sphere is projected on the octahedron |x| + |y| + |z| = 1, whose lower half is folded out
/// around the upper one, so that both fill the square [-1, 1]^2.
///
/// Source      [Ehmann, Lin 2000] (SWIFT); the grid is that of [Meyer et al. 2010]'s unit vectors.
class NormalTable {
public:
    NormalTable() = default;
    /// Of resolution^2 cells.
    NormalTable(const Polytope& polytope, std::uint32_t resolution);

    /// In          any direction; of any length, zero included. A table without cells says 0.
    [[nodiscard]] std::uint32_t vertex(const Vec3& direction) const;
    /// One vertex a cell, in the order of the cells.
    [[nodiscard]] const std::vector<std::uint32_t>& vertices() const { return vertices_; }

private:
    std::uint32_t resolution_ = 1;
    double half_ = 0.5; ///< of the resolution
    std::vector<std::uint32_t> vertices_;
};

} // namespace abut
