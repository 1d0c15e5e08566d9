#include "volume/ssv.h"

#include "volume/fit/principal_axes.h"

#include <algorithm>
#include <numbers>
#include <vector>

namespace abut {

namespace {

// Costs in tests of two points, measured. The second is that of all that follows from a pair that
// its test does not tell apart.
constexpr std::array<double, 3> kTestCost{1, 3, 30};
constexpr double kOpeningCost = 300;

/// The measure of the relative placements at which the volume meets a copy of itself.
double measure(const Ssv& swept) {
    constexpr double kPi = std::numbers::pi;
    const double a = 2 * double{swept.axes[0].half}, b = 2 * double{swept.axes[1].half},
                 r = swept.radius;
    const double volume = 2 * a * b * r + kPi * (a + b) * r * r + (4 * kPi / 3) * r * r * r;
    const double surface = 2 * a * b + 2 * kPi * (a + b) * r + 4 * kPi * r * r;
    const double curvature = kPi * (a + b) + 4 * kPi * r;
    return 2 * volume + surface * curvature / (2 * kPi);
}

/// An image as that of a volume with more axes.
template <std::size_t dimension>
SsvImage widened(const SweptSphereImage<dimension>& image) {
    SsvImage wide;
    wide.swept = Ssv(image.swept);
    std::copy(image.dual.begin(), image.dual.end(), wide.dual.begin());
    wide.is_slanted = image.is_slanted;
    wide.circumradius = image.circumradius;
    wide.margin = image.margin;
    wide.dimension = dimension;
    return wide;
}

/// The volume with fewer axes. In: the others have no length.
template <std::size_t dimension>
SweptSphere<dimension> narrowed(const Ssv& volume) {
    SweptSphere<dimension> swept;
    swept.centre = volume.centre;
    swept.radius = volume.radius;
    for (std::size_t i = 0; i < dimension; ++i)
        swept.axes[i] = {volume.axes[i].direction, volume.axes[i].half};
    return swept;
}

} // namespace

Ssv cheapest(const Pss& point, const Lss& segment, const Rss& rectangle) {
    const std::array candidates{Ssv(point), Ssv(segment), Ssv(rectangle)};
    std::array<double, 3> measures{};
    std::transform(candidates.begin(), candidates.end(), measures.begin(), measure);
    const double least = *std::min_element(measures.begin(), measures.end());
    std::size_t best = 0;
    // Multiplied by `least`, which may be 0.
    const auto cost = [&](std::size_t kind) {
        return kTestCost[kind] * least + kOpeningCost * measures[kind];
    };
    for (std::size_t kind = 1; kind < candidates.size(); ++kind)
        if (cost(kind) < cost(best))
            best = kind;
    return candidates[best];
}

Ssv Ssv::fit(std::span<const Triangle> triangles, double margin) {
    const std::vector<Ball> vertices = vertex_balls(triangles, margin);
    const Axes directions = hull_axes(triangles);
    return cheapest(BoundingSphere::fit(triangles, margin), fit_balls<1>(vertices, directions),
                    fit_balls<2>(vertices, directions));
}

Ssv Ssv::merge(const Ssv& a, const Ssv& b) {
    std::vector<Ball> corners;
    add_corners(a, corners);
    add_corners(b, corners);
    std::vector<Vec3> points;
    points.reserve(corners.size());
    for (const Ball& ball : corners)
        points.push_back(ball.centre);
    const Axes directions = principal_axes(points);
    return cheapest(fit_balls<0>(corners, directions), fit_balls<1>(corners, directions),
                    fit_balls<2>(corners, directions));
}

SsvImage image_of(const Ssv& volume, const RelativePose& pose) {
    switch (volume.dimension()) {
    case 0:
        return widened(image_of(narrowed<0>(volume), pose));
    case 1:
        return widened(image_of(narrowed<1>(volume), pose));
    default:
        return widened(image_of(narrowed<2>(volume), pose));
    }
}

} // namespace abut
