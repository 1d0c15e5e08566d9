#pragma once

#include <abut/mesh.h>

#include "math/vector.h"
#include "mesh/topology.h"

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

namespace abut {

/// Whether a mesh bounds a solid, and how its triangles are oriented.
///
/// A point off the surface is inside if the triangles, each oriented as `weights` says, wind around
/// it at least once; if `has_parity_only`, if a ray from it crosses them an odd number of times.
/// shells.h says why, and clean_surface.h which triangles have no weight.
struct Solid {
    Topology topology;
    std::vector<std::uint32_t> components; ///< a triangle of each connected component
    /// The triangles that have a weight have no border, and there is at least one.
    bool closed = false;
    /// True if the mesh is closed; or if, in spite of T-junctions, the winding number around its
    /// largest triangles is an integer to rounding.
    bool solid = false;
    /// +1: the normals of all triangles that have a weight point out; -1: they point in; 0: mixed
    /// or unknown.
    int outward = 0;
    /// By triangle: +1 if its normal points out of the solid, -1 if it points in, 0 if it bounds
    /// nothing. Empty: `outward` is the weight of all triangles.
    std::vector<std::int8_t> weights;
    /// Only the parity of crossings tells the inside; `weights` is 0 or 1, or empty.
    bool has_parity_only = false;
    /// Two shells may have a common part, so that faces of one may lie inside the solid.
    bool may_overlap = false;
    bool has_sheets = false;           ///< as CleanSurface
    std::vector<std::uint32_t> copies; ///< dropped duplicates of triangles that are left
    /// The triangles of components that are open and bound nothing; empty if none has a weight.
    std::vector<std::uint32_t> open;

    /// The weight of a triangle.
    [[nodiscard]] int weight(std::uint32_t triangle) const {
        return weights.empty() ? outward : weights[triangle];
    }
    /// Whether every triangle has a side that faces out of the solid, or bounds nothing.
    [[nodiscard]] bool is_oriented() const {
        return solid && !has_parity_only && (outward != 0 || !weights.empty());
    }
};

/// In          a valid mesh.
/// Cost        O(n log n): about a quarter of a microsecond a triangle. Plus a few winding numbers where
///             the mesh is not closed.
Solid examine_solid(const Mesh& mesh);

/// Returns examine_solid(mesh).solid, without the rest: fast where triangles are joined by index and
/// leave no border.
///
/// In          a valid mesh.
/// Accuracy    as examine_solid, but for a chance of 2^-64: a sum of hashes over all edges, which is
///             0 for a surface without a border, may be 0 for another one.
/// Cost        O(n) if the sum is 0; else that of examine_solid.
bool bounds_solid(const Mesh& mesh);

/// Upper bound on the bytes of a Solid for this many triangles and vertices.
constexpr std::uint64_t most_solid_bytes(std::uint64_t triangles, std::uint64_t vertices) {
    return 128 * triangles + 8 * vertices;
}
/// Upper bound on the bytes that examine_solid needs besides its result and the mesh.
constexpr std::uint64_t most_examination_bytes(std::uint64_t triangles) {
    return 160 * triangles;
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
/// As above, for some of the triangles.
double winding_number(const Mesh& mesh, std::span<const std::uint32_t> triangles,
                      const Vec3& point);
/// How many times the boundary of a solid winds around a point, each triangle taken by its weight.
///
/// In          solid: that of the mesh, and oriented.
double winding_number(const Mesh& mesh, const Solid& solid, const Vec3& point);

double doubled_area_sq(const Triangle& t);

/// Points just over and just under a triangle, where its normal points up.
struct FaceProbe {
    Vec3 over, under;
};
FaceProbe face_probe(const Triangle& t);
/// How many of the largest triangles are probed by winding number to decide whether an open mesh
/// bounds a solid.
inline constexpr std::size_t kProbes = 6;

/// Decides how a mesh is oriented by winding numbers beside its largest triangles. +1: the mesh winds
/// k times around the point over each of them, and more often around the point under it, with
/// integers k >= 0; k > 0 if another shell has the triangle inside. -1: the same with k <= -1. 0:
/// neither. A triangle with the same number on both sides does not count: another one of opposite
/// orientation lies on it, as where two solids share a face.
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
