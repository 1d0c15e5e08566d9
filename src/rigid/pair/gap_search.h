#pragma once

#include "rigid/pair/gap_frame.h"
#include "rigid/pair/placed_pair.h"

#include <cstdint>

namespace abut {

/// What a GapSearch asks of the search that it continues.
class GapVisitor : public LeafPairVisitor {
public:
    /// Whether pairs at least this far apart need no visit. `computed` and `sizes`: see certain_gap.
    [[nodiscard]] virtual bool is_beyond(double computed, double sizes) const = 0;
};

/// Visits the pairs of leaves of two models that the visitor does not find beyond its bound, with
/// bounds in double precision along the axes of a frame in the gap.
///
/// The traversals in single precision widen each box by some 3e-6 of the distance. Of surfaces that are
/// much farther apart than their triangles are wide, and nearly parallel, they hardly drop any pair.
/// Here the bounds of two leaves are right to rounding, so pairs are dropped that are farther apart by
/// more than rounding.
///
/// In          traversal: its bound and frame are not used; its steps and counters go on. If it runs
///             out of steps, left_sq is set.
/// Out         of triangles of one model with the same corners in the same order, only the one with the
///             least index is visited: a pile of copies is one triangle.
/// Accuracy    certified, as far as the visitor asks for it (certain_gap).
/// Cost        first about 50 ns a triangle for the boxes of both trees, and for each model once a sort
///             of its triangles; then depth first, the nearer child first, one box against eight in
///             double precision.
/// Source      refit of a hierarchy [van den Bergen 1997], into a frame that depends on the query.
Verdict search_gap(const PlacedPair& pair, const GapFrame& frame, PairTraversal& traversal,
                   GapVisitor& visitor);

} // namespace abut
