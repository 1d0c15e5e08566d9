#include "world/solids/segment_overlap.h"

#include "world/solids/capsule_height.h"

#include <algorithm>

namespace abut {

namespace {

double square(double v) {
    return v * v;
}

Vec3 place_of(const FlatCorner& corner) {
    return {corner.x, corner.y, corner.height};
}

} // namespace

void add_segment_overlap(const FlatSegment& a, const FlatSegment& b,
                         ContactCandidates& candidates) {
    const double radii = a.radius + b.radius;
    if (!(radii > 0))
        return;
    const Vec3 a0 = place_of(a.ends[0]), a1 = place_of(a.ends[1]);
    const Vec3 b0 = place_of(b.ends[0]), b1 = place_of(b.ends[1]);
    const CapsuleSurface surface_a(a0, a1, a.radius), surface_b(b0, b1, b.radius);
    const double reach_sq =
        square(kNamedShare) * std::min(surface_a.across_sq(), surface_b.across_sq());
    // The end of one axis and the point of the other beside it; the place of contact divides their
    // difference as the radii.
    const auto add = [&](const NearestCorner& near_a, double x_a, double y_a,
                         const NearestCorner& near_b, double x_b, double y_b, FeatureKind end) {
        const double share = a.radius / radii;
        const double x = x_a + share * (x_b - x_a), y = y_a + share * (y_b - y_a);
        const auto top = surface_a.height(x, y, 1), bottom = surface_b.height(x, y, -1);
        if (!top || !bottom)
            return;
        add_candidate(candidates,
                      {x, y, *top, -*bottom,
                       name_of(kind_within(reach_sq, near_a, near_b, end), near_a, near_b, 0, 0)});
    };
    for (const FlatCorner& end : a.ends)
        if (const auto t = surface_b.beside(end.x, end.y, radii)) {
            const double x = b0.x + *t * (b1.x - b0.x), y = b0.y + *t * (b1.y - b0.y);
            add(NearestCorner(end), end.x, end.y, NearestCorner(b.ends, x, y), x, y,
                FeatureKind::vertex_of_a);
        }
    for (const FlatCorner& end : b.ends)
        if (const auto t = surface_a.beside(end.x, end.y, radii)) {
            const double x = a0.x + *t * (a1.x - a0.x), y = a0.y + *t * (a1.y - a0.y);
            add(NearestCorner(a.ends, x, y), x, y, NearestCorner(end), end.x, end.y,
                FeatureKind::vertex_of_b);
        }
}

} // namespace abut
