#pragma once

#include "math/vector.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace abut {

/// Finds the boxes of a list that meet a box.
///
/// Cost        O(n log n) once, and O(log n) for each query and box found, if boxes overlap little.
class BoxIndex {
public:
    explicit BoxIndex(std::vector<Box3> boxes)
        : boxes_(std::move(boxes)), order_(boxes_.size()), bounds_(boxes_.size()) {
        std::iota(order_.begin(), order_.end(), 0U);
        arrange(0, order_.size());
    }

    /// Calls visit(number of a box) for all boxes that meet one.
    template <typename Visit>
    void for_each_overlap(const Box3& box, const Visit& visit) const {
        search(0, order_.size(), box, visit);
    }

private:
    // The middle of each range is a node: boxes on its left and right have lower and higher middles.
    static std::size_t middle_of(std::size_t first, std::size_t last) { return (first + last) / 2; }

    Box3 arrange(std::size_t first, std::size_t last) {
        if (first == last)
            return {};
        Box3 bounds;
        for (std::size_t i = first; i < last; ++i)
            extend(bounds, boxes_[order_[i]].lower), extend(bounds, boxes_[order_[i]].upper);
        const Vec3 size = bounds.upper - bounds.lower;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t middle = middle_of(first, last);
        const auto at = [&](std::size_t i) {
            return order_.begin() + static_cast<std::ptrdiff_t>(i);
        };
        std::nth_element(at(first), at(middle), at(last), [&](std::uint32_t i, std::uint32_t j) {
            const auto key = [&](std::uint32_t k) {
                return component(boxes_[k].lower, axis) + component(boxes_[k].upper, axis);
            };
            const double of_i = key(i), of_j = key(j);
            return of_i == of_j ? i < j : of_i < of_j;
        });
        bounds_[middle] = bounds;
        arrange(first, middle);
        arrange(middle + 1, last);
        return bounds;
    }

    template <typename Visit>
    void search(std::size_t first, std::size_t last, const Box3& box, const Visit& visit) const {
        if (first == last)
            return;
        const std::size_t middle = middle_of(first, last);
        if (!overlap(bounds_[middle], box))
            return;
        search(first, middle, box, visit);
        if (overlap(boxes_[order_[middle]], box))
            visit(order_[middle]);
        search(middle + 1, last, box, visit);
    }

    std::vector<Box3> boxes_;
    std::vector<std::uint32_t> order_;
    std::vector<Box3> bounds_; ///< of the range whose middle is there
};

} // namespace abut
