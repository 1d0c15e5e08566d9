#pragma once

#include <abut/mesh.h>

#include "mesh/topology.h"

#include <cstdint>
#include <mutex>
#include <vector>

namespace abut {

/// Whether a mesh bounds a solid, and how its triangles are turned.
struct Solid {
    Topology topology;
    std::vector<std::uint32_t> components; ///< a triangle of each connected component
    bool closed = false;                   ///< every edge is used by exactly two triangles
    /// Closed, or with winding number 0 or 1 to rounding around its largest triangles in spite of
    /// T-junctions.
    bool solid = false;
    /// +1: normals point out; -1: they point in; 0: neither everywhere.
    int outward = 0;
};

/// In          a valid mesh.
/// Cost        O(n log n), plus a few winding numbers where the mesh is not closed.
Solid examine_solid(const Mesh& mesh);

/// At least the bytes of the solid of a mesh so large.
constexpr std::uint64_t most_solid_bytes(std::uint64_t triangles, std::uint64_t vertices) {
    return 128 * triangles + 8 * vertices;
}

/// The solid of one mesh, examined when it is first asked for. Any number of threads may ask.
class LazySolid {
public:
    [[nodiscard]] const Solid& of(const Mesh& mesh) const {
        std::call_once(once_, [&] { solid_ = examine_solid(mesh); });
        return solid_;
    }

private:
    mutable std::once_flag once_;
    mutable Solid solid_;
};

/// Signed number of times that the mesh winds around a point: the sum of the solid angles over 4
/// pi.
///
/// Accuracy    to rounding for points off the surface.
/// Source      [Van Oosterom, Strackee 1983].
double winding_number(const Mesh& mesh, const Vec3& point);

/// What a winding number may differ from an integer by, and still be that integer: stored
/// coordinates are floats, so an edge that should coincide with two others (a T-junction) misses
/// them by one part in 2^24.
inline constexpr double kWindingRounding = 0x1p-20;

} // namespace abut
