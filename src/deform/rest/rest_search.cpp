#include "deform/rest/rest_search.h"

#include "deform/candidate_search.h"

namespace abut {

MovedLeaves::MovedLeaves(const DeformableData& surface, std::span<const std::uint8_t> moved) {
    if (moved.empty())
        return;
    const FeatureRuns& faces = surface.swept.leaves.faces;
    moved_.resize(faces.leaves());
    for (std::uint32_t leaf = 0; leaf < moved_.size(); ++leaf)
        for (std::uint32_t k = 0; k < faces.count(leaf); ++k)
            for (const std::uint32_t vertex : surface.triangles[faces.ids(leaf)[k]])
                moved_[leaf] |= moved[vertex] != 0 ? 1 : 0;
}

MovingTree MovedLeaves::tree(const DeformableData& surface, StepEnd end) const {
    MovingTree tree = surface.swept.tree;
    for (MovingNode& node : tree.nodes)
        for (std::size_t lane = 0; lane < MovingNode::kWidth; ++lane) {
            const NodeRef child = node.child[lane];
            if (!child.is_none() && child.is_leaf() && !contains(leaf_number(child)))
                moving_tree::set_box(node, lane, end, {});
        }
    moving_tree::fit_inner(tree, end);
    return tree;
}

RestSearch::RestSearch(const DeformableData& a, const DeformableData& b, StepEnd at, float margin,
                       const Moved& moved)
    : a_(a), b_(b), at_(at), margin_(margin), leaves_a_(a, a.swept), leaves_b_(b, b.swept),
      moved_a_(a, moved.a), moved_b_(b, &a == &b ? std::span<const std::uint8_t>{} : moved.b) {
    if (!moved_a_.has_marks() && !moved_b_.has_marks())
        split(Pass::all);
    if (moved_a_.has_marks()) {
        tree_of_moved_a_ = moved_a_.tree(a, at);
        split(Pass::moved_of_a);
    }
    if (moved_b_.has_marks()) {
        tree_of_moved_b_ = moved_b_.tree(b, at);
        split(Pass::moved_of_b);
    }
}

void RestSearch::split(Pass pass) {
    for (const OverlapTraversal::Pair& pair : split_overlaps(traversal(pass), kSearchTasks))
        starts_.push_back({pass, pair});
}

OverlapTraversal RestSearch::traversal(Pass pass) const {
    OverlapTraversal traversal{pass == Pass::moved_of_a ? tree_of_moved_a_ : a_.swept.tree,
                               pass == Pass::moved_of_b ? tree_of_moved_b_ : b_.swept.tree,
                               margin_,
                               {},
                               at_};
    if (pass == Pass::all && &a_ == &b_ && margin_ == 0)
        traversal.skipped = a_.flat_regions.flat();
    return traversal;
}

/// Two moved leaves of one surface are met in both orders. Those of two surfaces are met in both
/// passes.
bool RestSearch::is_visited_elsewhere(Pass pass, std::uint32_t a, std::uint32_t b) const {
    if (pass == Pass::moved_of_a)
        return &a_ == &b_ && a > b && moved_a_.contains(b);
    return pass == Pass::moved_of_b && moved_a_.has_marks() && moved_a_.contains(a);
}

} // namespace abut
