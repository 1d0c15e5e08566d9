#pragma once

#include <abut/clash.h>
#include <abut/rigid.h>

#include "rigid/pair/contacts.h"
#include "rigid/solid/world_solid.h"

#include <vector>

namespace abut {

/// Returns a `touch` clash of two surfaces at a common point of a pair of triangles.
///
/// In          first: two triangles that share a point.
Clash touch_clash(const WorldSolid& a, const WorldSolid& b, const TrianglePair& first);

/// Returns the clash of two parts that meet and are not duplicates: `hard` or `touch`.
///
/// In          contacts: all of them, sorted, at least one; touch: metres.
Clash meeting_clash(const WorldSolid& a, const WorldSolid& b, const std::vector<Contact>& contacts,
                    double touch);

/// Whether every component of `inner` lies inside `outer`. Their surfaces must not meet.
bool lies_inside(const WorldSolid& inner, const WorldSolid& outer);

/// Returns the clash of two parts that do not meet: `contained` or `clearance`.
Clash apart_clash(const Gap& gap, bool contained);

} // namespace abut
