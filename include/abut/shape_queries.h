#pragma once

#include <abut/model.h>
#include <abut/progress.h>
#include <abut/rigid.h>
#include <abut/shapes.h>
#include <abut/types.h>

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// Queries of one model under its transform (a Pose converts silently) with a point, a ray, a
/// segment, a sphere or a box. Shapes and results are in the world frame that the transform maps
/// to.
///
/// All take any transform: where it has no inverse (a flattened part), a copy of the mesh is
/// transformed and given a hierarchy first, once a call. All throw Error{bad_argument} if the
/// transform is not finite or a coordinate of a shape is not finite or beyond 1e18, and
/// Error{bad_mesh} if such a copy has positions beyond 1e18. Zero-area triangles count as the
/// segments or points that they are. All end with Error{interrupted} if the stop flag of their
/// progress is set, and report nothing.
namespace abut {

// ------------------------------------------------------------------------------ nearest point ---

struct NearestOptions {
    /// Stop caring beyond this: if no point is nearer, the result is `bound_only` with this
    /// distance.
    double upper_bound = std::numeric_limits<double>::infinity();
    /// Negative strictly inside a closed model.
    bool signed_distance = false;
    Progress progress{};
};

/// A point of the surface.
struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    Vec3 point;
    std::uint32_t triangle = 0; ///< of several at the same distance, the least
    Feature feature = Feature::face;
    std::uint8_t index = 0; ///< the triangle's vertex, or its edge: i runs from vertex i to i + 1
    std::array<double, 3> barycentric{}; ///< of `point`: weights of the triangle's vertices
    Status status = Status::exact; ///< bound_only: |distance| is the bound given, and no point is
                                   ///< nearer; nothing else is set
};

/// The surface point nearest to a point.
///
/// Degenerate  an empty model is infinitely far away (status `bound_only`).
/// Accuracy    to double rounding; 0 exactly if and only if the point lies on the surface; its sign
///             is exact.
/// Errors      Error{bad_argument} if the bound is negative or NaN, or if a signed distance is
///             asked of a model that is not closed.
/// Cost        some 30 boxes and triangles. Signed: also that of `contains`.
Nearest nearest(const Model& model, const Transform& world_from_model, const Vec3& point,
                const NearestOptions& options = {});
/// Many points, in parallel; results in their order.
std::vector<Nearest> nearest(const Model& model, const Transform& world_from_model,
                             std::span<const Vec3> points, const NearestOptions& options = {});

// ----------------------------------------------------------------------------------------- ray ---

/// Which side of a triangle a ray comes from.
enum class HitSide : std::uint8_t {
    front, ///< the side from which its vertices run counter-clockwise
    back,
    along, ///< the ray lies in its plane, or it has no area
};

/// Where a ray meets a triangle.
struct RayHit {
    bool meet = false;                                  ///< else nothing below is set
    double t = std::numeric_limits<double>::infinity(); ///< the ray's parameter
    Vec3 point;                                         ///< on the triangle
    std::uint32_t triangle = 0;
    std::array<double, 3> barycentric{}; ///< weights of its vertices
    HitSide side = HitSide::front;
};

/// The first triangle that a ray meets; of several at the same t, the one of least index.
///
/// A ray in a triangle's plane meets it where it enters (at t_min if it starts within).
///
/// Accuracy    which triangles are met, and their order along the ray: exact. A ray through an edge
///             or a vertex meets all triangles there, so none slips between two. t: to 2^-40
///             relative.
/// Errors      Error{bad_argument} if the direction is zero or not finite, or an end of the range
///             is NaN.
/// Source      the sides of edges as seen along the ray [Woop, Benthin, Wald 2013]; differs: the
///             signs are exact, hence watertight without a sheared frame.
RayHit first_hit(const Model& model, const Transform& world_from_model, const Ray& ray,
                 const Progress& progress = {});
/// Many rays, in parallel; results in their order.
std::vector<RayHit> first_hit(const Model& model, const Transform& world_from_model,
                              std::span<const Ray> rays, const Progress& progress = {});

/// Every triangle that a ray meets, each once, sorted by t, then by index. Otherwise as first_hit.
std::vector<RayHit> all_hits(const Model& model, const Transform& world_from_model, const Ray& ray,
                             const Progress& progress = {});

// ------------------------------------------------------------------------------------- segment ---

/// Distance of the surface and a segment, and one pair of points that realises it: a is the model,
/// b the segment (`triangle_b` is 0). 0 and a common point if they meet. As abut/rigid.h says of
/// two models.
Gap distance(const Model& model, const Transform& world_from_model, const Segment& segment,
             const DistanceOptions& options = {});

// ------------------------------------------------------------------------------------- overlap ---

/// Whether the surface and a solid shape (or a segment) share a point. Touching counts.
///
/// The model counts as a surface: a shape inside a closed model, away from its triangles, does not
/// overlap it (`contains` tells), while triangles inside a shape do.
///
/// Degenerate  a box that is empty (lower > upper on some axis) overlaps nothing.
/// Accuracy    exact.
/// Errors      Error{bad_argument} if a radius is negative.
bool overlaps(const Model& model, const Transform& world_from_model, const Sphere& sphere,
              const Progress& progress = {});
bool overlaps(const Model& model, const Transform& world_from_model, const Box3& box,
              const Progress& progress = {});
bool overlaps(const Model& model, const Transform& world_from_model, const OrientedBox& box,
              const Progress& progress = {});
bool overlaps(const Model& model, const Transform& world_from_model, const Segment& segment,
              const Progress& progress = {});

/// All triangles that share a point with the shape, sorted. Otherwise as `overlaps`.
std::vector<std::uint32_t> overlapping_triangles(const Model& model,
                                                 const Transform& world_from_model,
                                                 const Sphere& sphere,
                                                 const Progress& progress = {});
std::vector<std::uint32_t> overlapping_triangles(const Model& model,
                                                 const Transform& world_from_model, const Box3& box,
                                                 const Progress& progress = {});
std::vector<std::uint32_t> overlapping_triangles(const Model& model,
                                                 const Transform& world_from_model,
                                                 const OrientedBox& box,
                                                 const Progress& progress = {});
std::vector<std::uint32_t> overlapping_triangles(const Model& model,
                                                 const Transform& world_from_model,
                                                 const Segment& segment,
                                                 const Progress& progress = {});

// --------------------------------------------------------------------------------- containment ---

enum class Side : std::uint8_t { outside, inside, on_surface };

/// What the answer of `contains` rests on.
enum class ContainmentMethod : std::uint8_t {
    crossings, ///< the model is closed: parity of a ray's crossings, exact
    winding,   ///< it is not: the winding number, rounded
};

/// Where a point is.
struct Containment {
    Side side = Side::outside;
    ContainmentMethod method = ContainmentMethod::crossings;
    /// Signed number of times that the surface winds around the point, a fraction where it has
    /// holes. Only if `method` is winding and the point is not on the surface; else 0.
    double winding_number = 0;
};

/// Whether a point lies inside the model, outside, or on its surface.
///
/// A closed model (every edge used by exactly two triangles, equal positions merged) is decided by
/// parity, whatever the orientation of its triangles: a closed shell inside another is a cavity.
/// Any other by its winding number: inside if it is at least 1/2 in magnitude.
///
/// Accuracy    on_surface: exact. crossings: exact. winding: to rounding; where the surface has
///             holes, the answer near them is a convention.
/// Cost        the first question to a model examines its edges, O(n log n), and keeps what it
///             found with the model, about 60 bytes a triangle; no lock after that. Then: one ray;
///             with a winding number, O(n).
/// Source      [Jacobson, Kavan, Sorkine-Hornung 2013] for the winding number of dirty surfaces.
Containment contains(const Model& model, const Transform& world_from_model, const Vec3& point,
                     const Progress& progress = {});
/// Many points, in parallel; results in their order.
std::vector<Containment> contains(const Model& model, const Transform& world_from_model,
                                  std::span<const Vec3> points, const Progress& progress = {});

} // namespace abut
