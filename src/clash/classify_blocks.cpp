#include "clash/classify_blocks.h"

#include "clash/block_list.h"
#include "clash/pair_verdict.h"
#include "clash/same_triangles.h"
#include "rigid/pair/contacts.h"
#include "rigid/pair/separating_plane.h"
#include "rigid/solid/placed_solid.h"

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

class BlocksPair {
    // Defined before its uses, because its return type is deduced.
    /// Calls ask(a, b) with both parts as solids.
    template <typename Ask>
    auto with_solids(const Ask& ask) {
        const auto whole = [](const ClashPart& part) {
            return PlacedSolid(*part.model, part.model->data().solid(), part.world_from_mesh);
        };
        if (a_.placed() == nullptr)
            return ask(whole(a_.part()), *b_.placed());
        if (b_.placed() == nullptr)
            return ask(*a_.placed(), whole(b_.part()));
        return ask(*a_.placed(), *b_.placed());
    }

public:
    BlocksPair(const ClashPart& a, const ClashPart& b) : a_(a), b_(b) {}

    std::optional<Clash> classify(double clearance, double touch) {
        // Duplicates have too many contacts to keep them in memory.
        if (same_triangles(a_.part(), b_.part()) && a_.triangles() > 0)
            return duplicate();
        std::vector<Contact> contacts;
        for_each_contact([&](const Contact& contact) { contacts.push_back(contact); });
        if (contacts.empty())
            return apart(clearance);
        std::sort(contacts.begin(), contacts.end(),
                  [](const Contact& c, const Contact& d) { return c.pair < d.pair; });
        return with_solids([&](const WorldSolid& a, const WorldSolid& b) {
            return meeting_clash(a, b, contacts, touch);
        });
    }

private:
    using Held = BlockList::Held;

    /// Calls take(contact) for each contact, with triangle indices of the whole meshes. Afterwards
    /// both parts know which block holds each triangle in contact.
    template <typename Take>
    void for_each_contact(const Take& take) {
        TriangleNames names_a, names_b;
        Counters counters;
        for (std::size_t i = 0; i < a_.size(); ++i) {
            if (is_empty(a_.box(i)) || !overlap(a_.box(i), b_.part().box))
                continue;
            const Held of_a = a_.hold(i);
            for (std::size_t j = 0; j < b_.size(); ++j) {
                if (is_empty(b_.box(j)) || !overlap(a_.box(i), b_.box(j)))
                    continue;
                const Held of_b = b_.hold(j);
                if (are_far_apart(of_a, of_b, 0))
                    continue;
                for (Contact contact :
                     find_contacts(placed(of_a, of_b), ContactMode::all, counters)) {
                    TrianglePair& pair = contact.pair;
                    const TrianglePair local = pair;
                    pair = {of_a.number(local.a), of_b.number(local.b)};
                    names_a.add(pair.a, PlacedBlocks::name(i, local.a));
                    names_b.add(pair.b, PlacedBlocks::name(j, local.b));
                    take(contact);
                }
            }
        }
        if (a_.placed() != nullptr)
            a_.placed()->set_known(names_a.take());
        if (b_.placed() != nullptr)
            b_.placed()->set_known(names_b.take());
    }

    [[nodiscard]] bool are_far_apart(const Held& a, const Held& b, double gap) const {
        return far_apart(a.model->data(), a_.part().world_from_mesh, b.model->data(),
                         b_.part().world_from_mesh, gap);
    }
    [[nodiscard]] PlacedPair placed(const Held& a, const Held& b) const {
        return {*a.model, a_.part().world_from_mesh, *b.model, b_.part().world_from_mesh};
    }

    Clash duplicate() {
        std::uint64_t count = 0;
        Contact first;
        for_each_contact([&](const Contact& contact) {
            if (count++ == 0 || contact.pair < first.pair)
                first = contact;
        });
        Clash clash = with_solids([&](const WorldSolid& a, const WorldSolid& b) {
            return touch_clash(a, b, first.pair);
        });
        clash.kind = ClashKind::duplicate;
        clash.direction = {};
        clash.triangle_pairs = count;
        return clash;
    }

    std::optional<Clash> apart(double clearance) {
        const bool a_in_b = encloses(b_.part().box, a_.part().box);
        const bool b_in_a = encloses(a_.part().box, b_.part().box);
        const bool contained =
            (a_in_b || b_in_a) && with_solids([&](const WorldSolid& a, const WorldSolid& b) {
                return (a_in_b && lies_inside(a, b)) || (b_in_a && lies_inside(b, a));
            });
        if (!contained && clearance == 0)
            return std::nullopt;
        const MeasuredGap nearest = nearest_within(
            contained ? std::numeric_limits<double>::infinity() : clearance * clearance);
        if (!contained && (std::isinf(nearest.measured_sq) || nearest.gap.distance >= clearance))
            return std::nullopt;
        return apart_clash(nearest.gap, contained);
    }

    /// Returns the gap of the whole models, which is the least over all pairs of blocks. Pairs with
    /// the nearest boxes are tested first.
    MeasuredGap nearest_within(double bound_sq) {
        struct BlockPair {
            double least_sq;
            std::uint32_t i, j;
        };
        double reach_sq = bound_sq;
        for_each_pair([&](std::size_t i, std::size_t j) {
            reach_sq = std::min(reach_sq, largest_distance_sq(a_.box(i), b_.box(j)));
        });
        std::vector<BlockPair> pairs;
        for_each_pair([&](std::size_t i, std::size_t j) {
            const double least_sq = least_distance_sq(a_.box(i), b_.box(j));
            if (least_sq <= reach_sq)
                pairs.push_back(
                    {least_sq, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
        });
        std::sort(pairs.begin(), pairs.end(), [](const BlockPair& p, const BlockPair& q) {
            return std::tie(p.least_sq, p.i, p.j) < std::tie(q.least_sq, q.i, q.j);
        });
        MeasuredGap best;
        for (const BlockPair& pair : pairs) {
            if (pair.least_sq > bound_sq)
                break;
            const Held of_a = a_.hold(pair.i), of_b = b_.hold(pair.j);
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
        return best;
    }

    static bool is_before(const MeasuredGap& x, const MeasuredGap& y) {
        const auto key = [](const MeasuredGap& g) {
            return std::tuple(g.measured_sq, g.gap.triangle_a, g.gap.triangle_b);
        };
        return key(x) < key(y);
    }

    template <typename Visit>
    void for_each_pair(const Visit& visit) const {
        for (std::size_t i = 0; i < a_.size(); ++i)
            for (std::size_t j = 0; j < b_.size(); ++j)
                if (!is_empty(a_.box(i)) && !is_empty(b_.box(j)))
                    visit(i, j);
    }

    BlockList a_, b_;
};

} // namespace

std::optional<Clash> classify_blocks(const ClashPart& a, const ClashPart& b, double clearance,
                                     double touch) {
    return BlocksPair(a, b).classify(clearance, touch);
}

} // namespace abut
