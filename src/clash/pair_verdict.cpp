#include "clash/pair_verdict.h"

#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_penetration.h"
#include "rigid/penetration/contact_evidence.h"
#include "rigid/penetration/local_penetration.h"

#include <algorithm>

namespace abut {

namespace {

/// Samples of each surface, at most, to make a depth accurate. docs/clash.md gives the accuracy.
constexpr int kSamples = 200;

} // namespace

Clash touch_clash(const WorldSolid& a, const WorldSolid& b, const TrianglePair& first) {
    const Triangle ta = a.world_triangle(first.a), tb = b.world_triangle(first.b);
    const ClosestPoints common = triangle_triangle_distance(ta, tb);
    Clash clash;
    clash.kind = ClashKind::touch;
    clash.point_a = common.a, clash.point_b = common.b;
    clash.direction = triangle_triangle_penetration(ta, tb).direction;
    return clash;
}

Clash meeting_clash(const WorldSolid& a, const WorldSolid& b, const std::vector<Contact>& contacts,
                    double touch) {
    Clash clash = touch_clash(a, b, contacts.front().pair);
    clash.triangle_pairs = contacts.size();
    const Meeting meeting = examine_meeting(a, b, contacts);
    if (meeting.parting != Vec3{})
        clash.direction = meeting.parting;
    if (meeting.interpenetrate) {
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
    }
    return clash;
}

bool lies_inside(const WorldSolid& inner, const WorldSolid& outer) {
    const std::vector<Vec3> points = inner.component_points();
    return std::all_of(points.begin(), points.end(),
                       [&](const Vec3& point) { return outer.winds_around(point); });
}

Clash apart_clash(const Gap& gap, bool contained) {
    Clash clash;
    clash.kind = contained ? ClashKind::contained : ClashKind::clearance;
    clash.distance = contained ? -gap.distance : gap.distance;
    clash.point_a = gap.point_a, clash.point_b = gap.point_b;
    const Vec3 away = normalized_or_zero(gap.point_b - gap.point_a);
    clash.direction = contained ? -away : away;
    return clash;
}

} // namespace abut
