#pragma once

#include "rigid/pair/contacts.h"
#include "rigid/penetration/contact_evidence.h"
#include "rigid/penetration/local_penetration.h"
#include "rigid/solid/placed_solid.h"
#include "tests/support/shapes.h"

#include <vector>

namespace abut::test {

/// A placed mesh with the data that tests of solids need.
struct Body {
    explicit Body(const Mesh& mesh, const Transform& world = {})
        : model(mesh), solid(examine_solid(mesh)), placed(model, solid, world) {}
    Body(const Body&) = delete;
    Body& operator=(const Body&) = delete;

    Model model;
    Solid solid;
    PlacedSolid placed;
};

struct Meeting {
    std::vector<Contact> contacts;
    bool go_in = false;       ///< the solids interpenetrate
    LocalPenetration depth{}; ///< computed only if go_in
};

inline Meeting meeting(const Body& a, const Body& b, const DepthSearch& options = {}) {
    Meeting m;
    Counters counters;
    m.contacts = find_contacts(
        PlacedPair(a.model, a.placed.model().world(), b.model, b.placed.model().world()),
        ContactMode::all, counters);
    if (m.contacts.empty())
        return m;
    m.go_in = examine_meeting(a.placed, b.placed, m.contacts).interpenetrate;
    if (m.go_in)
        m.depth = penetration_depth(a.placed, b.placed, m.contacts, options);
    return m;
}

} // namespace abut::test
