#include "world/contacts/body_contacts.h"

#include "convex/body/convex_data.h"
#include "convex/hull/placed_polytope.h"
#include "math/transform.h"
#include "math/vector.h"
#include "rigid/manifold/surface_manifolds.h"
#include "world/contacts/capsule_contacts.h"
#include "world/contacts/plane_contacts.h"
#include "world/contacts/solid_contacts.h"
#include "world/narrow_phase/contact_rounding.h"
#include "world/narrow_phase/offset_surface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <variant>

namespace abut {

namespace {

/// A unit vector from a to b where the contact itself has no direction: between the middles of the
/// bodies' boxes.
Vec3 direction_between(const PlacedBody& a, const PlacedBody& b) {
    const auto middle = [](const PlacedBody& body) {
        const Box3 box = bounds_of(body.shape, bounds_of(body.shape), body.world_from_body);
        return is_empty(box) ? Vec3{} : 0.5 * box.lower + 0.5 * box.upper;
    };
    const Vec3 direction = normalized_or_zero(middle(b) - middle(a));
    return direction == Vec3{} || !is_finite(direction) ? Vec3{0, 0, 1} : direction;
}

/// The largest distance of a convex shape's coordinates from its own origin.
double size_of(const BodyShape& shape) {
    if (const auto* convex = std::get_if<ConvexShape>(&shape))
        return convex->solid.data().reach;
    const auto& box = std::get<RoundedBox>(shape);
    return sum_of_sizes(box.centre) + box.half[0] + box.half[1] + box.half[2] + box.radius;
}

/// The face of a convex shape that is most opposed to another body.
ContactFace face_of(const PlacedBody& body, const Vec3& direction, const Vec3& origin) {
    if (const auto* convex = std::get_if<ConvexShape>(&body.shape))
        return contact_face(convex->solid, *convex->faces, body.world_from_body, direction, origin);
    return contact_face(placed(std::get<RoundedBox>(body.shape), body.world_from_body), direction,
                        origin);
}

/// The contact of two convex shapes. Returns whether they are at most the margin apart.
bool convex_contact(const PlacedBody& a, const PlacedBody& b, double margin,
                    PairWarmStart& warm_start, ContactManifold& manifold) {
    const BodyGap gap =
        gap_between(a, b, std::nextafter(margin, HUGE_VAL), Depths::yes, warm_start);
    if (gap.distance > margin)
        return false;
    const auto &m = a.world_from_body.m, &n = b.world_from_body.m;
    const Vec3 origin{m[9], m[10], m[11]};
    const Vec3 normal = gap.normal == Vec3{} ? direction_between(a, b) : gap.normal;
    // The depth is compared with the search's own, which has a few roundings more.
    const double rounding = 0x1p-44 * (size_of(a.shape) + size_of(b.shape) +
                                       sum_of_sizes(Vec3{n[9], n[10], n[11]} - origin)) +
                            0x1p-50 * sum_of_sizes(origin);
    set_corners_and_witness(
        face_of(a, normal, origin), face_of(b, -normal, origin), ContactFrame(origin, normal),
        {gap.distance, gap.point_a, gap.point_b, normal}, {margin, rounding}, manifold);
    return true;
}

/// One contact point: that of `penetration`, or of the distance.
void append_one_point(const PlacedBody& a, const PlacedBody& b, double margin,
                      PairWarmStart& warm_start, std::vector<ContactManifold>& manifolds) {
    if (margin == 0 && !touch(a, b, warm_start))
        return;
    const BodyGap gap =
        margin == 0 ? gap_between(a, b, HUGE_VAL, Depths::yes, warm_start)
                    : signed_gap_between(a, b, std::nextafter(margin, HUGE_VAL), warm_start);
    if (margin > 0 && gap.distance > margin)
        return;
    ContactManifold& manifold = manifolds.emplace_back();
    manifold.normal = gap.normal == Vec3{} ? direction_between(a, b) : gap.normal;
    manifold.count = 1;
    // Witness points without a direction are one point.
    const Vec3 point_b =
        gap.normal == Vec3{} ? gap.point_a + gap.distance * manifold.normal : gap.point_b;
    // The name of the only point stays the same from triangle to triangle.
    manifold.points[0] = {gap.point_a, point_b, -gap.distance, 0};
    manifold.status = gap.status;
}

bool is_surface(const BodyShape& shape) {
    return std::holds_alternative<Model>(shape) || is_deformable(shape);
}

/// The faces of a body as triangles. None of a ball, a capsule, a box without area, a curved shape or
/// a half-space.
std::optional<OffsetSurface> triangles_of(const BodyShape& shape) {
    if (const auto* deformable = std::get_if<DeformableShape>(&shape))
        return OffsetSurface{deformable->snapshot->model(), {}, 0};
    if (const auto* box = std::get_if<RoundedBox>(&shape);
        box != nullptr && std::count(box->half.begin(), box->half.end(), 0.0) > 1)
        return std::nullopt;
    if (std::holds_alternative<CurvedShape>(shape) || is_half_space(shape))
        return std::nullopt;
    return offset_surface_of(shape);
}

/// The manifolds of two surfaces, one for each region where they meet. A surface that lies inside the
/// other shares no point with it.
void append_surface_contacts(const OffsetSurface& a, const Transform& world_from_a,
                             const OffsetSurface& b, const Transform& world_from_b, double margin,
                             std::vector<ContactManifold>& manifolds) {
    ManifoldOptions options;
    options.margin = margin;
    for (const ModelManifold& region :
         surface_manifolds(a.surface, compose(world_from_a, a.body_from_surface), b.surface,
                           compose(world_from_b, b.body_from_surface), options)) {
        ContactManifold& manifold = manifolds.emplace_back();
        manifold.normal = region.normal, manifold.region = region.region;
        manifold.count = region.count, manifold.points = region.points;
        manifold.status = Status::bound_only;
    }
}

/// Whether the kind of shape has a face for `face_of`. Curved shapes and half-spaces have one point.
bool has_faces(const BodyShape& shape) {
    return std::holds_alternative<RoundedBox>(shape) || std::holds_alternative<ConvexShape>(shape);
}

/// Adds the other corners of a body that stands on a half-space.
void add_plane_corners(const PlacedBody& a, const PlacedBody& b, double margin,
                       ContactManifold& manifold) {
    const bool body_is_a = is_half_space(b.shape);
    const PlacedBody &body = body_is_a ? a : b, &ground = body_is_a ? b : a;
    const PlaneShape plane = placed(std::get<PlaneShape>(ground.shape), ground.world_from_body);
    const ContactPoint& deepest = manifold.points[0];
    const Vec3 origin = body_is_a ? deepest.point_a : deepest.point_b;
    const ContactLimits limits{margin, contact_rounding(a, b) + 0x1p-50 * sum_of_sizes(origin)};
    if (has_faces(body.shape)) {
        set_plane_corners(face_of(body, -plane.normal, origin), body_is_a, plane, limits, manifold);
    } else if (const auto triangles = triangles_of(body.shape)) {
        const PlacedModel surface(triangles->surface,
                                  compose(body.world_from_body, triangles->body_from_surface));
        set_plane_corners(corners_over_plane(surface, plane, margin + limits.rounding, origin),
                          body_is_a, plane, limits, manifold);
    }
}

/// The contact of two convex shapes, by the cheapest way there is for them.
bool solid_contact(const PlacedBody& a, const PlacedBody& b, double margin,
                   PairWarmStart& warm_start, ContactManifold& manifold) {
    const auto* box_a = std::get_if<RoundedBox>(&a.shape);
    const auto* box_b = std::get_if<RoundedBox>(&b.shape);
    if (box_a == nullptr || box_b == nullptr)
        return convex_contact(a, b, margin, warm_start, manifold);
    // Those that rounding puts beyond the margin are looked at too; is_within decides.
    const double at_most = margin + 2 * contact_rounding(a, b);
    const RoundedBox placed_a = placed(*box_a, a.world_from_body),
                     placed_b = placed(*box_b, b.world_from_body);
    // In the order in which gap_between measures: of several normals that are as good, it has one.
    if (!comes_before(*box_b, b.world_from_body, *box_a, a.world_from_body))
        return rounded_box_contact(placed_a, placed_b, at_most, manifold);
    const bool is_near = rounded_box_contact(placed_b, placed_a, at_most, manifold);
    manifold.normal = -manifold.normal;
    for (std::uint32_t i = 0; is_near && i < manifold.count; ++i) {
        ContactPoint& point = manifold.points[i];
        std::swap(point.point_a, point.point_b);
        point.feature = turned_round(point.feature);
    }
    return is_near;
}

/// Adds the ends of a capsule on a surface.
void add_capsule_points(const PlacedBody& a, const PlacedBody& b, double margin,
                        ContactManifold& manifold) {
    const bool capsule_is_a = is_surface(b.shape);
    const PlacedBody &body = capsule_is_a ? a : b, &ground = capsule_is_a ? b : a;
    const auto* rounded = std::get_if<RoundedBox>(&body.shape);
    if (rounded == nullptr || dimension(*rounded) != 1)
        return;
    const RoundedBox solid = placed(*rounded, body.world_from_body);
    const auto triangles = triangles_of(ground.shape);
    add_capsule_ends(triangles->surface,
                     compose(ground.world_from_body, triangles->body_from_surface),
                     {axis_of(solid), solid.radius}, capsule_is_a,
                     {margin, 2 * contact_rounding(a, b)}, manifold);
}

/// Whether two bodies are at most the margin apart, as the other queries of a world tell it.
bool is_within(const PlacedBody& a, const PlacedBody& b, double margin, PairWarmStart& warm_start) {
    if (margin == 0)
        return touch(a, b, warm_start);
    const double bound = std::nextafter(margin, HUGE_VAL);
    return gap_between(a, b, bound, Depths::no, warm_start).distance <= margin;
}

/// The largest depth of the manifolds from `first` on.
double deepest_from(std::size_t first, const std::vector<ContactManifold>& manifolds) {
    double deepest = -HUGE_VAL;
    for (std::size_t k = first; k < manifolds.size(); ++k)
        for (std::uint32_t i = 0; i < manifolds[k].count; ++i)
            deepest = std::max(deepest, manifolds[k].points[i].depth);
    return deepest;
}

/// Removes the manifolds from `first` on if they are nearly the margin apart and other queries say
/// that the bodies are beyond it. Else no gap exceeds the margin.
void keep_within_margin(const PlacedBody& a, const PlacedBody& b, double margin,
                        PairWarmStart& warm_start, std::size_t first,
                        std::vector<ContactManifold>& manifolds) {
    const double rounding = contact_rounding(a, b);
    if (rounding == 0 || manifolds.size() == first)
        return;
    const auto begin = manifolds.begin() + static_cast<std::ptrdiff_t>(first);
    const double deepest = deepest_from(first, manifolds);
    // The triangles of a box are rounded in the world.
    const double doubt = 2 * rounding + (is_surface(a.shape) || is_surface(b.shape)
                                             ? world_rounding(a.world_from_body, b.world_from_body)
                                             : 0);
    if (deepest <= -margin + doubt && !is_within(a, b, margin, warm_start)) {
        manifolds.erase(begin, manifolds.end());
        return;
    }
    for (auto each = begin; each != manifolds.end(); ++each)
        for (std::uint32_t i = 0; i < each->count; ++i)
            each->points[i].depth = std::max(each->points[i].depth, -margin);
}

/// As append_surface_contacts, if both bodies have triangles. The result depends on nothing but the
/// bodies' placements and the margin, so that it may be kept.
void append_kept_contacts(const BodiesInContact& bodies, double margin, PairWarmStart& warm_start,
                          std::vector<ContactManifold>& manifolds) {
    std::unique_ptr<RestingContacts>& kept = warm_start.resting;
    if (kept && kept->placements == bodies.placements && kept->margin == margin) {
        manifolds.insert(manifolds.end(), kept->manifolds.begin(), kept->manifolds.end());
        return;
    }
    kept.reset();
    const auto triangles_a = triangles_of(bodies.a.shape),
               triangles_b = triangles_of(bodies.b.shape);
    if (!triangles_a || !triangles_b)
        return;
    const auto first = static_cast<std::ptrdiff_t>(manifolds.size());
    append_surface_contacts(*triangles_a, bodies.a.world_from_body, *triangles_b,
                            bodies.b.world_from_body, margin, manifolds);
    keep_within_margin(bodies.a, bodies.b, margin, warm_start, std::size_t(first), manifolds);
    if (bodies.at_rest)
        kept = std::make_unique<RestingContacts>(RestingContacts{
            bodies.placements, margin, {manifolds.begin() + first, manifolds.end()}});
}

} // namespace

void append_contacts(const BodiesInContact& bodies, double margin, PairWarmStart& warm_start,
                     std::vector<ContactManifold>& manifolds) {
    const PlacedBody &a = bodies.a, &b = bodies.b;
    const std::size_t first = manifolds.size();
    if (is_surface(a.shape) || is_surface(b.shape)) {
        append_kept_contacts(bodies, margin, warm_start, manifolds);
        // The triangles of a box are rounded, so that they may miss what the box touches. They also
        // miss a surface that lies wholly inside a solid, which is in contact.
        if (!(is_surface(a.shape) && is_surface(b.shape)) &&
            (manifolds.size() == first ||
             (deepest_from(first, manifolds) < 0 && touch(a, b, warm_start)))) {
            manifolds.erase(manifolds.begin() + static_cast<std::ptrdiff_t>(first),
                            manifolds.end());
            append_one_point(a, b, margin, warm_start, manifolds);
            if (manifolds.size() > first && !is_half_space(a.shape) && !is_half_space(b.shape))
                add_capsule_points(a, b, margin, manifolds[first]);
        }
    } else if (!has_faces(a.shape) || !has_faces(b.shape)) {
        append_one_point(a, b, margin, warm_start, manifolds);
    } else if (solid_contact(a, b, margin, warm_start, manifolds.emplace_back())) {
        keep_within_margin(a, b, margin, warm_start, first, manifolds);
    } else {
        manifolds.pop_back();
    }
    if (manifolds.size() > first && is_half_space(a.shape) != is_half_space(b.shape))
        add_plane_corners(a, b, margin, manifolds[first]);
    for (std::size_t i = first; i < manifolds.size(); ++i)
        manifolds[i].a = bodies.ids.a, manifolds[i].b = bodies.ids.b;
}

} // namespace abut
