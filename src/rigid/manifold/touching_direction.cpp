#include "rigid/manifold/touching_direction.h"

#include "geometry/point_triangle_distance.h"
#include "geometry/triangle_triangle_distance.h"

#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

namespace abut {

namespace {

/// Bound of the rounding of a position, relative to the coordinates in the world and to the models.
constexpr double kPlaceRounding = 0x1p-48;
/// A way above this share of the coordinates tells its direction to 2^-22.
constexpr double kTellsWay = 0x1p-26;
/// A height of this many roundings is no height. Planes through rounded corners tilt by some.
constexpr double kFlat = 16;
/// Edges tell a direction if the sine between them is larger; faces that lie on each other, if what they
/// share is a larger part of one of them.
constexpr double kClearOfParallel = 0x1p-20;
/// Directions belong together if the cosine between them is larger: within 0.08 degrees.
constexpr double kSameDirection = 1 - 0x1p-20;

Vec3 middle_of(const Triangle& t) {
    return (1.0 / 3) * (t[0] + t[1] + t[2]);
}

double extent_of(const Triangle& t) {
    return std::max({max_abs(t[1] - t[0]), max_abs(t[2] - t[1]), max_abs(t[0] - t[2])});
}

/// Returns whether all corners of a triangle are as high as a plane.
bool lies_in_plane(const Triangle& t, const Vec3& point, const Vec3& normal, double error) {
    return normal != Vec3{} && std::all_of(t.begin(), t.end(), [&](const Vec3& corner) {
               return std::abs(dot(corner - point, normal)) <= error;
           });
}

using Outline = decltype(TouchingDirection::outline);

/// The part of b's triangle over a's, seen along a unit vector.
///
/// Source      [Sutherland, Hodgman 1974]
Outline common_outline(const Triangle& ta, const Triangle& tb, const Vec3& along) {
    Outline outline(tb.begin(), tb.end()), kept;
    const double turn = dot(cross(ta[1] - ta[0], ta[2] - ta[0]), along) < 0 ? -1 : 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 &from = ta[k], inward = turn * cross(along, ta[(k + 1) % 3] - from);
        kept.clear();
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const Vec3 &p = outline[i], &q = outline[(i + 1) % outline.size()];
            const double over_p = dot(inward, p - from), over_q = dot(inward, q - from);
            if (over_p >= 0)
                kept.push_back(p);
            if ((over_p >= 0) != (over_q >= 0))
                kept.push_back(p + (over_p / (over_p - over_q)) * (q - p));
        }
        outline = kept;
    }
    return outline;
}

double area_of(const Outline& outline, const Vec3& along) {
    double area = 0;
    for (std::size_t i = 2; i < outline.size(); ++i)
        area += 0.5 * dot(cross(outline[i - 1] - outline[0], outline[i] - outline[0]), along);
    return std::abs(area);
}

/// The feature of a triangle that holds one of its points: the smallest one that is near.
struct NearFeature {
    Feature kind = Feature::face;
    Vec3 along; ///< of an edge
};
NearFeature feature_near(const Triangle& t, const Vec3& p, double error) {
    for (const Vec3& corner : t)
        if (max_abs(p - corner) <= error)
            return {Feature::vertex, {}};
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 along = normalized_or_zero(t[(k + 1) % 3] - t[k]), from = p - t[k];
        if (max_abs(from - dot(from, along) * along) <= error)
            return {Feature::edge, along};
    }
    return {Feature::face, {}};
}

/// A direction towards either side, turned so that it leads from a to b: to the side on which b's
/// triangle lies, or out of the faces.
Vec3 turned_to_b(const Vec3& n, const TrianglesInTouch& t, double rounding) {
    const double height = dot(n, middle_of(t.b) - middle_of(t.a));
    if (std::abs(height) > kFlat * rounding)
        return height < 0 ? -n : n;
    const double of_a = dot(n, t.normal_a), of_b = -dot(n, t.normal_b);
    const bool by_a =
        t.is_oriented_a == t.is_oriented_b ? std::abs(of_a) >= std::abs(of_b) : t.is_oriented_a;
    return (by_a ? of_a : of_b) < 0 ? -n : n;
}

/// Sums of vectors with about one direction.
class DirectionSums {
public:
    void add(const Vec3& v) {
        const double size = length(v);
        for (Sum& each : sums_)
            if (dot(each.sum, v) > kSameDirection * length(each.sum) * size) {
                each.sum = each.sum + v;
                return;
            }
        sums_.push_back({v});
    }
    [[nodiscard]] bool empty() const { return sums_.empty(); }
    /// The direction of the sum for which a function is largest.
    template <typename Merit>
    [[nodiscard]] Vec3 best(const Merit& merit) const {
        const auto* best = &sums_.front();
        double most = merit(best->sum);
        for (const Sum& each : sums_)
            if (const double other = merit(each.sum); other > most)
                best = &each, most = other;
        return normalized_or_zero(best->sum);
    }

private:
    struct Sum {
        Vec3 sum;
    };
    std::vector<Sum> sums_;
};

/// A triangle at a place.
struct FanFace {
    Triangle corners;
    Vec3 normal; ///< outward, of unit length; zero without area
};
using Fan = boost::container::static_vector<FanFace, 64>;

/// The different triangles of a side within a radius of a point.
Fan fan_at(const ManifoldSide& side, const Vec3& point, double radius) {
    Fan fan;
    const PlacedModel& model = side.model();
    model.for_each_overlap(grown(Box3{point, point}, radius), [&](std::uint32_t slot) {
        const Triangle t = model.world_slot(slot);
        if (fan.size() == fan.capacity() ||
            nearest_on_triangle(point, t).distance_sq > radius * radius ||
            std::any_of(fan.begin(), fan.end(),
                        [&](const FanFace& each) { return each.corners == t; }))
            return;
        fan.push_back({t, side.facing() * normalized_or_zero(cross(t[1] - t[0], t[2] - t[0]))});
    });
    return fan;
}

/// Bound of the coordinates in the world, and of the models' extents.
double size_of_places(const ManifoldSide& a, const ManifoldSide& b) {
    return sum_of_sizes(a.model().origin()) + a.model().reach() + b.model().reach();
}

/// Two models at a place where they touch.
class TouchingPlace {
public:
    /// In          points: of the place, in the frame of the sides.
    TouchingPlace(const ManifoldSide& a, const ManifoldSide& b, const Vec3& point_a,
                  const Vec3& point_b, double rounding)
        : a_(a), b_(b), point_a_(point_a), point_b_(point_b), rounding_(rounding),
          radius_(4 * (length(point_b - point_a) + kFlat * rounding)),
          fan_a_(fan_at(a, point_a, radius_)), fan_b_(fan_at(b, point_b, radius_)) {}

    /// Zero if nothing lies here.
    [[nodiscard]] Vec3 direction() const {
        DirectionSums areas, across;
        for (const FanFace& of_a : fan_a_)
            for (const FanFace& of_b : fan_b_) {
                const TouchingDirection found =
                    touching_direction({of_a.corners, of_b.corners, of_a.normal, of_b.normal,
                                        a_.is_oriented(), b_.is_oriented()},
                                       rounding_);
                if (found.area != Vec3{})
                    areas.add(found.area);
                if (found.across != Vec3{})
                    across.add(found.across);
            }
        if (!areas.empty())
            return turned_outwards(areas.best([](const Vec3& sum) { return length(sum); }));
        const Vec3 between = normalized_or_zero(b_.model().middle() - a_.model().middle());
        const auto parts_best = [&](const Vec3& v) {
            const Vec3 n = normalized_or_zero(v);
            // Several directions may part them: the one that leads from middle to middle is taken.
            return dot(n, between) - 4 * reach_beyond(n);
        };
        if (across.empty())
            add_candidates(across);
        return across.empty() ? Vec3{} : across.best(parts_best);
    }

private:
    /// The directions out of each face here; if none of them parts the surfaces, also those across two
    /// edges.
    void add_candidates(DirectionSums& candidates) const {
        const auto add_normals = [&](const Fan& fan, bool is_oriented, double sign) {
            for (const FanFace& each : fan)
                if (each.normal != Vec3{}) {
                    candidates.add(sign * each.normal);
                    if (!is_oriented)
                        candidates.add(-sign * each.normal);
                }
        };
        add_normals(fan_a_, a_.is_oriented(), 1);
        add_normals(fan_b_, b_.is_oriented(), -1);
        const auto parts = [this](const Vec3& v) { return -reach_beyond(normalized_or_zero(v)); };
        if (!candidates.empty() && -parts(candidates.best(parts)) <= kClearOfParallel)
            return;
        for (const FanFace& of_a : fan_a_)
            for (const FanFace& of_b : fan_b_)
                for (std::size_t i = 0; i < 3; ++i)
                    for (std::size_t k = 0; k < 3; ++k)
                        add_across_edges(of_a.corners[(i + 1) % 3] - of_a.corners[i],
                                         of_b.corners[(k + 1) % 3] - of_b.corners[k], candidates);
    }
    static void add_across_edges(const Vec3& u, const Vec3& v, DirectionSums& candidates) {
        const Vec3 n = cross(normalized_or_zero(u), normalized_or_zero(v));
        if (length(n) > kClearOfParallel)
            candidates.add(normalized_or_zero(n)), candidates.add(-normalized_or_zero(n));
    }
    /// The largest slope at which a triangle here rises to the other side.
    [[nodiscard]] double reach_beyond(const Vec3& n) const {
        double most = 0;
        const auto take = [&](const Fan& fan, const Vec3& point, double sign) {
            for (const FanFace& each : fan)
                for (const Vec3& corner : each.corners)
                    if (const double away = length(corner - point); away > radius_)
                        most = std::max(most,
                                        (sign * dot(n, corner - point) - kFlat * rounding_) / away);
        };
        take(fan_a_, point_a_, 1), take(fan_b_, point_b_, -1);
        return most;
    }
    /// Faces of open surfaces that lie on each other do not tell their outside: b lies where its middle
    /// is.
    [[nodiscard]] Vec3 turned_outwards(const Vec3& n) const {
        if (a_.is_oriented() || b_.is_oriented())
            return n;
        return dot(n, b_.model().middle() - a_.model().middle()) < 0 ? -n : n;
    }

    const ManifoldSide &a_, &b_;
    Vec3 point_a_, point_b_;
    double rounding_, radius_;
    Fan fan_a_, fan_b_;
};

bool has_inverse(const Transform& t) {
    const auto& m = t.m;
    const Vec3 x{m[0], m[1], m[2]}, y{m[3], m[4], m[5]}, z{m[6], m[7], m[8]};
    constexpr double kLeastVolume = 0x1p-40; // of the axes, relative to that of perpendicular ones
    return std::abs(dot(cross(x, y), z)) > kLeastVolume * length(x) * length(y) * length(z);
}

} // namespace

double rounding_of_places(const ManifoldSide& a, const ManifoldSide& b) {
    return kPlaceRounding * size_of_places(a, b);
}

TouchingDirection touching_direction(const TrianglesInTouch& triangles, double rounding) {
    const Triangle &ta = triangles.a, &tb = triangles.b;
    const Vec3 &na = triangles.normal_a, &nb = triangles.normal_b;
    TouchingDirection found;
    const bool in_a = lies_in_plane(tb, ta[0], na, kFlat * rounding),
               in_b = lies_in_plane(ta, tb[0], nb, kFlat * rounding);
    found.in_one_plane = in_a || in_b;
    if (found.in_one_plane) {
        const Vec3& normal = in_a ? na : nb;
        const double least = 0.5 * std::min(length(cross(ta[1] - ta[0], ta[2] - ta[0])),
                                            length(cross(tb[1] - tb[0], tb[2] - tb[0])));
        const Outline outline = common_outline(ta, tb, normal);
        const double area = area_of(outline, normal);
        if (area > kClearOfParallel * least)
            found.outline = outline;
        const bool may_share =
            dot(na, nb) < 0 || !(triangles.is_oriented_a && triangles.is_oriented_b);
        if (!found.outline.empty() && may_share) {
            found.across = turned_to_b(normal, triangles, rounding);
            found.area = area * found.across;
            return found;
        }
    }
    const ClosestPoints nearest = triangle_triangle_distance(ta, tb);
    constexpr double kNearBorder = 0x1p-30; // of the triangle's extent
    const NearFeature of_a =
        feature_near(ta, nearest.a, kNearBorder * extent_of(ta) + 4 * kFlat * rounding);
    const NearFeature of_b =
        feature_near(tb, nearest.b, kNearBorder * extent_of(tb) + 4 * kFlat * rounding);
    Vec3 across;
    if (of_a.kind == Feature::face)
        across = na;
    else if (of_b.kind == Feature::face)
        across = nb;
    else if (of_a.kind == Feature::edge && of_b.kind == Feature::edge)
        if (const Vec3 n = cross(of_a.along, of_b.along); length(n) > kClearOfParallel)
            across = normalized_or_zero(n);
    if (across != Vec3{})
        found.across = turned_to_b(across, triangles, rounding);
    return found;
}

Vec3 direction_at(const ManifoldSide& a, const ManifoldSide& b, const Vec3& point_a,
                  const Vec3& point_b) {
    return TouchingPlace(a, b, point_a, point_b, rounding_of_places(a, b)).direction();
}

std::optional<Vec3> direction_of_touching(const Model& a, const Transform& world_from_a,
                                          const Model& b, const Transform& world_from_b,
                                          const Vec3& point_a, const Vec3& point_b, const Vec3& way,
                                          double distance) {
    if (!has_inverse(world_from_a) || !has_inverse(world_from_b))
        return std::nullopt;
    const ManifoldSide side_a(a, world_from_a, point_a), side_b(b, world_from_b, point_a);
    if (std::max(distance, length(way)) > kTellsWay * size_of_places(side_a, side_b))
        return std::nullopt;
    const double rounding = rounding_of_places(side_a, side_b);
    const Vec3 n = direction_at(side_a, side_b, {}, point_b - point_a);
    // A direction along which they are less far apart is not that of the distance.
    if (n == Vec3{} || dot(n, way) < length(way) - 2 * kFlat * rounding)
        return std::nullopt;
    return n;
}

} // namespace abut
