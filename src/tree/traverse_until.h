#pragma once

#include "tree/traverse_overlaps.h"

#include <vector>

namespace abut {

/// Called for pairs of leaves whose boxes may overlap until a time that the visitor may lower.
class UntilVisitor : public OverlapVisitor {
public:
    /// Pairs that overlap only later than this need not be visited. From 0 at the start of the
    /// motion to 1 at its end. It may change between calls, and never grows.
    [[nodiscard]] virtual float until() const = 0;
};

/// Two children, and a time before which their boxes do not overlap.
struct TimedPair {
    OverlapTraversal::Pair pair;
    float first = 0;
};

/// Visits the pairs of leaves below `start` whose boxes overlap at the start of the motion. Adds
/// pairs of children that overlap only later to `later`. The remaining pairs of leaves lie below
/// those. If `later` is null or has grown large, these pairs of leaves are visited too. Returns
/// false if the visitor stopped it.
///
/// Accuracy    conservative: leaves that overlap until visitor.until() are visited, or lie below a
///             pair of `later`.
/// Cost        one SIMD pass for a box against eight.
bool traverse_until(const OverlapTraversal& traversal, const TimedPair& start,
                    UntilVisitor& visitor, std::vector<TimedPair>* later);

} // namespace abut
