#pragma once

#include <abut/elementary_impact.h>

namespace abut {

/// `elementary_impact` of any pair, in integer arithmetic: for pairs that no filter decides.
///
/// Accuracy    `meet` is exact; `time` is less than 2^-44 below the first impact.
/// Cost        5 to 25 us where coordinates are of one magnitude; grows with the square of the
///             range of their exponents.
/// Source      see docs/elementary-tests.md.
ElementaryImpact elementary_impact_exact(const ElementaryPair& pair);

} // namespace abut
