#pragma once

#include "convex/support/support_pair.h"
#include "math/double_double.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace abut {

inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// Bound of the rounding of a facet's distance, relative to the size of the pair.
inline constexpr double kPlaneRounding = 0x1p-43;

/// A triangle of the polytope, counter-clockwise as seen from outside.
struct Facet {
    std::array<std::uint32_t, 3> corner{};
    std::array<std::uint32_t, 3> beyond{}; ///< the facet across the edge from corner i to i + 1
    Vec3 normal;                           ///< unit vector outward; zero: the facet has no area
    double distance = kUnbounded; ///< of its plane from the origin; infinite if it has no area
    bool alive = true;
};

/// An edge of the hole that visible facets leave, and the facet beyond it.
struct RimEdge {
    std::uint32_t from = 0, to = 0, beyond = 0;
};

inline std::size_t next_corner(std::size_t i) {
    return i == 2 ? 0 : i + 1;
}

/// A polytope inside the difference of two cores. Its memory is kept from one search to the next.
///
/// Its surface is closed. As long as no facet has a negative distance, it covers all directions seen
/// from the origin, and the polytope holds the ball whose radius is the least distance.
class GrowingPolytope {
public:
    /// In          four corners that are not in one plane.
    void begin(const SupportSimplex& simplex) {
        points_.assign(simplex.corners.begin(), simplex.corners.end());
        facets_.clear(), queue_.clear();
        // Outward facets, if the fourth corner is below the first three.
        const Vec3 n = cross(at(1) - at(0), at(2) - at(0));
        if (dot(n, at(3) - at(0)) > 0)
            std::swap(points_[0], points_[1]);
        for (const std::array<std::uint32_t, 3>& corners :
             {std::array{0U, 1U, 2U}, {1U, 0U, 3U}, {2U, 1U, 3U}, {0U, 2U, 3U}})
            static_cast<void>(add_facet(corners));
        facets_[0].beyond = {1, 2, 3};
        facets_[1].beyond = {0, 3, 2};
        facets_[2].beyond = {0, 1, 3};
        facets_[3].beyond = {0, 2, 1};
    }

    /// The facet whose plane is nearest to the origin; null if there is none.
    const Facet* take_nearest() {
        while (!queue_.empty()) {
            std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
            const std::uint32_t facet = queue_.back().facet;
            queue_.pop_back();
            if (facets_[facet].alive) {
                taken_ = facet;
                return &facets_[facet];
            }
        }
        return nullptr;
    }

    /// Adds a point beyond the facet that was taken. Returns false if rounding makes the facets
    /// below the point no disc; the polytope is spoiled then.
    bool add(const DifferencePoint& point, double margin) {
        rim_.clear();
        facets_[taken_].alive = false;
        for (std::size_t i = 0; i < 3; ++i)
            collect(taken_, i, point.at, margin);
        const auto corner = static_cast<std::uint32_t>(points_.size());
        points_.push_back(point);
        const auto first = static_cast<std::uint32_t>(facets_.size());
        const auto count = static_cast<std::uint32_t>(rim_.size());
        for (std::uint32_t i = 0; i < count; ++i) {
            const RimEdge& edge = rim_[i];
            if (edge.to != rim_[i + 1 == count ? 0 : i + 1].from)
                return false;
            const std::uint32_t facet = add_facet({edge.from, edge.to, corner});
            facets_[facet].beyond = {edge.beyond, first + (i + 1 == count ? 0 : i + 1),
                                     first + (i == 0 ? count - 1 : i - 1)};
            join(edge, facet);
        }
        return count >= 3;
    }

    [[nodiscard]] std::size_t size() const { return points_.size(); }

    /// The facet that a ray from the origin leaves the polytope through, with the weights of the
    /// point where it does.
    [[nodiscard]] SupportSimplex facet_along(const Vec3& ray) const {
        SupportSimplex best;
        double least_of_best = -kUnbounded;
        for (const Facet& facet : facets_) {
            if (!facet.alive)
                continue;
            SupportSimplex simplex;
            simplex.count = 3;
            double sum = 0, least = kUnbounded;
            for (std::size_t i = 0; i < 3; ++i) {
                simplex.corners[i] = points_[facet.corner[i]];
                const Vec3 &p = at(facet.corner[next_corner(i)]),
                           &q = at(facet.corner[next_corner(next_corner(i))]);
                simplex.weights[i] = dot(ray, cross(p, q));
                sum += simplex.weights[i], least = std::min(least, simplex.weights[i]);
            }
            if (!(sum > 0) || !(least / sum > least_of_best))
                continue;
            least_of_best = least / sum;
            for (double& weight : simplex.weights)
                weight = std::max(weight / sum, 0.0);
            best = simplex;
        }
        return best;
    }

private:
    struct Waiting {
        double distance = 0;
        std::uint32_t facet = 0;
        bool operator>(const Waiting& other) const { return distance > other.distance; }
    };

    [[nodiscard]] const Vec3& at(std::uint32_t point) const { return points_[point].at; }

    /// Sets the plane of a facet. That of a thin one is computed with more digits, so that a distance
    /// is wrong by at most kPlaneRounding.
    void set_plane(Facet& facet) const {
        constexpr double kRounding = 0x1p-50; // of a product of three lengths, with a margin of 2
        const Vec3 &p = at(facet.corner[0]), &q = at(facet.corner[1]), &r = at(facet.corner[2]);
        const Vec3 u = q - p, v = r - p, n = cross(u, v);
        const double area = length(n), reach = std::max(length(p), length(u) + length(v));
        if (kRounding * length(u) * length(v) * reach <= kPlaneRounding * area) {
            facet.normal = (1 / area) * n, facet.distance = dot(n, p) / area;
            return;
        }
        const WideVec3 wide_p(p), wide = cross(WideVec3(q) - wide_p, WideVec3(r) - wide_p);
        // Areas below the smallest normal double have no accurate length.
        const double size = max_abs(wide.rounded());
        if (!(size > 0x1p-500))
            return;
        const WideVec3 normal = DoubleDouble(std::ldexp(1.0, -std::ilogb(size))) * wide;
        const double stretch = length(normal.rounded());
        facet.normal = (1 / stretch) * normal.rounded();
        facet.distance = dot(normal, wide_p).high / stretch;
    }

    std::uint32_t add_facet(const std::array<std::uint32_t, 3>& corners) {
        Facet facet;
        facet.corner = corners;
        set_plane(facet);
        const auto number = static_cast<std::uint32_t>(facets_.size());
        facets_.push_back(facet);
        if (facet.distance < kUnbounded) {
            queue_.push_back({facet.distance, number});
            std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
        }
        return number;
    }

    /// Removes the facets that the point sees beyond an edge. Notes the edges at which it sees no
    /// further, in the order around the hole.
    void collect(std::uint32_t from, std::size_t edge, const Vec3& point, double margin) {
        stack_.clear();
        const auto enter = [&](std::uint32_t facet, std::size_t leaving) {
            const std::uint32_t next = facets_[facet].beyond[leaving];
            Facet& beyond = facets_[next];
            if (!beyond.alive)
                return;
            const std::size_t back = edge_to(beyond, facet);
            const bool seen = beyond.normal == Vec3{} ||
                              dot(beyond.normal, point - at(beyond.corner[0])) > margin;
            if (!seen) {
                rim_.push_back({facets_[facet].corner[leaving],
                                facets_[facet].corner[next_corner(leaving)], next});
                return;
            }
            beyond.alive = false;
            // The last of the two is visited first.
            stack_.push_back({next, next_corner(next_corner(back))});
            stack_.push_back({next, next_corner(back)});
        };
        enter(from, edge);
        while (!stack_.empty()) {
            const Pending pending = stack_.back();
            stack_.pop_back();
            enter(pending.facet, pending.edge);
        }
    }

    static std::size_t edge_to(const Facet& facet, std::uint32_t neighbour) {
        return facet.beyond[0] == neighbour ? 0 : facet.beyond[1] == neighbour ? 1 : 2;
    }

    /// Makes the facet beyond a rim edge point to the new facet.
    void join(const RimEdge& edge, std::uint32_t facet) {
        Facet& beyond = facets_[edge.beyond];
        for (std::size_t i = 0; i < 3; ++i)
            if (beyond.corner[i] == edge.to && beyond.corner[next_corner(i)] == edge.from)
                beyond.beyond[i] = facet;
    }

    /// An edge of a removed facet that is still to be crossed.
    struct Pending {
        std::uint32_t facet = 0;
        std::size_t edge = 0;
    };
    std::vector<DifferencePoint> points_;
    std::vector<Facet> facets_;
    std::vector<Waiting> queue_; ///< a heap
    std::vector<RimEdge> rim_;
    std::vector<Pending> stack_;
    std::uint32_t taken_ = 0;
};

} // namespace abut
