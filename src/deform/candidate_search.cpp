#include "deform/candidate_search.h"

#include <abut/error.h>

#include "mesh/topology.h"

#include <algorithm>

namespace abut {

float margin_of(double distance) {
    return round_up(std::min(distance, 4 * kLargestCoordinate));
}

CandidateSearch::CandidateSearch(const DeformableData& a, const SweptTree& swept_a,
                                 const DeformableData& b, const SweptTree& swept_b, double distance)
    : a_(a), b_(b), swept_a_(swept_a), swept_b_(swept_b), leaves_a_(a, swept_a),
      leaves_b_(b, swept_b), margin_(margin_of(distance)) {
    split(Between::triangles, between_triangles());
}

CandidateSearch::CandidateSearch(const DeformableData& a, const DeformableData& b, double distance)
    : a_(a), b_(b), swept_a_(a.swept), swept_b_(b.swept), leaves_a_(a, swept_a_),
      leaves_b_(b, swept_b_), margin_(margin_of(distance)), scheme_(a.options.scheme) {
    if (scheme_ != b.options.scheme)
        throw Error(ErrorCode::bad_argument, "the surfaces have different schemes");
    if (a.options.culling != b.options.culling)
        throw Error(ErrorCode::bad_argument, "the surfaces have different cullings");
    if (scheme_ == Scheme::database) {
        // The limit says only what is best: another thread may change it while the tasks run, and
        // oneTBB applies a new limit late. for_each_task makes sure of what runs.
        on_one_thread_ = is_sequential();
        tested_ = std::make_unique<ConcurrentSet>(on_one_thread_);
    }
    if (scheme_ == Scheme::features)
        split_features();
    else if (a.options.culling == Culling::grid)
        culling_ = make_grid_culling(a, b, margin_);
    else if (a.options.culling == Culling::sweep)
        culling_ = make_sweep_culling(a, b, margin_);
    else
        split(Between::triangles, between_triangles());
}

OverlapTraversal CandidateSearch::between_triangles() const {
    const bool skips = &a_ == &b_ && margin_ == 0 && scheme_ == Scheme::representative;
    return {swept_a_.tree, swept_b_.tree, margin_,
            skips ? a_.flat_regions.flat() : std::span<const std::uint8_t>{}};
}

void CandidateSearch::split(Between between, const OverlapTraversal& traversal) {
    for (const OverlapTraversal::Pair& pair : split_overlaps(traversal, kSearchTasks))
        starts_.push_back({between, pair});
}

void CandidateSearch::split_features() {
    const FeatureTrees &a = *a_.feature_trees, &b = *b_.feature_trees;
    split(Between::edges, {a.edges.tree, b.edges.tree, margin_});
    split(Between::vertices_faces, {a.vertices.tree, b.faces.tree, margin_});
    if (&a_ != &b_)
        split(Between::faces_vertices, {a.faces.tree, b.vertices.tree, margin_});
}

} // namespace abut
