#pragma once

#include <abut/mesh.h>
#include <abut/types.h>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

/// Convex bodies: solid, and small enough in features that a query walks over them. All results are
/// in the world frame that the transforms map to.
namespace abut {

class ConvexData;

struct ConvexOptions {
    /// Of a mesh: how deep a dent is still taken for rounding of its file, as a share of its box's
    /// diagonal.
    double relative_dent = 1e-6;
};

/// The convex hull of some points: a solid, or a polygon, a segment or a point where they span no
/// more. Immutable once built: copies share the data, and any number of threads may query it.
class Convex {
public:
    /// Errors      Error{bad_mesh} if there is no point, or a coordinate is not finite or beyond
    ///             1e18.
    /// Accuracy    queries answer for the hull of all points. `vertices()` are those that the hull of
    ///             the others does not hold, less those that it holds to 2^-46 of the largest
    ///             coordinate; what is coplanar exactly is one face.
    /// Cost        O(n log n).
    explicit Convex(std::span<const Vec3> points);

    /// Takes a mesh that is convex already: its hull, if that is the mesh.
    ///
    /// Errors      as above; Error{bad_mesh} naming a triangle if the mesh is not closed, is
    ///             turned inside out in part, or has a dent.
    explicit Convex(const Mesh& mesh, const ConvexOptions& options = {});

    [[nodiscard]] const std::vector<Vec3>& vertices() const noexcept;
    /// Ends of each edge: numbers of vertices.
    [[nodiscard]] const std::vector<std::array<std::uint32_t, 2>>& edges() const noexcept;
    [[nodiscard]] std::size_t face_count() const noexcept;
    /// Vertices of a face, counter-clockwise as seen from outside. A polygon has two faces.
    [[nodiscard]] std::span<const std::uint32_t> face(std::size_t index) const;
    /// Which of the points given (vertices of the mesh) each vertex is; of equal ones, one.
    [[nodiscard]] const std::vector<std::uint32_t>& source() const noexcept;
    /// 3, or 2 for a polygon, 1 for a segment, 0 for a point.
    [[nodiscard]] int dimension() const noexcept;
    /// Its surface in triangles; a segment and a point have one of zero area.
    [[nodiscard]] Mesh mesh() const;
    [[nodiscard]] std::size_t bytes() const noexcept;
    [[nodiscard]] const ConvexData& data() const noexcept { return *data_; }

private:
    std::shared_ptr<const ConvexData> data_;
};

/// A vertex of each of two bodies.
struct VertexPair {
    std::uint32_t a = 0, b = 0;
    friend bool operator==(const VertexPair&, const VertexPair&) = default;
};

/// A polytope inside of the difference b - a of two convex bodies, around the origin: its corners, and
/// its triangles, counter-clockwise as seen from outside.
struct DifferencePolytope {
    /// An edge of a face: the one from its corner `edge` to the next.
    struct Side {
        std::uint32_t face = 0, edge = 0;
    };
    struct Face {
        std::array<std::uint32_t, 3> corners{};
        std::array<Side, 3> across{}; ///< the same edges as the faces beyond have them
    };
    std::vector<VertexPair> corners;
    std::vector<Face> faces;
};

/// What queries remember of two convex bodies from one pose to the next. A query that is given it
/// walks on from there: the answer is the same to its accuracy, and proven as without it, but for
/// which of several closest pairs is found.
///
/// One a pair of bodies and a thread. Starts empty; what belongs to other bodies does no harm.
struct ConvexWarmStart {
    enum class Kind : std::uint8_t { empty, features, simplex };
    Kind kind = Kind::empty;
    /// simplex: pairs whose differences hold the origin. features: their vertices, edges, kinds.
    std::array<VertexPair, 4> pairs{};
    DifferencePolytope deepest; ///< what proved the last depth; may be empty
};

/// Work that a query did: the machine-independent part of its cost.
struct ConvexCounters {
    std::uint32_t feature_pairs = 0; ///< pairs of features that were measured
    std::uint32_t simplices = 0;     ///< of the search that takes over where walking ends
};

/// A pair of closest points of two convex bodies, or a common point.
struct ConvexGap {
    /// 0 if, and only if, they share a point.
    double distance = std::numeric_limits<double>::infinity();
    double at_least = 0; ///< no two points are closer: proven, rounded down
    /// World frame. Where they share a point: one of them, in both, to rounding.
    Vec3 point_a, point_b;
    /// What the points lie on: numbers of a vertex, an edge, a face. Within an error that was
    /// allowed: a vertex close by. Of no meaning at distance 0.
    Feature feature_a = Feature::vertex, feature_b = Feature::vertex;
    std::uint32_t id_a = 0, id_b = 0;
    /// converged: between at_least and distance, within the error allowed.
    Status status = Status::exact;
    ConvexCounters counters;
};

struct ConvexDistanceOptions {
    /// What the distance may exceed the true one by: a length. Simplified hulls inside of the
    /// bodies, whose deviation is known, may then answer.
    double absolute_error = 0;
    ConvexWarmStart* warm_start = nullptr;
};

/// How deep two convex bodies go into each other.
struct ConvexDepth {
    /// They share a point: exact. False: all else is zero.
    bool meet = false;
    double depth = 0;    ///< length of the shortest translation that leaves them touching
    double at_least = 0; ///< no shorter translation than that does: proven, rounded down
    Vec3 direction;      ///< unit vector in which b moves by `depth`
    /// On the surfaces, world frame: point_b meets point_a when b has moved.
    Vec3 point_a, point_b;
    Status status = Status::exact; ///< always: the bounds are equal to a few roundings
    ConvexCounters counters;
};

/// Distance of two solid convex bodies, and one pair of points that realises it.
///
/// Degenerate  points, segments and polygons as any other; transforms may be any affine map,
///             singular ones included.
/// Accuracy    0 if, and only if, the bodies meet where abut/types.h places their vertices. Else 1e-12
///             of the distance, or a few roundings of the coordinates in a frame with the world's axes
///             and the origin of `a`.
/// Errors      Error{bad_argument} if a transform is not finite or places a vertex beyond the range
///             of numbers, or the error allowed is negative or NaN.
/// Cost        with a warm start and small steps, constant; else a few steps a level of detail.
/// Source      [Lin, Canny 1991], [Mirtich 1998], [Ehmann, Lin 2000]; docs/convex.md.
ConvexGap distance(const Convex& a, const Transform& world_from_a, const Convex& b,
                   const Transform& world_from_b, const ConvexDistanceOptions& options = {});

struct ConvexPenetrationOptions {
    ConvexWarmStart* warm_start = nullptr;
};

/// The shortest translation that ends the overlap of two convex bodies.
///
/// Degenerate  as `distance`. Where they only touch, or one of them is flat, the depth may be 0.
/// Accuracy    whether they meet is exact, as for `distance`; the depth to a few roundings of the
///             coordinates: of all translations, not of those in some directions.
/// Errors      Error{bad_argument} if a transform is not finite or places a vertex beyond the range
///             of numbers.
/// Source      [van den Bergen 2001], ended by certified bounds; docs/convex.md.
ConvexDepth penetration(const Convex& a, const Transform& world_from_a, const Convex& b,
                        const Transform& world_from_b,
                        const ConvexPenetrationOptions& options = {});

} // namespace abut
