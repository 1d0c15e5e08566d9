#include "world/solids/segment_overlap.h"

#include "world/solids/capsule_height.h"

#include <algorithm>
#include <optional>

namespace abut {

namespace {

double square(double v) {
    return v * v;
}

/// The parameter of the point of the segment from p to q that is nearest to a point across the
/// normal; none if it is an end, or if the segment is parallel to the normal.
std::optional<double> inner_nearest(const FlatCorner& p, const FlatCorner& q, double x, double y) {
    const double length_sq = square(q.x - p.x) + square(q.y - p.y);
    const double along = (x - p.x) * (q.x - p.x) + (y - p.y) * (q.y - p.y);
    if (!(along >= 0 && along <= length_sq && length_sq > 0))
        return std::nullopt;
    return along / length_sq;
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
    const double reach_sq =
        square(kNamedShare) * std::min(square(a1.x - a0.x) + square(a1.y - a0.y),
                                       square(b1.x - b0.x) + square(b1.y - b0.y));
    // The end of one axis and the point of the other beside it; the place of contact divides their
    // difference as the radii.
    const auto add = [&](double x_a, double y_a, double x_b, double y_b, FeatureKind end) {
        // One of the two is straight beside the other's axis, so that no place is over both.
        if (square(x_b - x_a) + square(y_b - y_a) > square(radii))
            return;
        const double share = a.radius / radii;
        const double x = x_a + share * (x_b - x_a), y = y_a + share * (y_b - y_a);
        const auto top = capsule_height(a0, a1, a.radius, x, y, 1),
                   bottom = capsule_height(b0, b1, b.radius, x, y, -1);
        if (!top || !bottom)
            return;
        const NearestCorner near_a(a.ends, x_a, y_a), near_b(b.ends, x_b, y_b);
        add_candidate(candidates,
                      {x, y, *top, -*bottom,
                       name_of(kind_within(reach_sq, near_a, near_b, end), near_a, near_b, 0, 0)});
    };
    for (const FlatCorner& end : a.ends)
        if (const auto t = inner_nearest(b.ends[0], b.ends[1], end.x, end.y))
            add(end.x, end.y, b0.x + *t * (b1.x - b0.x), b0.y + *t * (b1.y - b0.y),
                FeatureKind::vertex_of_a);
    for (const FlatCorner& end : b.ends)
        if (const auto t = inner_nearest(a.ends[0], a.ends[1], end.x, end.y))
            add(a0.x + *t * (a1.x - a0.x), a0.y + *t * (a1.y - a0.y), end.x, end.y,
                FeatureKind::vertex_of_b);
}

} // namespace abut
