#include "world/contacts/four_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace abut {

namespace {

/// Points are as deep if their depths differ by at most this share of the region's extent.
constexpr double kAsDeep = 0x1p-14;
/// A point of the last step counts as this much farther away.
constexpr double kLoyalty = 1.25;

/// Chooses points one by one.
class FourPoints {
    using Four = std::array<std::size_t, 4>;

public:
    FourPoints(std::span<const RegionPoint> points, std::span<const std::uint64_t> last)
        : points_(points), last_(last) {}

    Four choose(double rounding) {
        double deepest = -HUGE_VAL, extent = 0;
        for (const RegionPoint& p : points_) {
            deepest = std::max(deepest, p.depth);
            extent = std::max({extent, std::abs(p.x - points_[0].x), std::abs(p.y - points_[0].y)});
        }
        const double as_deep = deepest - (last_.empty() ? 0 : std::max(rounding, kAsDeep * extent));
        choose_anew(deepest, as_deep);
        const std::optional<Four> before = those_of_last(as_deep);
        return before && area_of(*before) >= area_of(chosen_) / kLoyalty ? *before : chosen_;
    }

private:
    void choose_anew(double deepest, double as_deep) {
        // The first one of the last step that is as deep; else the deepest.
        take([&](const RegionPoint& p) {
            const std::size_t place = place_in_last(p);
            return p.depth < as_deep      ? -HUGE_VAL
                   : place < last_.size() ? static_cast<double>(last_.size() - place)
                                          : std::min(p.depth - deepest, 0.0);
        });
        const RegionPoint& first = points_[chosen_[0]];
        take([&](const RegionPoint& p) {
            const double x = p.x - first.x, y = p.y - first.y;
            return loyalty(p) * loyalty(p) * (x * x + y * y);
        });
        const RegionPoint& second = points_[chosen_[1]];
        const auto left = [&](const RegionPoint& p) {
            return (second.x - first.x) * (p.y - first.y) - (second.y - first.y) * (p.x - first.x);
        };
        take([&](const RegionPoint& p) { return (left(p) > 0 ? loyalty(p) : 1) * left(p); });
        take([&](const RegionPoint& p) { return (left(p) < 0 ? loyalty(p) : 1) * -left(p); });
    }
    /// The four points of the last step, if all are there and one of them is deep enough.
    [[nodiscard]] std::optional<Four> those_of_last(double as_deep) const {
        boost::container::static_vector<std::size_t, 5> there;
        bool is_deep = false;
        for (std::size_t i = 0; i < points_.size() && there.size() < 5; ++i)
            if (place_in_last(points_[i]) < last_.size()) {
                there.push_back(i);
                is_deep = is_deep || points_[i].depth >= as_deep;
            }
        if (there.size() != 4 || !is_deep)
            return std::nullopt;
        return Four{there[0], there[1], there[2], there[3]};
    }
    /// The area of the hull of four points; a little less if one lies within.
    [[nodiscard]] double area_of(const Four& four) const {
        const auto across = [&](std::size_t p, std::size_t q, std::size_t r, std::size_t s) {
            const RegionPoint &a = points_[four[p]], &b = points_[four[q]], &c = points_[four[r]],
                              &d = points_[four[s]];
            return 0.5 * std::abs((b.x - a.x) * (d.y - c.y) - (b.y - a.y) * (d.x - c.x));
        };
        // Half the cross product of the diagonals, which two they may be.
        return std::max({across(0, 1, 2, 3), across(0, 2, 1, 3), across(0, 3, 1, 2)});
    }

    /// Takes the point for which a function is largest.
    template <typename Merit>
    void take(const Merit& merit) {
        std::size_t best = 0;
        double most = -HUGE_VAL;
        bool found = false;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            if (std::find(chosen_.begin(), chosen_.begin() + count_, i) != chosen_.begin() + count_)
                continue;
            const double here = merit(points_[i]);
            if (!found || here > most)
                best = i, most = here, found = true;
        }
        chosen_[static_cast<std::size_t>(count_++)] = best;
    }
    [[nodiscard]] std::size_t place_in_last(const RegionPoint& p) const {
        return static_cast<std::size_t>(std::find(last_.begin(), last_.end(), p.feature) -
                                        last_.begin());
    }
    [[nodiscard]] double loyalty(const RegionPoint& p) const {
        return place_in_last(p) < last_.size() ? kLoyalty : 1;
    }

    std::span<const RegionPoint> points_;
    std::span<const std::uint64_t> last_;
    Four chosen_{};
    std::ptrdiff_t count_ = 0;
};

} // namespace

boost::container::static_vector<std::size_t, 4> four_points(std::span<const RegionPoint> points,
                                                            double rounding,
                                                            std::span<const std::uint64_t> last) {
    boost::container::static_vector<std::size_t, 4> result;
    if (points.size() > 4) {
        const auto chosen = FourPoints(points, last).choose(rounding);
        result.assign(chosen.begin(), chosen.end());
    } else {
        for (std::size_t i = 0; i < points.size(); ++i)
            result.push_back(i);
    }
    // Four at most: std::stable_sort would allocate a buffer.
    for (std::size_t i = 1; i < result.size(); ++i)
        for (std::size_t k = i; k > 0 && points[result[k]].depth > points[result[k - 1]].depth; --k)
            std::swap(result[k], result[k - 1]);
    return result;
}

} // namespace abut
