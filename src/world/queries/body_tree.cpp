#include "world/queries/body_tree.h"

#include <algorithm>
#include <cmath>

namespace abut {

BodyTree::BodyTree(std::span<const Box3> boxes, std::uint64_t version) : version_(version) {
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        const Box3& box = boxes[i];
        if (is_empty(box))
            continue;
        if (is_finite(box.lower) && is_finite(box.upper))
            order_.push_back(i);
        else
            unbounded_.push_back({i, box});
    }
    if (!order_.empty()) {
        nodes_.reserve(order_.size());
        nodes_.emplace_back();
        build(0, 0, static_cast<std::uint32_t>(order_.size()), boxes);
    }
    boxes_.reserve(order_.size());
    for (const std::uint32_t index : order_)
        boxes_.push_back(boxes[index]);
}

void BodyTree::build(std::uint32_t node, std::uint32_t begin, std::uint32_t end,
                     std::span<const Box3> boxes) {
    constexpr std::uint32_t kLeaf = 4;
    Box3 bounds, centres;
    const auto centre = [&](std::uint32_t index) {
        return 0.5 * boxes[index].lower + 0.5 * boxes[index].upper;
    };
    for (std::uint32_t i = begin; i < end; ++i) {
        extend(bounds, boxes[order_[i]].lower), extend(bounds, boxes[order_[i]].upper);
        extend(centres, centre(order_[i]));
    }
    nodes_[node].box = bounds;
    if (end - begin <= kLeaf) {
        nodes_[node].first = begin, nodes_[node].count = end - begin;
        return;
    }
    const Vec3 size = centres.upper - centres.lower;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t i, std::uint32_t k) {
                         const double x = component(centre(i), axis),
                                      y = component(centre(k), axis);
                         return x != y ? x < y : i < k;
                     });
    const auto children = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node].first = children;
    nodes_.emplace_back(), nodes_.emplace_back();
    build(children, begin, middle, boxes);
    build(children + 1, middle, end, boxes);
}

bool BodyTree::may_meet(const Box3& box, const Ray& ray, double last) {
    double from = ray.t_min, to = last;
    for (int axis = 0; axis < 3; ++axis) {
        const double o = component(ray.origin, axis), way = component(ray.direction, axis),
                     low = component(box.lower, axis), high = component(box.upper, axis);
        // Bounds the rounding of both parameters.
        const double slack = 0x1p-50 * (std::abs(o) + std::abs(low) + std::abs(high));
        if (way == 0) {
            if (o < low || o > high)
                return false;
            continue;
        }
        const double one = (low - o) / way, other = (high - o) / way,
                     by = std::isfinite(slack) ? slack / std::abs(way) : 0;
        from = std::max(from, std::min(one, other) - by);
        to = std::min(to, std::max(one, other) + by);
    }
    return from <= to;
}

} // namespace abut
