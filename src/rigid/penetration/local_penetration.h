#pragma once

#include "rigid/pair/contacts.h"
#include "rigid/penetration/deepest_point.h"
#include "rigid/solid/world_solid.h"

#include <span>

namespace abut {

/// How deep two models that interpenetrate go into each other.
struct LocalPenetration {
    double depth = 0;    ///< a depth that is reached
    double at_most = 0;  ///< no deeper than this, to rounding
    double rounding = 0; ///< at_most + rounding is proven; 0 where at_most is no bound but a length
    Vec3 point_a, point_b;
    Vec3 direction; ///< unit vector along which b moves to get out at point_a; zero if the depth is
    TrianglePair triangles{}; ///< that hold the points
};

/// Local penetration depth.
///
/// With a solid: the largest distance from a point of the other's surface inside the solid to the
/// solid's surface (of two solids, the larger of both ways). Between open surfaces: the largest,
/// over the crossing triangle pairs, of the shortest translation that separates the two triangles.
///
/// It is found as seen from one of the models' vertices: models that are moved together, without
/// rounding, have the same depth to the last bit.
///
/// In          all contacts, or those of a region and the part of the surfaces that is its own.
/// Accuracy    with a solid, `depth` is reached at point_a and point_b to rounding, and
///             [depth, at_most] encloses the true value; else it is the definition's value at a
///             common point.
LocalPenetration local_penetration(const WorldSolid& a, const WorldSolid& b,
                                   std::span<const Contact> contacts, const DepthSearch& options,
                                   const SurfacePart& part_a = {}, const SurfacePart& part_b = {});

/// The depth of two models that have contacts and interpenetrate: their local penetration; where the
/// surfaces give none although the models are locked into each other (coplanar faces only), the
/// shortest translation found that parts the surfaces.
LocalPenetration penetration_depth(const WorldSolid& a, const WorldSolid& b,
                                   std::span<const Contact> contacts, const DepthSearch& options);
/// That translation, as a depth at a common point.
LocalPenetration locked_depth(const WorldSolid& a, const WorldSolid& b,
                              std::span<const Contact> contacts);

} // namespace abut
