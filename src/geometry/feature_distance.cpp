#include "geometry/feature_distance.h"

#include "geometry/scaled_patch.h"

#include <algorithm>
#include <limits>

namespace abut {

FeatureDistance feature_distance(ElementaryKind kind, const std::array<Vec3, 4>& points) {
    const ScaledPatch patch({kind, points, points});
    const NearestOnPatch nearest = nearest_on_patch(patch.start);
    // Scaling rounds where the result is denormal.
    constexpr double kLeast = std::numeric_limits<double>::denorm_min();
    FeatureDistance result;
    const double distance = patch.unscaled(nearest.distance);
    result.distance_sq = distance * distance;
    result.lower = std::max(0.0, patch.unscaled(nearest.lower) - kLeast);
    result.upper = patch.unscaled(nearest.upper) + kLeast;
    result.barycentric = patch_barycentric(kind, nearest.x, nearest.y);
    return result;
}

} // namespace abut
