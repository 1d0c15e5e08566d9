#pragma once

#include "world/broad_phase/pair_search.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace abut {

/// Keeps the ends of all boxes sorted along three axes from step to step. Two boxes can begin or
/// cease to overlap only if an end of one changes places with an end of the other, so only these
/// pairs are tested.
///
/// Source      [Cohen, Lin, Manocha, Ponamgi 1995], I-COLLIDE. Differs: if too many ends change
///             places, the insertion sort stops, and the axes are sorted anew.
class SweepAndPrune final : public PairSearch {
public:
    explicit SweepAndPrune(PairFilter filter)
        : filter_(filter), bulk_(make_sweep_search(std::move(filter))) {}

    void restart(std::span<const Box3> boxes, PairList& list) override;
    void update(const BoxStep& step, PairList& list) override;

    /// Sorts the axes without searching pairs.
    void sort_axes(std::span<const Box3> boxes);
    /// Like `update`, but returns false if more than `most` ends would change places. The axes must
    /// then be sorted again before further use.
    bool try_update(const BoxStep& step, PairList& list, std::size_t most);

private:
    /// Where a box begins or ends on an axis.
    struct End {
        double at;
        std::uint32_t name; ///< box * 2, plus 1 for the upper end
        [[nodiscard]] std::uint32_t box() const { return name / 2; }
        [[nodiscard]] bool is_upper() const { return (name & 1) != 0; }
        /// At equal coordinates, lower ends come first, because boxes that touch overlap.
        [[nodiscard]] bool before(const End& other) const {
            return at != other.at ? at < other.at : !is_upper() && other.is_upper();
        }
    };

    [[nodiscard]] static End end_of(const Box3& box, std::uint32_t name, int axis);
    bool sort_axis(std::span<const Box3> boxes, int axis, std::size_t& moves_left);
    void compare(std::span<const Box3> boxes, std::uint32_t i, std::uint32_t k);

    PairFilter filter_;
    std::unique_ptr<PairSearch> bulk_;
    std::vector<End> ends_[3];
    std::vector<Box3> last_; ///< the boxes of the last step
    std::vector<IndexPair> begun_, ended_;
};

} // namespace abut
