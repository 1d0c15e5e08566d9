#pragma once

#include <abut/contacts.h>

#include "world/narrow_phase/narrow_phase.h"

#include <vector>

namespace abut {

/// Two bodies of a world.
struct BodiesInContact { // NOLINT(cppcoreguidelines-pro-type-member-init): has references
    PlacedBody a, b;
    PlacementPair placements;
};

/// Appends the contact manifolds of two bodies that are at most `margin` apart. Ids are not set. Those of a surface are
/// kept in the warm start, and appended again while both bodies stay.
void append_contacts(const BodiesInContact& bodies, double margin, PairWarmStart& warm_start,
                     std::vector<ContactManifold>& manifolds);

} // namespace abut
