#pragma once

#include <abut/elementary_impact.h>

#include "ccd/elementary_batch.h"

#include <cstdint>

namespace abut {

/// Returns a bit for each lane whose features may share a point, or come within `thickness` of each
/// other. A lane without a bit is proven to be farther apart at all times in [0, 1].
///
/// In          finite coordinates of any size; the kind of all lanes; a thickness of at least 0.
/// Accuracy    certified: rounding, overflow and underflow lose no pair, with or without fused
///             operations.
/// Cost        some 8 ns a pair (AVX-512, a full batch); 13 to 16 ns with a thickness.
/// Source      directions that separate at both ends separate always, because the motion is linear;
///             signs of the Bernstein coefficients of the coplanarity cubic [Tang, Manocha, Tong
///             2010]. Differs: with a rounding bound and a thickness.
std::uint32_t possible_impacts(const ElementaryBatch& batch, ElementaryKind kind,
                               double thickness = 0);

/// possible_impacts for one pair, with the same answer.
bool possible_impact(const ElementaryPair& pair, double thickness = 0);

/// possible_impacts with one lane at a time: the reference for every SIMD target.
std::uint32_t possible_impacts_reference(const ElementaryBatch& batch, ElementaryKind kind,
                                         double thickness = 0);

} // namespace abut
