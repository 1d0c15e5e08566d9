#pragma once

#include <abut/rigid.h>

#include "geometry/triangle_triangle_intersect.h"
#include "rigid/pair/placed_pair.h"

#include <vector>

namespace abut {

/// Two triangles that share a point, and how.
struct Contact {
    TrianglePair pair;
    TriangleContact kind = TriangleContact::none;
};

/// The contacts of two placed models, in the order of the traversal; or only the first one found.
///
/// In/out      steps: if given, limits the pairs of boxes that are opened. If they are used up,
///             contacts may be missing.
std::vector<Contact> find_contacts(const PlacedPair& pair, ContactMode mode, Counters& counters,
                                   SearchSteps* steps = nullptr);

Intersection common_points(const PlacedPair& pair, const TrianglePair& triangles);

} // namespace abut
