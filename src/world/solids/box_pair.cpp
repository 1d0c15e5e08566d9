#include "world/solids/box_pair.h"

#include "geometry/least_box_overlap.h"
#include "world/solids/box_face.h"
#include "world/solids/polygon_overlap.h"

#include <array>

namespace abut {

namespace {

/// The face of a box that faces along a direction, in a contact frame.
struct FlatBoxFace {
    std::array<FlatCorner, 4> corners;
    Vec3 normal; ///< in the world

    FlatBoxFace(const RoundedBox& box, const Vec3& direction, const ContactFrame& frame) {
        const BoxFace face(box, direction);
        normal = face.normal(box);
        const Vec3 middle =
            frame.coordinates((box.centre - frame.origin) + box.half[face.k] * normal);
        const Vec3 way_u = frame.coordinates(box.half[face.u] * box.axis[face.u]),
                   way_v = frame.coordinates(box.half[face.v] * box.axis[face.v]);
        const std::uint32_t side = face.side, u = face.bit_u(), v = face.bit_v();
        const auto corner = [](const Vec3& at, std::uint32_t vertex, std::uint32_t edge) {
            return FlatCorner{at.x, at.y, at.z, vertex, edge};
        };
        const Vec3 front = middle + way_u, back = middle - way_u;
        corners = {
            corner(front + way_v, side | u | v, BoxFace::edge(face.u, side | v)),
            corner(back + way_v, side | v, BoxFace::edge(face.v, side)),
            corner(back - way_v, side, BoxFace::edge(face.u, side)),
            corner(front - way_v, side | u, BoxFace::edge(face.v, side | u)),
        };
    }
};

} // namespace

BoxContact contact_of_boxes(const RoundedBox& a, const RoundedBox& b, const ContactLimits& limits,
                            std::vector<ContactManifold>& manifolds) {
    const LeastOverlap least = least_overlap(a, b, limits.margin + limits.rounding);
    if (least.overlap < -limits.margin)
        return least.overlap < -limits.margin - limits.rounding ? BoxContact::apart
                                                                : BoxContact::unknown;
    const ContactFrame frame(a.centre, least.normal);
    const FlatBoxFace face_a(a, least.normal, frame), face_b(b, -least.normal, frame);
    ContactCandidates candidates;
    add_quad_overlap(face_a.corners, face_b.corners,
                     FacePlane(face_a.corners[0], face_a.normal, frame),
                     -limits.margin - limits.rounding, candidates);
    if (!(deepest_of(candidates) >= least.overlap - limits.rounding))
        return BoxContact::unknown;
    write_points(candidates, frame, limits, manifolds.emplace_back());
    return BoxContact::written;
}

} // namespace abut
