#pragma once

#include "math/vector.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <limits>
#include <span>

namespace abut {

/// A frame at a contact: the normal, which points from a to b, and two axes across it.
struct ContactFrame {
    Vec3 origin, across_x, across_y, normal;

    ContactFrame(const Vec3& origin_in_world, const Vec3& unit_normal);
    /// The same contact as b sees it: the normal reversed, and the other two axes exchanged.
    [[nodiscard]] ContactFrame turned_round() const;
    [[nodiscard]] Vec3 world(double x, double y, double height) const {
        return origin + (x * across_x + (y * across_y + height * normal));
    }
    /// A vector of the world in this frame; z is the height.
    [[nodiscard]] Vec3 coordinates(const Vec3& v) const {
        return {dot(v, across_x), dot(v, across_y), dot(v, normal)};
    }

private:
    ContactFrame() = default;
};

/// A place that may become a contact point: where a line along the normal leaves a and enters b.
struct ContactCandidate {
    double x = 0, y = 0;
    double height_a = 0, height_b = 0; ///< along the normal
    std::uint64_t feature = 0;

    [[nodiscard]] double depth() const { return height_a - height_b; }
};
using ContactCandidates = boost::container::small_vector<ContactCandidate, 8>;

/// Adds a candidate. Of candidates with the same name, the deepest remains.
inline void add_candidate(ContactCandidates& candidates, const ContactCandidate& candidate) {
    for (ContactCandidate& known : candidates)
        if (known.feature == candidate.feature) {
            if (candidate.depth() > known.depth())
                known = candidate;
            return;
        }
    // Member by member: a copy of the whole would wait for the stores of its parts.
    ContactCandidate& added = candidates.emplace_back();
    added.x = candidate.x, added.y = candidate.y;
    added.height_a = candidate.height_a, added.height_b = candidate.height_b;
    added.feature = candidate.feature;
}

/// How the two features of a contact point are named: two bits for the kind, 31 bits for the number
/// of each feature. A vertex against a face is named by the vertex alone, so that it keeps its name
/// when the face changes.
///
///      63..62  61..31  30..0
///       kind     a       b
enum class FeatureKind : std::uint8_t { vertices, vertex_of_a, vertex_of_b, edges };
inline std::uint64_t feature_name(FeatureKind kind, std::uint32_t of_a, std::uint32_t of_b) {
    constexpr std::uint32_t kNumber = (1U << 31) - 1;
    return std::uint64_t{static_cast<std::uint8_t>(kind)} << 62 |
           std::uint64_t{of_a & kNumber} << 31 | (of_b & kNumber);
}
/// The name of the same features where a and b are exchanged.
inline std::uint64_t turned_round(std::uint64_t feature) {
    constexpr std::uint64_t kNumber = (std::uint64_t{1} << 31) - 1;
    const auto kind = static_cast<FeatureKind>(feature >> 62);
    const FeatureKind turned = kind == FeatureKind::vertex_of_a   ? FeatureKind::vertex_of_b
                               : kind == FeatureKind::vertex_of_b ? FeatureKind::vertex_of_a
                                                                  : kind;
    return feature_name(turned, static_cast<std::uint32_t>(feature & kNumber),
                        static_cast<std::uint32_t>(feature >> 31 & kNumber));
}

/// A corner of a face in the contact frame.
struct FlatCorner {
    double x = 0, y = 0, height = 0;
    std::uint32_t vertex = 0; ///< the number of this vertex in the solid
    std::uint32_t edge = 0;   ///< the number of the edge from this corner to the next
};

/// Twice the area of the triangle of the edge from p to q and the point at x, y; positive on the left.
inline double left_of(const FlatCorner& p, const FlatCorner& q, double x, double y) {
    return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
}

/// The corner of a face that is nearest across the normal.
struct NearestCorner {
    std::uint32_t vertex = 0;
    double distance_sq = std::numeric_limits<double>::infinity();

    /// A corner that is at the place.
    explicit NearestCorner(const FlatCorner& corner) : vertex(corner.vertex), distance_sq(0) {}
    template <typename Face>
    NearestCorner(const Face& face, double x, double y) {
        for (const FlatCorner& corner : face) {
            // Values are chosen: a branch would be taken at random.
            const double dx = corner.x - x, dy = corner.y - y, sq = dx * dx + dy * dy;
            vertex = sq < distance_sq ? corner.vertex : vertex;
            distance_sq = std::min(sq, distance_sq);
        }
    }
};

/// A vertex within this share of the region's extent takes part in the name of a corner.
inline constexpr double kNamedShare = 0x1p-6;

/// The square of that distance, for a region between two corners of its bounding rectangle.
inline double name_reach_sq(double low_x, double low_y, double high_x, double high_y) {
    const double dx = high_x - low_x, dy = high_y - low_y;
    return kNamedShare * kNamedShare * (dx * dx + dy * dy);
}

/// The kind of name where the nearest vertices of both faces are as near as given, and `otherwise`
/// if neither is within reach.
inline FeatureKind kind_within(double reach_sq, const NearestCorner& a, const NearestCorner& b,
                               FeatureKind otherwise) {
    const bool near_a = a.distance_sq <= reach_sq, near_b = b.distance_sq <= reach_sq;
    return near_a && near_b ? FeatureKind::vertices
           : near_a         ? FeatureKind::vertex_of_a
           : near_b         ? FeatureKind::vertex_of_b
                            : otherwise;
}

/// The name of a place where an edge of a and an edge of b meet, or a vertex of one is on the
/// other.
inline std::uint64_t name_of(FeatureKind kind, const NearestCorner& a, const NearestCorner& b,
                             std::uint32_t edge_a, std::uint32_t edge_b) {
    switch (kind) {
    case FeatureKind::vertices:
        return feature_name(kind, a.vertex, b.vertex);
    case FeatureKind::vertex_of_a:
        return feature_name(kind, a.vertex, 0);
    case FeatureKind::vertex_of_b:
        return feature_name(kind, 0, b.vertex);
    default:
        return feature_name(kind, edge_a, edge_b);
    }
}

} // namespace abut
