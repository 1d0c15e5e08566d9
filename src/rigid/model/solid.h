#pragma once

#include <abut/mesh.h>

#include "math/vector.h"
#include "mesh/topology.h"

#include <cstddef>
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

/// Half of the solid angle under which a triangle is seen, positive from behind it (from where its
/// corners go round clockwise).
///
/// Source      [Van Oosterom, Strackee 1983].
double half_solid_angle(const Triangle& t, const Vec3& point);

/// Signed number of times that the mesh winds around a point: the sum of the solid angles over 4
/// pi.
///
/// Accuracy    to rounding for points off the surface.
double winding_number(const Mesh& mesh, const Vec3& point);

double doubled_area_sq(const Triangle& t);

/// Points just over and just under a triangle, as its normal points.
struct FaceProbe {
    Vec3 over, under;
};
FaceProbe face_probe(const Triangle& t);
/// Of so many triangles, the largest, winding numbers tell whether a mesh bounds a solid.
inline constexpr std::size_t kProbes = 6;

/// +1 or -1 if a mesh winds once around the points just under (over) its largest triangles and not
/// around those on the other side; else 0.
class OutwardVote {
public:
    [[nodiscard]] bool failed() const { return failed_; }
    /// What the winding number over a triangle says, if that under it agrees.
    static int side(double over);
    /// Winding numbers over and under one more triangle.
    void add(double over, double under);
    [[nodiscard]] int outward() const { return failed_ ? 0 : outward_; }

private:
    int outward_ = 0;
    bool failed_ = false;
};

/// What a winding number may differ from an integer by, and still be that integer: stored
/// coordinates are floats, so an edge that should coincide with two others (a T-junction) misses
/// them by one part in 2^24.
inline constexpr double kWindingRounding = 0x1p-20;

} // namespace abut
