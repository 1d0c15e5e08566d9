#include "rigid/manifold/region_frame.h"

#include "rigid/manifold/touching_direction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace abut {

namespace {

/// A closed curve that encloses less than this share of what a circle of its length would is taken
/// for a slit: its vector area is too sensitive to its gaps.
constexpr double kLeastEnclosed = 0.1;
/// Faces whose normals differ from a direction by less than 30 degrees may stand for it ...
constexpr double kCosOfCone = 0.866;
/// ... if the mean of their unit normals is so long that they are one plane, to about 6 degrees ...
constexpr double kOnePlane = 0.995;
/// ... and they hold at least this share of the curve.
constexpr double kLeastShare = 0.25;

/// Faces look the same way if the cosine between their normals is larger.
constexpr double kSameNormal = 1 - 0x1p-30;

/// Sums over the meetings of a region.
struct RegionSums {
    Vec3 normals_a, normals_b;   ///< of crossing triangles, weighted
    Vec3 touching_a, touching_b; ///< of touching and coplanar triangles, each counted once
    Vec3 across; ///< directions across the features of triangles that touch, to rounding
    int across_count = 0;
    const TriangleMeeting* in_touch = nullptr; ///< one of those
    Vec3 common_area;                          ///< of touching faces
    Vec3 moment;
    double length = 0; ///< of the curve
    bool touches = false;
    bool is_flush = false; ///< some touching faces have the same normal

    void add_across(const TriangleMeeting& m) {
        across = across + m.across, across_count += m.across != Vec3{} ? 1 : 0;
        if (m.is_slight || m.kind != TriangleContact::none)
            in_touch = &m;
    }
    /// Returns whether all features tell about the same direction.
    [[nodiscard]] bool agrees() const {
        constexpr double kAgreeing = 1 - 0x1p-10;
        return across_count > 0 && abut::length(across) >= kAgreeing * across_count;
    }
};

/// The kind of a meeting; triangles that cross without a segment count as touching.
TriangleContact kind_of(const TriangleMeeting& m) {
    return m.kind == TriangleContact::cross && !(m.weight > 0) ? TriangleContact::touch : m.kind;
}

RegionSums sum_up(std::span<const TriangleMeeting> region) {
    RegionSums s;
    for (const TriangleMeeting& m : region) {
        const TriangleContact kind = kind_of(m);
        if (kind == TriangleContact::cross) {
            s.normals_a = s.normals_a + m.weight * m.normal_a;
            s.normals_b = s.normals_b + m.weight * m.normal_b;
            s.length += m.weight;
        } else if (kind == TriangleContact::touch) {
            s.touching_a = s.touching_a + m.normal_a, s.touching_b = s.touching_b + m.normal_b;
            s.common_area = s.common_area + m.common_area;
            s.add_across(m);
            s.touches = true;
            s.is_flush = s.is_flush || dot(m.normal_a, m.normal_b) > kSameNormal;
        } else {
            s.add_across(m);
            s.common_area = s.common_area + m.common_area;
        }
    }
    return s;
}

/// The mean of the shared points: of the curve if there is one, else of the touching ones, else of
/// the near ones.
Vec3 centre_of(std::span<const TriangleMeeting> region, const RegionSums& s) {
    const TriangleContact kind = s.length > 0 ? TriangleContact::cross
                                 : s.touches  ? TriangleContact::touch
                                              : TriangleContact::none;
    Vec3 moment;
    double total = 0;
    for (const TriangleMeeting& m : region) {
        if (kind_of(m) != kind)
            continue;
        const double weight = kind == TriangleContact::cross ? m.weight : 1;
        moment = moment + 0.5 * weight * ((m.from - region[0].from) + (m.to - region[0].from));
        total += weight;
    }
    return total > 0 ? region[0].from + (1 / total) * moment : region[0].from;
}

/// The mean normal of the flatter side, from a to b.
Vec3 flatter_side(const Vec3& normals_a, const Vec3& normals_b) {
    return length_sq(normals_a) >= length_sq(normals_b) ? normalized_or_zero(normals_a)
                                                        : normalized_or_zero(-normals_b);
}

/// The normal of a plane that many faces of a kind lie in, if it is near the direction; else the
/// direction.
Vec3 snapped(const Vec3& direction, std::span<const TriangleMeeting> region, TriangleContact kind,
             double weight_of_all) {
    Vec3 sum_a, sum_b;
    double length_a = 0, length_b = 0;
    for (const TriangleMeeting& m : region) {
        if (m.kind != kind)
            continue;
        if (dot(m.normal_a, direction) > kCosOfCone)
            sum_a = sum_a + m.weight * m.normal_a, length_a += m.weight;
        if (-dot(m.normal_b, direction) > kCosOfCone)
            sum_b = sum_b - m.weight * m.normal_b, length_b += m.weight;
    }
    const bool by_a = length(sum_a) >= length(sum_b);
    const Vec3 sum = by_a ? sum_a : sum_b;
    const double weight = by_a ? length_a : length_b;
    return weight >= kLeastShare * weight_of_all && length(sum) >= kOnePlane * weight
               ? normalized_or_zero(sum)
               : direction;
}

/// The normal of a curve where surfaces cross; zero if it has none.
Vec3 normal_of_curve(std::span<const TriangleMeeting> region, const RegionSums& s,
                     const Vec3& centre, bool closed) {
    Vec3 direction;
    if (closed) {
        Vec3 area;
        for (const TriangleMeeting& m : region)
            if (m.kind == TriangleContact::cross)
                area = area + 0.5 * cross(m.from - centre, m.to - centre);
        if (4 * std::numbers::pi * length(area) >= kLeastEnclosed * s.length * s.length)
            direction = normalized_or_zero(area);
    }
    if (direction == Vec3{})
        direction = flatter_side(s.normals_a, s.normals_b);
    return snapped(direction, region, TriangleContact::cross, s.length);
}

/// Whether the parts of the bodies inside each other lie outside a closed curve: behind both faces
/// at a segment is away from the curve's middle.
bool encloses_a_gap(std::span<const TriangleMeeting> region, const Vec3& centre) {
    double inwards = 0;
    for (const TriangleMeeting& m : region)
        if (m.kind == TriangleContact::cross)
            inwards -= m.weight * dot(m.normal_a + m.normal_b, centre - m.from);
    return inwards < 0;
}

/// The direction across features that touch. Where these tell none, or several, the other triangles
/// around the place may tell more.
Vec3 normal_of_touching(const ManifoldSide& a, const ManifoldSide& b, const RegionSums& s) {
    if (s.agrees())
        return normalized_or_zero(s.across);
    const Vec3 there = direction_at(a, b, s.in_touch->from, s.in_touch->to);
    if (there != Vec3{})
        return there;
    return s.across != Vec3{} ? normalized_or_zero(s.across)
                              : flatter_side(s.touching_a, s.touching_b);
}

/// The direction of the smallest gap. Where the gap ends on the line along a face's normal, to rounding, it is
/// that normal.
Vec3 direction_of_nearest(std::span<const TriangleMeeting> region, double rounding) {
    const TriangleMeeting& nearest = *std::max_element(
        region.begin(), region.end(),
        [](const TriangleMeeting& m, const TriangleMeeting& n) { return m.weight < n.weight; });
    const Vec3 gap = nearest.to - nearest.from;
    for (const Vec3& normal : {nearest.normal_a, nearest.normal_b})
        if (normal != Vec3{} && length(cross(gap, normal)) <= rounding)
            return dot(gap, normal) < 0 ? -normal : normal;
    return normalized_or_zero(gap);
}

/// Turns the normal of a pair without an inside so that it points to the side on which the other
/// model's middle is.
Vec3 turned_to_outside(const Vec3& normal, const ManifoldSide& a, const ManifoldSide& b,
                       const Vec3& centre) {
    const Vec3 from = a.is_oriented() ? a.model().middle() : centre,
               to = b.is_oriented() ? b.model().middle() : centre;
    const Vec3 way =
        a.is_oriented() || b.is_oriented() ? to - from : b.model().middle() - a.model().middle();
    return dot(normal, way) < 0 ? -normal : normal;
}

} // namespace

RegionFrame region_frame(const ManifoldSide& a, const ManifoldSide& b,
                         std::span<const TriangleMeeting> region, bool whole) {
    const RegionSums s = sum_up(region);
    RegionFrame frame;
    frame.centre = centre_of(region, s);
    frame.crosses = s.length > 0;
    frame.is_flush = frame.crosses && s.is_flush;
    frame.is_flat = !frame.crosses && s.common_area != Vec3{};
    frame.only_touches = !frame.crosses && s.touches && s.common_area == Vec3{};
    if (frame.crosses)
        frame.normal = normal_of_curve(region, s, frame.centre, whole);
    else if (s.common_area != Vec3{})
        frame.normal = normalized_or_zero(s.common_area);
    else if (s.in_touch != nullptr)
        frame.normal = normal_of_touching(a, b, s);
    else
        frame.normal = direction_of_nearest(region, rounding_of_heights(a, b));
    if ((frame.crosses || s.touches) && !(a.is_oriented() && b.is_oriented()))
        frame.normal = turned_to_outside(frame.normal, a, b, frame.centre);
    if (frame.normal == Vec3{})
        frame.normal = normalized_or_zero(b.model().middle() - a.model().middle());
    if (frame.normal == Vec3{})
        frame.normal = {0, 0, 1};
    frame.is_hole = frame.crosses && whole && a.is_oriented() && b.is_oriented() &&
                    encloses_a_gap(region, frame.centre);
    if (frame.is_hole)
        frame.normal = -frame.normal;
    frame.across = perpendicular(frame.normal);
    frame.upwards = cross(frame.normal, frame.across);
    return frame;
}

} // namespace abut
