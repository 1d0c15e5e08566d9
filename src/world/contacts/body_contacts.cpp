#include "world/contacts/body_contacts.h"

#include "convex/body/convex_data.h"
#include "convex/hull/placed_polytope.h"
#include "core/borrowed.h"
#include "geometry/triangle_triangle_distance.h"
#include "math/transform.h"
#include "math/vector.h"
#include "rigid/manifold/surface_manifolds.h"
#include "world/contacts/capsule_contacts.h"
#include "world/contacts/convex_faces.h"
#include "world/contacts/plane_contacts.h"
#include "world/contacts/rounded_on_surface.h"
#include "world/contacts/solid_contacts.h"
#include "world/contacts/solid_regions.h"
#include "world/contacts/walls.h"
#include "world/narrow_phase/contact_rounding.h"
#include "world/narrow_phase/offset_surface.h"
#include "world/solids/known_separation.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
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
    if (const auto* curved = std::get_if<CurvedShape>(&shape))
        return sum_of_sizes(curved->solid.centre) + curved->solid.reach;
    const auto& box = std::get<RoundedBox>(shape);
    return sum_of_sizes(box.centre) + box.half[0] + box.half[1] + box.half[2] + box.radius;
}

/// The face of a convex or curved shape that is most opposed to another body.
ContactFace face_of(const PlacedBody& body, const Vec3& direction, const Vec3& origin) {
    if (const auto* convex = std::get_if<ConvexShape>(&body.shape))
        return contact_face(convex->solid, *convex->faces, body.world_from_body, direction, origin);
    if (const auto* curved = std::get_if<CurvedShape>(&body.shape))
        return contact_face(placed(*curved, body.world_from_body), direction, origin);
    return contact_face(placed(std::get<RoundedBox>(body.shape), body.world_from_body), direction,
                        origin);
}

/// The names of points of the last query.
std::span<const std::uint64_t> names_of(const PairWarmStart& warm_start) {
    return {warm_start.points.data(), warm_start.points.size()};
}

/// Exchanges the bodies of a manifold.
void exchange_bodies(ContactManifold& manifold) {
    manifold.normal = -manifold.normal;
    for (std::uint32_t i = 0; i < manifold.count; ++i) {
        ContactPoint& point = manifold.points[i];
        std::swap(point.point_a, point.point_b);
        point.feature = turned_round(point.feature);
    }
}

/// Whether a curved shape is b, or the one that comes first in an order of curved shapes is.
bool curved_comes_second(const PlacedBody& a, const PlacedBody& b) {
    const auto *curved_a = std::get_if<CurvedShape>(&a.shape),
               *curved_b = std::get_if<CurvedShape>(&b.shape);
    return curved_b != nullptr &&
           (curved_a == nullptr ||
            comes_before(*curved_b, b.world_from_body, *curved_a, a.world_from_body));
}

/// Appends the contact of two convex shapes whose gap is known.
void append_convex_contact(const PlacedBody& a, const PlacedBody& b, const BodyGap& gap,
                           double margin, std::span<const std::uint64_t> last,
                           std::vector<ContactManifold>& manifolds) {
    const auto &m = a.world_from_body.m, &n = b.world_from_body.m;
    const Vec3 origin{m[9], m[10], m[11]};
    const Vec3 normal = gap.normal == Vec3{} ? direction_between(a, b) : gap.normal;
    // The depth is compared with the search's own, which has a few roundings more.
    const double rounding = 0x1p-44 * (size_of(a.shape) + size_of(b.shape) +
                                       sum_of_sizes(Vec3{n[9], n[10], n[11]} - origin)) +
                            0x1p-50 * sum_of_sizes(origin);
    set_corners_and_witness(
        face_of(a, normal, origin), face_of(b, -normal, origin), ContactFrame(origin, normal),
        {gap.distance, gap.point_a, gap.point_b, normal}, {margin, rounding, last}, manifolds);
}

/// Appends the contact of two convex shapes. Returns whether they are at most the margin apart.
bool convex_contact(const PlacedBody& a, const PlacedBody& b, double margin,
                    PairWarmStart& warm_start, std::vector<ContactManifold>& manifolds) {
    BodyGap gap = gap_between(a, b, std::nextafter(margin, HUGE_VAL), Depths::yes, warm_start);
    if (gap.distance > margin)
        return false;
    if (!curved_comes_second(a, b)) {
        append_convex_contact(a, b, gap, margin, names_of(warm_start), manifolds);
        return true;
    }
    // The points are the same whichever body is a: many corners of a disc are as good as each other.
    std::swap(gap.point_a, gap.point_b);
    gap.normal = -gap.normal;
    auto last = warm_start.points;
    std::transform(last.begin(), last.end(), last.begin(), turned_round);
    append_convex_contact(b, a, gap, margin, {last.data(), last.size()}, manifolds);
    exchange_bodies(manifolds.back());
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
    manifold.points[0] = {gap.point_a, point_b, -gap.distance, 0, gap.triangle_a, gap.triangle_b};
    manifold.status = gap.status;
}

/// The manifolds of two surfaces, one for each region where they meet. A surface that lies inside the
/// other shares no point with it.
std::vector<ModelManifold> surface_regions(const PlacedBody& a, const PlacedBody& b, double margin,
                                           const std::vector<ModelManifold>& last) {
    const auto of_a = triangles_of(a.shape), of_b = triangles_of(b.shape);
    ManifoldOptions options;
    options.margin = margin;
    options.last = &last;
    return surface_manifolds(of_a->surface, compose(a.world_from_body, of_a->body_from_surface),
                             of_b->surface, compose(b.world_from_body, of_b->body_from_surface),
                             options);
}

/// Whether the shape has a face for `face_of`: it is no surface, half-space, or curved shape without an extent.
bool has_faces(const BodyShape& shape) {
    if (const auto* curved = std::get_if<CurvedShape>(&shape))
        return has_curved_side(curved->solid);
    return std::holds_alternative<RoundedBox>(shape) || std::holds_alternative<ConvexShape>(shape);
}

/// Adds the other corners of a body that stands on a half-space.
void add_plane_corners(const PlacedBody& a, const PlacedBody& b, double margin,
                       const PairWarmStart& warm_start, ContactManifold& manifold) {
    const bool body_is_a = is_half_space(b.shape);
    const PlacedBody &body = body_is_a ? a : b, &ground = body_is_a ? b : a;
    const PlaneShape plane = placed(std::get<PlaneShape>(ground.shape), ground.world_from_body);
    const ContactPoint& deepest = manifold.points[0];
    const Vec3 origin = body_is_a ? deepest.point_a : deepest.point_b;
    const ContactLimits limits{margin, contact_rounding(a, b) + 0x1p-50 * sum_of_sizes(origin),
                               names_of(warm_start)};
    if (has_faces(body.shape)) {
        set_plane_corners(face_of(body, -plane.normal, origin), body_is_a, plane, limits, manifold);
    } else if (const auto triangles = triangles_of(body.shape)) {
        const PlacedModel surface(triangles->surface,
                                  compose(body.world_from_body, triangles->body_from_surface));
        set_plane_corners(corners_over_plane(surface, plane, margin + limits.rounding, origin),
                          body_is_a, plane, limits, manifold);
    }
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
    const auto ends = contacts_of_ends(
        triangles->surface, compose(ground.world_from_body, triangles->body_from_surface),
        {axis_of(solid), solid.radius}, capsule_is_a, manifold.normal,
        {margin, 2 * contact_rounding(a, b)});
    add_capsule_ends(axis_of(solid), ends, std::nullopt, capsule_is_a, manifold);
}

/// Whether two bodies are at most the margin apart, as the other queries of a world tell it.
bool is_within(const PlacedBody& a, const PlacedBody& b, double margin, PairWarmStart& warm_start) {
    if (margin == 0)
        return touch(a, b, warm_start);
    const double bound = std::nextafter(margin, HUGE_VAL);
    return gap_between(a, b, bound, Depths::no, warm_start).distance <= margin;
}

/// The largest depth of the manifolds from `first` on.
template <typename Manifold>
double deepest_from(std::size_t first, const std::vector<Manifold>& manifolds) {
    double deepest = -HUGE_VAL;
    for (std::size_t k = first; k < manifolds.size(); ++k)
        for (std::uint32_t i = 0; i < manifolds[k].count; ++i)
            deepest = std::max(deepest, manifolds[k].points[i].depth);
    return deepest;
}

/// How far the depths of two bodies may differ from those that other queries tell.
double doubt_of(const PlacedBody& a, const PlacedBody& b) {
    const double rounding = contact_rounding(a, b);
    // The triangles of a box are rounded in the world.
    return 2 * rounding + (rounding > 0 && (is_surface(a.shape) || is_surface(b.shape))
                               ? world_rounding(a.world_from_body, b.world_from_body)
                               : 0);
}

/// Removes the manifolds from `first` on if they are nearly the margin apart and other queries say
/// that the bodies are beyond it. Else no gap exceeds the margin.
template <typename Manifold>
void keep_within_margin(const PlacedBody& a, const PlacedBody& b, double margin, double doubt,
                        PairWarmStart& warm_start, std::size_t first,
                        std::vector<Manifold>& manifolds) {
    if (doubt == 0 || manifolds.size() == first)
        return;
    const auto begin = manifolds.begin() + static_cast<std::ptrdiff_t>(first);
    const double deepest = deepest_from(first, manifolds);
    if (deepest <= -margin + doubt && !is_within(a, b, margin, warm_start)) {
        manifolds.erase(begin, manifolds.end());
        return;
    }
    for (auto each = begin; each != manifolds.end(); ++each)
        for (std::uint32_t i = 0; i < each->count; ++i)
            each->points[i].depth = std::max(each->points[i].depth, -margin);
}

/// The least depth of bodies that touch. That of a curved shape is rounded.
double least_touching(const PlacedBody& a, const PlacedBody& b) {
    const bool is_curved = std::holds_alternative<CurvedShape>(a.shape) ||
                           std::holds_alternative<CurvedShape>(b.shape);
    return is_curved ? -2 * doubt_of(a, b) : 0;
}

/// Whether b comes first in the order in which gap_between measures.
bool b_comes_first(const PlacedBody& a, const PlacedBody& b) {
    const RoundedBox &box_a = *a.box_in_world, &box_b = *b.box_in_world;
    for (std::size_t k = 0; k < 3; ++k)
        if (box_a.half[k] != box_b.half[k])
            return box_b.half[k] < box_a.half[k];
    if (box_a.radius != box_b.radius)
        return box_b.radius < box_a.radius;
    // Equal shapes differ by their placements.
    const auto &m_a = a.world_from_body.m, &m_b = b.world_from_body.m;
    for (std::size_t k = 0; k < m_a.size(); ++k)
        if (m_a[k] != m_b[k])
            return m_b[k] < m_a[k];
    return comes_before(std::get<RoundedBox>(b.shape), b.world_from_body,
                        std::get<RoundedBox>(a.shape), a.world_from_body);
}

/// Appends the contact of two boxes, capsules or balls whose places in the world are known.
void append_box_contact(const PlacedBody& a, const PlacedBody& b, double margin,
                        PairWarmStart& warm_start, std::vector<ContactManifold>& manifolds) {
    const RoundedBox &box_a = *a.box_in_world, &box_b = *b.box_in_world;
    KnownSeparation& separation = warm_start.separation;
    // Those that rounding puts beyond the margin are looked at too; is_within decides.
    const double doubt = 2 * (contact_share(box_a) + contact_share(box_b));
    const double at_most = margin + doubt;
    const std::size_t first = manifolds.size();
    // Of several normals that are as good, gap_between has one.
    if (b_comes_first(a, b)) {
        auto last = warm_start.points;
        std::transform(last.begin(), last.end(), last.begin(), turned_round);
        const bool found = rounded_box_contact(box_b, box_a, at_most, {last.data(), last.size()},
                                               separation, manifolds);
        separation.exchange();
        if (!found)
            return;
        exchange_bodies(manifolds.back());
    } else if (!rounded_box_contact(box_a, box_b, at_most, names_of(warm_start), separation,
                                    manifolds)) {
        return;
    }
    keep_within_margin(a, b, margin, doubt, warm_start, first, manifolds);
}

/// Appends the contact of two shapes with faces.
void append_solid_contact(const PlacedBody& a, const PlacedBody& b, double margin,
                          PairWarmStart& warm_start, std::vector<ContactManifold>& manifolds) {
    const auto* box_a = std::get_if<RoundedBox>(&a.shape);
    const auto* box_b = std::get_if<RoundedBox>(&b.shape);
    const std::size_t first = manifolds.size();
    if (box_a != nullptr && box_b != nullptr) {
        const RoundedBox placed_a = placed(*box_a, a.world_from_body),
                         placed_b = placed(*box_b, b.world_from_body);
        append_box_contact({a.shape, a.world_from_body, &placed_a},
                           {b.shape, b.world_from_body, &placed_b}, margin, warm_start, manifolds);
    } else if (convex_contact(a, b, margin, warm_start, manifolds)) {
        keep_within_margin(a, b, margin, doubt_of(a, b), warm_start, first, manifolds);
    }
}

bool has_curved_faces(const BodyShape& shape) {
    return std::holds_alternative<CurvedShape>(shape) && has_faces(shape);
}

/// Adds the manifolds of a surface and another body. Returns a bound of the rounding of their depths; none where
/// pairs of triangles have told them.
std::optional<double> add_regions(const PlacedBody& a, const PlacedBody& b, double margin,
                                  PairWarmStart& warm_start, std::vector<ModelManifold>& regions) {
    if (has_curved_faces(a.shape) || has_curved_faces(b.shape))
        return add_curved_regions(a, b, margin, warm_start, regions);
    const SolidOfPair solid = solid_of(a, b);
    std::optional<double> rounding;
    if (solid.faces)
        rounding = add_solid_regions(a, b, solid, margin, warm_start, regions);
    if (!rounding && (!solid.faces || is_within(a, b, margin, warm_start)))
        regions = surface_regions(a, b, margin, warm_start.regions.manifolds);
    return rounding;
}

/// The contacts of two bodies, at least one of them a surface, that have triangles or a curved side. Of bodies
/// that have not moved since the last query, its contacts.
void append_region_contacts(const BodiesInContact& bodies, double margin, PairWarmStart& warm_start,
                            std::vector<ContactManifold>& manifolds) {
    const PlacedBody &a = bodies.a, &b = bodies.b;
    RegionsOfPair& kept = warm_start.regions;
    const bool is_curved = has_curved_faces(a.shape) || has_curved_faces(b.shape);
    if (kept.placements != bodies.placements || kept.margin != margin) {
        if (!is_curved && (!triangles_of(a.shape) || !triangles_of(b.shape)))
            return;
        static thread_local std::vector<ModelManifold> memory;
        Borrowed<std::vector<ModelManifold>> borrowed(memory);
        std::vector<ModelManifold>& regions = *borrowed;
        regions.clear();
        double doubt = doubt_of(a, b);
        if (const auto rounding = add_regions(a, b, margin, warm_start, regions))
            doubt += *rounding;
        keep_within_margin(a, b, margin, doubt, warm_start, 0, regions);
        kept.placements = bodies.placements, kept.margin = margin;
        kept.manifolds.assign(regions.begin(), regions.end());
    }
    for (const ModelManifold& region : kept.manifolds) {
        ContactManifold& manifold = manifolds.emplace_back();
        manifold.normal = region.normal, manifold.region = region.region;
        manifold.count = region.count, manifold.points = region.points;
        manifold.status = Status::bound_only;
        // The triangles of a box or a convex body are the library's own.
        for (ContactPoint& point : manifold.points) {
            point.triangle_a = is_surface(a.shape) ? point.triangle_a : 0;
            point.triangle_b = is_surface(b.shape) ? point.triangle_b : 0;
        }
    }
}

/// The contacts of a ball or a capsule and a surface, where triangles near its core tell them. Returns
/// whether they do.
bool append_rounded_contact(const PlacedBody& a, const PlacedBody& b, double margin,
                            PairWarmStart& warm_start, std::vector<ContactManifold>& manifolds) {
    const bool solid_is_a = is_surface(b.shape);
    const PlacedBody &body = solid_is_a ? a : b, &ground = solid_is_a ? b : a;
    const auto* rounded = std::get_if<RoundedBox>(&body.shape);
    if (rounded == nullptr || dimension(*rounded) > 1 || !(rounded->radius > 0))
        return false;
    const OffsetSurface surface = *triangles_of(ground.shape);
    const auto found = rounded_on_surface(
        placed(*rounded, body.world_from_body), surface.surface,
        compose(ground.world_from_body, surface.body_from_surface), solid_is_a, margin);
    if (!found)
        return false;
    const double doubt = found->rounding + 2 * contact_rounding(a, b);
    const std::size_t first = manifolds.size();
    append_walls({found->manifolds.data(), found->manifolds.size()}, warm_start.regions, manifolds);
    keep_within_margin(a, b, margin, doubt, warm_start, first, manifolds);
    return true;
}

} // namespace

void append_contacts(const BodiesInContact& bodies, double margin, PairWarmStart& warm_start,
                     std::vector<ContactManifold>& manifolds) {
    const PlacedBody &a = bodies.a, &b = bodies.b;
    const std::size_t first = manifolds.size();
    if (a.box_in_world != nullptr && b.box_in_world != nullptr) {
        if (is_apart(warm_start.separation, *a.box_in_world, *b.box_in_world, margin)) {
            warm_start.points.clear();
            return;
        }
        append_box_contact(a, b, margin, warm_start, manifolds);
    } else if ((is_surface(a.shape) || is_surface(b.shape)) &&
               append_rounded_contact(a, b, margin, warm_start, manifolds)) {
        // All is told.
    } else if (is_surface(a.shape) || is_surface(b.shape)) {
        append_region_contacts(bodies, margin, warm_start, manifolds);
        // The triangles of a box are rounded, so that they may miss what the box touches. They also
        // miss a surface that lies wholly inside a solid, which is in contact.
        if (!(is_surface(a.shape) && is_surface(b.shape)) &&
            (manifolds.size() == first ||
             (deepest_from(first, manifolds) < least_touching(a, b) && touch(a, b, warm_start)))) {
            manifolds.erase(manifolds.begin() + static_cast<std::ptrdiff_t>(first),
                            manifolds.end());
            append_one_point(a, b, margin, warm_start, manifolds);
            if (manifolds.size() > first && !is_half_space(a.shape) && !is_half_space(b.shape))
                add_capsule_points(a, b, margin, manifolds[first]);
        }
    } else if (!has_faces(a.shape) || !has_faces(b.shape)) {
        append_one_point(a, b, margin, warm_start, manifolds);
    } else {
        append_solid_contact(a, b, margin, warm_start, manifolds);
    }
    if (manifolds.size() > first && is_half_space(a.shape) != is_half_space(b.shape))
        add_plane_corners(a, b, margin, warm_start, manifolds[first]);
    warm_start.points.clear();
    for (std::uint32_t i = 0; manifolds.size() > first && i < manifolds[first].count; ++i)
        warm_start.points.push_back(manifolds[first].points[i].feature);
}

} // namespace abut
