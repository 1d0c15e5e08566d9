#include "deform/rest/feature_pair.h"

#include "math/predicates.h"

#include <algorithm>

namespace abut {

void measure(FeaturePair& pair, const std::array<Vec3, 4>& p, const FeatureDistance& found) {
    pair.distance = std::min(found.distance, pair.limit);
    pair.barycentric = found.barycentric;
    const auto& [u, v, w] = found.barycentric;
    // Both signs are that of the determinant of the two edges, or the face's two sides, and the
    // difference of the features.
    if (pair.kind == ElementaryKind::vertex_face) {
        pair.side = static_cast<std::int8_t>(orient3d(p[1], p[2], p[3], p[0]));
        pair.weights = {1, -u, -v, -w};
        pair.point_a = p[0];
        pair.point_b = u * p[1] + v * p[2] + w * p[3];
    } else {
        pair.side = static_cast<std::int8_t>(orient3d(p[0], p[1], p[2], p[3]));
        pair.weights = {1 - u, u, v - 1, -v};
        pair.point_a = (1 - u) * p[0] + u * p[1];
        pair.point_b = (1 - v) * p[2] + v * p[3];
    }
    if (found.lower > 0) {
        pair.normal = -found.direction;
        return;
    }
    const Vec3 across = common_normal(pair.kind, p);
    pair.normal = pair.side < 0 ? -across : across;
}

} // namespace abut
