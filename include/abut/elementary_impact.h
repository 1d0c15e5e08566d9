#pragma once

#include <abut/progress.h>
#include <abut/types.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// When do two moving features first meet: a vertex and a face, or two edges? The tests that
/// continuous collision detection of deforming surfaces is made of. docs/elementary-tests.md tells
/// how they are decided.
namespace abut {

enum class ElementaryKind : std::uint8_t { vertex_face, edge_edge };

/// Two features whose vertices move in straight lines at constant speed while t goes from 0 to 1:
///
///     x_i(t) = (1 - t) start[i] + t end[i]
///
/// vertex_face: the vertex, then the three of the face. edge_edge: the two of the first edge, then
/// the two of the second. All in one frame.
struct ElementaryPair {
    ElementaryKind kind = ElementaryKind::vertex_face;
    std::array<Vec3, 4> start, end;
};

struct ElementaryOptions {
    /// Length. 0: exact. Else conservative: a pair that shares a point at some time is reported,
    /// always; one that does not may be reported too if it comes as near as this (with status
    /// `bound_only`). It spares exact arithmetic; it is no thickness.
    double absolute_error = 0;
    /// Length. Above 0: a pair is an impact when the features are at most this far apart. None that
    /// comes so near is missed. One that is reported is so near at `time` too, but for
    /// max(1e-6 thickness, absolute_error, 6e-12 size), where the size is the largest coordinate of a vector
    /// between two of the vertices, at t = 0 or 1.
    double thickness = 0;
};

/// Who decided a test: each stage passes on only what it cannot decide.
enum class ElementaryStage : std::uint8_t {
    filter,   ///< separating directions and signs of the coplanarity cubic, many pairs at once
    interval, ///< enclosures of the cubic's roots, or steps of time, in double precision
    exact,    ///< integer arithmetic
};

struct ElementaryImpact {
    /// Whether the closed features share a point at some time in [0, 1], or are at most the
    /// thickness apart. Touching counts.
    bool meet = false;
    ElementaryStage decided_by = ElementaryStage::filter;
    /// exact: `meet` is right. bound_only: at `time` the features are at most the error allowed apart, and whether
    /// they touch was not decided. With a thickness, of a hit: converged, the features are at most
    /// (1 + 1e-6) thickness apart at `time`; bound_only, they may be farther apart, see
    /// ElementaryOptions.
    Status status = Status::exact;
    /// In [0, 1]. Never later than the first time at which they share a point, or are at most the
    /// thickness apart; without a thickness, less than 1e-9 before it where `status` is exact. 1
    /// where there is no hit.
    double time = 1;
    /// Where they meet, or are nearest. vertex_face: weights of the face's vertices. edge_edge:
    /// parameters from 0 (first vertex) to 1 along the first and the second edge, then 0.
    std::array<double, 3> barycentric{};
    /// Unit normal of the face, or of both edges, at `time`, from the second feature towards the
    /// first: on the side from which the first comes. With a thickness, along the closest points.
    Vec3 normal;
};

/// The first time at which two moving features share a point, or come within a thickness.
///
/// Degenerate  all of it is decided as the sets of points are at each time: faces that collapse to
///             segments or points (for a moment or always), edges without length, parallel edges,
///             motion within one plane, no motion at all. Where the features span no plane at
///             the time of impact, the normal is the relative velocity's part across their line,
///             reversed; zero where there is none.
/// Accuracy    `meet`: exact for the coordinates given, whatever their size, unless an error allowed says
///             otherwise. `time`: as said above. `barycentric` and `normal`: to rounding for
///             features in general position; not bounded near degenerate ones. The normal's side is
///             that from which the first feature comes if they approach; if they meet without
///             approaching (they slide, or do not move), either.
/// Errors      Error{bad_argument} if a coordinate is not finite, or the error allowed or the thickness is
///             negative or not finite.
/// Cost        some 30 ns where the filter decides, 250 ns for an impact in general position, 5 to
///             25 us where exact arithmetic decides. With a thickness: 300 to 700 ns where the
///             filter does not decide; some microseconds where the features graze.
/// Source      the coplanarity cubic of [Provot 1997]; its Bernstein signs as a filter [Tang,
///             Manocha, Tong 2010]; differs: every sign is certified, what is not goes to algebraic
///             numbers in integer arithmetic.
ElementaryImpact elementary_impact(const ElementaryPair& pair,
                                   const ElementaryOptions& options = {});

/// Many pairs, in parallel (`set_threads`); results in their order, the same as one by one.
///
/// Errors      those of the single test, for the first pair that has one; its message begins with
///             "pair N: ", N counted from 0. Error{interrupted} if the stop flag is set.
/// Cost        of a pair that the filter decides, some nanoseconds: eight are tested at once.
std::vector<ElementaryImpact> elementary_impacts(std::span<const ElementaryPair> pairs,
                                                 const ElementaryOptions& options = {},
                                                 const Progress& progress = {});

/// Pairs of a file, and whether they meet according to it.
struct ElementaryQueries {
    std::vector<ElementaryPair> pairs;
    std::vector<bool> truth; ///< of each pair; empty if the file has no such column
};

/// Reads pairs from comma-separated text: eight rows a pair, one a vertex in the order of
/// ElementaryPair, at t = 0 and again at t = 1. A row is x, y, z as numerator and denominator each,
/// and may end with the truth, 0 or 1, the same in all eight.
///
/// In          the kind; if none is given, the one that the file's name has in it ("vertex-face"
///             or "vf", "edge-edge" or "ee").
/// Errors      Error naming file and line: file_not_found, unreadable, malformed (a value that is
///             no number or no double, a zero denominator, columns or rows missing), bad_argument
///             (no kind).
ElementaryQueries read_elementary_queries(const std::string& file,
                                          std::optional<ElementaryKind> kind = std::nullopt);

} // namespace abut
