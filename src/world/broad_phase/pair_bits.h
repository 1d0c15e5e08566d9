#pragma once

#include <abut/broad_phase.h>

#include "world/broad_phase/box_node.h"
#include "world/broad_phase/pair_list.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The hubs of a step: boxes that meet a large share of all others.
class HubSet {
public:
    HubSet() = default;
    /// In          hubs: sorted; boxes: the number of all boxes.
    HubSet(std::vector<std::uint32_t> hubs, std::size_t boxes);

    [[nodiscard]] const std::vector<std::uint32_t>& hubs() const { return hubs_; }
    /// The number of all boxes.
    [[nodiscard]] std::size_t boxes() const { return is_hub_.size(); }
    [[nodiscard]] bool contains(std::size_t box) const { return is_hub_[box] != 0; }
    /// Whether at least one of the two is a hub.
    [[nodiscard]] bool has(IndexPair pair) const {
        return contains(pair.a()) || contains(pair.b());
    }
    /// The number of hubs with a lower index than the box.
    [[nodiscard]] std::size_t rank_of(std::uint32_t box) const;

private:
    std::vector<std::uint32_t> hubs_;
    BoxMarks is_hub_;
};

/// Rows of bits. A column holds sixteen bits, as many as a node has boxes.
struct BitTable {
    static constexpr std::size_t kWidth = BoxNode::kWidth;
    std::size_t columns = 0;
    std::vector<std::uint16_t> bits{};

    /// Resizes the table and sets all bits to zero.
    void assign(std::size_t rows, std::size_t lanes);
    void set(std::size_t row, std::size_t lane) {
        bits[row * columns + lane / kWidth] |= static_cast<std::uint16_t>(1U << lane % kWidth);
    }
    [[nodiscard]] std::span<const std::uint16_t> row(std::size_t row) const {
        return std::span(bits).subspan(row * columns, columns);
    }
    [[nodiscard]] std::size_t count(std::size_t row) const;
};

/// The pairs that contain a hub, as bits. The row of a hub has bits for its partners with a higher
/// index. The row of any other box has bits for the hubs with a higher index among its partners.
/// Reading the rows in the order of the boxes therefore gives sorted pairs.
struct PairBits {
    BitTable of_hubs;                       ///< rows: hubs; lanes: boxes
    BitTable of_boxes;                      ///< rows: boxes, empty for hubs; lanes: hubs
    std::vector<std::size_t> pairs_of_part; ///< for each part of kBoxesOfPart boxes
    static constexpr std::size_t kBoxesOfPart = 64;

    /// Resizes the tables, without any pair.
    void assign(const HubSet& hubs);
    void insert(const HubSet& hubs, IndexPair pair);
    /// Counts the pairs of each part. Call it after bits have changed.
    void count(const HubSet& hubs);
    /// Writes all pairs, these merged with others, sorted. In: `others` are sorted and contain no
    /// hub; `count` has been called.
    ///
    /// Cost        linear in the pairs and in the words of bits, in parallel.
    void write(const HubSet& hubs, std::span<const IndexPair> others,
               std::vector<IndexPair>& pairs) const;

private:
    static constexpr std::size_t kPartsOfTask = 8;
    IndexPair* write_row(const HubSet& hubs, std::uint32_t box, IndexPair* to) const;
    void write_part(const HubSet& hubs, std::size_t part, std::span<const IndexPair> others,
                    IndexPair* to) const;
};

} // namespace abut
