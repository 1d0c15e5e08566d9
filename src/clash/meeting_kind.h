#pragma once

#include <abut/clash.h>

#include "clash/part_pair.h"
#include "rigid/pair/contacts.h"
#include "rigid/penetration/contact_evidence.h"
#include "rigid/penetration/local_penetration.h"
#include "rigid/tolerance/reach_search.h"

#include <span>

namespace abut {

/// The kind of two parts whose surfaces meet, and how deep they go into each other.
struct MeetingKind {
    ClashKind kind = ClashKind::touch; ///< `touch`, `hard` or `undecided`
    LocalPenetration penetration;      ///< depth 0 if they only touch
};

/// Decides the kind of two parts that have contacts. docs/clash.md defines the kinds.
///
/// In          contacts: all, sorted; not empty. `meeting`: of these contacts. `touch`: metres, not
///             negative.
/// Accuracy    `touch` and `hard` are proven: where a length differs from `touch` by less than
///             rounding, it counts as `touch`. `undecided` if the budget of the proof is used up.
MeetingKind meeting_kind(PartPair& pair, std::span<const Contact> contacts, const Meeting& meeting,
                         double touch);

/// As above, for parts without contacts of which some components lie inside the other part.
///
/// In          point: of such a component.
MeetingKind kind_of_partly_inside(PartPair& pair, const Vec3& point, double touch);

/// Returns whether each surface is proven to be everywhere within `touch` of the other one; also
/// `open`, if neither that nor the opposite could be proven. In: `touch` is positive.
Proof are_duplicates(PartPair& pair, double touch);

} // namespace abut
