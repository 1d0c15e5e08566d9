#pragma once

#include <abut/mesh.h>
#include <abut/types.h>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

/// Convex bodies. They are solid, and have so few features that a query can walk over them. All
/// results are in the world frame that the transforms map to.
namespace abut {

class ConvexData;

struct ConvexOptions {
    /// For a mesh: the depth of a dent that is still accepted as a rounding error of the file, as a
    /// fraction of the diagonal of the mesh's box.
    double relative_dent = 1e-6;
};

/// The convex hull of some points: a solid, or a polygon, segment or point if they span no more.
/// Immutable once built: copies share the data, and any number of threads may query it.
class Convex {
public:
    /// Accuracy    queries answer for the hull of all points. A point is a vertex (`vertices()`) if
    ///             it lies outside the hull of the others by more than 2^-46 of the largest
    ///             coordinate. Faces that are exactly coplanar are one face.
    /// Errors      Error{bad_mesh} if there is no point, or a coordinate is not finite or beyond
    ///             1e18.
    /// Cost        O(n log n).
    explicit Convex(std::span<const Vec3> points);

    /// Takes a mesh that is already convex, and keeps its hull.
    ///
    /// Errors      as above; Error{bad_mesh}, naming a triangle, if the mesh is not closed, is
    ///             partly inside out, or has a dent.
    explicit Convex(const Mesh& mesh, const ConvexOptions& options = {});

    [[nodiscard]] const std::vector<Vec3>& vertices() const noexcept;
    /// The two vertex numbers of each edge.
    [[nodiscard]] const std::vector<std::array<std::uint32_t, 2>>& edges() const noexcept;
    [[nodiscard]] std::size_t face_count() const noexcept;
    /// The vertices of a face, counter-clockwise as seen from outside. A polygon has two faces.
    [[nodiscard]] std::span<const std::uint32_t> face(std::size_t index) const;
    /// For each vertex, the index of the given point (or vertex of the mesh) that it is; of several
    /// equal points, one of them.
    [[nodiscard]] const std::vector<std::uint32_t>& source() const noexcept;
    /// 3 for a solid, 2 for a polygon, 1 for a segment, 0 for a point.
    [[nodiscard]] int dimension() const noexcept;
    /// The surface as triangles. A segment or a point has one triangle of zero area.
    [[nodiscard]] Mesh mesh() const;
    [[nodiscard]] std::size_t bytes() const noexcept;
    [[nodiscard]] const ConvexData& data() const noexcept { return *data_; }

private:
    std::shared_ptr<const ConvexData> data_;
};

/// One vertex of each of two bodies.
struct VertexPair {
    std::uint32_t a = 0, b = 0;
    friend bool operator==(const VertexPair&, const VertexPair&) = default;
};

/// A polytope inside the difference b - a of two convex bodies, around the origin: its corners, and
/// its triangles, counter-clockwise as seen from outside.
struct DifferencePolytope {
    /// An edge of a face, from the face's corner `edge` to its next corner.
    struct Side {
        std::uint32_t face = 0, edge = 0;
    };
    struct Face {
        std::array<std::uint32_t, 3> corners{};
        std::array<Side, 3> across{}; ///< the same edges as the neighbouring faces number them
    };
    std::vector<VertexPair> corners;
    std::vector<Face> faces;
};

/// A warm start: what queries remember of two convex bodies from one pose to the next. A query
/// walks on from the state that it is given. The answer has the same accuracy and the same proof as
/// without a warm start; only which of several closest pairs is found may differ.
///
/// Use one for each pair of bodies and thread. It starts empty. State from other bodies is
/// harmless.
struct ConvexWarmStart {
    enum class Kind : std::uint8_t { empty, features, simplex };
    Kind kind = Kind::empty;
    /// simplex: pairs whose differences enclose the origin. features: vertices, edges and kinds.
    std::array<VertexPair, 4> pairs{};
    DifferencePolytope deepest; ///< the polytope that proved the last depth; may be empty
};

/// The work of a query: the part of its cost that does not depend on the machine.
struct ConvexCounters {
    std::uint32_t feature_pairs = 0; ///< pairs of features that were measured
    std::uint32_t simplices = 0;     ///< of the simplex search that follows where walking ends
};

/// The closest points of two convex bodies, or a common point.
struct ConvexGap {
    /// 0 if and only if the bodies share a point.
    double distance = std::numeric_limits<double>::infinity();
    double at_least = 0; ///< a proven lower bound of the distance, rounded down
    /// The closest points, world frame. Where the bodies meet: a common point, to rounding.
    Vec3 point_a, point_b;
    /// The vertex, edge or face that each point lies on, by its number. With an absolute error
    /// allowed, it may be a nearby vertex. Meaningless at distance 0.
    Feature feature_a = Feature::vertex, feature_b = Feature::vertex;
    std::uint32_t id_a = 0, id_b = 0;
    /// converged: the true distance lies between at_least and distance, within the error allowed.
    Status status = Status::exact;
    ConvexCounters counters;
};

struct ConvexDistanceOptions {
    /// Length by which the distance may exceed the true one. The query may then use simplified
    /// hulls inside the bodies, whose deviation is known.
    double absolute_error = 0;
    ConvexWarmStart* warm_start = nullptr;
};

/// The penetration of two convex bodies.
struct ConvexDepth {
    /// Whether the bodies share a point: exact. If false, all else is zero.
    bool meet = false;
    double depth = 0;    ///< length of the shortest translation that leaves the bodies touching
    double at_least = 0; ///< a proven lower bound of that length, rounded down
    Vec3 direction;      ///< unit vector along which b moves by `depth`
    /// Deepest points on the surfaces, world frame. point_b meets point_a when b has moved.
    Vec3 point_a, point_b;
    Status status = Status::exact; ///< always: both bounds agree to a few roundings
    ConvexCounters counters;
};

/// Returns the distance of two solid convex bodies and one pair of closest points.
///
/// Degenerate  points, segments and polygons are handled like solids. A transform may be any affine
///             map, also a singular one.
/// Accuracy    0 if and only if the bodies meet at the positions that abut/types.h defines. Else
///             the error is 1e-12 of the distance, or a few roundings of the coordinates in a frame
///             with the world's axes and the origin of `a`.
/// Errors      Error{bad_argument} if a transform is not finite or places a vertex beyond the range
///             of numbers, or if absolute_error is negative or NaN.
/// Cost        constant with a warm start and small steps; else a few steps for each level of
///             detail.
/// Source      [Lin, Canny 1991], [Mirtich 1998], [Ehmann, Lin 2000]; docs/convex.md.
ConvexGap distance(const Convex& a, const Transform& world_from_a, const Convex& b,
                   const Transform& world_from_b, const ConvexDistanceOptions& options = {});

struct ConvexPenetrationOptions {
    ConvexWarmStart* warm_start = nullptr;
};

/// Finds the shortest translation that separates two convex bodies.
///
/// Degenerate  as `distance`. Where the bodies only touch, or one of them is flat, the depth may be
///             0.
/// Accuracy    whether the bodies meet is exact, as for `distance`. The depth is that of the
///             shortest of all translations, to a few roundings of the coordinates; no set of
///             directions is sampled.
/// Errors      Error{bad_argument} if a transform is not finite or places a vertex beyond the range
///             of numbers.
/// Source      [van den Bergen 2001], ended by certified bounds; docs/convex.md.
ConvexDepth penetration(const Convex& a, const Transform& world_from_a, const Convex& b,
                        const Transform& world_from_b,
                        const ConvexPenetrationOptions& options = {});

} // namespace abut
