#pragma once

#include <abut/progress.h>
#include <abut/types.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Finds when two moving features first meet: a vertex and a face, or two edges. Continuous
/// collision detection of deforming surfaces consists of such tests. docs/elementary-tests.md
/// explains them.
namespace abut {

enum class ElementaryKind : std::uint8_t { vertex_face, edge_edge };

/// Two features whose vertices move in straight lines at constant speed while t goes from 0 to 1:
///
///     x_i(t) = (1 - t) start[i] + t end[i]
///
/// vertex_face: the vertex, then the three vertices of the face. edge_edge: the two vertices of the
/// first edge, then those of the second. All positions are in one frame.
struct ElementaryPair {
    ElementaryKind kind = ElementaryKind::vertex_face;
    std::array<Vec3, 4> start, end;
};

struct ElementaryOptions {
    /// Length. 0: the answer is exact. Above 0: the answer is conservative. A pair that shares a
    /// point at some time is always reported. A pair that comes at least as near as this may be
    /// reported without contact, with status `bound_only`. This saves exact arithmetic; it is not a
    /// thickness.
    double absolute_error = 0;
    /// Length. Above 0: a pair is an impact if the features come at most this far apart. No such
    /// pair is missed. At `time`, the features of a reported pair are that near, with an excess of
    /// at most max(1e-6 thickness, absolute_error, 6e-12 size). The size is the largest coordinate
    /// of a vector between two of the vertices, at t = 0 or 1.
    double thickness = 0;
};

/// The stage that decided a test. Each stage passes on only the tests that it cannot decide.
enum class ElementaryStage : std::uint8_t {
    filter,   ///< separating directions and signs of the coplanarity cubic, many pairs at once
    interval, ///< enclosures of the cubic's roots, or steps in time, in double precision
    exact,    ///< integer arithmetic
};

struct ElementaryImpact {
    /// Whether the closed features share a point at some time in [0, 1], or come within the
    /// thickness. Touching counts.
    bool meet = false;
    ElementaryStage decided_by = ElementaryStage::filter;
    /// exact: `meet` is right. bound_only: at `time` the features are at most absolute_error apart,
    /// and whether they touch was not decided. If a pair meets within a thickness: converged means
    /// that the features are at most (1 + 1e-6) thickness apart at `time`; bound_only means that
    /// they may be farther apart, see ElementaryOptions.
    Status status = Status::exact;
    /// In [0, 1]. Never later than the first time at which the features share a point or come
    /// within the thickness. Without a thickness it is less than 1e-9 before that time where
    /// `status` is exact. 1 if the features do not meet.
    double time = 1;
    /// The place where the features meet or are nearest. vertex_face: weights of the face's
    /// vertices. edge_edge: a parameter from 0 (first vertex) to 1 along the first edge, one along
    /// the second edge, then 0.
    std::array<double, 3> barycentric{};
    /// Unit normal of the face, or of both edges, at `time`. It points from the second feature to
    /// the side from which the first comes. With a thickness, it lies along the closest points.
    Vec3 normal;
};

/// Finds the first time at which two moving features share a point, or come within a thickness.
///
/// Degenerate  each feature is, at each time, the set of its points. This covers faces that
///             collapse to segments or points (for a moment or always), edges without length,
///             parallel edges, motion within one plane, and no motion. Where the features span no
///             plane at the time of impact, the normal is the reversed part of the relative
///             velocity across their line, or zero where there is none.
/// Accuracy    `meet`: exact for the given coordinates, whatever their size, unless absolute_error
///             allows otherwise. `time`: see ElementaryImpact::time. `barycentric` and `normal`: to
///             rounding for features in general position; not bounded near degenerate ones. The
///             normal is on the side from which the first feature comes if the features approach.
///             If they meet without approaching (they slide, or do not move), it may be on either
///             side.
/// Errors      Error{bad_argument} if a coordinate is not finite, or if absolute_error or the
///             thickness is negative or not finite.
/// Cost        about 30 ns where the filter decides, 250 ns for an impact in general position, 5 to
///             25 us where exact arithmetic decides. With a thickness: 300 to 700 ns where the
///             filter does not decide; some microseconds where the features graze.
/// Source      the coplanarity cubic of [Provot 1997]; its Bernstein signs as a filter [Tang,
///             Manocha, Tong 2010]. Differs: every sign is certified; algebraic numbers in integer
///             arithmetic decide the rest.
ElementaryImpact elementary_impact(const ElementaryPair& pair,
                                   const ElementaryOptions& options = {});

/// Tests many pairs, in parallel (`set_threads`). The results are in the order of the pairs and
/// equal those of single tests.
///
/// Errors      those of the single test, for the first pair that has one; the message begins with
///             "pair N: ", with N counted from 0. Error{interrupted} if the stop flag is set.
/// Cost        some nanoseconds for a pair that the filter decides: it tests eight pairs at a time.
std::vector<ElementaryImpact> elementary_impacts(std::span<const ElementaryPair> pairs,
                                                 const ElementaryOptions& options = {},
                                                 const Progress& progress = {});

/// The pairs in a file, and the file's own answers.
struct ElementaryQueries {
    std::vector<ElementaryPair> pairs;
    std::vector<bool> truth; ///< whether each pair meets; empty if the file has no such column
};

/// Reads pairs from comma-separated text. Each pair takes eight rows, one for each vertex in the
/// order of ElementaryPair, at t = 0 and then at t = 1. A row holds x, y and z, each as numerator
/// and denominator. It may end with the truth, 0 or 1, which is equal in all eight rows.
///
/// In          kind: if it is not given, the file's name tells it ("vertex-face" or "vf",
///             "edge-edge" or "ee").
/// Errors      Error, naming file and line: file_not_found, unreadable, malformed (a value that is
///             not a number or not a double, a zero denominator, missing columns or rows),
///             bad_argument (the kind is unknown).
ElementaryQueries read_elementary_queries(const std::string& file,
                                          std::optional<ElementaryKind> kind = std::nullopt);

} // namespace abut
