#include <abut/tour.h>

#include "core/arguments.h"
#include "math/vector.h"
#include "view/camera/camera_frame.h"
#include "view/camera/tour_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace abut {

namespace {

/// A rotation: w, x, y, z.
using Quaternion = std::array<double, 4>;

/// Returns the rotation that turns the axes x, y, z to the right, forward and up of a camera.
Quaternion rotation_of(const CameraFrame& frame) {
    const Vec3 &x = frame.right, &y = frame.forward, &z = frame.up;
    // Of four times the squares of w, x, y, z, the largest is at least 1.
    const std::array<double, 4> squares{1 + x.x + y.y + z.z, 1 + x.x - y.y - z.z,
                                        1 - x.x + y.y - z.z, 1 - x.x - y.y + z.z};
    const auto largest = std::max_element(squares.begin(), squares.end()) - squares.begin();
    const double s = 0.5 / std::sqrt(squares.at(static_cast<std::size_t>(largest)));
    const double most = 0.25 / s;
    switch (largest) {
    case 0:
        return {most, s * (y.z - z.y), s * (z.x - x.z), s * (x.y - y.x)};
    case 1:
        return {s * (y.z - z.y), most, s * (x.y + y.x), s * (x.z + z.x)};
    case 2:
        return {s * (z.x - x.z), s * (x.y + y.x), most, s * (y.z + z.y)};
    default:
        return {s * (x.y - y.x), s * (x.z + z.x), s * (y.z + z.y), most};
    }
}

Vec3 rotate_by(const Quaternion& q, const Vec3& v) {
    const Vec3 axis{q[1], q[2], q[3]};
    const Vec3 t = 2 * cross(axis, v);
    return v + q[0] * t + cross(axis, t);
}

/// Spherical interpolation on the shorter way.
Quaternion between(const Quaternion& a, Quaternion b, double share) {
    double cosine = 0;
    for (std::size_t i = 0; i < 4; ++i)
        cosine += a.at(i) * b.at(i);
    for (double& value : b)
        value = cosine < 0 ? -value : value;
    const double angle = std::acos(std::min(std::abs(cosine), 1.0));
    // Of equal rotations, the sines vanish, and so does the difference to a straight line.
    const bool is_straight = angle < 1e-6;
    const double of_a = is_straight ? 1 - share : std::sin((1 - share) * angle) / std::sin(angle);
    const double of_b = is_straight ? share : std::sin(share * angle) / std::sin(angle);
    Quaternion q{};
    double square = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        q.at(i) = of_a * a.at(i) + of_b * b.at(i);
        square += q.at(i) * q.at(i);
    }
    for (double& value : q)
        value /= std::sqrt(square);
    return q;
}

/// Velocity at a point: that between its neighbours, or one of them at an end or a cut.
Vec3 velocity_at(const std::vector<TourPoint>& points, std::size_t i) {
    const std::size_t before = i > 0 && points[i - 1].seconds < points[i].seconds ? i - 1 : i;
    const std::size_t after =
        i + 1 < points.size() && points[i].seconds < points[i + 1].seconds ? i + 1 : i;
    const double seconds = points[after].seconds - points[before].seconds;
    return seconds > 0 ? (1 / seconds) * (points[after].eye - points[before].eye) : Vec3{};
}

} // namespace

Camera camera_of(const TourPoint& point, const Camera& lens) {
    Camera camera = lens;
    camera.eye = point.eye, camera.forward = point.forward, camera.up = point.up;
    return camera;
}

double duration(const Tour& tour) {
    return tour.points.empty() ? 0 : tour.points.back().seconds;
}

Camera camera_at(const Tour& tour, double seconds, const Camera& lens) {
    const std::vector<TourPoint>& points = tour.points;
    require(!points.empty(), "tour has no points");
    require(!std::isnan(seconds), "time of the tour is not a number");
    const auto after = std::ranges::upper_bound(points, seconds, {}, &TourPoint::seconds);
    if (after == points.begin() || after == points.end()) {
        Camera camera = camera_of(after == points.end() ? points.back() : points.front(), lens);
        const CameraFrame checks(camera);
        return camera;
    }
    const auto i = static_cast<std::size_t>(after - points.begin()) - 1;
    const TourPoint &a = points[i], &b = points[i + 1];
    const CameraFrame frame_a(camera_of(a, lens)), frame_b(camera_of(b, lens));
    const double length = b.seconds - a.seconds;
    const double u = (seconds - a.seconds) / length;
    // The cubic with these positions and velocities at both ends.
    const Vec3 from_a = velocity_at(points, i), from_b = velocity_at(points, i + 1);
    Camera camera = lens;
    camera.eye = a.eye + (u * u * (3 - 2 * u)) * (b.eye - a.eye) +
                 (length * u * (1 - u) * (1 - u)) * from_a - (length * u * u * (1 - u)) * from_b;
    const Quaternion q = between(rotation_of(frame_a), rotation_of(frame_b), u);
    camera.forward = rotate_by(q, {0, 1, 0});
    camera.up = rotate_by(q, {0, 0, 1});
    return camera;
}

void record(Tour& tour, double seconds, const Camera& camera, const std::string& name) {
    constexpr double kLeastSeconds = 1.0 / 30;
    const CameraFrame checks(camera);
    require(std::isfinite(seconds), "time of the tour is not finite");
    require(tour.points.empty() || seconds >= duration(tour),
            "time is before that of the tour's last point");
    if (!tour.points.empty() && name.empty() && seconds < duration(tour) + kLeastSeconds)
        return;
    tour.points.push_back({seconds, camera.eye, camera.forward, camera.up, name});
}

} // namespace abut
