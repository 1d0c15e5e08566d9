#pragma once

#include <abut/elementary_impact.h>
#include <abut/mesh.h>
#include <abut/model.h>
#include <abut/progress.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

/// Continuous collision detection of deforming surfaces: finds which vertices and faces, and which
/// pairs of edges, meet while the vertices move, and when. docs/representative-triangles.md
/// explains the algorithm.
namespace abut {

/// Decides which of its triangles represents a vertex or an edge.
enum class Assignment : std::uint8_t {
    greedy,              ///< the first triangle in the mesh's order
    maximal,             ///< few triangles represent many features; the others need no tests
    uniform_vertex_edge, ///< all triangles represent about as many vertices and edges
    uniform_edge_edge,   ///< all triangles represent about as many edges, and as many vertices
    adaptive, ///< greedy, until `Deformable::adapt` moves features off triangles that collide
};

/// Decides how pairs of triangles that may meet become tests of features.
enum class Scheme : std::uint8_t {
    representative, ///< the features that both triangles represent, if the features' boxes overlap
    database, ///< all 15 tests whose features' boxes overlap; a hash table prevents repetitions
    markup,   ///< the features that both triangles represent, without boxes of features
    basic,    ///< all 15 tests
    features, ///< no triangle pairs: separate trees over vertices, edges and faces
    /// As representative, but one pair of triangles after another, as the schemes above take them.
    /// For a comparison on equal terms.
    pairwise,
};

/// The broad phase that finds pairs of triangles that may meet.
enum class Culling : std::uint8_t {
    tree,  ///< bounding-volume hierarchy
    grid,  ///< uniform grid
    sweep, ///< sweep and prune along one axis
};

struct DeformableOptions {
    Scheme scheme = Scheme::representative;
    Assignment assignment = Assignment::greedy;
    Culling culling = Culling::tree;
    /// Keeps no boxes of features, which are more than half of the memory: they are fitted when a
    /// search comes to them. The answers are the same. Has an effect with Scheme::representative and
    /// Culling::tree.
    bool lean = false;
};

/// Two features that meet during the step.
struct FeatureImpact {
    ElementaryKind kind = ElementaryKind::vertex_face;
    Status status = Status::exact; ///< as in ElementaryImpact
    /// For vertex_face between two surfaces: true if the face belongs to the first surface and the
    /// vertex to the second.
    bool face_first = false;
    /// vertex_face: the vertex and the triangle. edge_edge: the two edges, as `Deformable::edges`
    /// numbers them; within one surface, a < b.
    std::uint32_t a = 0, b = 0;
    double time = 1;                     ///< as in ElementaryImpact
    std::array<double, 3> barycentric{}; ///< as in ElementaryImpact
    Vec3 normal;                         ///< as in ElementaryImpact: from b towards a

    friend bool operator==(const FeatureImpact&, const FeatureImpact&) = default;
};

/// One number for each kind of test.
struct TestCounts {
    std::uint64_t vertex_face = 0, edge_edge = 0;
    friend bool operator==(const TestCounts&, const TestCounts&) = default;
};

/// The work of a query: the part of its cost that does not depend on the machine or on the number
/// of threads.
struct DeformableCounters {
    /// Triangle pairs whose boxes overlap, each counted once. Pairs within one flat region,
    /// which cannot meet, are not counted. 0 if the scheme uses no triangle pairs.
    std::uint64_t triangle_pairs = 0;
    TestCounts candidates; ///< feature pairs that the scheme selects; adjacent pairs are left out
    /// Candidates whose roots were computed, because neither separating directions nor the signs of
    /// the cubic ruled them out.
    TestCounts elementary_tests;
    std::uint64_t exact_fallbacks = 0; ///< elementary tests that integer arithmetic had to decide

    friend bool operator==(const DeformableCounters&, const DeformableCounters&) = default;
};

struct Impacts {
    /// Sorted by kind, face_first, a, b. Each pair of features occurs once.
    std::vector<FeatureImpact> list;
    DeformableCounters counters;
};

/// Two features that are near each other at one end of the step, with all that a constraint on their
/// distance needs. The gradient of the distance by the position of vertices[i] is
/// weights[i] * normal.
struct FeaturePair {
    ElementaryKind kind = ElementaryKind::vertex_face;
    bool face_first = false; ///< as in FeatureImpact
    /// vertex_face: the side of the triangle's plane that the vertex lies on: 1 if the triangle's
    /// vertices run counter-clockwise as seen from there, -1 on the other side, 0 in the plane.
    /// edge_edge: the sign of (p_a - p_b) . (e_a x e_b), where e is an edge from its lower vertex to
    /// its higher one, and p any point on it. The sign changes where edges pass through each other.
    /// Exact.
    std::int8_t side = 0;
    std::uint32_t a = 0, b = 0; ///< as in FeatureImpact
    /// vertex_face: the vertex, then the triangle's vertices. edge_edge: those of edge a, then of b.
    std::array<std::uint32_t, 4> vertices{};
    double distance = 0;
    double limit = 0; ///< the distance up to which this pair is listed; see NearOptions
    std::array<double, 3> barycentric{}; ///< of the closest points, as in FeatureImpact
    /// point_a - point_b is the sum of the vertices' positions, each times its weight. The weights of
    /// a's vertices sum to 1, those of b's to -1.
    std::array<double, 4> weights{};
    Vec3 point_a, point_b; ///< the closest points of both features
    /// Unit vector from point_b to point_a. Where the features touch to rounding: perpendicular to
    /// both of them, towards `side`; if that is 0, towards 1.
    Vec3 normal;

    friend bool operator==(const FeaturePair&, const FeaturePair&) = default;
};

/// What a query of near features knows of the vertices of a surface. Each span is empty, or has one
/// entry for each vertex.
struct NearVertices {
    /// Lengths, at least 0. A feature is as thick as the thickest of its vertices. Empty: 0.
    std::span<const double> thickness{};
    /// Bit sets: the groups of a vertex. A feature belongs to every group that one of its vertices belongs to. Empty: 1.
    std::span<const std::uint32_t> groups{};
    /// Bit sets: the groups that a vertex meets. A feature meets those that all its vertices meet.
    /// Empty: all. As for bodies of a `World`, both features must agree.
    std::span<const std::uint32_t> masks{};
    /// Not 0 for vertices that have moved since the pairs were last listed. Only pairs with such a
    /// vertex are listed. Empty for all surfaces of a query: all pairs.
    std::span<const std::uint8_t> moved{};
};

struct NearOptions {
    bool at_end = false;     ///< take the positions at the end of the step, not those at its start
    NearVertices vertices{}; ///< of the surface; of two surfaces, of the first
    NearVertices vertices_b{}; ///< of the second surface; of one surface, not to be set
    Progress progress{};
};

/// How an edge and a face that share a point lie to each other.
enum class EdgeFaceContact : std::uint8_t {
    /// The edge passes through the inside of the face: its ends lie strictly on the two sides of
    /// the face's plane, and the point that they share lies on no edge of the face.
    crossing,
    /// They share one point, but do not cross: the edge ends on the face, or passes through the
    /// face's border. So do an edge without length and a face without area, whatever they share.
    touching,
    /// The edge lies in the face's plane, and they share a point or a segment.
    coplanar,
};

/// An edge and a face that share a point.
struct EdgeFaceIntersection {
    bool face_first =
        false;              ///< of two surfaces: the face is the first one's, the edge the second's
    std::uint32_t edge = 0; ///< as `Deformable::edges` numbers it
    std::uint32_t face = 0; ///< the triangle
    EdgeFaceContact contact = EdgeFaceContact::crossing;
    Vec3 point;       ///< a shared point; of a shared segment, its middle
    double along = 0; ///< where it is on the edge: 0 at the lower vertex, 1 at the higher
    std::array<double, 3> barycentric{}; ///< where it is on the face

    friend bool operator==(const EdgeFaceIntersection&, const EdgeFaceIntersection&) = default;
};

struct IntersectionOptions {
    bool at_end = false; ///< take the positions at the end of the step, not those at its start
    Progress progress{};
};

class DeformableData;

/// A triangle mesh whose vertices move from step to step, with the data that its queries need.
/// During a step every vertex moves in a straight line from its start to its end while t goes from
/// 0 to 1.
///
/// Any number of threads may query it while no thread changes it. Movable, not copyable.
class Deformable {
public:
    /// Takes a mesh at rest: its positions are both start and end.
    ///
    /// Degenerate  any triangles are allowed, also with equal vertices or a repeated index.
    ///             Duplicate vertices are separate vertices, and features that share no index are
    ///             tested. Vertices that no triangle uses are ignored.
    /// Errors      Error{bad_mesh} as `Model`.
    /// Cost        O(n log n).
    explicit Deformable(Mesh mesh, const DeformableOptions& options = {});
    ~Deformable();
    Deformable(Deformable&&) noexcept;
    Deformable& operator=(Deformable&&) noexcept;

    /// Sets the step: the position of every vertex at t = 0 and at t = 1. Refits the hierarchy, and
    /// rebuilds it where its boxes have become too loose.
    ///
    /// Errors      Error{bad_argument} if the number of positions is not that of the vertices;
    ///             Error{bad_mesh} if a coordinate is not finite or beyond 1e18. Nothing has
    ///             changed then.
    /// Cost        O(n), parallel; O(n log n) where the hierarchy is rebuilt.
    void set_motion(std::span<const Vec3> start, std::span<const Vec3> end);
    /// As above, from the arrays of another program: x, y, z of each vertex. Floats are converted
    /// exactly to doubles. The arrays are read once, without another copy of them.
    ///
    /// Errors      as above; Error{bad_argument} unless there are three numbers for each vertex.
    void set_motion(std::span<const double> start, std::span<const double> end);
    void set_motion(std::span<const float> start, std::span<const float> end);
    /// Starts the next step: the old end becomes the start. Errors and cost as `set_motion`.
    void advance(std::span<const Vec3> end);
    void advance(std::span<const double> end);
    void advance(std::span<const float> end);
    /// As above, but frees the memory of `end` before it refits the hierarchy.
    void advance(std::vector<Vec3>&& end);

    /// Replaces the mesh, at rest, after cutting, fracture or remeshing. A triangle that keeps its
    /// index and its three vertices in the same order keeps the features that it represents.
    ///
    /// Errors      Error{bad_mesh} as the constructor; nothing has changed then.
    /// Cost        O(n log n).
    void set_mesh(Mesh mesh);

    /// Moves vertices and edges from triangles that met something to neighbouring triangles that
    /// met nothing. Call it from time to time with Assignment::adaptive. It changes no answer.
    ///
    /// In          `self_impacts` of this surface with its current triangles.
    /// Cost        O(n log n).
    void adapt(const Impacts& impacts);

    [[nodiscard]] std::size_t vertex_count() const noexcept;
    [[nodiscard]] const std::vector<std::array<std::uint32_t, 3>>& triangles() const noexcept;
    /// Every pair of vertices that a triangle joins, once, the lower vertex first. Sorted by the
    /// higher vertex, then by the lower one.
    [[nodiscard]] const std::vector<std::array<std::uint32_t, 2>>& edges() const noexcept;
    /// The surface at the start of its step as a model, for every query that takes one. The first
    /// call builds its hierarchy; a call in a later step refits it, and rebuilds it where its boxes
    /// have become too loose. The model keeps its positions when the surface moves on.
    ///
    /// Cost        O(n log n) at first and after `set_mesh`, O(n) in a new step, and nothing in the
    ///             same step.
    [[nodiscard]] Model model() const;
    /// Memory, in bytes. Includes that of the last `model`.
    [[nodiscard]] std::size_t bytes() const noexcept;
    [[nodiscard]] const DeformableData& data() const noexcept { return *data_; }

private:
    /// A second handle to the same surface, which keeps its data.
    friend std::shared_ptr<const Deformable> shared(const Deformable& surface);
    explicit Deformable(std::shared_ptr<DeformableData> data);

    std::shared_ptr<DeformableData> data_;
};

/// Finds every vertex and face, and every two edges, of one surface that meet during the step. Each
/// pair is listed once. Features that share a vertex are not a pair.
///
/// In          options: exact by default; see ElementaryOptions.
/// Accuracy    complete, and exact where the options say so; each pair is decided as by
///             `elementary_impact`.
/// Errors      Error{bad_argument} for the options, as `elementary_impact`, or if the schemes or
///             cullings of two surfaces differ. All queries below throw Error{interrupted} if the
///             stop flag is set.
/// Cost        parallel (`set_threads`); a list of candidates is never stored.
/// Source      [Curtis, Tamstorf, Manocha 2008]. Differs: a leaf holds several triangles and tests
///             the boxes of all features that they represent, one against many in SIMD; certified
///             filters follow at once, eight pairs at a time.
Impacts self_impacts(const Deformable& surface, const ElementaryOptions& options = {},
                     const Progress& progress = {});
/// As `self_impacts`, but between two surfaces. The features of `a` come first, except where
/// FeatureImpact::face_first says otherwise.
Impacts impacts(const Deformable& a, const Deformable& b, const ElementaryOptions& options = {},
                const Progress& progress = {});

/// Returns the earliest impact; of several at the same time, the first in the order of the list.
/// Returns nothing if there is none.
///
/// Accuracy    `time` is never later than the first contact. With an absolute error or a thickness,
///             the features may only be near each other at that time, within the tolerances that
///             ElementaryOptions describes.
/// Errors      Error{bad_argument} for the options.
/// Cost        mostly less than that of all impacts: each impact that is found shortens the time
///             that is searched. It is about that of all impacts where features hardly move.
std::optional<FeatureImpact> self_time_of_impact(const Deformable& surface,
                                                 const ElementaryOptions& options = {},
                                                 const Progress& progress = {});
std::optional<FeatureImpact> time_of_impact(const Deformable& a, const Deformable& b,
                                            const ElementaryOptions& options = {},
                                            const Progress& progress = {});

/// Returns whether there is no impact. Stops at the first one found. Errors as `self_impacts` and
/// `impacts`.
bool is_free_of_self_impacts(const Deformable& surface, const ElementaryOptions& options = {},
                             const Progress& progress = {});
bool is_free_of_impacts(const Deformable& a, const Deformable& b,
                        const ElementaryOptions& options = {}, const Progress& progress = {});

/// Finds every vertex and face, and every two edges, that are near each other at one end of the
/// step. Each pair is listed once, sorted by kind, face_first, a, b. Features that share a vertex
/// are not a pair.
///
/// In          distance: a length, at least 0. A pair is near if it is at most `distance` apart, plus
///             the sum of the thicknesses of both features (NearVertices).
/// Accuracy    the selection of pairs is exact for the given doubles; FeaturePair::limit is rounded
///             before it is compared. Distances are rounded, by less than 1e-12 of the features' size,
///             and never exceed the limit. The closest points lie on the features to rounding of
///             their coordinates. The normal is off by at most 1e-7 from a direction in which the
///             features are as far apart as their distance, if that is above 1e-9 of their size, or
///             1e-6 for nearly parallel edges and needles; in general position by some 1e-15 of the
///             size over the distance.
/// Errors      Error{bad_argument} if a length is negative or not finite, or if a span has another
///             number of entries than the surface has vertices. Error{interrupted} if the stop flag
///             is set.
/// Cost        parallel (`set_threads`). The least thickness of a vertex widens all boxes, and a
///             leaf's box is wider by what its thickest vertex has beyond that: one thick vertex
///             costs what is near it. The hierarchy's nodes are copied, in O(n), where vertices
///             differ in thickness or are marked as moved.
/// Source      representatives as [Curtis, Tamstorf, Manocha 2008]. Certified bounds of the distance
///             dismiss eight pairs at a time.
std::vector<FeaturePair> self_within(const Deformable& surface, double distance,
                                     const NearOptions& options = {});
/// As `self_within`, but between two surfaces. The features of `a` come first, except where
/// FeaturePair::face_first says otherwise.
std::vector<FeaturePair> within(const Deformable& a, const Deformable& b, double distance,
                                const NearOptions& options = {});

/// Finds every edge and face of one surface that share a point while the surface is at rest: where
/// it passes through itself. Each pair is listed once, sorted by face_first, edge, face. An edge
/// and a face that share a vertex are not a pair.
///
/// Degenerate  any triangles are allowed; see EdgeFaceContact. Two triangles that share an edge and
///             are folded flat onto each other have no pair. Any other two triangles that share a
///             point beside their common vertex have one.
/// Accuracy    which pairs, and how they meet, is exact for the given doubles. The point lies on
///             both to rounding, and within 2^-36 of the edge's length of the true one.
/// Errors      Error{interrupted} if the stop flag is set.
/// Cost        parallel (`set_threads`). O(n) for a copy of the positions, then the search.
/// Source      representatives as [Curtis, Tamstorf, Manocha 2008]: an edge is tested in the
///             triangle that represents it, so that no pair is tested twice.
std::vector<EdgeFaceIntersection> self_intersections(const Deformable& surface,
                                                     const IntersectionOptions& options = {});
/// As `self_intersections`, but between two surfaces.
std::vector<EdgeFaceIntersection> intersections(const Deformable& a, const Deformable& b,
                                                const IntersectionOptions& options = {});

} // namespace abut
