#pragma once

#include <abut/body_id.h>
#include <abut/types.h>

#include <array>
#include <cstdint>

/// Contacts that hold a body: up to four points of each contact region, as a simulator needs them.
/// docs/contacts.md explains how they are found.
namespace abut {

/// A point where two bodies touch, penetrate each other, or are near each other.
struct ContactPoint {
    /// On the two surfaces, world frame: point_a - point_b is `depth` times the normal. With a margin,
    /// those of a solid beside an edge of a model that is not convex need not lie on one line along the
    /// normal: `depth` is the part along it. The deepest point of a capsule inside of a model that is not convex may lie inside the capsule, if
    /// another face is nearest to the rest of its axis.
    Vec3 point_a, point_b;
    double depth = 0;          ///< along the normal; negative: a gap, at most the margin
    std::uint64_t feature = 0; ///< names the two features that make the point; stays while they do
    /// Of models and deformables: the triangle of the contact. The body's point lies on it, to rounding; a
    /// capsule's end, and the point of a cylinder, cone or ellipsoid that is deep in the model, may lie beside
    /// it. Of several
    /// triangles that hold the point, motion may change which one it is. Of other bodies 0.
    std::uint32_t triangle_a = 0, triangle_b = 0;
};

/// A region where two bodies are in contact. The points are the corners of that region, without
/// those that four others represent. The region of a disc has 16 corners on its rim.
struct ContactManifold {
    BodyId a, b; ///< a.index < b.index
    Vec3 normal; ///< unit vector from a to b
    /// Names the contact region of this pair; 0 for convex bodies. A ball or capsule has one for each
    /// wall of a model that it touches.
    std::uint32_t region = 0;
    /// Of compounds: their pieces, each pair of which has regions and names of its own. Else 0.
    std::uint32_t piece_a = 0, piece_b = 0;
    std::uint64_t user_data_a = 0, user_data_b = 0; ///< BodyOptions::user_data of the bodies
    std::uint32_t count = 0;                        ///< of the points that are set
    std::array<ContactPoint, 4> points;             ///< the deepest first; their names differ
    /// exact: to rounding. bound_only: if both bodies are models, depths are those of lines along
    /// the normal; else as of BodyGap.
    Status status = Status::exact;
};

} // namespace abut
