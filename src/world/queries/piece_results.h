#pragma once

#include <abut/contacts.h>
#include <abut/world.h>

#include <vector>

namespace abut {

/// Queries find the results of pairs of pieces. These functions make them results of pairs of bodies:
/// with a before b, sorted by pair, one for each pair of bodies.

void unite_pieces(std::vector<BodyPair>& pairs);
/// Keeps the least distance of each pair.
void unite_pieces(std::vector<BodyGap>& gaps);
/// Keeps the earliest impact of each pair.
void unite_pieces(std::vector<BodyImpact>& impacts);
/// Keeps all manifolds, sorted by pieces within a pair.
void unite_pieces(std::vector<ContactManifold>& manifolds);

} // namespace abut
