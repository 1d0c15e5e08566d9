#pragma once

#include "world/broad_phase/loose_pairs.h"
#include "world/broad_phase/pair_search.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace abut {

/// Finds the pairs of boxes that move slowly. Each box lies in a loose box, which is larger and
/// stands still for some steps. As long as all boxes lie in their loose boxes, every pair that meets
/// is among the pairs of the loose boxes, so that a step only tests these.
///
/// Source      [Verlet 1967], neighbour lists. Differs: a loose box reaches ahead along the box's own
///             motion, and boxes that leave theirs get new ones alone, if they are few.
class LooseSearch {
public:
    explicit LooseSearch(PairFilter filter);

    /// Gives all boxes loose boxes, and finds their pairs.
    void begin(std::span<const Box3> boxes);
    /// Updates `list` to this step, like PairSearch::update. Returns false, and leaves the list as
    /// it is, if the boxes move so fast or are so dense that another search is faster. Call `begin`
    /// before the next use then.
    bool try_update(const BoxStep& step, PairList& list);

private:
    /// A box when it got its loose box.
    struct Start {
        BoxLine box;
        std::size_t step = 0;
    };

    struct Motion {
        std::array<double, 3> lower{}, upper{}; ///< change of each bound a step
        double side = 0, speed = 0;             ///< the mean side, and the largest change
    };

    [[nodiscard]] Motion motion_of(std::uint32_t box) const;
    bool look_ahead();
    void report(PairList& list);
    void move_boxes(const BoxStep& step);
    void loosen_all();
    void loosen_some();
    void loosen(std::uint32_t box);
    /// Appends the pairs of loose boxes that began and whose boxes meet.
    void add_new_pairs();
    /// Removes the pairs that the filter excludes. There must be a filter.
    void keep_wanted(std::vector<IndexPair>& pairs) const;

    PairFilter filter_;
    std::unique_ptr<PairSearch> tree_; ///< over the loose boxes
    PairList loose_pairs_;
    std::vector<Box3> loose_;
    std::vector<BoxLine> boxes_, loose_lines_;
    std::vector<Start> starts_;
    std::vector<std::uint8_t> meets_; ///< for each pair of loose boxes: 1 if the boxes meet
    std::vector<std::uint32_t> flipped_, left_, all_;
    std::vector<IndexPair> begun_, ended_, now_;
    std::size_t step_ = 0;
    std::size_t all_loosened_ = 0; ///< the step in which all boxes got their loose boxes
    double ahead_ = 0;             ///< how many steps loose boxes reach ahead
    bool knows_motion_ = false;
};

} // namespace abut
