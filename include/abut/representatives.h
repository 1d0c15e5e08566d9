#pragma once

#include <abut/deformable.h>
#include <abut/rigid.h>
#include <abut/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

/// Representative triangles for a culling of your own: turns the triangle pairs that any tree, grid
/// or sweep has found into the feature pairs to be tested, each once. docs/any-culling.md shows it.
namespace abut {

/// A vertex and a face, or two edges, that are to be tested against each other.
struct FeatureTest {
    ElementaryKind kind = ElementaryKind::vertex_face;
    bool face_first = false; ///< as in FeatureImpact
    /// vertex_face: the vertex and the triangle. edge_edge: the two edges, as
    /// `Representatives::edges` numbers them; within one surface, a < b.
    std::uint32_t a = 0, b = 0;
    /// The features' vertices, in the order of ElementaryPair: the vertex, then the face's three;
    /// or the first edge's two, then the second edge's two.
    std::array<std::uint32_t, 4> vertices{};

    friend bool operator==(const FeatureTest&, const FeatureTest&) = default;
};

struct RepresentativesData;

/// The triangles of a surface, with exactly one of its triangles for every vertex and every edge:
/// the one that represents it.
///
/// Any number of threads may read it while no thread changes it. Movable, not copyable.
class Representatives {
public:
    /// Degenerate  any triangles are allowed, as in `Deformable`. A polygon soup, in which every
    ///             triangle has three vertices of its own, represents all its features in itself.
    /// Errors      Error{bad_mesh} if an index is not below `vertices`, or for more than 2^28
    ///             triangles or 2^32 - 1 vertices.
    /// Cost        O(n log n).
    explicit Representatives(std::size_t vertices,
                             std::vector<std::array<std::uint32_t, 3>> triangles,
                             Assignment assignment = Assignment::greedy);
    ~Representatives();
    Representatives(Representatives&&) noexcept;
    Representatives& operator=(Representatives&&) noexcept;

    /// Replaces the triangles, after cutting, fracture or remeshing, and forgets the motion. A
    /// triangle that keeps its index and its three vertices in the same order keeps its edges'
    /// numbers and the features that it represents.
    ///
    /// In          triangles: not part of `triangles()`, unless it is all of them.
    /// Errors      as the constructor; nothing has changed then.
    /// Cost        a comparison for each triangle; for each one that differs, proportional to the
    ///             number of triangles around its vertices.
    void set_triangles(std::size_t vertices,
                       std::span<const std::array<std::uint32_t, 3>> triangles);

    /// Sets the position of every vertex at the start and at the end of a step. From then on, only
    /// features are tested whose boxes come near each other. Without a motion, all are.
    ///
    /// Errors      Error{bad_argument} if the number of positions is not that of the vertices;
    ///             Error{bad_mesh} if a coordinate is not finite or beyond 1e18. Nothing has
    ///             changed then.
    /// Cost        O(n), parallel (`set_threads`).
    void set_motion(std::span<const Vec3> start, std::span<const Vec3> end);

    [[nodiscard]] std::size_t vertex_count() const noexcept;
    [[nodiscard]] const std::vector<std::array<std::uint32_t, 3>>& triangles() const noexcept;
    /// The vertices of each edge, the lower one first. An edge that no triangle has any more is
    /// (0xffffffff, 0xffffffff) until a new edge takes its number.
    [[nodiscard]] const std::vector<std::array<std::uint32_t, 2>>& edges() const noexcept;
    /// The features that each triangle represents: bit k for its vertex k, bit 3 + k for the edge
    /// from its vertex k to its vertex k + 1 (mod 3).
    [[nodiscard]] const std::vector<std::uint8_t>& represented() const noexcept;
    /// Memory, in bytes.
    [[nodiscard]] std::size_t bytes() const noexcept;
    [[nodiscard]] const RepresentativesData& data() const noexcept { return *data_; }

private:
    std::unique_ptr<RepresentativesData> data_;
};

/// Returns the tests to which pairs of triangles of one surface lead: those of the features that
/// the two triangles represent. Features that share a vertex are not tested.
///
/// In          pairs: triangles of the surface, each pair at most once, in either order; a triangle
///             with itself leads to nothing. margin: a length; features nearer than this are
///             tested too.
///             The tests are complete if `pairs` has all pairs of triangles that may come within
///             the margin of each other, also those that share a vertex. Pairs may be handed over
///             in several calls, from several threads.
/// Accuracy    conservative: no pair of features is left out that comes within the margin during
///             the step. Each pair of features occurs once in all calls together.
/// Errors      Error{bad_argument} if a triangle's index is out of range, or the margin negative or
///             not finite.
/// Cost        constant for each triangle pair.
/// Source      [Curtis, Tamstorf, Manocha 2008].
std::vector<FeatureTest> self_feature_tests(const Representatives& surface,
                                            std::span<const TrianglePair> pairs, double margin = 0);
/// As `self_feature_tests`, but between two surfaces: pairs of a triangle of `a` and one of `b`.
/// FeatureTest::vertices are those of the surface that the feature belongs to. Boxes of features
/// are used if both surfaces have a motion.
///
/// Errors      Error{bad_argument} also if both are the same object.
std::vector<FeatureTest> feature_tests(const Representatives& a, const Representatives& b,
                                       std::span<const TrianglePair> pairs, double margin = 0);

} // namespace abut
