#include "ccd/scaled_patch.h"

#include "ccd/rounded_patch.h"

#include <cmath>
#include <limits>

namespace abut {

namespace {

double size_of(const RoundedPatch& p) {
    return p.corner.size + p.side_x.size + p.side_y.size;
}

ElementaryPair eighth_of(ElementaryPair pair) {
    for (auto* points : {&pair.start, &pair.end})
        for (Vec3& p : *points)
            p = 0.125 * p;
    return pair;
}

} // namespace

ScaledPatch::ScaledPatch(const ElementaryPair& pair) {
    RoundedPatch patch(pair);
    int pair_exponent = 0;
    // The digits that an eighth of a coordinate loses to underflow are negligible beside a size
    // that overflows.
    if (!std::isfinite(size_of(patch))) {
        patch = RoundedPatch(eighth_of(pair));
        pair_exponent = 3;
    }
    const double size = size_of(patch);
    using Limits = std::numeric_limits<double>;
    int patch_exponent = Limits::min_exponent - Limits::digits;
    if (size > 0)
        std::frexp(size, &patch_exponent);
    exponent = pair_exponent + patch_exponent;
    const PowerOfTwo scale(-patch_exponent);
    start = {pair.kind, scale * patch.corner.start, scale * patch.side_x.start,
             scale * patch.side_y.start};
    end = {pair.kind, scale * patch.corner.end, scale * patch.side_x.end, scale * patch.side_y.end};
}

ScaledPatch::ScaledPatch(ElementaryKind kind, const std::array<Vec3, 4>& points) {
    const PatchLayout layout = patch_layout(kind);
    const auto vector = [&](const VertexDifference& d) { return points[d.to] - points[d.from]; };
    const Vec3 corner = vector(layout.corner), side_x = vector(layout.side_x),
               side_y = vector(layout.side_y);
    const double size = max_abs(corner) + max_abs(side_x) + max_abs(side_y);
    using Limits = std::numeric_limits<double>;
    if (!(size >= Limits::min() && size <= Limits::max())) {
        *this = ScaledPatch(ElementaryPair{kind, points, points});
        return;
    }
    std::frexp(size, &exponent);
    const PowerOfTwo scale(-exponent);
    start = end = {kind, scale * corner, scale * side_x, scale * side_y};
}

FlatPatch ScaledPatch::at(double t) const {
    const auto blend = [t](const Vec3& a, const Vec3& b) { return (1 - t) * a + t * b; };
    return {start.kind, blend(start.corner, end.corner), blend(start.side_x, end.side_x),
            blend(start.side_y, end.side_y)};
}

} // namespace abut
