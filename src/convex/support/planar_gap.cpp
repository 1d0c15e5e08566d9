#include "convex/support/planar_gap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace abut {

namespace {

/// Positive if v is counter-clockwise of u, seen against y.
double ccw_part(const Vec3& u, const Vec3& v) {
    return u.x * v.z - u.z * v.x;
}

/// The directions between two unit vectors, and the points that are farthest along these.
struct Arc {
    Vec3 from, to;
    DifferencePoint at_from, at_to;
    double at_least = 0; ///< bound of the farthest points' coordinates
    Vec3 lowest;         ///< where the two points have the bound; it splits the arc
    bool operator>(const Arc& other) const { return at_least > other.at_least; }
};

class ArcSearch {
public:
    ArcSearch(const SupportPair& pair, double low, double high)
        : pair_(pair), low_(low), high_(high) {}

    PlanarGap find() {
        constexpr std::size_t kMostArcs = 4096;
        start();
        const double enough = 2 * pair_.rounding();
        while (true) {
            std::pop_heap(arcs_.begin(), arcs_.end(), std::greater<>());
            const Arc arc = arcs_.back();
            best_.at_least = std::min(arc.at_least, best_.value);
            if (best_.value - best_.at_least <= enough || best_.value < low_ ||
                best_.at_least > high_ || arcs_.size() >= kMostArcs)
                break;
            arcs_.pop_back();
            const DifferencePoint point = pair_.farthest(arc.lowest);
            offer(arc.lowest, point);
            add(arc.from, arc.at_from, arc.lowest, point);
            add(arc.lowest, point, arc.to, arc.at_to);
        }
        set_nearest();
        return best_;
    }

private:
    void start() {
        const std::array<Vec3, 4> axes{Vec3{1, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 0, -1}};
        best_.value = std::numeric_limits<double>::infinity();
        std::array<DifferencePoint, 4> points;
        for (std::size_t i = 0; i < 4; ++i) {
            points[i] = pair_.farthest(axes[i]);
            offer(axes[i], points[i]);
        }
        for (std::size_t i = 0; i < 4; ++i)
            add(axes[i], points[i], axes[(i + 1) % 4], points[(i + 1) % 4]);
    }

    void offer(const Vec3& direction, const DifferencePoint& point) {
        const double value = dot(point.at, direction);
        if (value < best_.value)
            best_.value = value, best_.outward = direction;
    }

    void add(const Vec3& from, const DifferencePoint& at_from, const Vec3& to,
             const DifferencePoint& at_to) {
        Arc arc{from, to, at_from, at_to, 0, {}};
        bound(arc);
        arcs_.push_back(arc);
        std::push_heap(arcs_.begin(), arcs_.end(), std::greater<>());
    }

    /// Any farthest point is at least as far as both points of the arc. The bound is the minimum of
    /// the farther one of them.
    static void bound(Arc& arc) {
        const Vec3 &p = arc.at_from.at, &q = arc.at_to.at, edge = q - p;
        const Vec3 across = normalized_or_zero(Vec3{edge.z, 0, -edge.x});
        const bool between = ccw_part(arc.from, across) > 0 && ccw_part(across, arc.to) > 0;
        const Vec3 middle = between ? across : normalized_or_zero(arc.from + arc.to);
        arc.at_least = std::numeric_limits<double>::infinity();
        offer_lowest(arc, p, arc.from, middle);
        offer_lowest(arc, q, middle, arc.to);
        // Where rounding moves the crossing out of the arc, the points are near each other.
        if (!between)
            arc.at_least -= length(edge) * length(arc.to - arc.from);
        if (arc.lowest == arc.from || arc.lowest == arc.to)
            arc.lowest = middle;
    }

    /// The minimum of a point's coordinate between two directions.
    static void offer_lowest(Arc& arc, const Vec3& p, const Vec3& from, const Vec3& to) {
        const auto take = [&](const Vec3& direction) {
            const double value = dot(p, direction);
            if (value < arc.at_least)
                arc.at_least = value, arc.lowest = direction;
        };
        take(from), take(to);
        const Vec3 opposite = -normalized_or_zero(p);
        if (ccw_part(from, opposite) > 0 && ccw_part(opposite, to) > 0)
            take(opposite);
    }

    /// Finds the arc whose chord has the point that the best direction touches.
    void set_nearest() {
        const Vec3 foot = best_.value * best_.outward;
        double least = std::numeric_limits<double>::infinity();
        for (const Arc& arc : arcs_) {
            const Vec3 edge = arc.at_to.at - arc.at_from.at;
            const double all = length_sq(edge),
                         part = all > 0 ? dot(foot - arc.at_from.at, edge) / all : 0;
            const double t = std::clamp(part, 0.0, 1.0);
            const double off = length(arc.at_from.at + t * edge - foot);
            if (!(off < least))
                continue;
            least = off;
            best_.nearest.count = 2;
            best_.nearest.corners[0] = arc.at_from, best_.nearest.corners[1] = arc.at_to;
            best_.nearest.weights[0] = 1 - t, best_.nearest.weights[1] = t;
        }
    }

    const SupportPair& pair_;
    double low_, high_;
    std::vector<Arc> arcs_;
    PlanarGap best_;
};

bool is_point(const SupportShape& shape) {
    return shape.kind == CoreKind::box && shape.half == std::array<double, 3>{};
}

} // namespace

std::optional<ParallelAxes> parallel_axes(const SupportShape& a, const SupportShape& b) {
    // A pose rounds its axes to a few units in the last place. Such a tilt moves points by rounding.
    constexpr double kParallel = 0x1p-48;
    const std::optional<SolidOfRevolution> round_a = as_solid_of_revolution(with_largest_radius(a)),
                                           round_b = as_solid_of_revolution(with_largest_radius(b));
    if (!round_a || !round_b)
        return std::nullopt;
    const bool is_a_point = is_point(round_a->shape), is_b_point = is_point(round_b->shape);
    const Vec3 along = is_a_point ? round_b->shape.axis[2] : round_a->shape.axis[2];
    if (!is_b_point && !(max_abs(cross(along, round_b->shape.axis[2])) <= kParallel))
        return std::nullopt;
    ParallelAxes result{round_a->shape,           round_b->shape, round_a->shift, {}, {},
                        normalized_or_zero(along)};
    const Vec3 offset = (b.centre - a.centre) + (round_b->shift - round_a->shift),
               across = offset - dot(offset, result.z) * result.z;
    // An offset along the axis leaves only rounding, which may have any direction.
    const Vec3 x = normalized_or_zero(across);
    result.x = std::abs(dot(x, result.z)) < 0.5 && x != Vec3{}
                   ? normalized_or_zero(x - dot(x, result.z) * result.z)
                   : perpendicular(result.z);
    result.y = cross(result.z, result.x);
    const bool opposite = !is_b_point && dot(along, round_b->shape.axis[2]) < 0;
    result.a.axis = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    result.b.axis = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, opposite ? -1.0 : 1.0}};
    result.a.centre = {};
    result.b.centre = {dot(offset, result.x), 0, dot(offset, result.z)};
    return result;
}

PlanarGap planar_gap(const SupportPair& pair, double low, double high) {
    return ArcSearch(pair, low, high).find();
}

} // namespace abut
