#include "deform/feature_pairs.h"

namespace abut {

namespace {

struct Bounds {
    Vec3 low, high;
};

Bounds bounds_of(const PairVertices& vertices, std::size_t first, std::size_t last,
                 Vec3 MovingVertex::*end) {
    Bounds bounds{vertices[first]->*end, vertices[first]->*end};
    for (std::size_t i = first + 1; i < last; ++i) {
        bounds.low = min(bounds.low, vertices[i]->*end);
        bounds.high = max(bounds.high, vertices[i]->*end);
    }
    return bounds;
}

} // namespace

bool boxes_apart(ElementaryKind kind, const PairVertices& vertices, double margin) {
    const std::size_t second = kind == ElementaryKind::vertex_face ? 1 : 2;
    const Bounds a0 = bounds_of(vertices, 0, second, &MovingVertex::start),
                 b0 = bounds_of(vertices, second, 4, &MovingVertex::start),
                 a1 = bounds_of(vertices, 0, second, &MovingVertex::end),
                 b1 = bounds_of(vertices, second, 4, &MovingVertex::end);
    // Along each axis: the larger of the overlaps at the two ends, once with a below b and once
    // with a above b. If it is below -margin, the boxes are apart at both ends, on the same side. A
    // rounded difference is below a double only if the exact one is.
    const Vec3 below = max(a0.high - b0.low, a1.high - b1.low),
               above = max(b0.high - a0.low, b1.high - a1.low), least = min(below, above);
    return std::min({least.x, least.y, least.z}) < -margin;
}

} // namespace abut
