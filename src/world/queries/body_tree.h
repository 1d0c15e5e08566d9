#pragma once

#include <abut/shapes.h>
#include <abut/types.h>

#include "math/vector.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A tree over the boxes of bodies, for questions about places and ways.
class BodyTree {
public:
    /// In          boxes: one that is empty holds no body; one may be infinite.
    /// In          version: tells when the boxes were current.
    BodyTree(std::span<const Box3> boxes, std::uint64_t version);

    [[nodiscard]] std::uint64_t version() const { return version_; }

    /// Calls visit(index) for each box that shares a point with a box.
    template <typename Visit>
    void for_each_overlap(const Box3& box, const Visit& visit) const {
        walk([&](const Box3& each) { return overlap(each, box); }, visit);
    }
    /// Calls visit(index) for boxes that a ray may meet. visit returns the largest t that still matters.
    template <typename Visit>
    void for_each_on_ray(const Ray& ray, const Visit& visit) const {
        double last = ray.t_max;
        walk([&](const Box3& each) { return may_meet(each, ray, last); },
             [&](std::uint32_t index) { last = std::min(last, visit(index)); });
    }

private:
    struct Node {
        Box3 box;
        std::uint32_t first = 0; ///< of a leaf: in order_; else the first of two children in a row
        std::uint32_t count = 0; ///< of boxes in a leaf; 0: an inner node
    };
    void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end,
               std::span<const Box3> boxes);
    /// False only if the ray misses the box up to a parameter.
    static bool may_meet(const Box3& box, const Ray& ray, double last);

    template <typename Test, typename Visit>
    void walk(const Test& test, const Visit& visit) const {
        for (const auto& [index, box] : unbounded_)
            if (test(box))
                visit(index);
        if (nodes_.empty())
            return;
        boost::container::small_vector<std::uint32_t, 64> stack{0U};
        while (!stack.empty()) {
            const Node& node = nodes_[stack.back()];
            stack.pop_back();
            if (!test(node.box))
                continue;
            if (node.count == 0) {
                stack.push_back(node.first + 1), stack.push_back(node.first);
                continue;
            }
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
                if (test(boxes_[i]))
                    visit(order_[i]);
        }
    }

    struct Unbounded {
        std::uint32_t index = 0;
        Box3 box;
    };
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_; ///< bodies by leaf
    std::vector<Box3> boxes_;          ///< in this order
    std::vector<Unbounded> unbounded_;
    std::uint64_t version_;
};

} // namespace abut
