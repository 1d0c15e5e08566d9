#include "world/solids/four_points.h"

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
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
        : points_(points), last_(last) {
        states_.reserve(points.size());
        for (const RegionPoint& p : points) {
            const auto place = std::find(last.begin(), last.end(), p.feature) - last.begin();
            states_.push_back({static_cast<std::uint32_t>(place), false});
        }
    }

    Four choose(double rounding) {
        double deepest = -HUGE_VAL, low_x = 0, low_y = 0, high_x = 0, high_y = 0;
        for (const RegionPoint& p : points_) { // extents are relative to the first point
            const double x = p.x - points_[0].x, y = p.y - points_[0].y;
            deepest = std::max(deepest, p.depth);
            low_x = std::min(low_x, x), high_x = std::max(high_x, x);
            low_y = std::min(low_y, y), high_y = std::max(high_y, y);
        }
        const double extent = std::max({-low_x, high_x, -low_y, high_y});
        const double as_deep = deepest - (last_.empty() ? 0 : std::max(rounding, kAsDeep * extent));
        const std::optional<Four> before = those_of_last(as_deep);
        // No four hold more than the rectangle around all.
        if (before && area_of(*before) >= (high_x - low_x) * (high_y - low_y) / kLoyalty)
            return *before;
        choose_anew(deepest, as_deep);
        return before && area_of(*before) >= area_of(chosen_) / kLoyalty ? *before : chosen_;
    }

private:
    void choose_anew(double deepest, double as_deep) {
        // The first one of the last step that is as deep; else the deepest.
        take([&](const RegionPoint& p, std::size_t i) {
            return p.depth < as_deep ? -HUGE_VAL
                   : was_chosen(i)   ? static_cast<double>(last_.size() - states_[i].place_in_last)
                                     : std::min(p.depth - deepest, 0.0);
        });
        const RegionPoint& first = points_[chosen_[0]];
        take([&](const RegionPoint& p, std::size_t i) {
            const double x = p.x - first.x, y = p.y - first.y;
            return loyalty(i) * loyalty(i) * (x * x + y * y);
        });
        const RegionPoint& second = points_[chosen_[1]];
        const auto left = [&](const RegionPoint& p) {
            return (second.x - first.x) * (p.y - first.y) - (second.y - first.y) * (p.x - first.x);
        };
        take([&](const RegionPoint& p, std::size_t i) {
            const double here = left(p);
            return (here > 0 ? loyalty(i) : 1) * here;
        });
        take([&](const RegionPoint& p, std::size_t i) {
            const double here = left(p);
            return (here < 0 ? loyalty(i) : 1) * -here;
        });
    }
    /// The four points of the last step, if all are there and one of them is deep enough.
    [[nodiscard]] std::optional<Four> those_of_last(double as_deep) const {
        boost::container::static_vector<std::size_t, 5> there;
        bool is_deep = false;
        for (std::size_t i = 0; i < points_.size() && there.size() < 5; ++i)
            if (was_chosen(i)) {
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

    /// Takes the point for which a function is largest; of equal ones, the first.
    template <typename Merit>
    void take(const Merit& merit) {
        std::size_t best = 0;
        double most = -HUGE_VAL;
        // Values are chosen: a branch would be taken at random.
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const double here = states_[i].is_taken ? -HUGE_VAL : merit(points_[i], i);
            best = here > most ? i : best;
            most = std::max(here, most);
        }
        chosen_[count_++] = best;
        states_[best].is_taken = true;
    }
    /// Whether a point is one of the last step.
    [[nodiscard]] bool was_chosen(std::size_t i) const {
        return states_[i].place_in_last < last_.size();
    }
    [[nodiscard]] double loyalty(std::size_t i) const { return was_chosen(i) ? kLoyalty : 1; }

    struct State {
        std::uint32_t place_in_last; ///< the size of the list if it is not there
        bool is_taken;
    };

    std::span<const RegionPoint> points_;
    std::span<const std::uint64_t> last_;
    boost::container::small_vector<State, 32> states_; ///< of each point
    Four chosen_{};
    std::size_t count_ = 0;
};

/// Sorts the places of up to four points; those of equal depth keep their order. Ranks are counted: a branch
/// would be taken at random.
void put_deepest_first(std::span<const RegionPoint> points,
                       boost::container::static_vector<std::size_t, 4>& places) {
    const std::size_t count = places.size();
    // Places beyond the count are the least deep.
    std::array<double, 4> depths{};
    std::array<std::size_t, 4> ranks{}, sorted{};
    for (std::size_t i = 0; i < 4; ++i)
        depths[i] = i < count ? points[places[i]].depth : -HUGE_VAL;
    for (std::size_t i = 1; i < 4; ++i)
        for (std::size_t k = 0; k < i; ++k) {
            const std::size_t is_deeper = depths[i] > depths[k] ? 1 : 0;
            ranks[k] += is_deeper, ranks[i] += 1 - is_deeper;
        }
    for (std::size_t i = 0; i < 4; ++i)
        sorted[ranks[i]] = i < count ? places[i] : 0;
    for (std::size_t i = 0; i < count; ++i)
        places[i] = sorted[i];
}

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
    put_deepest_first(points, result);
    return result;
}

} // namespace abut
