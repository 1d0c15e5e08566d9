#pragma once

#include "deform/feature_pairs.h"
#include "deform/leaf_boxes.h"
#include "deform/leaf_pairs.h"
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
    /// A copy of a surface's hierarchy in which all other leaves have empty boxes at one end.
    [[nodiscard]] MovingTree tree(const DeformableData& surface, StepEnd end) const;

private:
    std::vector<std::uint8_t> moved_; ///< for each leaf
};

/// Finds the feature pairs of two surfaces, or of one surface with itself, whose boxes at one end of
/// the step are near each other. The search is divided into tasks, which may run in any order and on
/// any thread. It always uses the hierarchies, whatever the surfaces' scheme and culling are.
class RestSearch {
public:
    struct Moved {
        std::span<const std::uint8_t> a, b; ///< see MovedLeaves
    };
    /// In: a and b, which must outlive this; the same object for one surface with itself. If a
    /// vertex is marked as moved, only pairs of leaves with a moved vertex are visited.
    RestSearch(const DeformableData& a, const DeformableData& b, StepEnd at, float margin,
               const Moved& moved = {});
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

    void split(Pass pass);
    [[nodiscard]] OverlapTraversal traversal(Pass pass) const;
    /// Whether another visit of the search meets these leaves too, and takes their pairs.
    [[nodiscard]] bool is_visited_elsewhere(Pass pass, std::uint32_t a, std::uint32_t b) const;

    const DeformableData& a_;
    const DeformableData& b_;
    StepEnd at_;
    float margin_;
    LeafSource leaves_a_, leaves_b_;
    MovedLeaves moved_a_, moved_b_;
    MovingTree tree_of_moved_a_, tree_of_moved_b_;
    std::vector<Start> starts_;
};

template <typename Sink>
void RestSearch::run(std::size_t task, Sink& sink) const {
    class Visitor final : public OverlapVisitor {
    public:
        Visitor(const RestSearch& search, Pass pass, RepresentativePairs<Sink>& pairs)
            : search_(search), pass_(pass), pairs_(pairs) {}
        bool visit(std::uint32_t a, std::uint32_t b) override {
            return search_.is_visited_elsewhere(pass_, a, b) || pairs_.visit(a, b);
        }

    private:
        const RestSearch& search_;
        Pass pass_;
        RepresentativePairs<Sink>& pairs_;
    };

    const Start& start = starts_[task];
    FeaturePairs<Sink> pairs(a_, b_, sink);
    RepresentativePairs<Sink> leaf_pairs(leaves_a_, leaves_b_, margin_, pairs);
    leaf_pairs.set_at(at_);
    Visitor visitor(*this, start.pass, leaf_pairs);
    traverse_overlaps(traversal(start.pass), start.pair, visitor);
}

} // namespace abut
