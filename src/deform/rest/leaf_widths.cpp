#include "deform/rest/leaf_widths.h"

#include "core/parallel.h"
#include "deform/candidate_search.h"
#include "volume/aabb.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

namespace {

constexpr std::size_t kLeavesAtOnce = 1024;

/// A float above a length. The step beyond it is larger than what doubles have rounded.
float above(double length) {
    return std::nextafter(margin_of(length), std::numeric_limits<float>::infinity());
}

/// The box that encloses all points within `by` of a box, whatever rounds.
Aabb grown(const Aabb& box, float by) {
    constexpr float kFar = std::numeric_limits<float>::infinity();
    Aabb wide = box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        wide.lower[axis] = std::nextafter(box.lower[axis] - by, -kFar);
        wide.upper[axis] = std::nextafter(box.upper[axis] + by, kFar);
    }
    return wide;
}

} // namespace

LeafWidths::LeafWidths(const DeformableData& surface, std::span<const double> thickness) {
    const FeatureRuns& faces = surface.swept.leaves.faces;
    if (thickness.empty() || faces.leaves() == 0)
        return;
    std::vector<double> most(faces.leaves()), least(faces.leaves());
    parallel_for(faces.leaves(), kLeavesAtOnce, [&](std::size_t i) {
        const auto leaf = static_cast<std::uint32_t>(i);
        least[i] = std::numeric_limits<double>::infinity();
        for (std::uint32_t k = 0; k < faces.count(leaf); ++k)
            for (const std::uint32_t vertex : surface.triangles[faces.ids(leaf)[k]]) {
                most[i] = std::max(most[i], thickness[vertex]);
                least[i] = std::min(least[i], thickness[vertex]);
            }
    });
    least_ = *std::min_element(least.begin(), least.end());
    if (*std::max_element(most.begin(), most.end()) == least_)
        return;
    beyond_.resize(most.size());
    std::transform(most.begin(), most.end(), beyond_.begin(),
                   [&](double of_leaf) { return of_leaf > least_ ? above(of_leaf - least_) : 0; });
}

MovingTree LeafWidths::widened(const DeformableData& surface, StepEnd end) const {
    MovingTree tree = surface.swept.tree;
    for (MovingNode& node : tree.nodes)
        for (std::size_t lane = 0; lane < MovingNode::kWidth; ++lane) {
            const NodeRef child = node.child[lane];
            if (child.is_none() || !child.is_leaf())
                continue;
            const float by = beyond(leaf_number(child));
            if (by > 0)
                moving_tree::set_box(node, lane, end,
                                     grown(moving_tree::box_of(node, lane).at(end), by));
        }
    moving_tree::fit_inner(tree, end);
    return tree;
}

float least_margin(const LeafWidths& a, const LeafWidths& b, double distance) {
    const double least = distance + (a.least() + b.least());
    return a.is_uniform() && b.is_uniform() ? margin_of(least) : above(least);
}

float widened_margin(float margin, float beyond_a, float beyond_b) {
    if (beyond_a == 0 && beyond_b == 0)
        return margin;
    constexpr float kFar = std::numeric_limits<float>::infinity();
    // Each sum is off by half a step at most.
    return std::nextafter(std::nextafter(margin + beyond_a, kFar) + beyond_b, kFar);
}

} // namespace abut
