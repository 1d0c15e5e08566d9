#include "world/contacts/capsule_contacts.h"

#include "world/narrow_phase/core_gap.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace abut {

namespace {

/// In          inwards: from the end to the other one. normal: from the surface to the capsule.
std::optional<ContactPoint> contact_of_end(const Model& surface,
                                           const Transform& world_from_surface, const Sphere& end,
                                           const Vec3& inwards, const Vec3& normal,
                                           const ContactLimits& limits) {
    const double farthest = limits.margin + limits.rounding;
    BodyGap gap =
        ball_gap(surface, world_from_surface, end, std::nextafter(farthest, HUGE_VAL), Depths::no);
    if (gap.distance > farthest)
        return std::nullopt;
    if (gap.distance <= 0)
        gap = ball_gap(surface, world_from_surface, end, HUGE_VAL, Depths::yes);
    const Vec3 out = outwards_at_end(inwards, normal);
    if (!leads_same_way(gap.normal, normal) || out == Vec3{})
        return std::nullopt;
    // The surface counts as flat beside the place that is nearest to the end.
    ContactPoint point;
    point.point_b = end.centre - end.radius * out;
    const double depth = dot(gap.normal, gap.point_a - point.point_b) / dot(gap.normal, normal);
    if (depth < -farthest)
        return std::nullopt;
    point.depth = std::max(depth, -limits.margin);
    point.point_a = point.point_b + point.depth * normal;
    point.triangle_a = gap.triangle_a;
    return point;
}

} // namespace

std::array<std::optional<ContactPoint>, 2>
contacts_of_ends(const Model& surface, const Transform& world_from_surface, const Capsule& capsule,
                 bool capsule_is_a, const Vec3& normal, const ContactLimits& limits) {
    const auto contact = [&](const Vec3& centre, const Vec3& other) {
        auto point = contact_of_end(surface, world_from_surface, {centre, capsule.radius},
                                    other - centre, capsule_is_a ? -normal : normal, limits);
        if (point && capsule_is_a)
            std::swap(point->point_a, point->point_b),
                std::swap(point->triangle_a, point->triangle_b);
        return point;
    };
    return {contact(capsule.axis.a, capsule.axis.b), contact(capsule.axis.b, capsule.axis.a)};
}

void add_capsule_ends(const Segment& axis,
                      const std::array<std::optional<ContactPoint>, 2>& contacts_of_ends,
                      const std::optional<ContactPoint>& between, bool capsule_is_a,
                      ContactManifold& manifold) {
    constexpr double kApart = 0.125; // parts of the axis' length
    const ContactPoint deepest = manifold.points[0];
    const Vec3 way = axis.b - axis.a;
    double depth_of_ends = -HUGE_VAL;
    manifold.count = 0;
    const auto add = [&](ContactPoint point, CapsulePoint name) {
        point.feature = static_cast<std::uint64_t>(name);
        manifold.points[manifold.count++] = point;
    };
    for (const auto& [contact, name] : {std::pair(contacts_of_ends[0], CapsulePoint::end_a),
                                        std::pair(contacts_of_ends[1], CapsulePoint::end_b)})
        if (contact) {
            depth_of_ends = std::max(depth_of_ends, contact->depth);
            add(*contact, name);
        }
    const auto along = [&](const ContactPoint& point) {
        return dot((capsule_is_a ? point.point_a : point.point_b) - axis.a, way) / length_sq(way);
    };
    const bool is_deeper = deepest.depth > depth_of_ends + kDeeperThanEnds * length(way);
    if (!is_deeper && between)
        add(*between, CapsulePoint::middle);
    else if (is_deeper || manifold.count == 0 ||
             (manifold.count == 1 && std::abs(along(deepest) - along(manifold.points[0])) > kApart))
        add(deepest, CapsulePoint::middle);
    // Three at most: std::stable_sort would allocate a buffer.
    for (std::uint32_t i = 1; i < manifold.count; ++i)
        for (std::uint32_t k = i; k > 0 && manifold.points[k].depth > manifold.points[k - 1].depth;
             --k)
            std::swap(manifold.points[k], manifold.points[k - 1]);
}

} // namespace abut
