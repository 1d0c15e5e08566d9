#pragma once

#include "math/vector.h"

#include <array>
#include <cstddef>
#include <optional>

namespace abut {

/// The segment in which two triangles in general position cross, as both faces' boundaries of their
/// common solid need it: directed so that, seen against the normal of face a, the inside of face b
/// lies to its left.
struct FaceCrossing {
    /// An end of the segment: an edge of one face meets the other face.
    struct End {
        Vec3 point;
        bool of_a = true;     ///< the edge belongs to face a
        std::size_t edge = 0; ///< from this corner to the next
        bool enters = true;   ///< the edge goes from the outer to the inner side of the other face
        double fraction = 0;  ///< of the edge, from that corner to the point
    };
    bool is_degenerate = false; ///< a corner in a plane, or an edge that meets an edge's line
    bool is_there = false;
    End start, stop;
};

/// Crosses two faces.
///
/// Accuracy    whether and where they cross is exact; points are on their edges to rounding, and
///             equal for two faces with a common edge.
FaceCrossing cross_faces(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b);

/// Returns +1 if a segment goes through a triangle from its outer to its inner side, -1 the other
/// way, 0 if it misses it; none if it meets an edge's line or ends in the plane. Exact.
std::optional<int> segment_crossing(const Vec3& from, const Vec3& to,
                                    const std::array<Vec3, 3>& triangle);

} // namespace abut
