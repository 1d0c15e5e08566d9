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

/// Queries of one model, with its transform (a Pose converts implicitly), and a point, ray,
/// segment, sphere or box. Shapes and results are in the world frame that the transform maps to.
///
/// Any transform is allowed. If it has no inverse (a flattened part), each call first transforms a
/// copy of the mesh and builds its hierarchy. Zero-area triangles count as segments or points.
///
/// Errors      of all queries: Error{bad_argument} if the transform is not finite, or if a
///             coordinate of a shape is not finite or beyond 1e18; Error{bad_mesh} if such a copy
///             has positions beyond 1e18; Error{interrupted} if the stop flag of their progress is
///             set. They report no progress.
namespace abut {

// ------------------------------------------------------------------------------ nearest point ---

struct NearestOptions {
    /// If no point is nearer than this, the result is `bound_only` with this distance.
    double upper_bound = std::numeric_limits<double>::infinity();
    /// Makes the distance negative strictly inside a closed model.
    bool signed_distance = false;
    Progress progress{};
};

/// The nearest point of the surface.
struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    Vec3 point;
    std::uint32_t triangle = 0; ///< of several at the same distance, the lowest
    Feature feature = Feature::face;
    std::uint8_t index = 0; ///< vertex i of the triangle, or its edge from vertex i to i + 1
    std::array<double, 3> barycentric{}; ///< of `point`: weights of the triangle's vertices
    Status status = Status::exact;       ///< bound_only: |distance| is the given bound, no point is
                                         ///< nearer, and nothing else is set
};

/// Finds the surface point nearest to a point.
///
/// Degenerate  an empty model is infinitely far away (status `bound_only`).
/// Accuracy    to double rounding; 0 if and only if the point lies on the surface. The sign is
///             exact.
/// Errors      Error{bad_argument} if the bound is negative or NaN, or if signed_distance is set
///             for a model that is not closed.
/// Cost        about 30 boxes and triangles. With signed_distance, also the cost of `contains`.
Nearest nearest(const Model& model, const Transform& world_from_model, const Vec3& point,
                const NearestOptions& options = {});
/// As above for many points, in parallel. Results are in the order of the points.
std::vector<Nearest> nearest(const Model& model, const Transform& world_from_model,
                             std::span<const Vec3> points, const NearestOptions& options = {});

// ----------------------------------------------------------------------------------------- ray ---

/// The side of a triangle that a ray comes from.
enum class HitSide : std::uint8_t {
    front, ///< the side from which the vertices run counter-clockwise
    back,
    along, ///< the ray lies in the triangle's plane, or the triangle has zero area
};

/// The point where a ray meets a triangle.
struct RayHit {
    bool meet = false;                                  ///< if false, nothing else is set
    double t = std::numeric_limits<double>::infinity(); ///< the ray's parameter
    Vec3 point;                                         ///< on the triangle
    std::uint32_t triangle = 0;
    std::array<double, 3> barycentric{}; ///< weights of the triangle's vertices
    HitSide side = HitSide::front;
};

/// Finds the first triangle that a ray meets; of several at the same t, the one of lowest index.
///
/// A ray in a triangle's plane meets it where it enters, or at t_min if it starts within.
///
/// Accuracy    which triangles are met, and their order along the ray: exact. A ray through an edge
///             or a vertex meets all triangles there, so no ray passes between two. t: to a
///             relative 2^-40.
/// Errors      Error{bad_argument} if the direction is zero or not finite, or an end of the range
///             is NaN.
/// Source      the sides of edges as seen along the ray [Woop, Benthin, Wald 2013]. Differs: the
///             signs are exact, hence watertight without a sheared frame.
RayHit first_hit(const Model& model, const Transform& world_from_model, const Ray& ray,
                 const Progress& progress = {});
/// As above for many rays, in parallel. Results are in the order of the rays.
std::vector<RayHit> first_hit(const Model& model, const Transform& world_from_model,
                              std::span<const Ray> rays, const Progress& progress = {});

/// Finds every triangle that a ray meets, each once, sorted by t, then by index. Otherwise as
/// first_hit.
std::vector<RayHit> all_hits(const Model& model, const Transform& world_from_model, const Ray& ray,
                             const Progress& progress = {});

// ------------------------------------------------------------------------------------- segment ---

/// Returns the distance of the surface and a segment, with one pair of closest points: a is the
/// model, b the segment (`triangle_b` is 0). If they meet, the distance is 0 and both points are
/// one common point. Otherwise as `distance` of two models in abut/rigid.h.
Gap distance(const Model& model, const Transform& world_from_model, const Segment& segment,
             const DistanceOptions& options = {});

// ------------------------------------------------------------------------------------- overlap ---

/// Returns whether the surface and a solid shape (or a segment) share a point. Touching counts.
///
/// The model counts as a surface. A shape inside a closed model, away from its triangles, does not
/// overlap it (`contains` tests that); triangles inside a shape do.
///
/// Degenerate  an empty box (lower > upper on some axis) overlaps nothing.
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

/// Finds all triangles that share a point with the shape, sorted. Otherwise as `overlaps`.
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

/// The method that `contains` used.
enum class ContainmentMethod : std::uint8_t {
    crossings, ///< for a closed model: a ray's signed crossings, exact
    winding,   ///< for any other model: the winding number, rounded
};

/// The result of `contains`.
struct Containment {
    Side side = Side::outside;
    ContainmentMethod method = ContainmentMethod::crossings;
    /// Signed number of times that the surface winds around the point; a fraction where it has
    /// holes. Set only if `method` is winding and the point is not on the surface; else 0.
    double winding_number = 0;
};

/// Returns whether a point lies inside the model, outside, or on its surface.
///
/// A closed model has no border after duplicates and dangling triangles are dropped, equal positions
/// merged. A point is inside if its shells, each oriented outwards or around a cavity, wind around it
/// at least once: shells that overlap are a union (docs/solids.md). For any other model the winding
/// number decides: the point is inside if its magnitude is at least 1/2. If some components are
/// closed, the number is that of the others, and asked outside of the closed ones.
///
/// Accuracy    on_surface: exact; of faces that lie inside the solid, it is inside. crossings: exact.
///             winding: to rounding; where the surface has
///             holes, the answer near them is a convention.
/// Cost        the first query of a model examines its edges, O(n log n), and keeps the result with
///             the model, about 60 bytes a triangle; later queries take no lock. Then one ray; with
///             a winding number, O(n).
/// Source      [Jacobson, Kavan, Sorkine-Hornung 2013] for the winding number of open surfaces.
Containment contains(const Model& model, const Transform& world_from_model, const Vec3& point,
                     const Progress& progress = {});
/// As above for many points, in parallel. Results are in the order of the points.
std::vector<Containment> contains(const Model& model, const Transform& world_from_model,
                                  std::span<const Vec3> points, const Progress& progress = {});

} // namespace abut
