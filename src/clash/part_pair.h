#pragma once

#include <abut/rigid.h>

#include "clash/block_list.h"
#include "clash/outer_contacts.h"
#include "rigid/pair/contacts.h"
#include "rigid/pair/placed_pair.h"

#include <cmath>
#include <functional>
#include <vector>

namespace abut {

/// The questions that classify_pair asks about two parts. Not thread-safe.
class PartPair {
public:
    /// In          a, b: they and all that they refer to must outlive the pair.
    PartPair(const ClashPart& a, const ClashPart& b) : a_(a), b_(b) {}
    PartPair(const PartPair&) = delete;
    PartPair& operator=(const PartPair&) = delete;
    virtual ~PartPair() = default;

    [[nodiscard]] BlockList& a() { return a_; }
    [[nodiscard]] BlockList& b() { return b_; }

    /// Calls take(contact) for each contact, in any order, with triangle indices of the whole
    /// meshes. Afterwards the solids of a part in blocks know the triangles in contact. Contacts with
    /// faces inside their own solid are left out, but for parts in blocks (OuterContacts).
    virtual void for_each_contact(const std::function<void(const Contact&)>& take) = 0;

    /// Returns the nearest points of the two surfaces. The distance is infinite if the search finds
    /// none nearer than `bound`. With an infinite bound, faces inside their own solid do not count
    /// (WorldSolid::boundary), but those of a part in blocks do: one part may lie in the other.
    [[nodiscard]] virtual Gap nearest(double bound) = 0;

private:
    BlockList a_, b_;
};

/// Two parts of one model each.
class WholePair final : public PartPair {
public:
    WholePair(const ClashPart& a, const ClashPart& b)
        : PartPair(a, b), placed_(*a.model, a.world_from_mesh, *b.model, b.world_from_mesh) {}

    void for_each_contact(const std::function<void(const Contact&)>& take) override {
        Counters counters;
        const std::vector<Contact> contacts = find_contacts(placed_, ContactMode::all, counters);
        if (contacts.empty())
            return;
        const OuterContacts outer(a().solid(), b().solid());
        const bool all = outer.are_all();
        for (const Contact& contact : contacts)
            if (all || outer.holds(contact.pair))
                take(contact);
    }
    [[nodiscard]] Gap nearest(double bound) override {
        // Nothing outside of a solid is nearest to a face inside, so solids are not examined for it.
        const bool may_contain = std::isinf(bound);
        const SolidBoundary* const of_a = may_contain ? a().solid().boundary() : nullptr;
        const SolidBoundary* const of_b = may_contain ? b().solid().boundary() : nullptr;
        if (of_a == nullptr && of_b == nullptr)
            return nearest_gap(placed_, bound * bound).gap;
        const PlacedPair outsides(
            of_a != nullptr ? of_a->model : *a().part().model, a().part().world_from_mesh,
            of_b != nullptr ? of_b->model : *b().part().model, b().part().world_from_mesh);
        Gap gap = nearest_gap(outsides, bound * bound).gap;
        if (of_a != nullptr)
            gap.triangle_a = of_a->source[gap.triangle_a];
        if (of_b != nullptr)
            gap.triangle_b = of_b->source[gap.triangle_b];
        return gap;
    }

private:
    PlacedPair placed_;
};

} // namespace abut
