#pragma once

#include <abut/walk.h>

#include <array>
#include <cstdint>
#include <string>

namespace abut::viewer {

enum class Measured : std::uint8_t { points, point_part, parts };

/// "points", "point_part", "parts".
const char* to_string(Measured kind);

/// A place on a part.
struct PartPoint {
    WalkPart part;
    Vec3 point; ///< world
};

struct Measurement {
    std::string text;
    std::array<Vec3, 2> ends{}; ///< the witness points
};

/// Measures the exact distance of two parts, of a point and a part, or of two points, where the walk
/// has them. Where two parts meet, the text has the depth.
///
/// In          point_part: the point of a, the part of b.
Measurement measure(Walk& walk, Measured kind, const PartPoint& a, const PartPoint& b);

} // namespace abut::viewer
