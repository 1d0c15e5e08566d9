#pragma once

#include <abut/elementary_impact.h>

#include "geometry/elementary_block.h"

#include <cstdint>

namespace abut {

/// The lanes whose features may share a point, or come within `thickness` of each other: a bit each.
/// A lane without a bit is proven farther apart for all times in [0, 1].
///
/// In          finite coordinates of any size; the kind of all lanes; a thickness of at least 0.
/// Accuracy    certified: nothing is lost to rounding, overflow or underflow, with or without fused
///             operations.
/// Cost        some 8 ns a pair (AVX-512, a full block); 13 to 16 ns with a thickness.
/// Source      separating directions that hold at both ends, and so, the motion being linear,
///             always; signs of the Bernstein coefficients of the coplanarity cubic [Tang, Manocha,
///             Tong 2010], differs: with a bound of rounding, and a thickness.
std::uint32_t possible_impacts(const ElementaryBlock& block, ElementaryKind kind,
                               double thickness = 0);

/// The same of one pair, with the same answer.
bool possible_impact(const ElementaryPair& pair, double thickness = 0);

/// The same as for a block with one lane at a time: the reference for every SIMD target.
std::uint32_t possible_impacts_reference(const ElementaryBlock& block, ElementaryKind kind,
                                         double thickness = 0);

} // namespace abut
