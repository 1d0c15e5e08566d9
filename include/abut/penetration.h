#pragma once

#include <abut/model.h>
#include <abut/progress.h>
#include <abut/rigid.h>
#include <abut/types.h>

#include <cstdint>
#include <optional>
#include <vector>

/// How deep two models go into each other, where, and a way out. docs/penetration.md says what is
/// exact, what is a bound and what is only a direction.
namespace abut {

/// A place where two models meet: a connected set of points that both surfaces share, or (without
/// pairs) the components of one that lie wholly inside the other.
struct ContactRegion {
    /// Triangles that share those points, sorted. Two pairs belong to one region if the points
    /// that they share do: across edges and vertices that lie in the other's triangle.
    std::vector<TrianglePair> pairs;
    bool touching = false; ///< no pair crosses and nothing lies inside: depth 0
    /// Where surfaces cross: what the intersection curve encloses, as projected along the normal.
    /// Where they touch: of the faces in common. 0 without pairs.
    double area = 0;
    Vec3 normal; ///< unit vector from a to b, weighted by area; zero where areas cancel or are none
    /// The deepest point of either surface inside the other, a solid, among the points that are
    /// nearer to this region than to any other. Between open shells: see Depth::depth.
    double depth = 0;
    double depth_at_most = 0; ///< no such point lies deeper: proven
    /// On the surfaces, world frame; `depth` apart with a solid, else (open shells, or depth 0) a
    /// common point.
    Vec3 point_a, point_b;
    Vec3 direction; ///< unit vector in which b moves to get out there; zero if depth is
};

struct Depth {
    /// They share a point, or one lies inside the other. False: all else is zero.
    bool meet = false;
    /// The models go into each other: surfaces cross, interiors overlap, or one lies inside the
    /// other. False if they only touch.
    bool interpenetrate = false;
    std::vector<ContactRegion> regions; ///< by first pair; those without pairs come last
    /// Of the deepest region: a lower bound of every separating translation's length; between open
    /// shells, the largest of two crossing triangles. Where neither surface reaches inside the other
    /// (solids that coincide), the shortest translation found that parts them. docs/penetration.md
    double depth = 0;
    double depth_at_most = 0;
    Vec3 direction, point_a, point_b; ///< of the deepest region
    /// A translation of b after which the surfaces share no point and neither model lies inside the
    /// other. Verified, for world_from_b with this added to its last column. An upper bound of the
    /// shortest one, not always the shortest. Zero if the models are apart.
    Vec3 separation;
    Status status = Status::exact; ///< bound_only: the deepest point lies between depth and
                                   ///< depth_at_most
    /// The search ended because of PenetrationOptions::max_steps. The depth lies between `depth` and
    /// `depth_at_most`, and `separation`, if it was asked for, separates. If the steps did not suffice
    /// to find where the models meet, there are no regions, and `meet` and `interpenetrate` are true, to be safe:
    /// they may be apart.
    bool out_of_steps = false;
    std::uint64_t steps = 0; ///< see PenetrationOptions::max_steps
    Counters counters;
};

struct PenetrationOptions {
    /// Relative width that [depth, depth_at_most] should have. Work is limited: look at both.
    double relative_error = 0.01;
    bool separation = true; ///< false: leave `separation` zero, and save its time
    /// At most so many steps: in each, a pair of boxes is opened or a point is measured. A search that
    /// needs more answers what it has proven, see Depth::out_of_steps. None given: no limit.
    std::optional<std::uint64_t> max_steps{};
    Progress progress{};
};

/// Penetration of two models.
///
/// Frame       all results in the world frame.
/// Degenerate  an empty model meets nothing. Solids that coincide have no point of one surface
///             inside the other: see Depth::depth; their regions have depth 0. Flattened models
///             contain nothing.
/// Accuracy    whether surfaces meet and cross, and what is connected: exact. Depths are reached at
///             the witness points, to rounding.
/// Errors      Error{bad_argument} if a transform is not finite or the error allowed is negative or NaN.
///             Error{interrupted} if the stop flag is set.
/// Cost        what a model is as a solid is examined once, whatever the steps allowed.
/// Source      depth by branch and bound over the tree; the way out as [Je, Tang, Lee, Lee, Kim
///             2012], PolyDepth. Differs: bisection against exact contact in place of continuous
///             collision, and a guaranteed start from the boxes.
Depth penetration(const Model& a, const Transform& world_from_a, const Model& b,
                  const Transform& world_from_b, const PenetrationOptions& options = {});

} // namespace abut
