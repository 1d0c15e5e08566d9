#include "world/broad_phase/pair_bits.h"

#include "core/parallel.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace abut {

namespace {

/// Writes the pairs of a box with the partners whose bits are set.
template <typename Partner>
IndexPair* write_bits(std::uint32_t box, std::uint32_t bits, const Partner& partner,
                      IndexPair* to) {
    const auto pair = [&](std::uint32_t lane) {
        return IndexPair::of_key(std::uint64_t{box} << 32 | partner(lane));
    };
    if (bits == BoxNode::kAllLanes) {
        for (std::uint32_t lane = 0; lane < BoxNode::kWidth; ++lane)
            to[lane] = pair(lane);
        return to + BoxNode::kWidth;
    }
    // Has no branch on the data: an entry that is no pair is overwritten. The last entry is a pair.
    for (std::uint32_t lane = 0; bits != 0; ++lane, bits >>= 1) {
        *to = pair(lane);
        to += bits & 1;
    }
    return to;
}

/// Merges `others` into sorted pairs in place. The result begins at `to`; the room before the pairs
/// is exactly large enough for the others.
void put_between(std::span<const IndexPair> others, std::span<IndexPair> pairs, IndexPair* to) {
    IndexPair* from = pairs.data();
    for (const IndexPair other : others) {
        // std::lower_bound without a branch on the data.
        IndexPair* next = from;
        for (std::ptrdiff_t left = pairs.data() + pairs.size() - from; left > 0;) {
            const std::ptrdiff_t half = (left + 1) / 2;
            next += half * static_cast<std::ptrdiff_t>(next[half - 1] < other);
            left -= half;
        }
        to = std::copy(from, next, to);
        *to++ = other;
        from = next;
    }
}

} // namespace

HubSet::HubSet(std::vector<std::uint32_t> hubs, std::size_t boxes)
    : hubs_(std::move(hubs)), is_hub_(boxes, 0) {
    for (const std::uint32_t hub : hubs_)
        is_hub_[hub] = 1;
}

std::size_t HubSet::rank_of(std::uint32_t box) const {
    return static_cast<std::size_t>(std::lower_bound(hubs_.begin(), hubs_.end(), box) -
                                    hubs_.begin());
}

void BitTable::assign(std::size_t rows, std::size_t lanes) {
    // Rounded up to whole 64-bit words for `count`.
    constexpr std::size_t kWord = 64;
    columns = (lanes + kWord - 1) / kWord * (kWord / kWidth);
    bits.assign(rows * columns, 0);
}

std::size_t BitTable::count(std::size_t row) const {
    int sum = 0;
    for (std::size_t i = row * columns; i < (row + 1) * columns; i += sizeof(std::uint64_t) / 2) {
        std::uint64_t word = 0;
        std::memcpy(&word, &bits[i], sizeof(word));
        sum += word == 0 ? 0 : std::popcount(word);
    }
    return static_cast<std::size_t>(sum);
}

void PairBits::assign(const HubSet& hubs) {
    of_hubs.assign(hubs.hubs().size(), hubs.boxes());
    of_boxes.assign(hubs.boxes(), hubs.hubs().size());
    pairs_of_part.assign((hubs.boxes() + kBoxesOfPart - 1) / kBoxesOfPart, 0);
}

void PairBits::insert(const HubSet& hubs, IndexPair pair) {
    if (hubs.contains(pair.a()))
        of_hubs.set(hubs.rank_of(pair.a()), pair.b());
    else
        of_boxes.set(pair.a(), hubs.rank_of(pair.b()));
}

IndexPair* PairBits::write_row(const HubSet& hubs, std::uint32_t box, IndexPair* to) const {
    constexpr auto kWidth = static_cast<std::uint32_t>(BitTable::kWidth);
    if (hubs.contains(box)) {
        const std::span<const std::uint16_t> row = of_hubs.row(hubs.rank_of(box));
        for (std::uint32_t column = box / kWidth; column < row.size(); ++column)
            to = write_bits(
                box, row[column], [&](std::uint32_t lane) { return column * kWidth + lane; }, to);
    } else {
        const std::span<const std::uint16_t> row = of_boxes.row(box);
        for (std::size_t column = 0; column < row.size(); ++column) {
            const std::uint32_t* const partners = hubs.hubs().data() + column * kWidth;
            to = write_bits(
                box, row[column], [&](std::uint32_t lane) { return partners[lane]; }, to);
        }
    }
    return to;
}

void PairBits::count(const HubSet& hubs) {
    parallel_for(pairs_of_part.size(), kPartsOfTask, [&](std::size_t part) {
        pairs_of_part[part] = 0;
        const std::size_t end = std::min((part + 1) * kBoxesOfPart, hubs.boxes());
        for (std::size_t box = part * kBoxesOfPart; box < end; ++box)
            pairs_of_part[part] +=
                hubs.contains(box) ? of_hubs.count(hubs.rank_of(static_cast<std::uint32_t>(box)))
                                   : of_boxes.count(box);
    });
}

void PairBits::write_part(const HubSet& hubs, std::size_t part, std::span<const IndexPair> others,
                          IndexPair* to) const {
    if (pairs_of_part[part] == 0) {
        std::copy(others.begin(), others.end(), to);
        return;
    }
    std::size_t other = 0;
    const std::size_t box_end = std::min((part + 1) * kBoxesOfPart, hubs.boxes());
    for (auto box = static_cast<std::uint32_t>(part * kBoxesOfPart); box < box_end; ++box) {
        std::size_t end = other;
        while (end < others.size() && others[end].a() == box)
            ++end;
        IndexPair* const from = to + (end - other);
        IndexPair* const row_end = write_row(hubs, box, from);
        put_between(others.subspan(other, end - other), {from, row_end}, to);
        other = end, to = row_end;
    }
}

void PairBits::write(const HubSet& hubs, std::span<const IndexPair> others,
                     std::vector<IndexPair>& pairs) const {
    const std::size_t parts = pairs_of_part.size();
    // The first entry of each part, and the end.
    std::vector<std::size_t> first_other(parts + 1, others.size()), first(parts + 1, 0);
    parallel_for(parts, kPartsOfTask, [&](std::size_t part) {
        const auto box = static_cast<std::uint32_t>(part * kBoxesOfPart);
        const auto at = std::lower_bound(others.begin(), others.end(), IndexPair(box, box));
        first_other[part] = static_cast<std::size_t>(at - others.begin());
    });
    for (std::size_t part = 0; part < parts; ++part)
        first[part + 1] =
            first[part] + pairs_of_part[part] + first_other[part + 1] - first_other[part];
    pairs.resize(first[parts]);
    parallel_for(parts, kPartsOfTask, [&](std::size_t part) {
        write_part(hubs, part,
                   others.subspan(first_other[part], first_other[part + 1] - first_other[part]),
                   pairs.data() + first[part]);
    });
}

} // namespace abut
