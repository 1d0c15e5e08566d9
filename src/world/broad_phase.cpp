#include "world/broad_phase.h"

#include "core/parallel.h"
#include "math/vector.h"
#include "tree/traverse_one.h"
#include "tree/tree.h"

#include <algorithm>

namespace abut {

std::vector<std::pair<std::uint32_t, std::uint32_t>>
overlapping_boxes(std::span<const Box3> boxes, double gap,
                  const std::function<bool(std::uint32_t, std::uint32_t)>& wanted) {
    std::vector<std::uint32_t> used; // primitive of the tree -> box
    std::vector<Aabb> aabbs;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        if (!is_empty(boxes[i])) {
            used.push_back(i);
            aabbs.emplace_back(boxes[i]);
        }
    const Tree tree = build_tree(aabbs);

    std::vector<std::vector<std::uint32_t>> partners(boxes.size());
    parallel_for(used.size(), 64, [&](std::size_t k) {
        const std::uint32_t i = used[k];
        for_each_overlap(tree, Aabb(boxes[i], gap), [&](std::uint32_t slot) {
            const std::uint32_t j = used[tree.order[slot]];
            if (i < j && overlap(boxes[i], boxes[j], gap) && wanted(i, j))
                partners[i].push_back(j);
        });
        std::sort(partners[i].begin(), partners[i].end());
    });
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
        for (const std::uint32_t j : partners[i])
            pairs.emplace_back(i, j);
    return pairs;
}

} // namespace abut
