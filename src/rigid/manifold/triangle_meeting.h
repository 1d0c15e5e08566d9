#pragma once

#include "rigid/manifold/manifold_side.h"
#include "rigid/pair/contacts.h"

#include <boost/container/static_vector.hpp>
#include <cstdint>
#include <vector>

namespace abut {

/// A possible contact point whose depth is known.
struct FixedPoint {
    Vec3 a, b; ///< on the two surfaces
    std::uint64_t feature = 0;
};

/// A triangle that meets others.
struct MeetingFace {
    Triangle corners;
    std::array<std::uint32_t, 3> vertices{}; ///< merged, as ManifoldSide::vertices
    Vec3 normal;                             ///< outward; its length is twice the area
    Vec3 unit_normal;                        ///< zero without area
};

/// Two triangles that meet, or that are within the margin.
///
/// Frame       that of the sides.
struct TriangleMeeting {
    TrianglePair pair;
    TriangleContact kind = TriangleContact::none; ///< none: they are only near
    std::uint32_t region = 0;
    std::uint32_t face_a = 0, face_b = 0; ///< in TriangleMeetings::faces
    /// Fixed points, of pairs that touch or are apart by little more than rounding.
    std::uint32_t first_point = 0, point_count = 0;
    Vec3 normal_a, normal_b; ///< outward unit normals; zero without area
    /// Crossing: the common segment, along normal_a x normal_b; one of its points, twice, if the
    /// triangles are coplanar to rounding. Touching: one common point, twice. Near: the nearest
    /// points of a and of b.
    Vec3 from, to;
    /// A length: of the segment; of the common area's border; what the gap lacks to the margin. Not
    /// 0 for near triangles.
    double weight = 0;
    /// Faces that lie on each other, to rounding: the area they share times the normal, from a to b.
    Vec3 common_area;
    /// Touching, or apart by little more than rounding: the direction across the features that touch. Zero
    /// if these leave it open.
    Vec3 across;
    bool is_slight = false; ///< near, and the gap is so short that rounding tilts it
    /// Near, and the gap is straight across a normal, of open surfaces across both: that of a face
    /// around the corner.
    bool is_beside = false;

    /// Whether the triangles are apart by more than rounding.
    [[nodiscard]] bool is_gap() const { return kind == TriangleContact::none && !is_slight; }
};

/// The meetings of two sides and their points, sorted by pair.
struct TriangleMeetings {
    std::vector<TriangleMeeting> all;
    std::vector<FixedPoint> points;
    std::vector<MeetingFace> faces; ///< of both sides; a triangle may be there several times
    /// The nearest pair that is only near, also if its faces look away; its squared distance, infinite
    /// if there is none.
    TrianglePair nearest;
    double nearest_sq = 0;
};

/// Names of contact points.
namespace point_name {
inline constexpr std::uint64_t kMiddle = 1; ///< of the region
constexpr std::uint64_t vertex_a(std::uint32_t vertex) {
    return std::uint64_t{1} << 62U | vertex;
}
constexpr std::uint64_t vertex_b(std::uint32_t vertex) {
    return std::uint64_t{2} << 62U | vertex;
}
/// In          corner: of the polygon that two triangles share, 0 to 5.
constexpr std::uint64_t triangles(const TrianglePair& pair, std::uint32_t corner = 0) {
    return std::uint64_t{3} << 62U | std::uint64_t{corner} << 59U |
           std::uint64_t{pair.a & 0x1fffffffU} << 30U | (pair.b & 0x3fffffffU);
}
} // namespace point_name

/// The pairs of triangles of which a manifold is made.
struct MeetingPairs {
    std::vector<Contact> meeting;   ///< sorted
    std::vector<TrianglePair> near; ///< all others within the margin; some are a little beyond it
};

/// Finds the triangle pairs of two placed models that meet or are at most `margin` apart.
///
/// Cost        of the pairs that are near, their bounds in single precision.
MeetingPairs meeting_pairs(const PlacedPair& pair, double margin);

/// Computes where the pairs meet. Those that meet, or are apart by no more than rounding, come first.
///
/// In          a, b: the sides of the placed pair.
/// Cost        of a pair that is only near, one lane of eight that are measured at once.
void describe_meetings(const PlacedPair& placed, const ManifoldSide& a, const ManifoldSide& b,
                       const MeetingPairs& pairs, double margin, TriangleMeetings& meetings);

/// Places where a pair of triangles that are only near may have a contact point.
using NearPoints = boost::container::static_vector<FixedPoint, 7>;

/// The nearest points of the triangles, if they lie on no vertex, and those of each vertex within the
/// margin.
NearPoints near_points(const TriangleMeeting& m, const TriangleMeetings& meetings, double margin);

/// As near_points, on lines along a normal: a vertex and the place of the other triangle that lies over it,
/// or the nearest points where the gap is along the normal.
///
/// In          rounding: of positions.
NearPoints points_along(const TriangleMeeting& m, const TriangleMeetings& meetings,
                        const Vec3& normal, double margin, double rounding);

} // namespace abut
