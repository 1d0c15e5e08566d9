#include "clash/classify_pair.h"

#include "clash/blocks_pair.h"
#include "clash/part_pair.h"
#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_penetration.h"
#include "rigid/pair/separating_plane.h"
#include "rigid/penetration/contact_evidence.h"
#include "rigid/penetration/local_penetration.h"
#include "rigid/penetration/overlap_volume.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace abut {

namespace {

/// Samples of each surface, at most, to make a depth accurate. docs/clash.md gives the accuracy.
constexpr int kSamples = 200;

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

/// Returns the clash of two parts whose surfaces meet, `hard` or `touch`; none if they do not meet.
std::optional<Clash> classify_meeting(PartPair& pair, double touch) {
    std::vector<Contact> contacts;
    pair.for_each_contact([&](const Contact& contact) { contacts.push_back(contact); });
    if (contacts.empty())
        return std::nullopt;
    // Sorted, so that the order visibly depends neither on the SIMD width nor on the blocks.
    std::sort(contacts.begin(), contacts.end(),
              [](const Contact& c, const Contact& d) { return c.pair < d.pair; });
    const WorldSolid &a = pair.a().solid(), &b = pair.b().solid();
    Clash clash = clash_at(a, b, contacts.front().pair);
    clash.triangle_pairs = contacts.size();
    const Meeting meeting = examine_meeting(a, b, contacts);
    if (meeting.parting != Vec3{})
        clash.direction = meeting.parting;
    if (!meeting.interpenetrate)
        return clash;
    DepthSearch options;
    options.threshold = touch;
    options.accuracy_budget = kSamples;
    const LocalPenetration p = penetration_depth(a, b, contacts, options);
    // The clash is hard unless the depth is proven to be at most `touch`.
    clash.kind = touch == 0 || p.at_most > touch ? ClashKind::hard : ClashKind::touch;
    if (p.depth > 0) {
        clash.distance = -p.depth;
        clash.point_a = p.point_a, clash.point_b = p.point_b;
        clash.direction = p.direction;
    }
    if (clash.kind == ClashKind::hard)
        set_volume(clash, overlap_volume(a, b));
    return clash;
}

/// Returns whether every component of `inner` lies inside `outer`. Their surfaces must not meet.
bool lies_inside(BlockList& inner, BlockList& outer) {
    if (!encloses(outer.part().box, inner.part().box))
        return false;
    const std::vector<Vec3> points = inner.solid().component_points();
    return std::all_of(points.begin(), points.end(),
                       [&](const Vec3& point) { return outer.solid().winds_around(point); });
}

/// Returns the clash of two parts whose surfaces do not meet: `contained`, `clearance` or none.
std::optional<Clash> classify_apart(PartPair& pair, double clearance) {
    const bool a_inside = lies_inside(pair.a(), pair.b());
    const bool contained = a_inside || lies_inside(pair.b(), pair.a());
    if (!contained && clearance == 0)
        return std::nullopt;
    const Gap gap = pair.nearest(contained ? std::numeric_limits<double>::infinity() : clearance);
    if (!contained && !(gap.distance < clearance))
        return std::nullopt;
    Clash clash;
    clash.kind = contained ? ClashKind::contained : ClashKind::clearance;
    clash.distance = contained ? -gap.distance : gap.distance;
    clash.point_a = gap.point_a, clash.point_b = gap.point_b;
    const Vec3 away = normalized_or_zero(gap.point_b - gap.point_a);
    clash.direction = contained ? -away : away;
    if (contained)
        set_volume(clash, solid_volume(a_inside ? pair.a().solid() : pair.b().solid()));
    return clash;
}

std::optional<Clash> classify(PartPair& pair, double clearance, double touch) {
    const std::optional<Clash> clash = same_triangles(pair.a(), pair.b())
                                           ? classify_duplicates(pair)
                                           : classify_meeting(pair, touch);
    return clash ? clash : classify_apart(pair, clearance);
}

} // namespace

std::optional<Clash> classify_pair(const ClashPart& a, const ClashPart& b, double clearance,
                                   double touch) {
    if (a.blocks != nullptr || b.blocks != nullptr) {
        BlocksPair pair(a, b);
        return classify(pair, clearance, touch);
    }
    if (far_apart(a.model->data(), a.world_from_mesh, b.model->data(), b.world_from_mesh,
                  clearance))
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
