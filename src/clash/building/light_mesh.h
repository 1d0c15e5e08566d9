#pragma once

#include <abut/mesh.h>
#include <abut/types.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace abut {

/// A mesh of a page: vertices on a grid, in the order in which the triangles first use them.
///
///     position = lower + step * vertex
struct LightMesh {
    std::vector<std::array<std::uint32_t, 3>> vertices;
    std::vector<std::uint32_t> indices; ///< three for each triangle
    Vec3 lower;
    double step = 1;
};

/// How much a mesh may be simplified. Lengths are in the mesh's unit.
struct LightMeshTerms {
    double step = 0;  ///< distance of the grid's points
    double error = 0; ///< the simplified surface is about this near to the mesh; 0: as it is
    double share = 1; ///< of the triangles that may remain; prevails over `error`
};

/// Builds a light mesh piece by piece.
class LightMeshBuilder {
public:
    /// In          lower: the origin of the grid.
    LightMeshBuilder(const Vec3& lower, const LightMeshTerms& terms);
    /// Adds a piece of the mesh.
    void add(const Mesh& piece);
    LightMesh take() { return std::move(result_); }

private:
    LightMesh result_;
    LightMeshTerms terms_;
};

} // namespace abut
