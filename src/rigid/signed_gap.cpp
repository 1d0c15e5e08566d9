#include "rigid/signed_gap.h"

#include "geometry/triangle_triangle_distance.h"
#include "rigid/penetration/contact_evidence.h"
#include "rigid/penetration/local_penetration.h"
#include "rigid/penetration/separation_search.h"
#include "rigid/solid/containment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace abut {

namespace {

Gap common_point(const PlacedSolid& a, const PlacedSolid& b, const TrianglePair& pair) {
    const ClosestPoints common =
        triangle_triangle_distance(a.world_triangle(pair.a), b.world_triangle(pair.b));
    Gap gap;
    gap.distance = 0;
    gap.point_a = common.a, gap.point_b = common.b;
    gap.triangle_a = pair.a, gap.triangle_b = pair.b;
    gap.feature_a = common.on_a.kind, gap.index_a = common.on_a.index;
    gap.feature_b = common.on_b.kind, gap.index_b = common.on_b.index;
    return gap;
}

Gap minus_depth(const LocalPenetration& p) {
    Gap gap;
    gap.distance = -p.depth;
    gap.at_least = -(p.at_most + p.rounding);
    gap.point_a = p.point_a, gap.point_b = p.point_b;
    gap.triangle_a = p.triangles.a, gap.triangle_b = p.triangles.b;
    gap.status = p.is_in_solid && p.at_most <= p.depth ? Status::exact : Status::bound_only;
    return gap;
}

/// The answer if the steps are used up: the nearest or deepest points found so far, with the bounds
/// that these and the models' boxes prove.
///
/// In          at_most: bounds the distance if no points were found. p: the result of a search for
///             the depth, if there was one.
Gap undecided(const PlacedSolid& a, const PlacedSolid& b, const std::vector<Contact>& contacts,
              double at_most, const LocalPenetration& p, const SearchSteps& steps,
              Counters& counters) {
    Gap gap;
    if (p.depth > 0)
        gap = minus_depth(p);
    else if (!contacts.empty())
        gap = common_point(a, b, contacts.front().pair);
    else
        gap.distance = at_most;
    const double out = length(separation_of_boxes(a, b, counters)) * (1 + 0x1p-50);
    gap.at_least =
        std::max(p.at_most > 0 ? -(p.at_most + p.rounding) : -HUGE_VAL, out > 0 ? -out : -HUGE_VAL);
    gap.status = Status::bound_only;
    gap.out_of_steps = true;
    gap.steps = steps.count();
    gap.counters = counters;
    return gap;
}

} // namespace

Gap signed_gap(const Model& a, const Transform& world_from_a, const Model& b,
               const Transform& world_from_b, const DistanceOptions& apart, double relative_error) {
    const PlacedPair pair(a, world_from_a, b, world_from_b);
    if (pair.world_from_a() != world_from_a || pair.world_from_b() != world_from_b)
        // A transform was flattened: the pair holds copies of the meshes in world coordinates. A
        // flat model contains nothing, but the other may be a solid.
        return signed_gap(Model(pair.a().mesh()), {}, Model(pair.b().mesh()), {}, apart,
                          relative_error);

    Counters counters;
    SearchSteps steps(apart.max_steps.value_or(std::numeric_limits<std::uint64_t>::max()));
    std::vector<Contact> contacts = find_contacts(pair, ContactMode::all, counters, &steps);
    std::sort(contacts.begin(), contacts.end(),
              [](const Contact& c, const Contact& d) { return c.pair < d.pair; });
    const PlacedSolid placed_a(a, a.data().solid(), world_from_a),
        placed_b(b, b.data().solid(), world_from_b);
    if (steps.ran_out())
        return undecided(placed_a, placed_b, contacts, apart.upper_bound, {}, steps, counters);
    const bool contained = contacts.empty() && (any_component_inside(placed_a, placed_b) ||
                                                any_component_inside(placed_b, placed_a));
    const auto distance_of_surfaces = [&](double upper_bound) {
        DistanceOptions rest = apart;
        rest.upper_bound = upper_bound;
        if (apart.max_steps)
            rest.max_steps = *apart.max_steps - std::min(*apart.max_steps, steps.count());
        Gap gap = distance(pair, rest);
        gap.steps += steps.count();
        return gap;
    };
    if (contacts.empty() && !contained)
        return distance_of_surfaces(apart.upper_bound);

    Gap gap;
    LocalPenetration p;
    if (contained || examine_meeting(placed_a, placed_b, contacts).interpenetrate) {
        DepthSearch search;
        search.relative_error = relative_error;
        search.steps = &steps;
        p = contained ? local_penetration(placed_a, placed_b, contacts, search)
                      : penetration_depth(placed_a, placed_b, contacts, search);
    }
    if (steps.ran_out())
        return undecided(placed_a, placed_b, contacts, 0, p, steps, counters);
    if (p.depth == 0 && contacts.empty()) {
        // One lies inside the other one, less deep than rounding. The nearest points tell where.
        gap = distance_of_surfaces(HUGE_VAL);
        gap.distance = 0;
        gap.at_least = -(p.at_most + p.rounding);
        if (p.at_most > 0)
            gap.status = Status::bound_only;
        return gap;
    }
    gap = p.depth > 0 ? minus_depth(p) : common_point(placed_a, placed_b, contacts.front().pair);
    gap.steps = steps.count();
    gap.counters = counters;
    return gap;
}

} // namespace abut
