#include "rigid/manifold/meeting_regions.h"

#include "core/disjoint_sets.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>

namespace abut {

namespace {

/// Directions that differ by less belong to one part.
constexpr double kCosOfPart = 0.5;
/// If the mean of unit normals is at least this long, they are taken to differ little: most lie
/// within 30 degrees of the mean.
constexpr double kHardlyBent = 0.866;
/// By so much the unit normals of two parts must lean together: a quarter of what two walls at 60
/// degrees do.
constexpr double kLeastLean = 0.25;
constexpr std::size_t kMostParts = 6;

std::size_t mixed(std::uint64_t key) {
    key *= 0x9E3779B97F4A7C15U;
    return static_cast<std::size_t>(key ^ key >> 32U);
}

/// Meetings with similar normals.
struct NormalPart {
    Vec3 seed;                 ///< the direction that decides what belongs to it
    Vec3 normals_a, normals_b; ///< sums, weighted
    Vec3 moment;
    double weight = 0;
    [[nodiscard]] Vec3 centre() const { return (1 / weight) * moment; }
};

using NormalParts = std::array<NormalPart, kMostParts>;

std::size_t nearest_part(const NormalParts& parts, std::size_t count, const Vec3& normal) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < count; ++k)
        if (dot(parts[k].seed, normal) > dot(parts[best].seed, normal))
            best = k;
    return best;
}

/// Whether the sides' normals lean towards each other from one part to the other, on either side.
bool hollow_between(const NormalPart& p, const NormalPart& q) {
    const Vec3 apart = q.centre() - p.centre();
    const auto leans = [&](const Vec3& m, const Vec3& n) {
        return dot(apart, normalized_or_zero(n) - normalized_or_zero(m)) <
               -kLeastLean * length(apart);
    };
    return leans(p.normals_a, q.normals_a) || leans(p.normals_b, q.normals_b);
}

} // namespace

void MeetingRegions::sort_by_region(std::vector<TriangleMeeting>& meetings, std::uint32_t count) {
    next_.assign(count + 1, 0);
    for (const TriangleMeeting& m : meetings)
        ++next_[m.region + 1];
    std::partial_sum(next_.begin(), next_.end(), next_.begin());
    sorted_.resize(meetings.size());
    for (const TriangleMeeting& m : meetings)
        sorted_[next_[m.region]++] = m;
    meetings.swap(sorted_);
}

void MeetingRegions::begin_pass(std::size_t meetings) {
    // A table that was needed once for a huge pair is not kept.
    constexpr std::size_t kMostKept = std::size_t{1} << 16U;
    const std::size_t needed = std::bit_ceil(6 * meetings + 1);
    if (slots_.size() < needed || slots_.size() > std::max(needed, kMostKept))
        slots_ = std::vector<Slot>(needed), pass_ = 0;
    if (pass_ == std::numeric_limits<std::uint32_t>::max())
        std::fill(slots_.begin(), slots_.end(), Slot{}), pass_ = 0;
    ++pass_;
}

std::uint32_t MeetingRegions::first_with(std::uint64_t key, std::uint32_t meeting) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t i = mixed(key) & mask;; i = (i + 1) & mask) {
        Slot& slot = slots_[i];
        if (slot.used_in != pass_) {
            slot = {key, meeting, pass_};
            return meeting;
        }
        if (slot.key == key)
            return slot.meeting;
    }
}

std::uint32_t MeetingRegions::group(TriangleMeetings& meetings) {
    std::vector<TriangleMeeting>& all = meetings.all;
    const auto meeting = static_cast<std::uint32_t>(
        std::find_if(all.begin(), all.end(), [](const TriangleMeeting& m) { return m.is_gap(); }) -
        all.begin());
    DisjointSets sets(all.size());
    const auto connect = [&](std::uint32_t TrianglePair::*shared,
                             std::uint32_t TriangleMeeting::*differing, std::size_t count) {
        begin_pass(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint64_t key = std::uint64_t{all[i].pair.*shared} << 32U;
            for (const std::uint32_t v : meetings.faces[all[i].*differing].vertices) {
                const std::uint32_t j = first_with(key | v, i);
                // The root is the least member: of a set with pairs that meet, one of these.
                if (j != i && (i < meeting || sets.root(i) >= meeting || sets.root(j) >= meeting))
                    sets.unite(i, j);
            }
        }
    };
    const auto connect_all = [&](std::size_t count) {
        connect(&TrianglePair::a, &TriangleMeeting::face_b, count);
        connect(&TrianglePair::b, &TriangleMeeting::face_a, count);
    };
    if (meeting > 0)
        connect_all(meeting);
    if (meeting < all.size())
        connect_all(all.size());
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < all.size(); ++i) {
        const std::uint32_t root = sets.root(i); // the least member: it has its region already
        all[i].region = root == i ? count++ : all[root].region;
    }
    if (count > 1)
        sort_by_region(all, count);
    return count;
}

std::uint32_t split_where_hollow(std::span<const TriangleMeeting> region,
                                 std::vector<std::uint32_t>& part) {
    part.assign(region.size(), 0);
    Vec3 sum_a, sum_b;
    double total = 0;
    for (const TriangleMeeting& m : region) {
        sum_a = sum_a + m.weight * m.normal_a, sum_b = sum_b + m.weight * m.normal_b;
        total += m.weight;
    }
    const bool by_a = length_sq(sum_a) >= length_sq(sum_b);
    if (!(total > 0) || length(by_a ? sum_a : sum_b) >= kHardlyBent * total)
        return 1;
    const auto normal = [by_a](const TriangleMeeting& m) { return by_a ? m.normal_a : m.normal_b; };
    NormalParts parts;
    std::size_t count = 0;
    for (int round = 0; round < 3; ++round) {
        for (std::size_t i = 0; i < region.size(); ++i) {
            const TriangleMeeting& m = region[i];
            std::size_t k = nearest_part(parts, count, normal(m));
            if (round == 0 && count < kMostParts && m.weight > 0 &&
                (count == 0 || dot(parts[k].seed, normal(m)) < kCosOfPart))
                k = count++, parts[k].seed = normal(m);
            part[i] = static_cast<std::uint32_t>(k);
        }
        for (NormalPart& p : parts)
            p = {p.seed, {}, {}, {}, 0};
        for (std::size_t i = 0; i < region.size(); ++i) {
            const TriangleMeeting& m = region[i];
            NormalPart& p = parts[part[i]];
            p.normals_a = p.normals_a + m.weight * m.normal_a;
            p.normals_b = p.normals_b + m.weight * m.normal_b;
            p.moment = p.moment + 0.5 * m.weight * (m.from + m.to);
            p.weight += m.weight;
        }
        for (NormalPart& p : parts)
            p.seed = normalized_or_zero(by_a ? p.normals_a : p.normals_b);
    }
    DisjointSets sets(count);
    for (std::uint32_t k = 0; k < count; ++k)
        for (std::uint32_t l = k + 1; l < count; ++l)
            if (!(parts[k].weight > 0) || !(parts[l].weight > 0) ||
                dot(parts[k].seed, parts[l].seed) > kCosOfPart ||
                !hollow_between(parts[k], parts[l]))
                sets.unite(k, l);
    std::array<std::uint32_t, kMostParts> number{};
    std::uint32_t regions = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t root = sets.root(k);
        number[k] = root == k ? regions++ : number[root];
    }
    for (std::uint32_t& p : part)
        p = number[p];
    return std::max(regions, 1U);
}

} // namespace abut
