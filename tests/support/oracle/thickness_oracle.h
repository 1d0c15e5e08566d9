#pragma once

#include <abut/elementary_impact.h>

#include "ccd/difference_patch.h"
#include "math/dyadic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

/// Decides how near two moving features come, in exact arithmetic. It tests single times, and
/// subdivides time, pruned by a bound on the features' speed.
namespace abut::test {

class ThicknessOracle {
public:
    explicit ThicknessOracle(const ElementaryPair& pair)
        : kind_(pair.kind), start_(vertices(pair.start)), end_(vertices(pair.end)) {
        // Any vector between the features changes no faster than one between their vertices.
        const std::size_t first = kind_ == ElementaryKind::vertex_face ? 1 : 2;
        for (std::size_t i = 0; i < first; ++i)
            for (std::size_t k = first; k < 4; ++k)
                speed_ = std::max(speed_, (1 + 1e-9) * length((pair.end[k] - pair.start[k]) -
                                                              (pair.end[i] - pair.start[i])));
    }

    /// Whether they are at most `distance` apart at a time. In: distance is at least 0.
    [[nodiscard]] bool within(double distance, double time) const {
        const std::array<DyadicVec3, 4> p = at(time);
        const Dyadic limit = Dyadic(distance) * Dyadic(distance);
        if (kind_ == ElementaryKind::vertex_face)
            return meets_inside(limit, p[1] - p[0], p[2] - p[1], p[3] - p[1], true) ||
                   near_segment(limit, p[0], p[1], p[2]) || near_segment(limit, p[0], p[2], p[3]) ||
                   near_segment(limit, p[0], p[3], p[1]);
        return meets_inside(limit, p[2] - p[0], p[0] - p[1], p[3] - p[2], false) ||
               near_segment(limit, p[0], p[2], p[3]) || near_segment(limit, p[1], p[2], p[3]) ||
               near_segment(limit, p[2], p[0], p[1]) || near_segment(limit, p[3], p[0], p[1]);
    }

    /// A time at which they are within the distance, an early one if there are many. If none is
    /// found, nothing is proven.
    [[nodiscard]] std::optional<double> early_time(double distance) const {
        if (within(distance, 0))
            return 0;
        int cells = 0;
        return early_time(distance, {0, 1}, cells);
    }

private:
    using Range = std::pair<double, double>;

    [[nodiscard]] std::optional<double> early_time(double distance, const Range& range,
                                                   int& cells) const {
        constexpr int kMostCells = 400;
        constexpr double kShortest = 0x1p-30;
        const double half = 0.5 * (range.second - range.first), middle = range.first + half;
        if (half < kShortest || ++cells > kMostCells ||
            !within(distance + (1 + 1e-9) * half * speed_, middle))
            return within(distance, range.second) ? std::optional(range.second) : std::nullopt;
        if (const auto time = early_time(distance, {range.first, middle}, cells))
            return time;
        return early_time(distance, {middle, range.second}, cells);
    }

    static std::array<DyadicVec3, 4> vertices(const std::array<Vec3, 4>& p) {
        return {DyadicVec3(p[0]), DyadicVec3(p[1]), DyadicVec3(p[2]), DyadicVec3(p[3])};
    }
    [[nodiscard]] std::array<DyadicVec3, 4> at(double time) const {
        const Dyadic t(time), s = Dyadic(1) - t;
        const auto blend = [&](const Dyadic& a, const Dyadic& b) { return s * a + t * b; };
        std::array<DyadicVec3, 4> p;
        for (std::size_t i = 0; i < 4; ++i)
            p[i] = {blend(start_[i].x, end_[i].x), blend(start_[i].y, end_[i].y),
                    blend(start_[i].z, end_[i].z)};
        return p;
    }
    static bool at_most(const Dyadic& a, const Dyadic& b) { return (b - a).sign() >= 0; }

    static bool near_segment(const Dyadic& limit, const DyadicVec3& p, const DyadicVec3& a,
                             const DyadicVec3& b) {
        const DyadicVec3 to_a = a - p, to_b = b - p, along = b - a;
        if (at_most(dot(to_a, to_a), limit) || at_most(dot(to_b, to_b), limit))
            return true;
        const DyadicVec3 moment = cross(to_a, to_b);
        return dot(to_a, along).sign() < 0 && dot(to_b, along).sign() > 0 &&
               at_most(dot(moment, moment), limit * dot(along, along));
    }
    /// Whether the plane corner + x u + y v is within the limit and its nearest point lies inside
    /// the patch. Uses Cramer's rule on the normal equations.
    static bool meets_inside(const Dyadic& limit, const DyadicVec3& corner, const DyadicVec3& u,
                             const DyadicVec3& v, bool triangle) {
        const DyadicVec3 area = cross(u, v);
        const Dyadic whole = dot(area, area), height = dot(corner, area);
        if (whole.sign() == 0 || !at_most(height * height, limit * whole))
            return false;
        const Dyadic uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), cu = dot(corner, u),
                     cv = dot(corner, v);
        const Dyadic x = uv * cv - vv * cu, y = uv * cu - uu * cv;
        if (x.sign() < 0 || y.sign() < 0)
            return false;
        return triangle ? at_most(x + y, whole) : at_most(x, whole) && at_most(y, whole);
    }

    ElementaryKind kind_;
    std::array<DyadicVec3, 4> start_, end_;
    double speed_ = 0;
};

} // namespace abut::test
