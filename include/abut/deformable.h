#pragma once

#include <abut/elementary_impact.h>
#include <abut/mesh.h>
#include <abut/progress.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

/// Continuous collision detection of deforming surfaces: which vertices and faces, and which edges,
/// meet while the vertices move, and when. docs/representative-triangles.md tells how they are
/// found.
namespace abut {

/// Which one of its triangles represents a vertex or an edge.
enum class Assignment : std::uint8_t {
    greedy,              ///< the first one in the mesh's order
    maximal,             ///< few triangles represent much: the others need no tests of their own
    uniform_vertex_edge, ///< all triangles represent about as many vertices and edges
    uniform_edge_edge,   ///< all triangles represent about as many edges, and as many vertices
    adaptive, ///< greedy, until `Deformable::adapt` moves features off triangles that collide
};

/// How pairs of triangles that may meet become tests of features.
enum class Scheme : std::uint8_t {
    representative, ///< tests of the features that both represent, if the features' boxes overlap
    database, ///< all 15 tests whose features' boxes overlap and that a hash table has not yet seen
    markup,   ///< tests of the features that both represent, without boxes of features
    basic,    ///< all 15 tests
    features, ///< no triangle pairs: trees over vertices, edges and faces of their own
};

/// How pairs of triangles that may meet are found.
enum class Culling : std::uint8_t {
    tree,  ///< bounding-volume hierarchy
    grid,  ///< uniform grid
    sweep, ///< sweep and prune along one axis
};

struct DeformableOptions {
    Scheme scheme = Scheme::representative;
    Assignment assignment = Assignment::greedy;
    Culling culling = Culling::tree;
};

/// Two features that meet.
struct FeatureImpact {
    ElementaryKind kind = ElementaryKind::vertex_face;
    Status status = Status::exact; ///< as in ElementaryImpact
    /// vertex_face between two surfaces: the face is the first surface's, the vertex the second's.
    bool face_first = false;
    /// vertex_face: vertex and triangle. edge_edge: edges, as numbered by `Deformable::edges`; of
    /// one surface, a < b.
    std::uint32_t a = 0, b = 0;
    double time = 1;                     ///< as in ElementaryImpact
    std::array<double, 3> barycentric{}; ///< as in ElementaryImpact
    Vec3 normal;                         ///< as in ElementaryImpact: from b towards a

    friend bool operator==(const FeatureImpact&, const FeatureImpact&) = default;
};

/// A number for each kind of test.
struct TestCounts {
    std::uint64_t vertex_face = 0, edge_edge = 0;
    friend bool operator==(const TestCounts&, const TestCounts&) = default;
};

/// Work that a query did: the machine-independent part of its cost. The same for any number of
/// threads.
struct DeformableCounters {
    std::uint64_t triangle_pairs = 0; ///< whose boxes overlap, each once, but for those that flat
                                      ///< regions spare; 0 where the scheme looks at none
    TestCounts candidates; ///< feature pairs that the scheme wants tested: without adjacent ones
    TestCounts elementary_tests;       ///< of these, those for whose roots was looked: that neither
                                       ///< directions nor signs of the cubic have told apart
    std::uint64_t exact_fallbacks = 0; ///< of these, those that integers had to decide

    friend bool operator==(const DeformableCounters&, const DeformableCounters&) = default;
};

struct Impacts {
    /// Sorted by kind, face_first, a, b; each pair of features once.
    std::vector<FeatureImpact> list;
    DeformableCounters counters;
};

/// Two features at rest that are near each other.
struct FeaturePair {
    ElementaryKind kind = ElementaryKind::vertex_face;
    bool face_first = false;    ///< as in FeatureImpact
    std::uint32_t a = 0, b = 0; ///< as in FeatureImpact
    double distance = 0;
    std::array<double, 3> barycentric{}; ///< of the closest points, as in FeatureImpact

    friend bool operator==(const FeaturePair&, const FeaturePair&) = default;
};

class DeformableData;

/// A triangle mesh whose vertices move from step to step, with all that its queries need. During a
/// step every vertex goes from its start to its end in a straight line while t goes from 0 to 1.
///
/// Any number of threads may query it; none may change it meanwhile. Movable, not copyable.
class Deformable {
public:
    /// The mesh at rest: its positions are start and end.
    ///
    /// Degenerate  any triangles, also with equal vertices or a repeated index; duplicate vertices are
    ///             vertices of their own, and features that share no index are tested. Vertices
    ///             that no triangle uses take no part.
    /// Errors      Error{bad_mesh} as `Model`.
    /// Cost        O(n log n).
    explicit Deformable(Mesh mesh, const DeformableOptions& options = {});
    ~Deformable();
    Deformable(Deformable&&) noexcept;
    Deformable& operator=(Deformable&&) noexcept;

    /// Sets the step: where every vertex is at t = 0 and at t = 1. Refits the hierarchy, and builds it
    /// anew where its boxes have become bad.
    ///
    /// Errors      Error{bad_argument} if there are not as many positions as vertices; Error{bad_mesh} if
    ///             a coordinate is not finite or beyond 1e18. Nothing has changed then.
    /// Cost        O(n), in parallel; O(n log n) where the hierarchy is built anew.
    void set_motion(std::span<const Vec3> start, std::span<const Vec3> end);
    /// The next step: what was the end is the start. Errors and cost as set_motion.
    void advance(std::span<const Vec3> end);
    /// The same; the memory of the positions is free before the hierarchy is fitted.
    void advance(std::vector<Vec3>&& end);

    /// Takes another mesh, at rest: cutting, fracture, remeshing. What is represented by a triangle
    /// that has the same three vertices in the same order at the same index stays so.
    ///
    /// Errors      Error{bad_mesh} as the constructor; nothing has changed then.
    /// Cost        O(n log n).
    void set_mesh(Mesh mesh);

    /// Moves the vertices and edges of triangles that met something to other triangles of theirs that
    /// did not. For Assignment::adaptive, from time to time; changes no answer.
    ///
    /// In          `self_impacts` of this surface, as its triangles are.
    /// Cost        O(n log n).
    void adapt(const Impacts& impacts);

    [[nodiscard]] std::size_t vertex_count() const noexcept;
    [[nodiscard]] const std::vector<std::array<std::uint32_t, 3>>& triangles() const noexcept;
    /// Every pair of vertices that a triangle joins, once, the lower first; sorted by the higher,
    /// then by the lower.
    [[nodiscard]] const std::vector<std::array<std::uint32_t, 2>>& edges() const noexcept;
    /// Memory, in bytes.
    [[nodiscard]] std::size_t bytes() const noexcept;
    [[nodiscard]] const DeformableData& data() const noexcept { return *data_; }

private:
    std::unique_ptr<DeformableData> data_;
};

/// Every vertex and face, and every two edges, of one surface that meet during the step, each once.
/// Features that share a vertex are no pair.
///
/// In          options: exact by default; see ElementaryOptions.
/// Accuracy    complete, and exact where the options say so: decided as `elementary_impact` does.
/// Errors      Error{bad_argument} for the options, as `elementary_impact`; or if the schemes or
///             cullings of two surfaces differ. Error{interrupted} if the stop flag is set, as
///             of all queries below.
/// Cost        in parallel (`set_threads`); no list of candidates is ever made.
/// Source      [Curtis, Tamstorf, Manocha 2008]. Differs: leaves of several triangles test the boxes of all
///             the features that they represent, one against many in SIMD; certified filters follow at
///             once, eight pairs at a time.
Impacts self_impacts(const Deformable& surface, const ElementaryOptions& options = {},
                     const Progress& progress = {});
/// The same between two surfaces: a's features come first, but for FeatureImpact::face_first.
Impacts impacts(const Deformable& a, const Deformable& b, const ElementaryOptions& options = {},
                const Progress& progress = {});

/// The earliest of them; of several at the same time, the first of the list. Nothing if there is none.
///
/// Accuracy    `time` is never later than the first contact. With an error allowed or a thickness, some other
///             of the list may have an earlier `time`, at which it is only near within the tolerances
///             that ElementaryOptions tells.
/// Errors      Error{bad_argument} for the options.
/// Cost        less than all impacts: times are searched in growing windows, and only what moves into
///             each other within a window is looked at.
std::optional<FeatureImpact> self_time_of_impact(const Deformable& surface,
                                                 const ElementaryOptions& options = {},
                                                 const Progress& progress = {});
std::optional<FeatureImpact> time_of_impact(const Deformable& a, const Deformable& b,
                                            const ElementaryOptions& options = {},
                                            const Progress& progress = {});

/// Whether there is none: stops at the first that is found. Errors as those of `self_impacts` and
/// `impacts`.
bool is_free_of_self_impacts(const Deformable& surface, const ElementaryOptions& options = {},
                             const Progress& progress = {});
bool is_free_of_impacts(const Deformable& a, const Deformable& b,
                        const ElementaryOptions& options = {}, const Progress& progress = {});

/// Every vertex and face, and every two edges, that are at most `distance` apart at the start of
/// the step, each once, sorted; features that share a vertex are no pair.
///
/// In          a length, at least 0.
/// Accuracy    which pairs are listed is exact for the given doubles. Their distances are rounded,
///             by less than 1e-12 of the features' size, and not above `distance`.
/// Errors      Error{bad_argument} if the distance is negative or not finite.
std::vector<FeaturePair> self_within(const Deformable& surface, double distance,
                                     const Progress& progress = {});
std::vector<FeaturePair> within(const Deformable& a, const Deformable& b, double distance,
                                const Progress& progress = {});

} // namespace abut
