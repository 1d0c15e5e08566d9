#pragma once

#include <abut/deformable.h>

#include "core/concurrent_set.h"
#include "core/parallel.h"
#include "core/stop.h"
#include "deform/feature_pairs.h"
#include "deform/feature_trees.h"
#include "deform/leaf_boxes.h"
#include "deform/leaf_pairs.h"
#include "deform/triangle_culling.h"
#include "deform/triangle_pairs.h"
#include "tree/traverse_overlaps.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace abut {

/// Enough tasks that the longest one does not keep the other threads waiting.
inline constexpr std::size_t kSearchTasks = 512;

/// The margin by which boxes are widened to find what comes within a distance. It is at most the
/// value at which all boxes overlap, so that bounds stay finite.
float margin_of(double distance);

/// Finds the feature pairs of two surfaces, or of one surface with itself, that may come within a
/// distance of each other. The surfaces' scheme and culling determine how. The search is divided
/// into tasks, which may run in any order, and on any thread if for_each_task calls them.
class CandidateSearch {
public:
    /// Searches with the hierarchies `swept_a` and `swept_b`, which may differ from the surfaces'
    /// own and must outlive this object. If a and b are the same object, finds that surface's pairs
    /// with itself.
    CandidateSearch(const DeformableData& a, const SweptTree& swept_a, const DeformableData& b,
                    const SweptTree& swept_b, double distance);
    /// Searches as the surfaces' options say.
    ///
    /// Errors      Error{bad_argument} if their schemes or cullings differ.
    CandidateSearch(const DeformableData& a, const DeformableData& b, double distance);

    [[nodiscard]] std::size_t tasks() const {
        return culling_ ? culling_->tasks() : starts_.size();
    }
    /// Calls body(task) for every task, in parallel. A search whose table of tested pairs has no locks
    /// calls them one after the other on the calling thread, whatever the limit of threads has become
    /// since.
    template <typename Body>
    void for_each_task(const Body& body) const;
    /// Hands the candidates of a task to a sink (see FeaturePairs) until the sink is done. Adds the
    /// numbers of candidates and triangle pairs to `counters`, unless it is null.
    template <typename Sink>
    void run(std::size_t task, Sink& sink, DeformableCounters* counters = nullptr) const;

private:
    /// Which hierarchies a task traverses.
    enum class Between : std::uint8_t { triangles, edges, vertices_faces, faces_vertices };
    struct Start {
        Between between = Between::triangles;
        OverlapTraversal::Pair pair;
    };
    void split(Between between, const OverlapTraversal& traversal);
    [[nodiscard]] OverlapTraversal between_triangles() const;
    void split_features();

    template <typename Sink>
    void run_features(const Start& start, FeaturePairs<Sink>& pairs) const;
    template <typename Visit>
    void run_features(const FeatureTree& a, const FeatureTree& b, OverlapTraversal::Pair start,
                      const Visit& visit) const;

    const DeformableData& a_;
    const DeformableData& b_;
    const SweptTree& swept_a_;
    const SweptTree& swept_b_;
    LeafSource leaves_a_, leaves_b_;
    float margin_;
    Scheme scheme_ = Scheme::representative;
    std::vector<Start> starts_;
    std::unique_ptr<const TriangleCulling> culling_; ///< finds triangle pairs if no hierarchy does;
                                                     ///< else null
    std::unique_ptr<ConcurrentSet> tested_;          ///< for Scheme::database
    bool on_one_thread_ = false; ///< tasks run one after the other; `tested_` has no locks
};

template <typename Body>
void CandidateSearch::for_each_task(const Body& body) const {
    if (!on_one_thread_)
        return parallel_for(tasks(), 1, body);
    for (std::size_t task = 0; task < tasks(); ++task) {
        poll_stop();
        body(task);
    }
}

template <typename Sink>
void CandidateSearch::run(std::size_t task, Sink& sink, DeformableCounters* counters) const {
    FeaturePairs<Sink> pairs(a_, b_, sink);
    const bool represented = scheme_ == Scheme::representative || scheme_ == Scheme::pairwise ||
                             scheme_ == Scheme::markup;
    const bool boxes = a_.compares_boxes_of_pairs();
    TrianglePairs<Sink> triangles(a_, b_, {represented, boxes, margin_, tested_.get()}, pairs);
    std::uint64_t triangle_pairs = 0;
    if (culling_) {
        culling_->run(task, triangles);
        triangle_pairs = triangles.count();
    } else if (scheme_ == Scheme::features) {
        run_features(starts_[task], pairs);
    } else {
        const OverlapTraversal traversal = between_triangles();
        if (scheme_ == Scheme::representative) {
            RepresentativePairs<Sink> visitor(leaves_a_, leaves_b_, margin_, pairs);
            traverse_overlaps(traversal, starts_[task].pair, visitor);
            triangle_pairs = visitor.triangle_pairs();
        } else {
            LeafTrianglePairs visitor(swept_a_.leaves, swept_b_.leaves, margin_, triangles);
            traverse_overlaps(traversal, starts_[task].pair, visitor);
            triangle_pairs = triangles.count();
        }
    }
    if (counters != nullptr) {
        counters->triangle_pairs += triangle_pairs;
        counters->candidates.vertex_face += pairs.counts().vertex_face;
        counters->candidates.edge_edge += pairs.counts().edge_edge;
    }
}

template <typename Sink>
void CandidateSearch::run_features(const Start& start, FeaturePairs<Sink>& pairs) const {
    const FeatureTrees &a = *a_.feature_trees, &b = *b_.feature_trees;
    if (start.between == Between::edges)
        run_features(a.edges, b.edges, start.pair, [&](auto e, auto f) {
            pairs.edges(e, f);
            return !pairs.is_done();
        });
    else if (start.between == Between::vertices_faces)
        run_features(a.vertices, b.faces, start.pair, [&](auto v, auto f) {
            pairs.vertex_face(v, f);
            return !pairs.is_done();
        });
    else
        run_features(a.faces, b.vertices, start.pair, [&](auto f, auto v) {
            pairs.face_vertex(f, v);
            return !pairs.is_done();
        });
}

template <typename Visit>
void CandidateSearch::run_features(const FeatureTree& a, const FeatureTree& b,
                                   OverlapTraversal::Pair start, const Visit& visit) const {
    FeatureLeafPairs<Visit> visitor(a, b, margin_, visit);
    traverse_overlaps({a.tree, b.tree, margin_}, start, visitor);
}

} // namespace abut
