#pragma once

#include <abut/model.h>
#include <abut/progress.h>
#include <abut/rigid.h>
#include <abut/types.h>

#include <cstdint>
#include <optional>
#include <vector>

/// Finds how deep two models penetrate each other, where, and a translation that separates them.
/// docs/penetration.md explains which results are exact, which are bounds, and which are only
/// directions.
namespace abut {

/// A region where two models meet. It is a connected set of points that both surfaces share; or, if
/// it has no pairs, the components of one surface that lie wholly inside the other.
struct ContactRegion {
    /// The triangle pairs that share these points, sorted. Two pairs belong to one region if their
    /// shared points are connected, also across edges and vertices that lie in the other's
    /// triangle.
    std::vector<TrianglePair> pairs;
    bool touching = false; ///< no pair crosses and nothing lies inside; the depth is 0
    /// Where surfaces cross: the area inside the intersection curve, projected along the normal.
    /// Where they touch: the area that their faces have in common. 0 without pairs.
    double area = 0;
    Vec3 normal; ///< unit vector from a to b, weighted by area; zero where the areas sum to zero
    /// The largest depth of a point of either surface inside the other, a solid, among the points
    /// that are nearer to this region than to any other. Between open shells: see Depth::depth.
    double depth = 0;
    double depth_at_most = 0; ///< proven upper bound of that depth
    /// Witness points on the surfaces, world frame. In a solid they are `depth` apart. Between open
    /// shells, or at depth 0, they are one common point.
    Vec3 point_a, point_b;
    Vec3 direction; ///< unit vector along which b moves to get out there; zero if the depth is zero
};

struct Depth {
    /// The models share a point, or one lies inside the other. If false, all else is zero.
    bool meet = false;
    /// The models penetrate each other: surfaces cross, interiors overlap, or one model lies inside
    /// the other. False if they only touch.
    bool interpenetrate = false;
    std::vector<ContactRegion> regions; ///< by first pair; those without pairs come last
    /// Depth of the deepest region. It is a lower bound of the length of every separating
    /// translation. Between open shells: the largest depth of two crossing triangles. Where neither
    /// surface has points inside the other (for example, solids that coincide): the length of the
    /// shortest separating translation that was found, which is not a lower bound. See
    /// docs/penetration.md.
    double depth = 0;
    double depth_at_most = 0;
    Vec3 direction, point_a, point_b; ///< of the deepest region
    /// A translation of b after which the surfaces share no point and neither model lies inside the
    /// other. This is verified for world_from_b with the translation added to its last column. The
    /// shortest such translation may be shorter. Zero if the models are apart.
    Vec3 separation;
    Status status = Status::exact; ///< bound_only: the largest depth is in [depth, depth_at_most];
                                   ///< or, always: open shells, solids that coincide, see `depth`
    /// The search ended because of PenetrationOptions::max_steps. The largest depth lies between
    /// `depth` and `depth_at_most`, and `separation`, if requested, separates the models. If the
    /// steps did not suffice to find where the models meet, there are no regions; `meet` and
    /// `interpenetrate` are then true, to be safe, although the models may be apart.
    bool out_of_steps = false;
    std::uint64_t steps = 0; ///< see PenetrationOptions::max_steps
    Counters counters;
};

struct PenetrationOptions {
    /// Allowed relative width of the interval [depth, depth_at_most]. The work is limited, so the
    /// interval may be wider: check both values.
    double relative_error = 0.01;
    bool separation = true; ///< false: `separation` stays zero, which saves time
    /// Maximum number of steps; none given: no limit. A step opens a pair of boxes or measures a
    /// point. A search that needs more steps returns what it has proven so far, see
    /// Depth::out_of_steps.
    std::optional<std::uint64_t> max_steps{};
    Progress progress{};
};

/// Computes the penetration of two models.
///
/// Frame       all results in the world frame.
/// Degenerate  an empty model meets nothing. If two solids coincide, no point of one surface lies
///             inside the other; see Depth::depth. Their regions have depth 0. Flattened models
///             contain nothing.
/// Accuracy    whether surfaces meet and cross, and which pairs are connected, is exact. Depths are
///             attained at the witness points, to rounding.
/// Errors      Error{bad_argument} if a transform is not finite or relative_error is negative or
///             NaN. Error{interrupted} if the stop flag is set.
/// Cost        the first query of a model analyses which solid it bounds. This does not count as
///             steps.
/// Source      depth by branch and bound over the tree. Separation as PolyDepth [Je, Tang, Lee,
///             Lee, Kim 2012]. Differs: bisection against exact contact in place of continuous
///             collision, and a guaranteed start from the boxes.
Depth penetration(const Model& a, const Transform& world_from_a, const Model& b,
                  const Transform& world_from_b, const PenetrationOptions& options = {});

} // namespace abut
