#pragma once

#include <abut/contacts.h>

#include "world/narrow_phase/narrow_phase.h"

#include <span>
#include <vector>

namespace abut {

/// Appends the walls that a ball or a capsule touches. They keep the numbers of those of the last query
/// that are nearest.
void append_walls(std::span<const ContactManifold> walls, RegionsOfPair& last,
                  std::vector<ContactManifold>& manifolds);

} // namespace abut
