#include "world/curved/curved_side.h"

#include "math/vector.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace abut {

namespace {

/// A corner of the rim is as far along a direction as another place of it if they differ by at most this
/// share of the solid's size.
constexpr double kAsFar = 0x1p-44;

/// A direction along the axes of a solid.
struct LocalDirection {
    double x, y, z, across;

    LocalDirection(const SupportShape& solid, const Vec3& direction)
        : x(dot(solid.axis[0], direction)), y(dot(solid.axis[1], direction)),
          z(dot(solid.axis[2], direction)), across(std::sqrt(x * x + y * y)) {}
};

/// The rim of the disc at the end of the axis (sign 1) or at its start (sign -1).
CurvedSide disc_of(const SupportShape& solid, double sign, const LocalDirection& d) {
    constexpr auto kRim = CurvedSide::kRim;
    constexpr double kStep = 2 * std::numbers::pi / kRim;
    const double radius = solid.half[0];
    const Vec3 middle = sign * solid.half[2] * solid.axis[2];
    const std::uint32_t first = sign > 0 ? 0 : kRim;
    std::uint32_t farthest = kRim;
    if (d.across > 0) {
        const double turns = std::atan2(d.y, d.x) / kStep;
        const auto nearest = static_cast<std::int32_t>(std::lround(turns));
        const double missed = 1 - std::cos(kStep * (turns - nearest));
        if (radius * d.across * missed > kAsFar * (radius + solid.half[2]))
            farthest = static_cast<std::uint32_t>(nearest + static_cast<std::int32_t>(kRim)) % kRim;
    }
    CurvedSide side;
    side.normal = sign * solid.axis[2];
    for (std::uint32_t i = 0; i < kRim; ++i) {
        const std::uint32_t k = sign > 0 ? i : kRim - 1 - i;
        const double angle = kStep * k;
        const bool is_farthest = k == farthest;
        const double x = is_farthest ? d.x / d.across : std::cos(angle),
                     y = is_farthest ? d.y / d.across : std::sin(angle);
        const std::uint32_t edge = sign > 0 ? k : (k + kRim - 1) % kRim;
        side.corners.push_back(
            {middle + radius * (x * solid.axis[0] + y * solid.axis[1]), first + k, first + edge});
    }
    return side;
}

/// The line on the side that is farthest along a direction. Of a cone whose apex points there, the apex.
CurvedSide line_of(const SupportShape& solid, const LocalDirection& d) {
    constexpr double kTellsLine = 0x1p-20;
    const Vec3 along = solid.half[2] * solid.axis[2];
    const Vec3 out = d.across > 0
                         ? (solid.half[0] / d.across) * (d.x * solid.axis[0] + d.y * solid.axis[1])
                         : Vec3{};
    constexpr auto kLine = CurvedSide::kLine;
    const bool is_cone = solid.kind == CoreKind::cone;
    CurvedSide side;
    if (!is_cone || d.across > kTellsLine)
        side.corners.push_back({out - along, kLine, kLine});
    side.corners.push_back({is_cone ? along : out + along, kLine + 1, kLine});
    return side;
}

/// Keeps the part of a line where a t^2 + 2 b t + c <= 0, which is one piece. In: a is not negative.
bool keep_below(double a, double b, double c, LineChord& part) {
    if (!(a > 0)) {
        return c <= 0;
    }
    const double discriminant = b * b - a * c;
    if (!(discriminant >= 0))
        return false;
    // The root without cancellation first.
    const double q = -(b + with_sign(std::sqrt(discriminant), b));
    const double t = q / a, u = q != 0 ? c / q : t;
    part.begin = std::max(part.begin, std::min(t, u));
    part.end = std::min(part.end, std::max(t, u));
    return true;
}

/// Keeps the part of a line where low <= p + t v <= high.
bool keep_between(double p, double v, double low, double high, LineChord& part) {
    if (v == 0)
        return low <= p && p <= high;
    const double t = (low - p) / v, u = (high - p) / v;
    part.begin = std::max(part.begin, std::min(t, u));
    part.end = std::min(part.end, std::max(t, u));
    return true;
}

/// Keeps the part of a line where x^2 + y^2 <= k^2 w^2, with w the distance below the apex. The part with
/// a negative w is cut off elsewhere.
bool keep_in_cone(const Vec3& p, const Vec3& v, double height, double slope, LineChord& part) {
    const double w = height - p.z, sq = slope * slope;
    const double a = v.x * v.x + v.y * v.y - sq * v.z * v.z,
                 b = v.x * p.x + v.y * p.y + sq * v.z * w, c = p.x * p.x + p.y * p.y - sq * w * w;
    if (a > 0)
        return keep_below(a, b, c, part);
    const double discriminant = std::max(b * b - a * c, 0.0);
    const double q = -(b + with_sign(std::sqrt(discriminant), b));
    // Such a line enters through the side once: w grows along it, or against it.
    const double t = a != 0 ? q / a : HUGE_VAL, u = q != 0 ? c / q : t;
    if (v.z < 0)
        part.begin = std::max(part.begin, a != 0 ? std::max(t, u) : u);
    else
        part.end = std::min(part.end, a != 0 ? std::min(t, u) : u);
    return true;
}

} // namespace

const CurvedSide::Corner& CurvedSide::farthest(const Vec3& direction) const {
    return *std::max_element(corners.begin(), corners.end(), [&](const Corner& p, const Corner& q) {
        return dot(p.at, direction) < dot(q.at, direction);
    });
}

bool CurvedSide::lies_across(const Vec3& direction) const {
    constexpr double kSin = 0.035, kCos = 0.9994;
    if (is_disc())
        return std::abs(dot(normal, direction)) > kCos;
    if (corners.size() < 2)
        return false;
    const Vec3 way = corners[1].at - corners[0].at;
    return std::abs(dot(way, direction)) < kSin * length(way);
}

bool has_curved_side(const SupportShape& solid) {
    const bool is_curved = solid.kind == CoreKind::cylinder || solid.kind == CoreKind::cone ||
                           solid.kind == CoreKind::ellipsoid;
    return is_curved && solid.radius == 0 && solid.inset == 0 &&
           std::all_of(solid.half.begin(), solid.half.end(), [](double h) { return h > 0; });
}

CurvedSide side_towards(const SupportShape& solid, const Vec3& direction) {
    const LocalDirection d(solid, direction);
    if (solid.kind == CoreKind::ellipsoid) {
        CurvedSide side;
        side.corners.push_back({farthest(solid, direction), 0, 0});
        return side;
    }
    if (solid.kind == CoreKind::cylinder)
        return std::abs(d.z) >= d.across ? disc_of(solid, with_sign(1, d.z), d) : line_of(solid, d);
    const double r = solid.half[0], length_of_axis = 2 * solid.half[2];
    const double cosine_of_side =
        (length_of_axis * d.across + r * d.z) / std::sqrt(length_of_axis * length_of_axis + r * r);
    return -d.z >= cosine_of_side ? disc_of(solid, -1, d) : line_of(solid, d);
}

std::optional<LineChord> part_inside(const SupportShape& solid, const Vec3& from,
                                     const Vec3& along) {
    const auto local = [&](const Vec3& v) {
        return Vec3{dot(solid.axis[0], v), dot(solid.axis[1], v), dot(solid.axis[2], v)};
    };
    const auto& [a, b, c] = solid.half;
    Vec3 p = local(from), v = local(along);
    LineChord part{-HUGE_VAL, HUGE_VAL};
    bool is_inside = true;
    if (solid.kind == CoreKind::ellipsoid) {
        p = {p.x / a, p.y / b, p.z / c}, v = {v.x / a, v.y / b, v.z / c};
        is_inside = keep_below(dot(v, v), dot(p, v), dot(p, p) - 1, part);
    } else {
        is_inside =
            keep_between(p.z, v.z, -c, c, part) &&
            (solid.kind == CoreKind::cone ? keep_in_cone(p, v, c, a / (2 * c), part)
                                          : keep_below(v.x * v.x + v.y * v.y, p.x * v.x + p.y * v.y,
                                                       p.x * p.x + p.y * p.y - a * a, part));
    }
    if (!is_inside || !(part.begin <= part.end))
        return std::nullopt;
    return part;
}

} // namespace abut
