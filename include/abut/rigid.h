#pragma once

#include <abut/model.h>
#include <abut/progress.h>
#include <abut/types.h>
#include <abut/volume.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

/// Queries on two rigid models, each with its own transform (a Pose converts implicitly). All
/// results are in the world frame that the transforms map to.
namespace abut {

/// The work of a query: the part of its cost that does not depend on the machine.
struct Counters {
    /// The kind of bounding volume that was tested. It may differ from what the models were built
    /// with: see common_volume. `automatic`: the boxes that every model has, or none.
    Volume volume = Volume::automatic;
    std::uint64_t volume_tests = 0;    ///< pairs of bounding volumes
    std::uint64_t primitive_tests = 0; ///< pairs of triangles
    std::uint64_t exact_tests = 0; ///< orientation signs that only exact arithmetic could decide
};

/// Two triangles that share a point, as their indices in the two meshes.
struct TrianglePair {
    std::uint32_t a = 0, b = 0;
    friend bool operator==(const TrianglePair&, const TrianglePair&) = default;
    friend bool operator<(const TrianglePair& p, const TrianglePair& q) {
        return p.a != q.a ? p.a < q.a : p.b < q.b;
    }
};

/// A warm start: what queries remember of two models from one pose to the next, that is, where the
/// models met or were closest. A query looks there first. The answer is the same; only which of
/// several first contacts or closest pairs is found may differ.
///
/// Use one for each pair of models and thread. It starts empty. State from other models is
/// harmless.
struct WarmStart {
    bool used = false;
    TrianglePair last;
};

enum class ContactMode : std::uint8_t {
    first, ///< stops at the first pair found
    all,   ///< finds every pair
};

struct CollideOptions {
    ContactMode mode = ContactMode::first;
    WarmStart* warm_start = nullptr; ///< used for a first contact only
    bool segments = false;           ///< also computes where each pair meets
    Progress progress{};
};

struct Contacts {
    std::vector<TrianglePair> pairs; ///< sorted
    /// If requested: the points that the triangles of pairs[i] share. A segment runs along n_a x
    /// n_b, where n is the normal from which the triangle's corners run counter-clockwise. Coplanar
    /// triangles share a polygon, counter-clockwise about n_a. Corners are placed to 2^-36 of their
    /// edge.
    std::vector<Intersection> segments;
    Status status = Status::exact;
    Counters counters;
    /// True if the surfaces share a point. Touching counts.
    [[nodiscard]] bool meet() const noexcept { return !pairs.empty(); }
};

/// Finds the triangle pairs that share a point. Models are surfaces: a part inside a closed model
/// does not collide with it.
///
/// Degenerate  zero-area triangles count as segments or points.
/// Accuracy    exact: decided by certified filters, then by exact arithmetic.
/// Errors      Error{bad_argument} if a transform is not finite. Error{interrupted} if the stop
///             flag is set; contacts found so far are not returned, because they could be taken for
///             all.
/// Cost        output-sensitive; a few hundred volume tests for a first contact.
/// Source      traversal as [Gottschalk, Lin, Manocha 1996]. Differs: eight boxes at a time in
///             SIMD.
Contacts collide(const Model& a, const Transform& world_from_a, const Model& b,
                 const Transform& world_from_b, const CollideOptions& options = {});

/// The closest points of two models.
struct Gap {
    double distance = std::numeric_limits<double>::infinity(); ///< 0 if the surfaces meet
    double at_least = 0;   ///< a proven lower bound of the distance, rounded down
    Vec3 point_a, point_b; ///< on the surfaces, world frame
    std::uint32_t triangle_a = 0, triangle_b = 0;
    /// The feature that each point lies on: vertex i of the triangle, its edge from vertex i to the
    /// next, or its face.
    Feature feature_a = Feature::face, feature_b = Feature::face;
    std::uint8_t index_a = 0, index_b = 0; ///< the number i of the vertex or edge
    /// exact: the distance to rounding; its error is at most distance - at_least. converged: within
    /// the errors allowed. bound_only: `distance` is the given `upper_bound`, and no pair is closer
    /// to rounding; or the search ran out of steps.
    Status status = Status::exact;
    /// The search ended because of DistanceOptions::max_steps. `at_least` is still proven.
    /// `distance` is that of the nearest points found, or the given `upper_bound` if none nearer
    /// were found.
    bool out_of_steps = false;
    std::uint64_t steps = 0; ///< see DistanceOptions::max_steps
    Counters counters;
};

struct DistanceOptions {
    /// If no two points are closer than this (to rounding), the result is `bound_only` with this
    /// distance; any other result is smaller. A known bound makes the query faster.
    double upper_bound = std::numeric_limits<double>::infinity();
    /// Error allowed: the distance may exceed the true one by this length, or by this fraction of
    /// the result.
    double absolute_error = 0, relative_error = 0;
    /// Makes the distance negative where the models penetrate or one lies inside the other. It is
    /// then minus the depth, as abut/penetration.h defines it, attained at the points (bound_only
    /// as Depth::status says). The errors allowed and the bound apply only to models that are
    /// apart.
    bool signed_distance = false;
    WarmStart* warm_start = nullptr;
    /// Maximum number of steps; none given: no limit. A step opens a pair of boxes or (for a depth)
    /// measures a point. A search that needs more steps returns what it has proven so far, see
    /// Gap::out_of_steps.
    std::optional<std::uint64_t> max_steps{};
    Progress progress{};
};

/// Returns the distance of the surfaces and one pair of closest points.
///
/// Degenerate  an empty model is infinitely far away (status `bound_only`).
/// Accuracy    to double rounding, or within the errors allowed; 0 if and only if `collide` finds a
///             contact. With no error allowed, whether the surfaces meet is decided exactly.
/// Errors      Error{bad_argument} if a transform is not finite, or if the bound or an error is
///             negative or NaN. Error{interrupted} if the stop flag is set.
/// Source      best-first order as [Larsen, Gottschalk, Lin, Manocha 1999].
Gap distance(const Model& a, const Transform& world_from_a, const Model& b,
             const Transform& world_from_b, const DistanceOptions& options = {});

struct WithinOptions {
    WarmStart* warm_start = nullptr;
    Progress progress{};
};

/// Returns whether any two points of the surfaces are at most `tolerance` apart. Stops at the first
/// proof: a pair of triangles or boxes within the tolerance, or the last pair of boxes beyond it.
///
/// Errors      Error{bad_argument} if a transform is not finite, or if the tolerance is negative or
///             NaN. Error{interrupted} if the stop flag is set.
/// Cost        there is no limit of steps. To limit them, call `distance` with max_steps and with
///             the tolerance as upper_bound: its answer may be "not decided".
bool within(const Model& a, const Transform& world_from_a, const Model& b,
            const Transform& world_from_b, double tolerance, const WithinOptions& options = {});

} // namespace abut
