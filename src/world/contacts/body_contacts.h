#pragma once

#include <abut/contacts.h>

#include "world/narrow_phase/narrow_phase.h"

#include <vector>

namespace abut {

/// Appends the contact manifolds of two bodies that are at most `margin` apart.
void append_contacts(const PlacedBody& a, const PlacedBody& b, const BodyPair& ids, double margin,
                     PairWarmStart& warm_start, std::vector<ContactManifold>& manifolds);

} // namespace abut
