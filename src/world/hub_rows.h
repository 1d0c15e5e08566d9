#pragma once

#include <abut/broad_phase.h>

#include "world/box_block.h"
#include "world/pair_list.h"
#include "world/pair_search.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The pairs of hubs: boxes that meet a large share of all others. They are tested against all boxes,
/// sixteen at a time, and kept as rows of bits in the order of the indices: so they need not be
/// sorted, and what begins and ends is where bits differ.
///
/// The row of a hub says which boxes of a higher index it meets; the row of any other box, which hubs
/// of a higher index.
class HubRows {
public:
    /// In          hubs: sorted; boxes: their number; pairs: of the last step, of which those with a
    ///             hub are taken over.
    void assign(std::vector<std::uint32_t> hubs, std::size_t boxes,
                std::span<const IndexPair> pairs);

    [[nodiscard]] const std::vector<std::uint32_t>& hubs() const { return hubs_; }
    /// How many boxes there are.
    [[nodiscard]] std::size_t size() const { return is_hub_.size(); }
    [[nodiscard]] bool has(IndexPair pair) const {
        return (is_hub_[pair.a()] | is_hub_[pair.b()]) != 0;
    }

    /// Brings the rows to this step; adds what begins and what ends to the lists, in any order.
    /// Cost        a SIMD test for 16 pairs of a hub, where one of them or the hub has changed.
    void update(const BoxStep& step, const PairFilter& wanted,
                std::vector<std::vector<IndexPair>>& begun,
                std::vector<std::vector<IndexPair>>& ended);

    /// All pairs, of hubs and others, sorted. In: others: sorted, without a hub.
    void write(std::span<const IndexPair> others, std::vector<IndexPair>& pairs) const;

private:
    static constexpr std::size_t kWidth = BoxBlock::kWidth;
    static constexpr std::size_t kBoxesOfTask = 512; ///< whose pairs one task writes

    /// Bits in rows, sixteen to a column.
    struct BitTable {
        std::size_t columns = 0;
        std::vector<std::uint16_t> bits{};
        void resize(std::size_t rows, std::size_t lanes) {
            columns = (lanes + kWidth - 1) / kWidth;
            bits.assign(rows * columns, 0);
        }
        void set(std::size_t row, std::size_t lane) {
            bits[row * columns + lane / kWidth] |= static_cast<std::uint16_t>(1U << lane % kWidth);
        }
        [[nodiscard]] std::span<const std::uint16_t> row(std::size_t row) const {
            return std::span(bits).subspan(row * columns, columns);
        }
    };
    class Comparison;

    [[nodiscard]] std::size_t rank_of(std::uint32_t hub) const;
    void fit(const BoxStep& step);
    IndexPair* write_row(std::uint32_t box, IndexPair* to) const;

    std::vector<std::uint32_t> hubs_;
    BoxMarks is_hub_;
    BitTable of_hubs_;                       ///< rows: hubs; lanes: boxes
    BitTable of_boxes_;                      ///< rows: boxes, those of hubs empty; lanes: hubs
    std::vector<std::size_t> pairs_of_task_; ///< of hubs
    NarrowFrame frame_;
    std::vector<BoxBlock> boxes_, hub_boxes_;    ///< in the order of their indices
    BoxMarks is_changed_, is_hub_block_changed_; ///< by block
    bool is_new_ = true;                         ///< boxes are yet to be fitted
};

} // namespace abut
