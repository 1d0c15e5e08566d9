#include "world/broad_phase/box_strips.h"

#include "math/vector.h"
#include "world/broad_phase/box_node.h"
#include "world/broad_phase/pair_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace abut {

namespace {

/// Moves a bound outward by slightly more than half of the gap, so that boxes at most `gap` apart
/// overlap. The factor 0x1p-50 exceeds the rounding of normal numbers. For numbers near zero, sums
/// are exact, and the error of half the gap is below the smallest subnormal number.
double lowered(double x, double gap) {
    constexpr double kLeast = std::numeric_limits<double>::denorm_min();
    return x - (0.5 * gap + kLeast + 0x1p-50 * (std::abs(x) + gap));
}
Box3 widened(const Box3& box, double gap) {
    const auto &l = box.lower, &u = box.upper;
    return {{lowered(l.x, gap), lowered(l.y, gap), lowered(l.z, gap)},
            {-lowered(-u.x, gap), -lowered(-u.y, gap), -lowered(-u.z, gap)}};
}

/// Whether a - b <= gap. Exact.
///
/// In          a is below infinity, b above minus infinity; gap is finite.
bool differ_by_at_most(double a, double b, double gap) {
    const double difference = a - b;
    // Rounding is monotone, so only if the difference rounds to the gap itself is the answer
    // uncertain.
    if (difference != gap)
        return difference < gap;
    // The rounding error of a difference is itself a double, computed here. [Dekker 1971]
    const double error = std::abs(a) >= std::abs(b) ? (a - difference) - b : a - (difference + b);
    return error <= 0;
}

/// Whether the boxes are at most `gap` apart on every axis. Exact.
///
/// In          boxes that take part.
bool are_near(const Box3& p, const Box3& q, double gap) {
    for (int axis = 0; axis < 3; ++axis)
        if (!differ_by_at_most(component(p.lower, axis), component(q.upper, axis), gap) ||
            !differ_by_at_most(component(q.lower, axis), component(p.upper, axis), gap))
            return false;
    return true;
}

/// Searches one strip after the other.
class Strips {
public:
    Strips(std::span<const Box3> boxes, double gap, const PairFilter& filter)
        : boxes_(boxes), gap_(gap), filter_(filter) {
        order_.reserve(boxes.size());
        for (std::uint32_t i = 0; i < boxes.size(); ++i)
            if (takes_part(boxes[i]))
                order_.push_back(i);
    }

    std::vector<IndexPair> find(std::size_t strip) {
        if (order_.size() > strip)
            axis_ = least_crowded_axis();
        cut({order_.begin(), order_.end()}, strip);
        std::vector<IndexPair> pairs;
        order_ = {}, reaching_ = {};
        sort_pairs(found_, boxes_.size(), pairs);
        return pairs;
    }

private:
    using Indices = std::span<std::uint32_t>;

    [[nodiscard]] Box3 box(std::uint32_t i) const {
        return gap_ == 0 ? boxes_[i] : widened(boxes_[i], gap_);
    }
    [[nodiscard]] double lower(std::uint32_t i) const {
        const double bound = component(boxes_[i].lower, axis_);
        return gap_ == 0 ? bound : lowered(bound, gap_);
    }

    /// The axis along which boxes are short compared with the extent of all boxes.
    [[nodiscard]] int least_crowded_axis() const {
        std::array<double, 3> crowd{};
        for (int axis = 0; axis < 3; ++axis) {
            double low = HUGE_VAL, high = -HUGE_VAL, sum = 0;
            for (const std::uint32_t i : order_) {
                const double l = component(boxes_[i].lower, axis),
                             u = component(boxes_[i].upper, axis);
                if (u - l == HUGE_VAL)
                    continue; // a half-space says nothing about the others
                low = std::min(low, l), high = std::max(high, l);
                sum += u - l;
            }
            const double crowded = sum / (high - low); // not a number if no box is bounded
            crowd.at(static_cast<std::size_t>(axis)) = crowded >= 0 ? crowded : HUGE_VAL;
        }
        return static_cast<int>(std::min_element(crowd.begin(), crowd.end()) - crowd.begin());
    }

    /// Halves a part until its parts are strips. Strips are searched in ascending order.
    void cut(Indices part, std::size_t strip) {
        if (part.size() <= strip) {
            search(part);
            return;
        }
        const auto middle = part.begin() + static_cast<std::ptrdiff_t>(part.size() / 2);
        std::nth_element(part.begin(), middle, part.end(),
                         [&](std::uint32_t i, std::uint32_t k) { return lower(i) < lower(k); });
        cut({part.begin(), middle}, strip);
        cut({middle, part.end()}, strip);
    }

    /// Finds the pairs of a strip. A pair belongs to the strip of its later box.
    void search(Indices strip) {
        double begin = HUGE_VAL;
        for (const std::uint32_t i : strip)
            begin = std::min(begin, lower(i));
        std::erase_if(reaching_,
                      [&](std::uint32_t i) { return component(box(i).upper, axis_) < begin; });
        const std::size_t before = reaching_.size();
        reaching_.insert(reaching_.end(), strip.begin(), strip.end());
        std::vector<Box3> here;
        here.reserve(reaching_.size());
        for (const std::uint32_t i : reaching_)
            here.push_back(box(i));
        PairList list;
        make_tree_search([&](std::uint32_t i, std::uint32_t k) {
            if (std::max(i, k) < before)
                return false;
            const auto [a, b] = std::minmax(reaching_[i], reaching_[k]);
            return (gap_ == 0 || are_near(boxes_[a], boxes_[b], gap_)) &&
                   (!filter_ || filter_(a, b));
        })->restart(here, list);
        std::vector<IndexPair>& found = found_.emplace_back();
        found.reserve(list.pairs().size());
        for (const IndexPair pair : list.pairs())
            found.emplace_back(reaching_[pair.a()], reaching_[pair.b()]);
    }

    std::span<const Box3> boxes_;
    double gap_;
    const PairFilter& filter_;
    int axis_ = 0;
    std::vector<std::uint32_t> order_; ///< the boxes that take part, strip by strip
    std::vector<std::uint32_t>
        reaching_; ///< boxes that may reach into the strip, from earlier ones or in it
    std::vector<std::vector<IndexPair>> found_;
};

} // namespace

std::vector<IndexPair> overlaps_by_strips(std::span<const Box3> boxes, double gap,
                                          const PairFilter& filter, std::size_t strip) {
    return Strips(boxes, gap, filter).find(strip);
}

} // namespace abut
