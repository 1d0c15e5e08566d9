#include "volume/fit/principal_axes.h"

#include "volume/fit/convex_hull.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

namespace abut {

namespace {

// With at most this many triangles (a leaf and a little more), a hull costs more than it gains.
constexpr std::size_t kFew = 8;
// A set flatter than this ratio of standard deviations has no useful hull.
constexpr double kFlat = 1e-6;
// A hull costs about 4 us a vertex. With more than kManyPoints points, the hull is built of the
// extreme points along kDirections directions, which is enough for a covariance.
constexpr std::size_t kManyPoints = 384, kDirections = 64;

struct Principal {
    Axes axes;
    double thinness = 0; ///< ratio of the least to the largest standard deviation
};

/// Keeps the first axis, and makes each further axis orthogonal to those before it.
Axes orthonormal(const Eigen::Matrix3d& v) {
    const Vec3 x{v(0, 2), v(1, 2), v(2, 2)}, y{v(0, 1), v(1, 1), v(2, 1)};
    const Vec3 first = normalized_or_zero(x);
    const Vec3 second = normalized_or_zero(y - dot(y, first) * first);
    return {first, second, cross(first, second)};
}

/// Sums weighted points about an origin and computes the principal axes of their covariance.
class Covariance {
public:
    void add(const Vec3& p, double weight) {
        const Eigen::Vector3d v(p.x, p.y, p.z);
        sum_ += weight * v * v.transpose();
    }
    [[nodiscard]] Principal principal() const {
        // Products of very large or very small coordinates may overflow or underflow.
        const double size = sum_.cwiseAbs().maxCoeff();
        if (!(size > 0) || !sum_.allFinite())
            return {{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, 0};
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sum_ / size);
        const Eigen::Vector3d& values = solver.eigenvalues();
        return {orthonormal(solver.eigenvectors()),
                std::sqrt(std::max(0.0, values[0]) / values[2])};
    }

private:
    Eigen::Matrix3d sum_ = Eigen::Matrix3d::Zero();
};

Principal principal_of(std::span<const Vec3> points) {
    Vec3 mean;
    for (const Vec3& p : points)
        mean = mean + (1.0 / static_cast<double>(points.size())) * p;
    Covariance covariance;
    for (const Vec3& p : points)
        covariance.add(p - mean, 1);
    return covariance.principal();
}

std::vector<Vec3> vertices_of(std::span<const Triangle> triangles) {
    std::vector<Vec3> vertices;
    vertices.reserve(3 * triangles.size());
    for (const Triangle& t : triangles)
        vertices.insert(vertices.end(), t.begin(), t.end());
    return vertices;
}

/// Directions spread evenly over a half sphere, along a spiral.
std::array<Vec3, kDirections> spiral() {
    std::array<Vec3, kDirections> directions;
    for (std::size_t i = 0; i < kDirections; ++i) {
        const double z = (static_cast<double>(i) + 0.5) / kDirections;
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / std::numbers::phi;
        const double r = std::sqrt(1 - z * z);
        directions[i] = {r * std::cos(angle), r * std::sin(angle), z};
    }
    return directions;
}

/// The distinct points. If there are many, only those that are extreme along some direction.
std::vector<Vec3> candidates_for_hull(std::vector<Vec3> points) {
    const auto key = [](const Vec3& p) { return std::tie(p.x, p.y, p.z); };
    if (points.size() > kManyPoints) {
        static const std::array<Vec3, kDirections> directions = spiral();
        std::vector<Vec3> extremes;
        for (const Vec3& direction : directions) {
            const Vec3 *low = &points[0], *high = low;
            double least = dot(direction, *low), most = least;
            for (const Vec3& p : points) {
                const double x = dot(direction, p);
                if (x < least)
                    least = x, low = &p;
                if (x > most)
                    most = x, high = &p;
            }
            extremes.insert(extremes.end(), {*low, *high});
        }
        points = std::move(extremes);
    }
    std::sort(points.begin(), points.end(),
              [&](const Vec3& p, const Vec3& q) { return key(p) < key(q); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

Principal principal_of(std::span<const Triangle> surface) {
    const Vec3 origin = surface[0][0];
    Vec3 mean;
    double area = 0;
    for (const Triangle& t : surface) {
        const double w = length(cross(t[1] - t[0], t[2] - t[0]));
        mean = mean + (w / 3) * ((t[0] - origin) + (t[1] - origin) + (t[2] - origin));
        area += w;
    }
    if (!(area > 0))
        return principal_of(vertices_of(surface));
    mean = origin + (1 / area) * mean;
    // The integral of x x^T over a triangle is (9 c c^T + p p^T + q q^T + r r^T) area / 12, where c
    // is the centroid.
    Covariance covariance;
    for (const Triangle& t : surface) {
        const double w = length(cross(t[1] - t[0], t[2] - t[0])) / area;
        const std::array d{t[0] - mean, t[1] - mean, t[2] - mean};
        covariance.add((1.0 / 3) * (d[0] + d[1] + d[2]), 9 * w);
        for (const Vec3& p : d)
            covariance.add(p, w);
    }
    return covariance.principal();
}

} // namespace

Axes principal_axes(std::span<const Vec3> points) {
    return principal_of(points).axes;
}

Axes principal_axes(std::span<const Triangle> surface) {
    return principal_of(surface).axes;
}

Axes hull_axes(std::span<const Triangle> triangles) {
    const Principal own = principal_of(triangles);
    if (triangles.size() <= kFew || own.thinness < kFlat)
        return own.axes;
    const std::vector<Triangle> hull = convex_hull(candidates_for_hull(vertices_of(triangles)));
    return hull.empty() ? own.axes : principal_of(hull).axes;
}

} // namespace abut
