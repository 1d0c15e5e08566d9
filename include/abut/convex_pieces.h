#pragma once

#include <abut/convex.h>
#include <abut/model.h>
#include <abut/progress.h>
#include <abut/rigid.h>
#include <abut/types.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

/// Solids as unions of convex pieces, with the queries distance, within, collide and penetration.
/// They are fast for solids of few pieces, and from step to step of a motion. All results are in
/// the world frame that the transforms map to.
namespace abut {

class ConvexPiecesData;

/// A solid whose surface is divided into patches. Each patch lies on the boundary of its own convex
/// hull, and all hulls lie inside the solid. Immutable once built: copies share the data, and any
/// number of threads may query it.
///
/// The solid is its surface and all points that the surface winds around. Two solids that share a
/// point are at distance 0, also if one lies inside the other; `distance` of two models, in
/// contrast, measures between their surfaces.
///
/// Two solids share a point, for all queries, in one of two cases. Their triangles, placed as
/// abut/types.h defines, share a point, which is decided exactly as by `collide` of two models; or
/// a component of one solid lies inside the other. Where rounding leaves the convex pieces
/// undecided, the triangles are tested.
///
/// All queries end with Error{interrupted} if the stop flag of their progress is set.
class ConvexPieces {
public:
    /// Degenerate  triangles of zero area belong to the surface as segments or points.
    /// Accuracy    exact: no hull leaves the solid by any amount. Therefore a surface that is
    ///             convex or flat only to rounding is divided into many pieces.
    /// Errors      Error{bad_mesh}, naming an edge or a triangle, if the mesh is not closed, or is
    ///             inside out as a whole or in part.
    /// Cost        about 10 to 50 microseconds a triangle; most for large patches, which have up to
    ///             16,384 triangles; less where a closed surface is convex as a whole.
    /// Source      [Ehmann, Lin 2001]; docs/convex-pieces.md.
    explicit ConvexPieces(const Model& model);

    [[nodiscard]] std::size_t size() const noexcept; ///< number of pieces
    /// The triangles of a piece. Each triangle belongs to exactly one piece.
    [[nodiscard]] std::span<const std::uint32_t> triangles(std::size_t piece) const;
    /// The hull of a piece. It is built anew in each call.
    [[nodiscard]] Convex hull(std::size_t piece) const;
    [[nodiscard]] const Model& model() const noexcept;
    /// Memory of the pieces and their hierarchy, in bytes, without the model.
    [[nodiscard]] std::size_t bytes() const noexcept;
    [[nodiscard]] const ConvexPiecesData& data() const noexcept { return *data_; }

private:
    std::shared_ptr<const ConvexPiecesData> data_;
};

/// A warm start: what queries remember of two solids from one pose to the next. It holds the
/// closest pieces and their features, and lower bounds of the distances of all other pairs of
/// pieces or of groups of pieces. The answer is the same; only which of several closest pairs is
/// found may differ.
///
/// Use one for each pair of solids and thread. It starts empty. State from other solids is
/// harmless.
class PiecesWarmStart {
public:
    PiecesWarmStart();
    ~PiecesWarmStart();
    PiecesWarmStart(PiecesWarmStart&&) noexcept;
    PiecesWarmStart& operator=(PiecesWarmStart&&) noexcept;

    class Data;
    [[nodiscard]] Data& data();

private:
    std::unique_ptr<Data> data_;
};

/// The work of a query: the part of its cost that does not depend on the machine.
struct PiecesCounters {
    std::uint64_t hull_pairs = 0;    ///< pairs of hulls that were measured
    std::uint64_t directions = 0;    ///< pairs of hulls that were compared along one direction
    std::uint64_t sphere_pairs = 0;  ///< pairs of the hulls' bounding spheres
    std::uint64_t feature_pairs = 0; ///< pairs of features that were measured
    std::uint64_t simplices = 0;     ///< of the simplex search that follows where walking ends
};

/// The closest points of two solids, or a common point.
struct PiecesGap {
    double distance = std::numeric_limits<double>::infinity(); ///< 0 if the solids share a point
    double at_least = 0; ///< a lower bound of the distance, rounded down
    /// The closest points, world frame. Where the solids meet: a common point, to rounding.
    Vec3 point_a, point_b;
    std::uint32_t piece_a = 0, piece_b = 0;
    /// The triangles of the models, and their features that the points lie on: vertex i, the edge
    /// from vertex i to the next, or the face. At distance 0: one triangle of each piece.
    std::uint32_t triangle_a = 0, triangle_b = 0;
    Feature feature_a = Feature::face, feature_b = Feature::face;
    std::uint8_t index_a = 0, index_b = 0; ///< the number i of the vertex or edge
    /// exact: the distance to rounding. converged: the true distance lies between at_least and
    /// distance, within the error allowed. bound_only: `distance` is the given upper bound, and no
    /// two points are closer.
    Status status = Status::exact;
    PiecesCounters counters;
};

struct PiecesDistanceOptions {
    /// If no two points are closer than this, the result is `bound_only`.
    double upper_bound = std::numeric_limits<double>::infinity();
    /// Length by which the distance may exceed the true one.
    double absolute_error = 0;
    PiecesWarmStart* warm_start = nullptr;
    Progress progress{};
};

/// Returns the distance of two solids and one pair of closest points.
///
/// Accuracy    1e-12 of the distance, or a few roundings of the coordinates. 0 if and only if the
///             solids share a point, which is decided exactly.
/// Errors      Error{bad_argument} if a transform is not finite, or if upper_bound or
///             absolute_error is negative or NaN.
/// Cost        with a warm start and small steps, a few pairs of pieces. Else a few pairs of hulls
///             for each level of the hierarchies, and more where the solids are close to each other
///             in many places. Where they are closer than rounding can tell, or faces are parallel
///             to rounding, also the cost of `distance` of two models.
/// Source      [Ehmann, Lin 2001]. Differs: a bound that the motion cannot have broken is not
///             examined again; docs/convex-pieces.md.
PiecesGap distance(const ConvexPieces& a, const Transform& world_from_a, const ConvexPieces& b,
                   const Transform& world_from_b, const PiecesDistanceOptions& options = {});

struct PiecesWithinOptions {
    PiecesWarmStart* warm_start = nullptr;
    Progress progress{};
};

/// Returns whether any two points of the solids are at most `tolerance` apart.
///
/// Accuracy    as `distance` without a warm start, which is computed if the result is close to the
///             tolerance.
/// Errors      Error{bad_argument} if a transform is not finite, or if the tolerance is negative or
///             NaN.
bool within(const ConvexPieces& a, const Transform& world_from_a, const ConvexPieces& b,
            const Transform& world_from_b, double tolerance,
            const PiecesWithinOptions& options = {});

/// One piece of each of two solids.
struct PiecePair {
    std::uint32_t a = 0, b = 0;
    friend bool operator==(const PiecePair&, const PiecePair&) = default;
    friend bool operator<(const PiecePair& p, const PiecePair& q) {
        return p.a != q.a ? p.a < q.a : p.b < q.b;
    }
};

struct PiecesCollideOptions {
    ContactMode mode = ContactMode::first;
    /// Also returns the triangles that share a point. For ContactMode::first, only triangles of the
    /// found pieces, which may be none.
    bool triangles = false;
    PiecesWarmStart* warm_start = nullptr; ///< used for a first contact only
    Progress progress{};
};

struct PiecesContacts {
    bool meet = false;                   ///< the solids share a point
    bool contained = false;              ///< one solid lies inside the other and no pieces meet
    std::vector<PiecePair> pairs;        ///< pieces that meet, to rounding; sorted
    std::vector<TrianglePair> triangles; ///< if requested; sorted, decided exactly
    PiecesCounters counters;
};

/// Finds the pieces of two solids that share a point. Touching counts.
///
/// Accuracy    whether the solids meet, and the triangles, are exact, as for `collide` of two
///             models. Every pair of pieces whose triangles share a point is listed. Where the
///             solids meet, pieces that are closer to each other than rounding can tell are listed,
///             too.
/// Errors      Error{bad_argument} if a transform is not finite.
PiecesContacts collide(const ConvexPieces& a, const Transform& world_from_a, const ConvexPieces& b,
                       const Transform& world_from_b, const PiecesCollideOptions& options = {});

/// The penetration of two solids, and a translation that separates them.
struct PiecesDepth {
    bool meet = false; ///< the solids share a point; if false, all else is zero
    /// No translation that separates the solids is shorter: proven, to rounding. The value is the
    /// depth of the two pieces that penetrate each other deepest. Where one solid lies inside the
    /// other and no pieces meet, it is the distance of the surfaces.
    double depth = 0;
    /// Unit vector along which b moves by `depth` to take these two pieces apart, and the points
    /// that then meet, world frame. Zero where no pieces meet.
    Vec3 direction, point_a, point_b;
    std::uint32_t piece_a = 0, piece_b = 0;
    /// A translation of b after which the solids share no point. This is verified for world_from_b
    /// with the translation added to its last column. The shortest such translation is at most as
    /// long.
    Vec3 separation;
    /// exact: each solid is one piece, so `depth` is the length of the shortest separating
    /// translation; or the solids are apart. bound_only: that length lies between `depth` and the
    /// length of `separation`.
    Status status = Status::exact;
    PiecesCounters counters;
};

struct PiecesPenetrationOptions {
    bool separation = true; ///< false: `separation` stays zero, which saves time
    Progress progress{};
};

/// Computes the penetration of two solids.
///
/// Degenerate  solids that only touch meet with depth 0. Where pieces are flat, the depth may be 0.
/// Accuracy    whether the solids meet is exact, as for `collide`. Depths are correct to a few
///             roundings of the coordinates. `separation` is tested exactly on the triangles.
/// Errors      Error{bad_argument} if a transform is not finite.
/// Cost        a search over the pairs of pieces that meet; with `separation`, also 50 to 100
///             contact queries of the triangle trees.
/// Source      depth of convex pieces [van den Bergen 2001]; `separation` as `penetration` of
///             models.
PiecesDepth penetration(const ConvexPieces& a, const Transform& world_from_a, const ConvexPieces& b,
                        const Transform& world_from_b,
                        const PiecesPenetrationOptions& options = {});

} // namespace abut
