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

/// Solids as unions of convex pieces: distance, tolerance, contacts and penetration of two solids,
/// fast where these are made of few pieces, and between steps of a motion. All results are in the world frame
/// that the transforms map to.
namespace abut {

class ConvexPiecesData;

/// A solid whose surface is parted into patches, each on the boundary of its own convex hull, with
/// all hulls inside of the solid. Immutable once built: copies share the data, and any number of
/// threads may query it.
///
/// The solid is what its surface winds around, with the surface itself. Two solids that share a
/// point, one inside of the other included, are at distance 0, where `distance` of two models is
/// about their surfaces.
///
/// All queries mean the same by "share a point": the triangles, placed as abut/types.h says, share
/// one, as `collide` of two models decides exactly, or a component of one solid lies inside of the
/// other. Where rounding hides what the convex pieces do, the triangles are asked.
///
/// All queries end with Error{interrupted} if the stop flag of their progress is set.
class ConvexPieces {
public:
    /// Errors      Error{bad_mesh} naming an edge or a triangle if the mesh is not closed, or turned
    ///             inside out in whole or in part.
    /// Degenerate  triangles without an area belong to the surface, as the segments or points that
    ///             they are.
    /// Accuracy    exact: no hull leaves the solid by any amount. So a surface that is convex or
    ///             flat but for rounding falls into many pieces.
    /// Cost        some 10 to 50 microseconds a triangle, most where patches are large, of up to 16,384
    ///             triangles; less where a closed surface is convex as a whole.
    /// Source      [Ehmann, Lin 2001]; docs/convex-pieces.md.
    explicit ConvexPieces(const Model& model);

    [[nodiscard]] std::size_t size() const noexcept; ///< number of pieces
    /// Triangles of a piece. Each triangle is in one piece.
    [[nodiscard]] std::span<const std::uint32_t> triangles(std::size_t piece) const;
    /// The hull of a piece; built anew.
    [[nodiscard]] Convex hull(std::size_t piece) const;
    [[nodiscard]] const Model& model() const noexcept;
    /// Memory of pieces and hierarchy, in bytes; that of the model comes on top.
    [[nodiscard]] std::size_t bytes() const noexcept;
    [[nodiscard]] const ConvexPiecesData& data() const noexcept { return *data_; }

private:
    std::shared_ptr<const ConvexPiecesData> data_;
};

/// What queries remember of two solids from one pose to the next: the closest pieces and their
/// features, and how far apart all other pairs of pieces, or of groups of them, are at least. The
/// answer is the same, but for which of several closest pairs is found.
///
/// One a pair of solids and a thread. Starts empty; what belongs to other solids does no harm.
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

/// Work that a query did: the machine-independent part of its cost.
struct PiecesCounters {
    std::uint64_t hull_pairs = 0;    ///< pairs of hulls that were measured
    std::uint64_t directions = 0;    ///< pairs of hulls that were compared along one direction
    std::uint64_t sphere_pairs = 0;  ///< pairs of spheres around them
    std::uint64_t feature_pairs = 0; ///< pairs of features that were measured
    std::uint64_t simplices = 0;     ///< of the search that takes over where walking ends
};

/// A pair of closest points of two solids, or a common point.
struct PiecesGap {
    double distance = std::numeric_limits<double>::infinity(); ///< 0 if they share a point
    double at_least = 0; ///< no two points are closer; rounded down
    /// World frame. Where the solids share a point: one of them, in both, to rounding.
    Vec3 point_a, point_b;
    std::uint32_t piece_a = 0, piece_b = 0;
    /// Of the models, and what of them the points lie on: a triangle's vertex i, its edge from
    /// vertex i to the next, its face. At distance 0: a triangle of each piece.
    std::uint32_t triangle_a = 0, triangle_b = 0;
    Feature feature_a = Feature::face, feature_b = Feature::face;
    std::uint8_t index_a = 0, index_b = 0; ///< that i
    /// exact: the distance to rounding. converged: between at_least and distance, within the error
    /// allowed. bound_only: `distance` is the bound given, and no two points are closer.
    Status status = Status::exact;
    PiecesCounters counters;
};

struct PiecesDistanceOptions {
    /// Stop caring beyond this: if no two points are closer, the result is `bound_only`.
    double upper_bound = std::numeric_limits<double>::infinity();
    /// What the distance may exceed the true one by: a length.
    double absolute_error = 0;
    PiecesWarmStart* warm_start = nullptr;
    Progress progress{};
};

/// Distance of two solids, and one pair of points that realises it.
///
/// Accuracy    1e-12 of the distance, or a few roundings of the coordinates. 0 if and only if the
///             solids share a point, which is decided exactly.
/// Errors      Error{bad_argument} if a transform is not finite, or the bound or the error is
///             negative or NaN.
/// Cost        with a warm start and small steps, a few pairs of pieces; else a few pairs of hulls
///             for each level of the hierarchies, and more where the solids are close to each other
///             in many places. Where they are nearer than rounding can tell, or faces are parallel
///             but for rounding, also that of `distance` of two models.
/// Source      [Ehmann, Lin 2001]. Differs: bounds that a motion cannot have broken are not looked
///             at again; docs/convex-pieces.md.
PiecesGap distance(const ConvexPieces& a, const Transform& world_from_a, const ConvexPieces& b,
                   const Transform& world_from_b, const PiecesDistanceOptions& options = {});

struct PiecesWithinOptions {
    PiecesWarmStart* warm_start = nullptr;
    Progress progress{};
};

/// Whether some two points of the solids are at most `tolerance` apart.
///
/// Accuracy    as `distance` without a warm start, whose result it is compared with where it is near
///             the tolerance.
/// Errors      Error{bad_argument} if a transform is not finite or the tolerance is negative or
///             NaN.
bool within(const ConvexPieces& a, const Transform& world_from_a, const ConvexPieces& b,
            const Transform& world_from_b, double tolerance,
            const PiecesWithinOptions& options = {});

/// A piece of each of two solids.
struct PiecePair {
    std::uint32_t a = 0, b = 0;
    friend bool operator==(const PiecePair&, const PiecePair&) = default;
    friend bool operator<(const PiecePair& p, const PiecePair& q) {
        return p.a != q.a ? p.a < q.a : p.b < q.b;
    }
};

struct PiecesCollideOptions {
    ContactMode mode = ContactMode::first;
    /// Also the triangles that share a point; of a first contact those of the pieces found, which
    /// may be none.
    bool triangles = false;
    PiecesWarmStart* warm_start = nullptr; ///< for a first contact
    Progress progress{};
};

struct PiecesContacts {
    bool meet = false;                   ///< the solids share a point
    bool contained = false;              ///< one lies inside of the other and no pieces meet
    std::vector<PiecePair> pairs;        ///< pieces that meet, to rounding; sorted
    std::vector<TrianglePair> triangles; ///< if asked for; sorted, decided exactly
    PiecesCounters counters;
};

/// The pieces of two solids that share a point. Touching counts.
///
/// Accuracy    whether the solids meet, and the triangles: exact, as `collide` of two models. Every
///             pair of pieces whose triangles share a point is listed, and where the solids meet also
///             pieces nearer to each other than rounding can tell.
/// Errors      Error{bad_argument} if a transform is not finite.
PiecesContacts collide(const ConvexPieces& a, const Transform& world_from_a, const ConvexPieces& b,
                       const Transform& world_from_b, const PiecesCollideOptions& options = {});

/// How deep two solids go into each other, and a way out.
struct PiecesDepth {
    bool meet = false; ///< they share a point; else all else is zero
    /// No shorter translation of either separates them: proven, to rounding. The depth of the two
    /// pieces that go deepest into each other; where one solid lies inside of the other and no pieces
    /// meet, the distance of the surfaces.
    double depth = 0;
    /// Unit vector in which b moves by `depth` to take these two pieces apart, and the points that
    /// meet then, world frame; zero where no pieces meet.
    Vec3 direction, point_a, point_b;
    std::uint32_t piece_a = 0, piece_b = 0;
    /// A translation of b after which the solids share no point. Verified, for world_from_b with this
    /// added to its last column. An upper bound of the shortest one.
    Vec3 separation;
    /// exact: the solids are one piece each, so `depth` is the length of the shortest; or they are
    /// apart. Else bound_only: that lies between `depth` and the length of `separation`.
    Status status = Status::exact;
    PiecesCounters counters;
};

struct PiecesPenetrationOptions {
    bool separation = true; ///< false: leave `separation` zero, and save its time
    Progress progress{};
};

/// Penetration of two solids.
///
/// Degenerate  where solids only touch they meet, with depth 0; where pieces are flat, it may be 0 too.
/// Accuracy    whether they meet exactly, as `collide`; depths to a few roundings of the coordinates;
///             `separation` is tested exactly on the triangles.
/// Errors      Error{bad_argument} if a transform is not finite.
/// Cost        a search over the pairs of pieces that meet; with `separation` 50 to 100 contact
///             queries of the triangle trees.
/// Source      depth of convex pieces [van den Bergen 2001]; the way out as `penetration` of models.
PiecesDepth penetration(const ConvexPieces& a, const Transform& world_from_a, const ConvexPieces& b,
                        const Transform& world_from_b,
                        const PiecesPenetrationOptions& options = {});

} // namespace abut
