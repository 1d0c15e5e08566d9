#include "deform/bodies/deepest_place.h"

#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>
#include <cstddef>
#include <limits>

namespace abut {

namespace {

constexpr std::size_t kMostSamples = 80;
/// How many bounds are kept. Three are equal at the place; a few more help a function with many
/// faces.
constexpr std::size_t kMostCuts = 6;

using Weights = std::array<double, 3>; ///< of the triangle's corners

/// Lower bounds of a function that are linear on a triangle, by their values at its corners.
class Cuts {
public:
    /// In: at, the last answer. If there are too many, the bound that is lowest there makes room.
    void add(const Weights& at_corners, const Weights& at) {
        if (cuts_.size() == kMostCuts) {
            const auto value = [&](const Weights& cut) {
                return cut[0] * at[0] + cut[1] * at[1] + cut[2] * at[2];
            };
            const auto lowest = std::min_element(
                cuts_.begin(), cuts_.end(),
                [&](const Weights& c, const Weights& d) { return value(c) < value(d); });
            cuts_.erase(lowest);
        }
        cuts_.push_back(at_corners);
    }

    /// The weights at which the largest of the bounds is least, if the last bound is above the others
    /// at the last answer. Out: that least value.
    [[nodiscard]] Weights least(double& value) const {
        Best best{{}, std::numeric_limits<double>::infinity()};
        for (std::size_t i = 0; i < 3; ++i) {
            Weights corner{};
            corner[i] = 1;
            keep_lower(best, corner);
        }
        for (std::size_t k = 0; k + 1 < cuts_.size(); ++k) {
            for (std::size_t i = 0; i < 3; ++i)
                try_on_edge(best, k, i, (i + 1) % 3);
            for (std::size_t m = 0; m < k; ++m)
                try_inside(best, k, m);
        }
        value = best.value;
        return best.weights;
    }

private:
    struct Best {
        Weights weights;
        double value;
    };

    void keep_lower(Best& best, const Weights& w) const {
        double largest = -std::numeric_limits<double>::infinity();
        // Most corners lie on the last bound, which alone tells of many that they are not lowest.
        for (std::size_t i = cuts_.size(); i-- > 0;) {
            const Weights& cut = cuts_[i];
            largest = std::max(largest, cut[0] * w[0] + cut[1] * w[1] + cut[2] * w[2]);
            if (largest >= best.value)
                return;
        }
        best = {w, largest};
    }
    /// Where the last bound and bound k are equal on an edge.
    void try_on_edge(Best& best, std::size_t k, std::size_t i, std::size_t j) const {
        const Weights &last = cuts_.back(), &cut = cuts_[k];
        const double at_i = last[i] - cut[i], at_j = last[j] - cut[j];
        if ((at_i < 0) == (at_j < 0) || at_i == at_j)
            return;
        Weights w{};
        w[j] = std::clamp(at_i / (at_i - at_j), 0.0, 1.0);
        w[i] = 1 - w[j];
        keep_lower(best, w);
    }
    /// Where the last bound and the bounds k and m are equal.
    void try_inside(Best& best, std::size_t k, std::size_t m) const {
        const Weights& last = cuts_.back();
        const Vec3 a{last[0] - cuts_[k][0], last[1] - cuts_[k][1], last[2] - cuts_[k][2]};
        const Vec3 b{last[0] - cuts_[m][0], last[1] - cuts_[m][1], last[2] - cuts_[m][2]};
        const Vec3 both = cross(a, b);
        const double sum = both.x + both.y + both.z;
        if (sum == 0)
            return;
        const Weights w{both.x / sum, both.y / sum, both.z / sum};
        if (w[0] >= 0 && w[1] >= 0 && w[2] >= 0)
            keep_lower(best, w);
    }

    boost::container::static_vector<Weights, kMostCuts> cuts_;
};

} // namespace

Vec3 deepest_place(const Triangle& triangle, const Vec3& start,
                   const std::function<ConvexSample(const Vec3&)>& function, double tolerance) {
    Cuts cuts;
    Vec3 point = start, deepest = start;
    Weights weights{}; // of `point`, but for the start
    double least = std::numeric_limits<double>::infinity();
    double bound = -least; // a function is nowhere less
    for (std::size_t i = 0; i < kMostSamples; ++i) {
        const ConvexSample sample = function(point);
        if (sample.value < least)
            least = sample.value, deepest = point;
        Weights at_corners;
        for (std::size_t k = 0; k < 3; ++k)
            at_corners[k] = sample.value + dot(sample.gradient, triangle[k] - point);
        cuts.add(at_corners, weights);
        double value = 0;
        weights = cuts.least(value);
        bound = std::max(bound, value);
        if (!(bound < least - tolerance))
            break;
        point = weights[0] * triangle[0] + weights[1] * triangle[1] + weights[2] * triangle[2];
    }
    return deepest;
}

} // namespace abut
