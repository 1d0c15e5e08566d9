#include "toolbox/gizmo.h"

#include <abut/renderer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace abut::viewer {

namespace {

constexpr double kArrowPixels = 95;  ///< length of the arrows
constexpr double kRingOfArrow = 1.2; ///< radius of the rings
constexpr double kGripOfArrow = 0.8; ///< where an arrow is taken; near its tip no ring crosses it
constexpr double kGripAngle = 0.6;   ///< where a ring is taken, radians
constexpr double kReachPixels = 9;   ///< of the mouse around a line
constexpr int kRingPoints = 64;
constexpr double kParallel = 1e-3; ///< square of the sine below which directions are parallel

/// A point of a ring, at an angle.
Vec3 on_ring(const Gizmo& gizmo, int about, double angle) {
    const Vec3 x = axis((about + 1) % 3), y = axis((about + 2) % 3);
    return gizmo.middle + (kRingOfArrow * gizmo.size) * (std::cos(angle) * x + std::sin(angle) * y);
}

std::optional<ScreenPoint> screen_point(const Camera& camera, const Vec3& point) {
    const std::optional<Vec3> seen = on_screen(camera, point);
    return seen ? std::optional(ScreenPoint{seen->x, seen->y}) : std::nullopt;
}

double distance_to_segment(const ScreenPoint& p, const ScreenPoint& a, const ScreenPoint& b) {
    const double x = b.x - a.x, y = b.y - a.y, length_sq = x * x + y * y;
    const double along = (p.x - a.x) * x + (p.y - a.y) * y;
    const double t = length_sq > 0 ? std::clamp(along / length_sq, 0.0, 1.0) : 0;
    return std::hypot(p.x - a.x - t * x, p.y - a.y - t * y);
}

} // namespace

const char* to_string(Handle handle) {
    static constexpr std::array kNames{"move_x", "move_y", "move_z", "turn_x", "turn_y", "turn_z"};
    return kNames.at(static_cast<std::size_t>(handle));
}

bool is_move(Handle handle) {
    return handle <= Handle::move_z;
}

int axis_of(Handle handle) {
    return static_cast<int>(handle) % 3;
}

Gizmo gizmo_at(const Camera& camera, const Vec3& middle) {
    const double depth = std::max(camera.near, dot(middle - camera.eye, unit(camera.forward)));
    return {middle, kArrowPixels * length_of_pixel(camera) * depth};
}

std::vector<ScreenPoint> line_of(const Camera& camera, const Gizmo& gizmo, Handle handle) {
    std::vector<ScreenPoint> line;
    const auto add = [&](const Vec3& point) {
        if (const auto seen = screen_point(camera, point))
            line.push_back(*seen);
    };
    if (is_move(handle)) {
        add(gizmo.middle);
        add(gizmo.middle + gizmo.size * axis(axis_of(handle)));
        return line;
    }
    for (int i = 0; i <= kRingPoints; ++i)
        add(on_ring(gizmo, axis_of(handle), 2 * std::numbers::pi * i / kRingPoints));
    return line;
}

std::optional<ScreenPoint> grip_of(const Camera& camera, const Gizmo& gizmo, Handle handle) {
    return screen_point(camera, is_move(handle) ? gizmo.middle + (kGripOfArrow * gizmo.size) *
                                                                     axis(axis_of(handle))
                                                : on_ring(gizmo, axis_of(handle), kGripAngle));
}

std::optional<Handle> handle_at(const Camera& camera, const Gizmo& gizmo, const ScreenPoint& at) {
    std::optional<Handle> nearest;
    double least = kReachPixels;
    for (const Handle handle : kHandles) {
        const std::vector<ScreenPoint> line = line_of(camera, gizmo, handle);
        for (std::size_t i = 1; i < line.size(); ++i) {
            const double off = distance_to_segment(at, line[i - 1], line[i]);
            if (off < least)
                least = off, nearest = handle;
        }
    }
    return nearest;
}

GizmoDrag::GizmoDrag(const Camera& camera, const Gizmo& gizmo, Handle handle, const ScreenPoint& at)
    : handle_(handle), gizmo_(gizmo), start_(place(camera, at).value_or(0)) {}

/// Where a point of the window is along the axis, or around it.
std::optional<double> GizmoDrag::place(const Camera& camera, const ScreenPoint& at) const {
    const Ray ray = ray_through(camera, at.x, at.y);
    const Vec3 along = axis(axis_of(handle_)), way = unit(ray.direction);
    const Vec3 from = ray.origin - gizmo_.middle;
    const double cosine = dot(along, way);
    if (is_move(handle_)) {
        // The point of the axis that is nearest to the ray.
        const double sine_sq = 1 - cosine * cosine;
        if (sine_sq < kParallel)
            return std::nullopt;
        return (dot(from, along) - cosine * dot(from, way)) / sine_sq;
    }
    if (cosine * cosine < kParallel)
        return std::nullopt;
    const Vec3 hit = from - (dot(from, along) / cosine) * way;
    return std::atan2(dot(hit, axis((axis_of(handle_) + 2) % 3)),
                      dot(hit, axis((axis_of(handle_) + 1) % 3)));
}

double GizmoDrag::amount(const Camera& camera, const ScreenPoint& at) {
    if (const std::optional<double> now = place(camera, at)) {
        // The nearest turn to the last one, so that several turns add up.
        const double change = *now - start_;
        amount_ = is_move(handle_)
                      ? change
                      : amount_ + std::remainder(change - amount_, 2 * std::numbers::pi);
    }
    return amount_;
}

} // namespace abut::viewer
