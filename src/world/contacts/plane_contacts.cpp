#include "world/contacts/plane_contacts.h"

#include <algorithm>
#include <array>

namespace abut {

ContactFace corners_over_plane(const PlacedModel& surface, const PlaneShape& plane, double height,
                               const Vec3& origin) {
    ContactFace face;
    const double reach = 2 * surface.reach() + 0x1p-20 * max_abs(surface.middle());
    const Box3 all = grown(Box3{surface.middle(), surface.middle()}, reach);
    const PlacedModel::HalfSpace beyond{plane.point + height * plane.normal, plane.normal};
    surface.for_each_overlap_outside(all, [&](std::uint32_t slot) {
        const Triangle t = surface.world_slot(slot);
        const std::uint32_t triangle = surface.data().triangle_at(slot);
        const auto& vertices = surface.data().mesh().triangles[triangle];
        for (std::size_t i = 0; i < 3; ++i)
            if (dot(plane.normal, t[i] - plane.point) <= height)
                face.corners.push_back({t[i] - origin, vertices[i], 0, triangle});
        return beyond;
    });
    // Vertices at one place are one, with the least number.
    const auto order = [](const ContactFace::Corner& c) {
        return std::array{c.at.x, c.at.y, c.at.z, double(c.vertex), double(c.triangle)};
    };
    std::ranges::sort(face.corners, {}, order);
    face.corners.erase(std::unique(face.corners.begin(), face.corners.end(),
                                   [](const ContactFace::Corner& p, const ContactFace::Corner& q) {
                                       return p.at == q.at;
                                   }),
                       face.corners.end());
    std::ranges::sort(face.corners, {}, &ContactFace::Corner::vertex);
    return face;
}

namespace {

/// Sets the triangle of each point that is a vertex of a model. The others keep theirs.
void set_triangles(const ContactFace& corners, bool body_is_a, ContactManifold& manifold) {
    for (std::uint32_t i = 0; i < manifold.count; ++i)
        for (const ContactFace::Corner& corner : corners.corners)
            if (ContactPoint& point = manifold.points[i];
                point.feature == (body_is_a
                                      ? feature_name(FeatureKind::vertex_of_a, corner.vertex, 0)
                                      : feature_name(FeatureKind::vertex_of_b, 0, corner.vertex)))
                (body_is_a ? point.triangle_a : point.triangle_b) = corner.triangle;
}

} // namespace

void set_plane_corners(const ContactFace& corners, bool body_is_a, const PlaneShape& plane,
                       const ContactLimits& limits, ContactManifold& manifold) {
    const ContactPoint deepest = manifold.points[0];
    const Status status = manifold.status;
    const Vec3 origin = body_is_a ? deepest.point_a : deepest.point_b;
    const ContactFrame frame(origin, manifold.normal);
    ContactCandidates candidates;
    for (const ContactFace::Corner& corner : corners.corners) {
        const Vec3 lowest = corner.at - corners.radius * plane.normal;
        double depth = -dot(plane.normal, (origin - plane.point) + lowest);
        // Corners that are as deep but for rounding are as deep: the choice must not follow it.
        if (depth >= deepest.depth - limits.rounding)
            depth = deepest.depth;
        const double height = dot(frame.normal, lowest);
        candidates.push_back(
            {dot(lowest, frame.across_x), dot(lowest, frame.across_y),
             body_is_a ? height : height + depth, body_is_a ? height - depth : height,
             body_is_a ? feature_name(FeatureKind::vertex_of_a, corner.vertex, 0)
                       : feature_name(FeatureKind::vertex_of_b, 0, corner.vertex)});
    }
    write_points(candidates, frame, limits, manifold);
    if (manifold.count == 0)
        manifold.points[0] = deepest, manifold.count = 1;
    set_triangles(corners, body_is_a, manifold);
    manifold.points[0].depth = deepest.depth;
    manifold.status = status;
}

} // namespace abut
