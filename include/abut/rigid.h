#pragma once

#include <abut/model.h>
#include <abut/progress.h>
#include <abut/types.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

/// Queries on two rigid models, each under its own transform (a Pose converts silently).
/// All results are in the world frame that the transforms map to.
namespace abut {

/// Work that a query did: the machine-independent part of its cost.
struct Counters {
    std::uint64_t volume_tests = 0;    ///< pairs of bounding volumes
    std::uint64_t primitive_tests = 0; ///< pairs of triangles
    std::uint64_t exact_tests = 0; ///< orientation signs that only exact arithmetic could decide
};

/// Two triangles that share a point, by their indices in the two meshes.
struct TrianglePair {
    std::uint32_t a = 0, b = 0;
    friend bool operator==(const TrianglePair&, const TrianglePair&) = default;
    friend bool operator<(const TrianglePair& p, const TrianglePair& q) {
        return p.a != q.a ? p.a < q.a : p.b < q.b;
    }
};

/// What queries remember of two models from one pose to the next: where they met, or where they
/// were closest. A query that is given it looks there first; the answer is the same, but for which
/// of several first contacts or closest pairs is found.
///
/// One a pair of models and a thread. Starts empty; what belongs to other models does no harm.
struct WarmStart {
    bool used = false;
    TrianglePair last;
};

enum class ContactMode : std::uint8_t {
    first, ///< stop at the first pair found
    all,   ///< every pair
};

struct CollideOptions {
    ContactMode mode = ContactMode::first;
    WarmStart* warm_start = nullptr; ///< for a first contact
    bool segments = false;           ///< also where each pair meets
    Progress progress{};
};

struct Contacts {
    std::vector<TrianglePair> pairs; ///< sorted
    /// If asked for: what the triangles of pairs[i] share. A segment runs along n_a x n_b (n: the
    /// normal that sees the triangle's corners counter-clockwise); of coplanar triangles it is the
    /// common polygon, counter-clockwise about n_a. Corners are placed to 2^-36 of their edge.
    std::vector<Intersection> segments;
    Status status = Status::exact;
    Counters counters;
    /// True if the surfaces share at least one point. Touching counts.
    [[nodiscard]] bool meet() const noexcept { return !pairs.empty(); }
};

/// The triangle pairs that share a point: surfaces only, a part inside a closed one does not
/// collide.
///
/// Degenerate  zero-area triangles count as the segments or points that they are.
/// Accuracy    exact: decided by certified filters, then by exact arithmetic.
/// Errors      Error{bad_argument} if a transform is not finite. Error{interrupted} if the stop flag
///             is set: contacts found so far are not returned, as they could be taken for all.
/// Cost        output-sensitive; a few hundred volume tests for a first contact.
/// Source      traversal as [Gottschalk, Lin, Manocha 1996], differs: eight boxes at a time in
///             SIMD.
Contacts collide(const Model& a, const Transform& world_from_a, const Model& b,
                 const Transform& world_from_b, const CollideOptions& options = {});

/// A pair of closest points.
struct Gap {
    double distance = std::numeric_limits<double>::infinity(); ///< 0 if the surfaces meet
    double at_least = 0;   ///< no two points are closer: proven, rounded down
    Vec3 point_a, point_b; ///< on the surfaces, world frame
    std::uint32_t triangle_a = 0, triangle_b = 0;
    /// What the points lie on: a triangle's vertex i, its edge from vertex i to the next, its face.
    Feature feature_a = Feature::face, feature_b = Feature::face;
    std::uint8_t index_a = 0, index_b = 0; ///< that i
    /// exact: to rounding, up or down by no more than distance - at_least; converged: within the errors
    /// allowed; bound_only: `distance` is the `upper_bound` given, and no pair is closer to rounding, or
    /// the search ran out of steps.
    Status status = Status::exact;
    /// The search ended because of DistanceOptions::max_steps. `at_least` is proven all the same, and
    /// `distance` is that of the points, the nearest that were found; or the `upper_bound` given, if
    /// none nearer than that were found.
    bool out_of_steps = false;
    std::uint64_t steps = 0; ///< see DistanceOptions::max_steps
    Counters counters;
};

struct DistanceOptions {
    /// Stop caring beyond this: if no two points are closer (to rounding), the result is `bound_only`
    /// with this distance; any other result is less. A known bound makes the query faster.
    double upper_bound = std::numeric_limits<double>::infinity();
    /// What the distance may exceed the true one by: this length, or this share of the result.
    double absolute_error = 0, relative_error = 0;
    /// Negative where the models go into each other or one lies in the other: minus the depth, as
    /// abut/penetration.h defines it, reached at the points (bound_only: it may be larger). The
    /// errors allowed and the bound are for models apart.
    bool signed_distance = false;
    WarmStart* warm_start = nullptr;
    /// At most so many steps: in each, a pair of boxes is opened, or (for a depth) a point is
    /// measured. A search that needs more answers what it has proven, see Gap::out_of_steps. None
    /// given: no limit.
    std::optional<std::uint64_t> max_steps{};
    Progress progress{};
};

/// Distance of the surfaces and one pair of points that realises it.
///
/// Degenerate  an empty model is infinitely far away (status `bound_only`).
/// Accuracy    to double rounding, or within the errors allowed; 0 exactly if and only if `collide`
///             finds a contact. With no error allowed, whether they meet is decided exactly.
/// Errors      Error{bad_argument} if a transform is not finite, or the bound or an error is
///             negative or NaN. Error{interrupted} if the stop flag is set.
/// Source      best-first order as [Larsen, Gottschalk, Lin, Manocha 1999].
Gap distance(const Model& a, const Transform& world_from_a, const Model& b,
             const Transform& world_from_b, const DistanceOptions& options = {});

struct WithinOptions {
    WarmStart* warm_start = nullptr;
    Progress progress{};
};

/// Whether some two points of the surfaces are at most `tolerance` apart. Stops at the first proof:
/// a pair of triangles or of boxes that lies within it, or the last box that lies beyond.
///
/// Errors      Error{bad_argument} if a transform is not finite or the tolerance is negative or
///             NaN. Error{interrupted} if the stop flag is set.
/// Cost        no limit of steps: `distance` with one and the tolerance as its bound has an answer
///             for "not decided".
bool within(const Model& a, const Transform& world_from_a, const Model& b,
            const Transform& world_from_b, double tolerance, const WithinOptions& options = {});

} // namespace abut
