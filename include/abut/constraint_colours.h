#pragma once

#include <abut/deformable.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// Groups of constraints that may be solved at the same time, because no two of a group move the same
/// vertex. docs/constraint-colours.md shows their use.
namespace abut {

/// A partition of constraints into colours.
struct ConstraintColours {
    /// The constraints' numbers: those of the first colour, then those of the second, and so on.
    /// Ascending within a colour.
    std::vector<std::uint32_t> order;
    /// Colour i is order[begins[i]] to order[begins[i + 1]], the latter not included. The last entry
    /// is order.size().
    std::vector<std::uint32_t> begins{0};

    [[nodiscard]] std::size_t count() const noexcept { return begins.size() - 1; }
    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t colour) const {
        return std::span(order).subspan(begins[colour], begins[colour + 1] - begins[colour]);
    }

    friend bool operator==(const ConstraintColours&, const ConstraintColours&) = default;
};

/// Colours constraints on two, three or four vertices each, such as `Deformable::edges` or the
/// `vertices` of contacts. No two constraints of a colour share a vertex.
///
/// In          constraints: the numbers of their vertices. A constraint may repeat a vertex. fixed: an
///             entry for each vertex, not 0 for those that no constraint moves; constraints that
///             share only such vertices may have one colour. If it is empty, no vertex is fixed.
/// Accuracy    each constraint takes the first colour that no earlier one at its vertices has. So if
///             at most d constraints have a vertex in common, there are at most k (d - 1) + 1 colours
///             of constraints on k vertices, and never fewer than d. The answer is always the same.
/// Errors      Error{bad_argument} if there are 2^32 constraints or more, if `fixed` is not empty and
///             a vertex has no entry in it, or if a vertex is 2^31 or more.
/// Cost        O(n) for every 64 colours. The memory is 8 bytes for each vertex up to the largest one.
/// Source      greedy colouring, here with a word of bits for each vertex.
ConstraintColours colour_constraints(std::span<const std::array<std::uint32_t, 2>> constraints,
                                     std::span<const std::uint8_t> fixed = {});
ConstraintColours colour_constraints(std::span<const std::array<std::uint32_t, 3>> constraints,
                                     std::span<const std::uint8_t> fixed = {});
ConstraintColours colour_constraints(std::span<const std::array<std::uint32_t, 4>> constraints,
                                     std::span<const std::uint8_t> fixed = {});

/// Colours pairs of near features of one surface, from `self_within`.
///
/// In          fixed, errors, accuracy and cost as above.
ConstraintColours colour_constraints(std::span<const FeaturePair> pairs,
                                     std::span<const std::uint8_t> fixed = {});
/// Colours pairs of near features of two surfaces a and b, from `within`.
///
/// In          vertices_a: the number of a's vertices. fixed: an entry for each vertex of a, then for
///             each vertex of b; or empty.
/// Errors      as above; Error{bad_argument} also if a pair has a vertex of a beyond them.
ConstraintColours colour_constraints(std::span<const FeaturePair> pairs, std::size_t vertices_a,
                                     std::span<const std::uint8_t> fixed = {});

} // namespace abut
