#include "clash/classify_pair.h"

#include "clash/blocks_pair.h"
#include "clash/meeting_kind.h"
#include "clash/outer_contacts.h"
#include "clash/outer_nearest.h"
#include "clash/part_pair.h"
#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_penetration.h"
#include "rigid/pair/separating_plane.h"
#include "rigid/penetration/contact_evidence.h"
#include "rigid/penetration/local_penetration.h"
#include "rigid/penetration/overlap_volume.h"
#include "rigid/tolerance/overlap_within.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace abut {

namespace {

/// Returns a `touch` clash at a common point of two triangles that share one.
Clash clash_at(const WorldSolid& a, const WorldSolid& b, const TrianglePair& triangles) {
    const Triangle ta = a.world_triangle(triangles.a), tb = b.world_triangle(triangles.b);
    const ClosestPoints common = triangle_triangle_distance(ta, tb);
    Clash clash;
    clash.kind = ClashKind::touch;
    clash.point_a = common.a, clash.point_b = common.b;
    clash.direction = triangle_triangle_penetration(ta, tb).direction;
    return clash;
}

void set_volume(Clash& clash, const std::optional<OverlapVolume>& found) {
    if (found)
        clash.volume = found->volume, clash.volume_error = found->error;
}

void set_depth(Clash& clash, const LocalPenetration& p) {
    clash.distance = -p.depth;
    clash.point_a = p.point_a, clash.point_b = p.point_b;
    clash.direction = p.direction;
}

/// Returns the clash of two parts of the same triangles; none if they have none. Their contacts are
/// counted and not kept, because there are too many.
std::optional<Clash> classify_duplicates(PartPair& pair) {
    std::uint64_t count = 0;
    Contact first;
    pair.for_each_contact([&](const Contact& contact) {
        if (count++ == 0 || contact.pair < first.pair)
            first = contact;
    });
    if (count == 0)
        return std::nullopt;
    Clash clash = clash_at(pair.a().solid(), pair.b().solid(), first.pair);
    clash.kind = ClashKind::duplicate;
    clash.direction = {};
    clash.triangle_pairs = count;
    set_volume(clash, solid_volume(pair.a().solid()));
    return clash;
}

/// Returns all contacts. With a touch tolerance, faces inside their own solid have none; without one,
/// the triangles decide.
std::vector<Contact> sorted_contacts(PartPair& pair, double touch) {
    std::vector<Contact> contacts;
    pair.for_each_contact([&](const Contact& contact) { contacts.push_back(contact); });
    if (!contacts.empty() && touch > 0) {
        const OuterContacts outer(pair.a().solid(), pair.b().solid());
        if (!outer.are_all())
            std::erase_if(contacts, [&](const Contact& c) { return !outer.holds(c.pair); });
    }
    // Sorted, so that the order visibly depends neither on the SIMD width nor on the blocks.
    std::sort(contacts.begin(), contacts.end(),
              [](const Contact& c, const Contact& d) { return c.pair < d.pair; });
    return contacts;
}

/// Returns the clash of two parts whose surfaces meet: `hard`, `touch` or `undecided`.
Clash classify_meeting(PartPair& pair, std::span<const Contact> contacts, double touch) {
    const WorldSolid &a = pair.a().solid(), &b = pair.b().solid();
    Clash clash = clash_at(a, b, contacts.front().pair);
    clash.triangle_pairs = contacts.size();
    const Meeting meeting = examine_meeting(a, b, contacts);
    if (meeting.parting != Vec3{})
        clash.direction = meeting.parting;
    const MeetingKind found = meeting_kind(pair, contacts, meeting, touch);
    clash.kind = found.kind;
    // A depth that rounding may have made is none.
    if (found.penetration.depth > found.penetration.rounding)
        set_depth(clash, found.penetration);
    if (clash.kind != ClashKind::touch)
        set_volume(clash, overlap_volume(a, b));
    return clash;
}

/// Returns the clash of two parts each of which is everywhere within `touch` of the other one: a
/// `duplicate`, or `undecided` if that is not proven.
Clash classify_near_duplicates(PartPair& pair, std::span<const Contact> contacts, Proof proof) {
    const WorldSolid &a = pair.a().solid(), &b = pair.b().solid();
    Clash clash;
    if (!contacts.empty()) {
        clash = clash_at(a, b, contacts.front().pair);
    } else {
        const Gap gap = nearest_outside(pair);
        clash.point_a = gap.point_a, clash.point_b = gap.point_b;
    }
    clash.kind = proof == Proof::holds ? ClashKind::duplicate : ClashKind::undecided;
    clash.direction = {};
    clash.triangle_pairs = contacts.size();
    set_volume(clash, overlap_volume(a, b));
    return clash;
}

/// How many components of one part lie inside another one, and a point of one that does.
struct Inside {
    bool all = false, some = false;
    Vec3 point;
};

/// In          the surfaces do not meet.
Inside examine_inside(BlockList& inner, BlockList& outer) {
    const Box3 &box = inner.part().box, &around = outer.part().box;
    if (!overlap(box, around))
        return {};
    Inside result{encloses(around, box), false, {}};
    const std::vector<Vec3> points = inner.solid().component_points();
    if (points.size() == 1 && !result.all)
        return {};
    for (const Vec3& point : points) {
        const bool inside = encloses(around, {point, point}) && outer.solid().winds_around(point);
        result.all = result.all && inside;
        if (inside)
            result.some = true, result.point = point;
    }
    return result;
}

/// Returns the clash of two parts whose surfaces do not meet, if some components of one lie inside the
/// other one.
Clash classify_partly_inside(PartPair& pair, const Vec3& point, double touch) {
    const WorldSolid &a = pair.a().solid(), &b = pair.b().solid();
    const MeetingKind found = kind_of_partly_inside(pair, point, touch);
    Clash clash;
    clash.kind = found.kind;
    set_depth(clash, found.penetration);
    if (clash.kind != ClashKind::touch)
        set_volume(clash, overlap_volume(a, b));
    return clash;
}

/// Returns whether a component of `outer` lies inside `inner`, as the surface of a cavity does that is
/// smaller than what lies around it. Their surfaces must not meet.
bool holds_a_component(BlockList& inner, BlockList& outer) {
    const Box3& box = inner.part().box;
    const std::vector<Vec3> points = outer.solid().component_points();
    return std::any_of(points.begin(), points.end(), [&](const Vec3& point) {
        return encloses(box, {point, point}) && inner.solid().winds_around(point);
    });
}

/// The volume that a part has in common with the solid that its surface lies in: its own, less the
/// cavities of that solid within.
std::optional<OverlapVolume> contained_volume(BlockList& inner, BlockList& outer) {
    return holds_a_component(inner, outer) ? overlap_volume(inner.solid(), outer.solid())
                                           : solid_volume(inner.solid());
}

/// Returns the clash of two parts whose surfaces do not meet: `contained`, `touch`, `clearance` or
/// none; `hard` or `undecided` if only some components lie inside the other part.
std::optional<Clash> classify_apart(PartPair& pair, double clearance, double touch) {
    const Inside of_a = examine_inside(pair.a(), pair.b()),
                 of_b = examine_inside(pair.b(), pair.a());
    const bool contained = of_a.all || of_b.all;
    if (!contained && (of_a.some || of_b.some))
        return classify_partly_inside(pair, of_a.some ? of_a.point : of_b.point, touch);
    const double farthest = std::max(clearance, touch);
    if (!contained && farthest == 0)
        return std::nullopt;
    // A gap that exceeds `touch` only by rounding counts as `touch`.
    const double touching =
        touch > 0 ? touch + rounding_of_lengths(pair.a().solid(), pair.b().solid()) : 0;
    const double bound =
        contained ? std::numeric_limits<double>::infinity() : std::max(clearance, touching);
    const Gap gap = contained && touch > 0 ? nearest_outside(pair) : pair.nearest(bound);
    const bool touches = gap.distance <= touching;
    if (!contained && !touches && !(gap.distance < clearance))
        return std::nullopt;
    Clash clash;
    clash.kind = contained ? ClashKind::contained
                 : touches ? ClashKind::touch
                           : ClashKind::clearance;
    clash.distance = contained ? -gap.distance : gap.distance;
    if (touches && gap.distance <= rounding_of_lengths(pair.a().solid(), pair.b().solid()))
        clash.distance = 0; // rounding may have made the gap
    clash.point_a = gap.point_a, clash.point_b = gap.point_b;
    const Vec3 away = normalized_or_zero(gap.point_b - gap.point_a);
    clash.direction = contained ? -away : away;
    if (contained)
        set_volume(clash, of_a.all ? contained_volume(pair.a(), pair.b())
                                   : contained_volume(pair.b(), pair.a()));
    return clash;
}

std::optional<Clash> classify(PartPair& pair, double clearance, double touch) {
    if (same_triangles(pair.a(), pair.b()))
        if (std::optional<Clash> clash = classify_duplicates(pair))
            return clash;
    const std::vector<Contact> contacts = sorted_contacts(pair, touch);
    if (touch > 0)
        if (const Proof proof = are_duplicates(pair, touch); proof != Proof::fails)
            return classify_near_duplicates(pair, contacts, proof);
    if (!contacts.empty())
        return classify_meeting(pair, contacts, touch);
    return classify_apart(pair, clearance, touch);
}

} // namespace

std::optional<Clash> classify_pair(const ClashPart& a, const ClashPart& b, double clearance,
                                   double touch) {
    if (a.blocks != nullptr || b.blocks != nullptr) {
        BlocksPair pair(a, b);
        return classify(pair, clearance, touch);
    }
    // More than what rounding adds to `touch`.
    const double touching = touch > 0
                                ? touch + 0x1p-40 * (max_abs(a.box.lower) + max_abs(a.box.upper) +
                                                     max_abs(b.box.lower) + max_abs(b.box.upper))
                                : 0;
    if (far_apart(a.model->data(), a.world_from_mesh, b.model->data(), b.world_from_mesh,
                  std::max(clearance, touching)))
        return std::nullopt;
    WholePair pair(a, b);
    return classify(pair, clearance, touch);
}

std::optional<Clash> classify_by_id(const ClashPart& a, std::string_view id_a, const ClashPart& b,
                                    std::string_view id_b, double clearance, double touch) {
    const bool exchanged = id_b < id_a;
    std::optional<Clash> clash =
        exchanged ? classify_pair(b, a, clearance, touch) : classify_pair(a, b, clearance, touch);
    if (!clash)
        return clash;
    // Negative zeros become positive, so that exchanging twice changes no bit.
    Vec3& d = clash->direction;
    d = {d.x + 0.0, d.y + 0.0, d.z + 0.0};
    if (exchanged)
        exchange_sides(*clash);
    return clash;
}

void exchange_sides(Clash& clash) {
    std::swap(clash.point_a, clash.point_b);
    Vec3& d = clash.direction;
    d = {0.0 - d.x, 0.0 - d.y, 0.0 - d.z};
}

} // namespace abut
