#pragma once

#include <abut/types.h>

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace abut {

/// The pairs (i, j), i < j, of boxes at most `gap` apart on every axis, sorted, that `wanted(i, j)`
/// admits.
///
/// In          boxes; empty ones (lower > upper) meet nothing. `wanted` is called from any thread.
/// Accuracy    exact for the given doubles.
/// Cost        O(n log n + pairs); parallel over boxes.
std::vector<std::pair<std::uint32_t, std::uint32_t>>
overlapping_boxes(std::span<const Box3> boxes, double gap,
                  const std::function<bool(std::uint32_t, std::uint32_t)>& wanted);

} // namespace abut
