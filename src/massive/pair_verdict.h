#pragma once

#include <abut/clash.h>
#include <abut/rigid.h>

#include "rigid/contacts.h"
#include "rigid/world_solid.h"

#include <vector>

namespace abut {

/// Two surfaces that share a point of two triangles.
Clash touch_clash(const WorldSolid& a, const WorldSolid& b, const TrianglePair& first);

/// What two parts are that meet and are no duplicates: `hard` or `touch`.
///
/// In          all contacts, at least one, sorted; touch: metres.
Clash meeting_clash(const WorldSolid& a, const WorldSolid& b, const std::vector<Contact>& contacts,
                    double touch);

/// Whether every component of `inner` lies inside `outer`. In: their surfaces do not meet.
bool lies_inside(const WorldSolid& inner, const WorldSolid& outer);

/// What two parts are that do not meet: `contained`, or `clearance`.
Clash apart_clash(const Gap& gap, bool contained);

} // namespace abut
