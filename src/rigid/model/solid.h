#pragma once

#include <abut/mesh.h>

#include "math/vector.h"
#include "mesh/topology.h"

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace abut {

/// Whether a mesh bounds a solid, and how its triangles are oriented.
struct Solid {
    Topology topology;
    std::vector<std::uint32_t> components; ///< a triangle of each connected component
    bool closed = false;                   ///< every edge is used by exactly two triangles
    /// True if the mesh is closed; or if, in spite of T-junctions, the winding number around its
    /// largest triangles is 0 or 1 to rounding.
    bool solid = false;
    /// +1: normals point out; -1: they point in; 0: mixed or unknown.
    int outward = 0;
};

/// In          a valid mesh.
/// Cost        O(n log n), plus a few winding numbers where the mesh is not closed.
Solid examine_solid(const Mesh& mesh);

/// Upper bound on the bytes of a Solid for this many triangles and vertices.
constexpr std::uint64_t most_solid_bytes(std::uint64_t triangles, std::uint64_t vertices) {
    return 128 * triangles + 8 * vertices;
}

/// The solid of one mesh, examined on first use. Safe for concurrent use.
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

/// Half the solid angle that a triangle subtends at a point. Positive if the point lies behind the
/// triangle, where its corners appear clockwise.
///
/// Source      [Van Oosterom, Strackee 1983].
double half_solid_angle(const Triangle& t, const Vec3& point);

/// How many times the mesh winds around a point, with sign: the sum of the solid angles over 4 pi.
///
/// Accuracy    to rounding for points off the surface.
double winding_number(const Mesh& mesh, const Vec3& point);

double doubled_area_sq(const Triangle& t);

/// Points just over and just under a triangle, where its normal points up.
struct FaceProbe {
    Vec3 over, under;
};
FaceProbe face_probe(const Triangle& t);
/// How many of the largest triangles are probed by winding number to decide whether an open mesh
/// bounds a solid.
inline constexpr std::size_t kProbes = 6;

/// Decides how a mesh is oriented by winding numbers beside its largest triangles. +1 (-1): the
/// mesh winds once around the points under (over) them, and not around those on the other side. 0:
/// neither.
class OutwardVote {
public:
    [[nodiscard]] bool failed() const { return failed_; }
    /// The vote of the winding number over a triangle, if that under it agrees.
    static int side(double over);
    /// Adds the winding numbers over and under one more triangle.
    void add(double over, double under);
    [[nodiscard]] int outward() const { return failed_ ? 0 : outward_; }

private:
    int outward_ = 0;
    bool failed_ = false;
};

/// Largest difference of a winding number from an integer that counts as that integer. Stored
/// coordinates may come from floats: an edge that should coincide with two others (a T-junction)
/// misses them by one part in 2^24.
inline constexpr double kWindingRounding = 0x1p-20;

} // namespace abut
