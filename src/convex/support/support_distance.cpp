#include "convex/support/support_distance.h"

#include "convex/support/nearest_simplex.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

bool has_corner(const SupportSimplex& simplex, const Vec3& at) {
    return std::any_of(simplex.corners.begin(), simplex.corners.begin() + simplex.count,
                       [&](const DifferencePoint& corner) { return corner.at == at; });
}

/// GJK, step by step.
class DistanceSearch {
public:
    DistanceSearch(const SupportPair& pair, const SupportSearch& search)
        : pair_(pair), search_(search) {}

    SupportDistance find() {
        // The plain search takes about 20 steps. Thin shapes that nearly touch take some hundred.
        constexpr int kMostSteps = 1024;
        const Vec3 first = search_.first != Vec3{} ? search_.first : pair_.offset();
        SupportSimplex& simplex = result_.simplex;
        simplex.corners[0] = pair_.farthest(-first), simplex.weights[0] = 1, simplex.count = 1;
        result_.direction = simplex.corners[0].at;
        result_.distance = length(result_.direction);
        for (int step = 0; step < kMostSteps; ++step)
            if (!advance())
                break;
        return result_;
    }

private:
    /// Makes one step. Returns false at the end of the search.
    bool advance() {
        if (result_.distance <= pair_.rounding())
            return meet();
        if (result_.distance <= search_.near)
            return false;
        const DifferencePoint next = pair_.farthest(-result_.direction);
        const double low = dot(next.at, result_.direction) / result_.distance;
        result_.at_least = std::max(result_.at_least, low);
        if (result_.at_least > search_.apart ||
            result_.distance - result_.at_least <= pair_.rounding())
            return false;
        SupportSimplex larger = result_.simplex;
        if (!has_corner(larger, next.at))
            larger.corners[larger.count++] = next;
        else if (precise_)
            return false;
        return precise_ ? improve_precisely(larger) : improve(larger);
    }

    bool meet() {
        result_.meet = true, result_.at_least = 0;
        return false;
    }

    /// Replaces the simplex by a part of a larger one that is nearer to the origin. Where rounding
    /// hides a nearer part, the search goes on with more digits.
    bool improve(const SupportSimplex& larger) {
        SupportSimplex part = larger;
        const std::optional<Vec3> nearest = reduce_to_nearest(part);
        if (nearest && length(*nearest) < result_.distance) { // else it has to be proven
            take(part, *nearest);
            return true;
        }
        precise_ = true;
        return improve_precisely(larger);
    }

    bool improve_precisely(SupportSimplex larger) {
        const std::optional<PrecisePoint> nearest = reduce_to_nearest_precisely(larger);
        if (!nearest) {
            result_.simplex = larger, result_.distance = 0;
            return meet();
        }
        // The decrease of a step may be less than the last bit of a double, and still turn the
        // direction. At the first precise step, the same part may have a more accurate point.
        if (!(nearest->distance_sq < distance_sq_))
            return false;
        distance_sq_ = nearest->distance_sq;
        take(larger, nearest->at);
        return true;
    }

    void take(const SupportSimplex& part, const Vec3& nearest) {
        result_.simplex = part;
        result_.direction = nearest, result_.distance = length(nearest);
    }

    const SupportPair& pair_;
    const SupportSearch& search_;
    SupportDistance result_;
    bool precise_ = false;
    DoubleDouble distance_sq_ = std::numeric_limits<double>::infinity(); ///< if precise_
};

} // namespace

SupportDistance support_distance(const SupportPair& pair, const SupportSearch& search) {
    return DistanceSearch(pair, search).find();
}

} // namespace abut
