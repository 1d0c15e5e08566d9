#pragma once

#include <abut/contacts.h>

#include "world/narrow_phase/narrow_phase.h"

#include <vector>

namespace abut {

/// Two bodies of a world.
struct BodiesInContact { // NOLINT(cppcoreguidelines-pro-type-member-init): has references
    PlacedBody a, b;
    BodyPair ids;
    PlacementPair placements;
    bool at_rest = false; ///< neither body has moved since the last query of the world's contacts
};

/// Appends the contact manifolds of two bodies that are at most `margin` apart. The manifolds of
/// two surfaces at rest are kept in the warm start, and appended again while both stay.
void append_contacts(const BodiesInContact& bodies, double margin, PairWarmStart& warm_start,
                     std::vector<ContactManifold>& manifolds);

} // namespace abut
