#pragma once

#include "clash/building/building_source.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// How finely a page shows a part.
enum class PartDetail : std::uint8_t {
    clash, ///< it clashes: as it is
    near,  ///< near a clash: simplified by millimetres
    rest,  ///< simplified by centimetres
};
inline constexpr std::size_t kPartDetails = 3;

struct ShownPart {
    std::uint32_t part = 0; ///< index in BuildingSource::parts()
    PartDetail detail = PartDetail::rest;
};

/// Chooses the parts that a page shows: all that clash, then the parts near a clash, then the
/// largest of the others.
///
/// In          clashing: indices of parts. points: witness points of the clashes. most: number of
///             parts to return, unless more of them clash.
/// Out         sorted by detail, then by part. Parts without triangles are left out.
/// Cost        O(n log n) in parts and points.
std::vector<ShownPart> choose_parts(const BuildingSource& source,
                                    std::span<const std::uint32_t> clashing,
                                    std::span<const Vec3> points, std::size_t most);

} // namespace abut
