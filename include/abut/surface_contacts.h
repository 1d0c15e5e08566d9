#pragma once

#include <abut/deformable.h>
#include <abut/rigid_shape.h>
#include <abut/types.h>

#include <array>
#include <cstdint>
#include <vector>

/// Where a deformable surface is near a rigid body or inside it: the contacts of cloth with balls,
/// capsules, boxes and models. docs/surface-contacts.md shows their use.
namespace abut {

/// A point of a surface that is near a rigid body, with all that a constraint needs. Outside of the body
/// the gradient of the distance by vertices[i] is weights[i] * normal. In a convex body this holds for
/// vertices; the deepest point of an edge or a triangle is as near to several faces, and the normal
/// is that of one of them.
struct SurfaceContact {
    Feature feature = Feature::vertex; ///< the part of the surface that has the point in its inside
    std::uint32_t id = 0; ///< a vertex, an edge as `Deformable::edges` numbers it, or a triangle
    /// The vertices of that part: one, two or three. The others repeat the last one.
    std::array<std::uint32_t, 3> vertices{};
    /// `point` is the sum of the vertices' positions, each times its weight. They sum to 1. The
    /// weights of repeated vertices are 0.
    std::array<double, 3> weights{};
    double distance = 0; ///< of both points, along the normal; negative inside a solid
    double limit = 0;    ///< the distance up to which this contact is listed
    Vec3 point;          ///< on the surface
    Vec3 point_on_body;  ///< on the body's boundary
    Vec3 normal;         ///< unit vector out of the body: the surface leaves it that way (`within`)
    std::uint32_t triangle = 0; ///< of a model, the one that holds point_on_body; else 0

    friend bool operator==(const SurfaceContact&, const SurfaceContact&) = default;
};

/// Finds where a surface is near a rigid body or inside it:
///
/// - every vertex whose signed distance is at most the limit;
/// - the point of every triangle that is nearest to the body, if it is more than 1e-9 of the triangle
///   from its vertices and within the limit: for the edge that holds it, or else for the triangle.
///   So a small ball in the middle of a large triangle is not missed.
///
/// Each part of the surface is listed once. An edge whose triangles are all nearer elsewhere is not
/// listed. Where groups and masks leave a triangle out, its edges stand for themselves. The list is
/// sorted by feature and id.
///
/// In          distance: a length, at least 0. The limit is the distance plus the thickness of the
///             part, as NearVertices says. The body belongs to group 1 and meets all groups.
///             options.vertices_b is not to be set.
/// Out         The normal of a gap is the direction of the nearest points. A vertex inside of a
///             solid comes to point_on_body by its depth along the normal; a longer way may lead
///             into another face beside a re-entrant edge. Where point and point_on_body are the
///             same to rounding, so also where a part passes through a model, the normal leaves all
///             triangles of the model that hold the point: their outward normals have positive dot
///             products with it. At a re-entrant edge it is the bisector. If no vector leaves all
///             of them, it is the normal of one. Outwards is out of a solid, however its triangles
///             are oriented; of an open model it is the side from which their vertices run
///             counter-clockwise.
/// Degenerate  A closed model is a solid, and negative distances of vertices are those of its
///             boundary. An edge or a triangle inside of it has no contact of its own. Where an edge
///             or a triangle passes through a model's surface, its distance is 0, at one of the
///             places where it does. The distance in a convex body is that of the deepest point of
///             a part, and the normal the direction of its shortest way out.
/// Accuracy    to rounding: some 2^-44 of the coordinates; in cylinders, cones and ellipsoids to 1e-12
///             of their size. Parts whose distance is within that of the limit may be listed or not.
/// Errors      Error{bad_argument} for the lengths and spans as `self_within`, or if a value of the
///             pose is not finite or its quaternion has zero length. Error{interrupted} if the stop
///             flag is set.
/// Cost        parallel (`set_threads`). O(n) tests of boxes; then, for each vertex and triangle near
///             the body's box, less than a microsecond of balls and capsules, and some microseconds
///             of other bodies. A triangle that reaches into a convex body takes 2 to 15 us, in a
///             `Convex` of 2,000 faces 30 us, of more than 4,096 faces up to 1 ms; one beside a
///             model 5 to 30 us, however large it is. The first part that reaches into a `Convex`
///             waits for its planes, some 100 ns a face. The first query of a closed model examines
///             it in O(m log m).
/// Source      distances as between bodies of a `World`; a triangle that reaches into a convex body
///             by cutting planes [Kelley 1960]; the normal of a touch by [Gilbert 1966].
std::vector<SurfaceContact> within(const Deformable& surface, const RigidShape& body,
                                   const Pose& world_from_body, double distance,
                                   const NearOptions& options = {});

} // namespace abut
