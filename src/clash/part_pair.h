#pragma once

#include <abut/rigid.h>

#include "clash/block_list.h"
#include "rigid/pair/contacts.h"
#include "rigid/pair/placed_pair.h"

#include <functional>

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
    /// faces inside their own solid are among them (OuterContacts).
    virtual void for_each_contact(const std::function<void(const Contact&)>& take) = 0;

    /// Returns the nearest points of the two surfaces. The distance is infinite if the search finds
    /// none nearer than `bound`. Faces inside their own solid count (nearest_outside).
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
        for (const Contact& contact : find_contacts(placed_, ContactMode::all, counters))
            take(contact);
    }
    [[nodiscard]] Gap nearest(double bound) override {
        return nearest_gap(placed_, bound * bound).gap;
    }

private:
    PlacedPair placed_;
};

} // namespace abut
