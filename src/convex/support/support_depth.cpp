#include "convex/support/support_depth.h"

#include "convex/support/support_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <vector>

namespace abut {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// A triangle of the polytope, counter-clockwise as seen from outside.
struct Facet {
    std::array<std::uint32_t, 3> corner{};
    std::array<std::uint32_t, 3> beyond{}; ///< the facet across the edge from corner i to i + 1
    Vec3 normal;                           ///< unit vector outward; zero: the facet has no area
    double distance = kFar; ///< of its plane from the origin; infinite if it has no area
    bool alive = true;
};

/// An edge of the hole that visible facets leave, and the facet beyond it.
struct RimEdge {
    std::uint32_t from = 0, to = 0, beyond = 0;
};

std::size_t after(std::size_t i) {
    return i == 2 ? 0 : i + 1;
}

/// A polytope inside the difference of two cores. Its memory is kept from one search to the next.
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
    /// The point of a facet's plane that is nearest to the origin, as a mean of the corners. None if
    /// it is outside of the facet, as another facet of the same plane may hold it.
    [[nodiscard]] std::optional<DifferencePoint> foot(const Facet& facet) const {
        constexpr double kOutside = -0x1p-30;
        SupportSimplex mean;
        mean.count = 3;
        const Vec3 foot = facet.distance * facet.normal;
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            mean.corners[i] = points_[facet.corner[i]];
            const Vec3 &p = at(facet.corner[after(i)]), &q = at(facet.corner[after(after(i))]);
            mean.weights[i] = dot(cross(p - foot, q - foot), facet.normal);
            sum += mean.weights[i];
        }
        for (double& weight : mean.weights) {
            if (!(weight >= kOutside * sum))
                return std::nullopt;
            weight /= sum;
        }
        return mean.nearest();
    }

private:
    struct Waiting {
        double distance = 0;
        std::uint32_t facet = 0;
        bool operator>(const Waiting& other) const { return distance > other.distance; }
    };

    [[nodiscard]] const Vec3& at(std::uint32_t point) const { return points_[point].at; }

    std::uint32_t add_facet(const std::array<std::uint32_t, 3>& corners) {
        Facet facet;
        facet.corner = corners;
        const Vec3 &p = at(corners[0]), &q = at(corners[1]), &r = at(corners[2]);
        facet.normal = normalized_or_zero(cross(q - p, r - p));
        if (facet.normal != Vec3{})
            facet.distance =
                std::max({dot(facet.normal, p), dot(facet.normal, q), dot(facet.normal, r)});
        const auto number = static_cast<std::uint32_t>(facets_.size());
        facets_.push_back(facet);
        if (facet.distance < kFar) {
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
                rim_.push_back(
                    {facets_[facet].corner[leaving], facets_[facet].corner[after(leaving)], next});
                return;
            }
            beyond.alive = false;
            // The last of the two is visited first.
            stack_.push_back({next, after(after(back))});
            stack_.push_back({next, after(back)});
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
            if (beyond.corner[i] == edge.to && beyond.corner[after(i)] == edge.from)
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

/// Lengths below this many roundings do not span a tetrahedron.
constexpr double kFlatRoundings = 64;

/// Adds the point farthest along one of the directions if `height` of it is not 0, to rounding.
template <typename Height>
bool add_high(const SupportPair& pair, std::initializer_list<Vec3> directions, const Height& height,
              SupportSimplex& simplex) {
    for (const Vec3& direction : directions) {
        const DifferencePoint point = pair.farthest(direction);
        if (height(point.at) > kFlatRoundings * pair.rounding()) {
            simplex.corners[simplex.count++] = point;
            return true;
        }
    }
    return false;
}

/// Adds corners until the simplex is a tetrahedron. Returns the normal of a plane that holds the
/// whole difference if there is one, to rounding; else zero.
Vec3 make_tetrahedron(const SupportPair& pair, SupportSimplex& simplex) {
    const auto at = [&](std::size_t i) { return simplex.corners[i].at; };
    if (simplex.count == 1 &&
        !add_high(
            pair, {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
            [&](const Vec3& p) { return length(p - at(0)); }, simplex))
        return {0, 0, 1};
    if (simplex.count == 2) {
        const Vec3 along = normalized_or_zero(at(1) - at(0)), u = perpendicular(along),
                   v = cross(along, u);
        if (!add_high(
                pair, {u, -u, v, -v},
                [&](const Vec3& p) { return length(cross(p - at(0), along)); }, simplex))
            return u;
    }
    if (simplex.count == 3) {
        const Vec3 n = normalized_or_zero(cross(at(1) - at(0), at(2) - at(0)));
        if (n == Vec3{} ||
            !add_high(
                pair, {n, -n}, [&](const Vec3& p) { return std::abs(dot(p - at(0), n)); }, simplex))
            return n == Vec3{} ? Vec3{0, 0, 1} : n;
    }
    return {};
}

/// The points of the cores that touch after b has moved by `depth` along the normal.
DifferencePoint contact_after(const SupportPair& pair, const Vec3& normal, double depth) {
    SupportSearch search;
    search.first = normal;
    DifferencePoint points =
        support_distance(pair.shifted(depth * normal), search).simplex.nearest();
    points.b = points.b - depth * normal;
    return points;
}

} // namespace

SupportDepth support_depth(const SupportPair& pair, const SupportSimplex& start) {
    constexpr std::size_t kMostPoints = 1000, kMostBeyond = 32;
    SupportDepth result;
    SupportSimplex simplex = start;
    if (const Vec3 across = make_tetrahedron(pair, simplex); across != Vec3{}) {
        const DifferencePoint shared = start.nearest();
        result.normal = across, result.point_a = shared.a, result.point_b = shared.b;
        return result;
    }
    static thread_local GrowingPolytope polytope;
    polytope.begin(simplex);
    const double enough = std::max(kDepthTolerance, 2 * pair.rounding());
    double best = kFar;
    std::optional<DifferencePoint> foot;
    std::size_t beyond = 0; // steps since both bounds agree, only for the points and the normal
    while (const Facet* nearest = polytope.take_nearest()) {
        const Facet facet = *nearest;
        const DifferencePoint point = pair.farthest(facet.normal);
        const double depth = dot(point.at, facet.normal);
        result.at_least = std::max(result.at_least, std::min(facet.distance, best));
        best = std::min(best, depth);
        const bool is_boundary = depth - facet.distance <= enough;
        if (depth <= best + enough || is_boundary) {
            result.normal = -facet.normal, result.depth = std::max(best, 0.0);
            foot = polytope.foot(facet);
        }
        if (is_boundary || polytope.size() >= kMostPoints ||
            (best - facet.distance <= enough && ++beyond >= kMostBeyond) ||
            !polytope.add(point, pair.rounding()))
            break;
    }
    const DifferencePoint points =
        foot ? *foot : contact_after(pair, result.normal, result.depth + 4 * enough);
    result.point_a = points.a, result.point_b = points.b;
    return result;
}

} // namespace abut
