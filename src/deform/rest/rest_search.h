#pragma once

#include "deform/feature_pairs.h"
#include "deform/leaf_boxes.h"
#include "deform/leaf_pairs.h"
#include "deform/rest/leaf_widths.h"
#include "tree/traverse_overlaps.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The leaves of a surface's hierarchy that have a vertex which has moved.
class MovedLeaves {
public:
    /// Without marks.
    MovedLeaves() = default;
    /// In: moved, which has an entry for each vertex, not 0 if it has moved; or is empty.
    MovedLeaves(const DeformableData& surface, std::span<const std::uint8_t> moved);

    [[nodiscard]] bool has_marks() const { return !moved_.empty(); }
    [[nodiscard]] bool contains(std::uint32_t leaf) const { return moved_[leaf] != 0; }
    /// Gives all other leaves of a copy of the surface's hierarchy empty boxes at one end.
    [[nodiscard]] MovingTree tree(MovingTree copy, StepEnd end) const;

private:
    std::vector<std::uint8_t> moved_; ///< for each leaf
};

/// Finds the feature pairs of two surfaces, or of one surface with itself, whose boxes at one end of
/// the step are within a distance of each other, plus the thickness of both leaves. The search is
/// divided into tasks, which may run in any order and on any thread. It always uses the
/// hierarchies, whatever the surfaces' scheme and culling are.
class RestSearch {
public:
    /// In: a and b, which must outlive this; the same object for one surface with itself, whose
    /// vertices are `of_a`. Their thicknesses and marks are used. If a vertex is marked as moved,
    /// only pairs of leaves with a moved vertex are visited.
    RestSearch(const DeformableData& a, const DeformableData& b, StepEnd at, double distance,
               const NearVertices& of_a, const NearVertices& of_b);
    RestSearch(const RestSearch&) = delete;
    RestSearch& operator=(const RestSearch&) = delete;

    [[nodiscard]] std::size_t tasks() const { return starts_.size(); }
    /// Hands the candidates of a task to a sink (see FeaturePairs). If both surfaces are the same
    /// object, a pair comes once.
    template <typename Sink>
    void run(std::size_t task, Sink& sink) const;

private:
    /// One of the traversals that make up the search.
    enum class Pass : std::uint8_t { all, moved_of_a, moved_of_b };
    struct Start {
        Pass pass = Pass::all;
        OverlapTraversal::Pair pair;
    };

    [[nodiscard]] bool is_self() const { return &a_ == &b_; }
    [[nodiscard]] bool has_one_margin() const {
        return widths_a_.is_uniform() && widths_b().is_uniform();
    }
    [[nodiscard]] const LeafWidths& widths_b() const { return is_self() ? widths_a_ : widths_b_; }
    [[nodiscard]] const MovingTree& tree_a() const {
        return widths_a_.is_uniform() ? a_.swept.tree : wide_tree_a_;
    }
    /// The same object as tree_a() for one surface.
    [[nodiscard]] const MovingTree& tree_b() const {
        return is_self() ? tree_a() : widths_b_.is_uniform() ? b_.swept.tree : wide_tree_b_;
    }
    void split(Pass pass);
    [[nodiscard]] OverlapTraversal traversal(Pass pass) const;
    /// Whether another visit of the search meets these leaves too, and takes their pairs.
    [[nodiscard]] bool is_visited_elsewhere(Pass pass, std::uint32_t a, std::uint32_t b) const;

    const DeformableData& a_;
    const DeformableData& b_;
    StepEnd at_;
    LeafWidths widths_a_, widths_b_;
    float margin_; ///< the distance, and the least thickness on both sides
    LeafSource leaves_a_, leaves_b_;
    MovedLeaves moved_a_, moved_b_;
    MovingTree wide_tree_a_, wide_tree_b_; ///< empty if the widths are uniform
    MovingTree tree_of_moved_a_, tree_of_moved_b_;
    std::vector<Start> starts_;
};

template <typename Sink>
void RestSearch::run(std::size_t task, Sink& sink) const {
    class Visitor final : public OverlapVisitor {
    public:
        Visitor(const RestSearch& search, Pass pass, RepresentativePairs<Sink>& pairs)
            : search_(search), pass_(pass), pairs_(pairs), one_margin_(search.has_one_margin()) {}
        bool visit(std::uint32_t a, std::uint32_t b) override {
            if (search_.is_visited_elsewhere(pass_, a, b))
                return true;
            if (!one_margin_)
                pairs_.set_margin(widened_margin(search_.margin_, search_.widths_a_.beyond(a),
                                                 search_.widths_b().beyond(b)));
            return pairs_.visit(a, b);
        }

    private:
        const RestSearch& search_;
        Pass pass_;
        RepresentativePairs<Sink>& pairs_;
        bool one_margin_;
    };

    const Start& start = starts_[task];
    FeaturePairs<Sink> pairs(a_, b_, sink);
    RepresentativePairs<Sink> leaf_pairs(leaves_a_, leaves_b_, margin_, pairs);
    leaf_pairs.set_at(at_);
    Visitor visitor(*this, start.pass, leaf_pairs);
    traverse_overlaps(traversal(start.pass), start.pair, visitor);
}

} // namespace abut
