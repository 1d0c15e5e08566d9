#include "convex/support/support_depth.h"

#include "convex/support/growing_polytope.h"
#include "convex/support/refined_gap.h"
#include "convex/support/support_distance.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace abut {

namespace {

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

/// The memory of polytopes, for all searches of a thread in turn.
GrowingPolytope& kept_polytope() {
    static thread_local GrowingPolytope polytope;
    return polytope;
}

/// EPA, step by step.
class DepthSearch {
public:
    DepthSearch(const SupportPair& pair, DepthEffort effort)
        : pair_(pair), enough_(std::max(kDepthTolerance, 2 * pair.rounding())),
          most_points_(effort == DepthEffort::full ? 2048 : 256) {}

    SupportDepth find(const SupportSimplex& tetrahedron) {
        polytope_.begin(tetrahedron);
        while (!bounds_agree() && advance()) {
        }
        if (const auto gap =
                refined(pair_, outward_, polytope_.facet_along(outward_), best_ + enough_))
            return result(*gap);
        // A few more points often make the bounds agree.
        constexpr int kMostBeyond = 32;
        for (int step = 0; step < kMostBeyond && !on_boundary_ && advance(); ++step) {
        }
        try_axes();
        SupportDepth depth = result({outward_, best_, {}});
        descend(depth);
        find_points(depth);
        depth.at_least = std::min(depth.at_least, depth.depth);
        return depth;
    }

private:
    [[nodiscard]] bool bounds_agree() const { return best_ - at_least_ <= enough_; }

    /// Adds a point to the polytope. Returns false if that is not possible.
    bool advance() {
        const Facet* nearest = polytope_.take_nearest();
        if (nearest == nullptr)
            return false;
        const Facet facet = *nearest;
        at_least_ = std::max(at_least_, std::min(facet.distance, best_));
        const DifferencePoint point = pair_.farthest(facet.normal);
        const double depth = dot(point.at, facet.normal);
        on_boundary_ = depth - facet.distance <= enough_;
        if (depth < best_ || (on_boundary_ && depth <= best_ + enough_))
            best_ = std::min(best_, depth), outward_ = facet.normal;
        return polytope_.size() < most_points_ && !on_boundary_ &&
               polytope_.add(point, pair_.rounding());
    }

    /// Takes the direction of an axis of a shape if that leaves the other one sooner: among motions
    /// that are nearly as short as each other, those along an axis are the shortest most often.
    void try_axes() {
        for (const SupportShape* shape : {&pair_.a(), &pair_.b()})
            for (const Vec3& axis : shape->axis)
                for (const Vec3& outward : {axis, -axis})
                    if (const double depth = dot(pair_.farthest(outward).at, outward);
                        depth < best_)
                        best_ = depth, outward_ = outward;
    }

    /// Shortens the motion. After the motion, and slightly more, the closest points of the shapes are a
    /// slight gap g apart. If they are farther apart, the motion was not the shortest: that along g is
    /// shorter by at least |g| - slight.
    void descend(SupportDepth& depth) const {
        // Far above the rounding of lengths, which are about 1 here.
        constexpr double kSlight = 0x1p-32;
        constexpr int kMostMotions = 32;
        for (int i = 0; i < kMostMotions; ++i) {
            const Vec3 way = (depth.depth + kSlight) * depth.normal;
            const SupportDistance found = support_distance(pair_.moved(way), {});
            if (found.meet || !(found.distance - kSlight > pair_.rounding()))
                return;
            const Vec3 normal = normalized_or_zero(found.simplex.nearest().at);
            const double shorter = dot(pair_.farthest(-normal).at, -normal);
            if (!(shorter < depth.depth))
                return;
            depth.depth = shorter, depth.normal = normal;
        }
    }

    /// Finds the points that the motion brings together. If it leaves a gap, it was not the shortest: the
    /// motion that closes the gap, too, leaves the shapes touching, and is told in its place. So the
    /// points are as far apart as the depth says. The direction stays if the gap lies along it, and where
    /// the depth is so small that the gap's direction is rounding.
    void find_points(SupportDepth& depth) const {
        // A gap of this many roundings is proven, and one of so many more is closed.
        constexpr double kApart = 4, kClosed = 16, kLargestTilt = 0x1p-20;
        const Vec3 way = (depth.depth + kApart * pair_.rounding()) * depth.normal;
        const DifferencePoint points = support_distance(pair_.moved(way), {}).simplex.nearest();
        depth.point_a = points.a, depth.point_b = points.b - way;
        const double closed = kClosed * pair_.rounding();
        if (length(points.at) <= closed)
            return;
        const Vec3 motion = way - points.at;
        const double along = dot(motion, depth.normal),
                     across = length(motion - along * depth.normal);
        if (!(along > 0 && across <= std::max(closed, kLargestTilt * along)))
            return;
        depth.depth = across <= closed ? along : length(motion);
        depth.normal = across <= closed ? depth.normal : normalized_or_zero(motion);
    }

    [[nodiscard]] SupportDepth result(const RefinedGap& gap) const {
        SupportDepth depth;
        depth.normal = -gap.outward;
        depth.depth = gap.value;
        depth.at_least = std::min(std::max(at_least_, 0.0), depth.depth);
        depth.point_a = gap.points.a, depth.point_b = gap.points.b;
        return depth;
    }

    const SupportPair& pair_;
    double enough_;
    std::size_t most_points_;
    GrowingPolytope& polytope_ = kept_polytope();
    double best_ = kUnbounded, at_least_ = -kUnbounded;
    Vec3 outward_;
    bool on_boundary_ = false;
};

} // namespace

SupportDepth support_depth(const SupportPair& pair, const SupportSimplex& start,
                           DepthEffort effort) {
    SupportSimplex simplex = start;
    if (const Vec3 across = make_tetrahedron(pair, simplex); across != Vec3{}) {
        const DifferencePoint shared = start.nearest();
        SupportDepth result;
        result.normal = across, result.point_a = shared.a, result.point_b = shared.b;
        return result;
    }
    return DepthSearch(pair, effort).find(simplex);
}

} // namespace abut
