#include "world/contacts/solid_contacts.h"

#include "geometry/least_box_overlap.h"
#include "world/solids/box_pair.h"
#include "world/solids/capsule_pair.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// The vertex of a face that is farthest along a direction.
const ContactFace::Corner& farthest_corner(const ContactFace& face, const Vec3& direction) {
    return *std::max_element(face.corners.begin(), face.corners.end(),
                             [&](const ContactFace::Corner& p, const ContactFace::Corner& q) {
                                 return dot(p.at, direction) < dot(q.at, direction);
                             });
}

/// Names the witness points: by the edges if both faces are segments, else by the vertices that are
/// farthest along the normal; beside a polygon by that of a segment or point alone, as add_overlap_corners
/// does.
std::uint64_t witness_name(const ContactFace& a, const ContactFace& b, const Vec3& normal) {
    const ContactFace::Corner &of_a = farthest_corner(a, normal),
                              &of_b = farthest_corner(b, -normal);
    const std::size_t of_face_a = std::min<std::size_t>(a.corners.size(), 3),
                      of_face_b = std::min<std::size_t>(b.corners.size(), 3);
    if (of_face_a == 2 && of_face_b == 2)
        return feature_name(FeatureKind::edges, of_a.edge, of_b.edge);
    if (of_face_a != of_face_b)
        return of_face_a < of_face_b ? feature_name(FeatureKind::vertex_of_a, of_a.vertex, 0)
                                     : feature_name(FeatureKind::vertex_of_b, 0, of_b.vertex);
    return feature_name(FeatureKind::vertices, of_a.vertex, of_b.vertex);
}

double size_of(const RoundedBox& box) {
    return box.half[0] + box.half[1] + box.half[2] + box.radius;
}

bool has_no_extent(const RoundedBox& box) {
    return box.half[0] == 0 && box.half[1] == 0 && box.half[2] == 0;
}

/// The contact along the direction of the distance or of the shortest separating motion.
bool contact_by_distance(const RoundedBox& a, const RoundedBox& b, const ContactLimits& limits,
                         std::vector<ContactManifold>& manifolds) {
    const SolidGap gap =
        rounded_box_distance(a, b, std::nextafter(limits.margin + limits.rounding, HUGE_VAL));
    if (gap.distance > limits.margin)
        return false;
    const ContactFrame frame(a.centre, gap.normal);
    set_corners_and_witness(contact_face(a, gap.normal, a.centre),
                            contact_face(b, -gap.normal, a.centre), frame, gap, limits, manifolds);
    return true;
}

/// The contact along the axis on which the boxes overlap least. False if they are nearest along
/// another direction; `apart` then tells whether they are farther apart than the margin.
bool contact_by_axis(const RoundedBox& a, const RoundedBox& b, const ContactLimits& limits,
                     bool& apart, std::vector<ContactManifold>& manifolds) {
    const LeastOverlap least = least_overlap(a, b);
    const double depth = least.overlap + a.radius + b.radius;
    apart = depth < -limits.margin - limits.rounding;
    if (depth < -limits.margin)
        return false;
    // Where the cores touch, to rounding, the direction of the distance may be another one.
    if (std::abs(least.overlap) <= limits.rounding && a.radius + b.radius > 0)
        return false;
    return set_corners(contact_face(a, least.normal, a.centre),
                       contact_face(b, -least.normal, a.centre),
                       ContactFrame(a.centre, least.normal), depth, limits, manifolds);
}

} // namespace

bool set_corners(const ContactFace& a, const ContactFace& b, const ContactFrame& frame,
                 double depth, const ContactLimits& limits,
                 std::vector<ContactManifold>& manifolds) {
    ContactCandidates candidates;
    add_overlap_corners(a, b, frame, candidates);
    if (!(deepest_of(candidates) >= depth - limits.rounding))
        return false;
    write_points(candidates, frame, limits, manifolds.emplace_back());
    return true;
}

void set_corners_and_witness(const ContactFace& a, const ContactFace& b, const ContactFrame& frame,
                             const SolidGap& witness, const ContactLimits& limits,
                             std::vector<ContactManifold>& manifolds) {
    ContactCandidates candidates;
    add_overlap_corners(a, b, frame, candidates);
    if (!(deepest_of(candidates) >= -witness.distance - limits.rounding))
        add_witness(witness, witness_name(a, b, frame.normal), frame, candidates);
    write_points(candidates, frame, limits, manifolds.emplace_back());
}

bool rounded_box_contact(const RoundedBox& a, const RoundedBox& b, double margin,
                         std::span<const std::uint64_t> last, KnownSeparation& separation,
                         std::vector<ContactManifold>& manifolds) {
    const ContactLimits limits{
        margin, 0x1p-46 * (length(b.centre - a.centre) + size_of(a) + size_of(b)), last};
    if (is_segment(a) && is_segment(b))
        return contact_of_capsules(a, b, limits, separation, manifolds);
    if (is_plain_box(a) && is_plain_box(b)) {
        if (const BoxContact found = contact_of_boxes(a, b, limits, separation, manifolds);
            found != BoxContact::unknown)
            return found == BoxContact::written;
    } else if (!has_no_extent(a) && !has_no_extent(b)) {
        bool apart = false;
        if (contact_by_axis(a, b, limits, apart, manifolds))
            return true;
        if (apart)
            return false;
    }
    return contact_by_distance(a, b, limits, manifolds);
}

} // namespace abut
