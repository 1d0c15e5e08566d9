#pragma once

#include <abut/contacts.h>
#include <abut/model.h>
#include <abut/progress.h>
#include <abut/types.h>

#include <array>
#include <cstdint>
#include <vector>

/// Contact manifolds of two models: a normal and up to four points for each region where they meet.
/// docs/model-contacts.md explains how they are found.
namespace abut {

/// A region where two models meet, as a contact solver needs it.
struct ModelManifold {
    Vec3 normal;              ///< unit vector from a to b
    std::uint32_t region = 0; ///< names the region; see ManifoldOptions::last
    std::uint32_t count = 0;  ///< of the points that are set, 1 to 4; the deepest comes first
    /// The two points of a contact point lie on the two surfaces. Its depth is
    /// dot(normal, point_a - point_b). Both points lie on one line along the normal, to rounding; not
    /// those of `bound_only`. Its `feature` names a vertex, a pair of triangles, or the middle of the region.
    std::array<ContactPoint, 4> points;
    /// exact: the depths are those of the points, to rounding; not the largest of the region.
    /// bound_only: the one point is from `penetration`, or no line along the normal was found that
    /// leaves both models, or the region only touches although the models overlap. The models may
    /// be deeper in each other.
    Status status = Status::exact;
};

struct ManifoldOptions {
    /// Triangles that are at most this far apart contribute points with a negative depth.
    double margin = 0;
    /// The manifolds of the same two models in the last step, or null. Of those whose normal
    /// differs by less than 60 degrees, a region then keeps the name of the one that shares most
    /// point names; if none does, of the nearest. The name of a region's middle does not count.
    const std::vector<ModelManifold>* last = nullptr;
    Progress progress{};
};

/// Computes the contact manifolds of two models.
///
/// Frame       all results in the world frame.
/// Degenerate  an empty model meets nothing. A solid that lies inside the other, without a common
///             point of their surfaces, gives one manifold with the depth of `penetration`. Of open
///             surfaces both sides count as outside; the normal points to the side on which the
///             other model's middle is. A component inside the other model is not reported if
///             triangles elsewhere meet. Solids that overlap although no triangles cross, as equal
///             boxes stacked too deep do, have one point with the depth of `penetration`.
/// Accuracy    which triangles meet is exact. A depth is measured along the normal; it is reached at
///             its two points, to rounding.
/// Errors      Error{bad_argument} if a transform is not finite, or the margin is negative or not
///             finite. Error{bad_mesh} if a transform without an inverse moves positions out of
///             range. Error{interrupted} if the stop flag is set.
/// Cost        that of `collide` for all contacts, that of the regions, which is linear but for
///             sorting, and of rays: at most 164 for a region of at most 24 triangle pairs, else at
///             most 68. Also that of `penetration` if a solid lies inside the other, if triangles
///             of a region only touch and share no area that parts the models, or if a region that
///             crosses also has faces that lie in one plane, to rounding, and look the same way.
///             The first query of a model analyses which solid it bounds.
std::vector<ModelManifold> contact_manifolds(const Model& a, const Transform& world_from_a,
                                             const Model& b, const Transform& world_from_b,
                                             const ManifoldOptions& options = {});

} // namespace abut
