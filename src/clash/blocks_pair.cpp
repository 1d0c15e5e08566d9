#include "clash/blocks_pair.h"

#include "rigid/pair/separating_plane.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace abut {

namespace {

/// Lower bound of the squared distance between points of two boxes; rounding is accounted for.
double least_distance_sq(const Box3& a, const Box3& b) {
    constexpr double kSafe = 1 - 0x1p-40;
    return kSafe * length_sq(max(max(a.lower - b.upper, b.lower - a.upper), {0, 0, 0}));
}
/// Upper bound of the squared distance between points of two boxes.
double largest_distance_sq(const Box3& a, const Box3& b) {
    constexpr double kSafe = 1 + 0x1p-40;
    return kSafe * length_sq(max(a.upper - b.lower, b.upper - a.lower));
}

/// Collects which block holds which triangle. Duplicates are removed whenever the list has doubled.
class TriangleNames {
public:
    using Name = std::pair<std::uint32_t, std::uint32_t>; ///< index in whole mesh, name

    void add(std::uint32_t number, std::uint32_t name) {
        names_.emplace_back(number, name);
        if (names_.size() < most_)
            return;
        unite();
        most_ = std::max(most_, 2 * names_.size());
    }
    std::vector<Name> take() {
        unite();
        return std::move(names_);
    }

private:
    void unite() {
        std::sort(names_.begin(), names_.end());
        names_.erase(std::unique(names_.begin(), names_.end()), names_.end());
    }

    std::vector<Name> names_;
    std::size_t most_ = std::size_t{1} << 16;
};

/// Calls visit(i, j) for each pair of blocks that are not empty.
template <typename Visit>
void for_each_filled_pair(const BlockList& a, const BlockList& b, const Visit& visit) {
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j)
            if (!is_empty(a.box(i)) && !is_empty(b.box(j)))
                visit(i, j);
}

/// A pair of blocks, and a lower bound of their squared distance.
struct BlockPair {
    double least_sq;
    std::uint32_t i, j;
};

/// Returns the pairs of blocks that may be the nearest and within a bound, the nearest boxes first.
std::vector<BlockPair> pairs_within(const BlockList& a, const BlockList& b, double bound_sq) {
    for_each_filled_pair(a, b, [&](std::size_t i, std::size_t j) {
        bound_sq = std::min(bound_sq, largest_distance_sq(a.box(i), b.box(j)));
    });
    std::vector<BlockPair> pairs;
    for_each_filled_pair(a, b, [&](std::size_t i, std::size_t j) {
        const double least_sq = least_distance_sq(a.box(i), b.box(j));
        if (least_sq <= bound_sq)
            pairs.push_back(
                {least_sq, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
    });
    std::sort(pairs.begin(), pairs.end(), [](const BlockPair& p, const BlockPair& q) {
        return std::tie(p.least_sq, p.i, p.j) < std::tie(q.least_sq, q.i, q.j);
    });
    return pairs;
}

bool is_before(const MeasuredGap& x, const MeasuredGap& y) {
    const auto key = [](const MeasuredGap& g) {
        return std::tuple(g.measured_sq, g.gap.triangle_a, g.gap.triangle_b);
    };
    return key(x) < key(y);
}

} // namespace

void BlocksPair::for_each_contact(const std::function<void(const Contact&)>& take) {
    TriangleNames names_a, names_b;
    Counters counters;
    for (std::size_t i = 0; i < a().size(); ++i) {
        if (is_empty(a().box(i)) || !overlap(a().box(i), b().part().box))
            continue;
        const Held of_a = a().hold(i);
        for (std::size_t j = 0; j < b().size(); ++j) {
            if (is_empty(b().box(j)) || !overlap(a().box(i), b().box(j)))
                continue;
            const Held of_b = b().hold(j);
            if (are_far_apart(of_a, of_b, 0))
                continue;
            for (Contact contact : find_contacts(placed(of_a, of_b), ContactMode::all, counters)) {
                TrianglePair& pair = contact.pair;
                const TrianglePair local = pair;
                pair = {of_a.number(local.a), of_b.number(local.b)};
                names_a.add(pair.a, PlacedBlocks::name(i, local.a));
                names_b.add(pair.b, PlacedBlocks::name(j, local.b));
                take(contact);
            }
        }
    }
    if (a().placed() != nullptr)
        a().placed()->set_known(names_a.take());
    if (b().placed() != nullptr)
        b().placed()->set_known(names_b.take());
}

bool BlocksPair::are_far_apart(const Held& of_a, const Held& of_b, double gap) {
    return far_apart(of_a.model->data(), a().part().world_from_mesh, of_b.model->data(),
                     b().part().world_from_mesh, gap);
}

PlacedPair BlocksPair::placed(const Held& of_a, const Held& of_b) {
    return {*of_a.model, a().part().world_from_mesh, *of_b.model, b().part().world_from_mesh};
}

Gap BlocksPair::nearest(double bound) {
    double bound_sq = bound * bound;
    MeasuredGap best;
    for (const BlockPair& pair : pairs_within(a(), b(), bound_sq)) {
        if (pair.least_sq > bound_sq)
            break;
        const Held of_a = a().hold(pair.i), of_b = b().hold(pair.j);
        if (std::isfinite(bound_sq) &&
            are_far_apart(of_a, of_b, std::sqrt(bound_sq) * (1 + 0x1p-40)))
            continue;
        MeasuredGap found = nearest_gap(placed(of_a, of_b), bound_sq);
        if (std::isinf(found.measured_sq))
            continue;
        found.gap.triangle_a = of_a.number(found.gap.triangle_a);
        found.gap.triangle_b = of_b.number(found.gap.triangle_b);
        if (is_before(found, best))
            best = found;
        // A gap of equal length still counts if its triangles come first.
        bound_sq = std::nextafter(best.measured_sq, std::numeric_limits<double>::infinity());
    }
    return best.gap;
}

} // namespace abut
