#pragma once

#include "math/vector.h"
#include "world/contacts/contact_face.h"

#include <boost/container/small_vector.hpp>
#include <cstdint>
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

/// How the two features of a contact point are named: two bits for the kind, 31 bits for the number
/// of each feature. A vertex against a face is named by the vertex alone, so that it keeps its name
/// when the face changes.
///
///      63..62  61..31  30..0
///       kind     a       b
enum class FeatureKind : std::uint8_t { vertices, vertex_of_a, vertex_of_b, edges };
std::uint64_t feature_name(FeatureKind kind, std::uint32_t of_a, std::uint32_t of_b);
/// The name of the same features where a and b are exchanged.
std::uint64_t turned_round(std::uint64_t feature);

/// Adds the corners of the region in which two faces lie over each other along the normal. Their
/// names differ: of corners with the same name, the deepest remains. None if the faces do not
/// overlap, if they are two crossing segments, or if neither is a polygon and one is a point.
///
/// In          faces relative to the frame's origin; no candidates yet.
/// Names       a corner is named by the two features that cross there. Vertices within 1/64 of the
///             region's extent take part in the name, so that the name also stays where vertices
///             and edges of both bodies lie over each other, up to small motions.
/// Cost        proportional to the product of the faces' numbers of corners.
/// Source      [Sutherland, Hodgman 1974]; a segment by [Cyrus, Beck 1978].
void add_overlap_corners(const ContactFace& a, const ContactFace& b, const ContactFrame& frame,
                         ContactCandidates& candidates);

/// Keeps at most four candidates, as four_points says: the deepest first.
void keep_four(ContactCandidates& candidates, double rounding = 0,
               std::span<const std::uint64_t> last = {});

} // namespace abut
