#include "deform/rest/rest_search.h"

#include "deform/candidate_search.h" // kSearchTasks

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

MovingTree MovedLeaves::tree(MovingTree copy, StepEnd end) const {
    for (MovingNode& node : copy.nodes)
        for (std::size_t lane = 0; lane < MovingNode::kWidth; ++lane) {
            const NodeRef child = node.child[lane];
            if (!child.is_none() && child.is_leaf() && !contains(leaf_number(child)))
                moving_tree::set_box(node, lane, end, {});
        }
    moving_tree::fit_inner(copy, end);
    return copy;
}

RestSearch::RestSearch(const DeformableData& a, const DeformableData& b, StepEnd at,
                       double distance, const NearVertices& of_a, const NearVertices& of_b)
    : a_(a), b_(b), at_(at), widths_a_(a, of_a.thickness),
      widths_b_(b, is_self() ? std::span<const double>{} : of_b.thickness),
      margin_(least_margin(widths_a_, widths_b(), distance)), leaves_a_(a, a.swept),
      leaves_b_(b, b.swept), moved_a_(a, of_a.moved),
      moved_b_(b, is_self() ? std::span<const std::uint8_t>{} : of_b.moved) {
    if (!widths_a_.is_uniform())
        wide_tree_a_ = widths_a_.widened(a, at);
    if (!widths_b_.is_uniform())
        wide_tree_b_ = widths_b_.widened(b, at);
    if (!moved_a_.has_marks() && !moved_b_.has_marks())
        split(Pass::all);
    if (moved_a_.has_marks()) {
        tree_of_moved_a_ = moved_a_.tree(tree_a(), at);
        split(Pass::moved_of_a);
    }
    if (moved_b_.has_marks()) {
        tree_of_moved_b_ = moved_b_.tree(tree_b(), at);
        split(Pass::moved_of_b);
    }
}

void RestSearch::split(Pass pass) {
    for (const OverlapTraversal::Pair& pair : split_overlaps(traversal(pass), kSearchTasks))
        starts_.push_back({pass, pair});
}

OverlapTraversal RestSearch::traversal(Pass pass) const {
    OverlapTraversal traversal{pass == Pass::moved_of_a ? tree_of_moved_a_ : tree_a(),
                               pass == Pass::moved_of_b ? tree_of_moved_b_ : tree_b(),
                               margin_,
                               {},
                               at_};
    if (pass == Pass::all && is_self() && margin_ == 0 && has_one_margin())
        traversal.skipped = a_.flat_regions.flat();
    return traversal;
}

/// Two moved leaves of one surface are met in both orders. Those of two surfaces are met in both
/// passes.
bool RestSearch::is_visited_elsewhere(Pass pass, std::uint32_t a, std::uint32_t b) const {
    if (pass == Pass::moved_of_a)
        return is_self() && a > b && moved_a_.contains(b);
    return pass == Pass::moved_of_b && moved_a_.has_marks() && moved_a_.contains(a);
}

} // namespace abut
