#include "clash/classify_pair.h"

#include "clash/classify_blocks.h"
#include "clash/pair_verdict.h"
#include "clash/same_triangles.h"
#include "rigid/pair/contacts.h"
#include "rigid/pair/separating_plane.h"
#include "rigid/solid/placed_solid.h"

#include <algorithm>
#include <limits>

namespace abut {

namespace {

PlacedSolid solid_of(const ClashPart& part) {
    return {*part.model, part.model->data().solid(), part.world_from_mesh};
}

Clash classify_meeting(const ClashPart& a, const ClashPart& b, std::vector<Contact> contacts,
                       double touch) {
    // Sorted, so that the order visibly does not depend on the SIMD width.
    std::sort(contacts.begin(), contacts.end(),
              [](const Contact& c, const Contact& d) { return c.pair < d.pair; });
    const PlacedSolid solid_a = solid_of(a), solid_b = solid_of(b);
    if (!same_triangles(a, b))
        return meeting_clash(solid_a, solid_b, contacts, touch);
    Clash clash = touch_clash(solid_a, solid_b, contacts.front().pair);
    clash.kind = ClashKind::duplicate;
    clash.direction = {};
    clash.triangle_pairs = contacts.size();
    return clash;
}

std::optional<Clash> classify_apart(const ClashPart& a, const ClashPart& b, const PlacedPair& pair,
                                    double clearance) {
    const bool a_in_b = encloses(b.box, a.box);
    const bool b_in_a = encloses(a.box, b.box);
    bool contained = false;
    if (a_in_b || b_in_a) {
        const PlacedSolid solid_a = solid_of(a), solid_b = solid_of(b);
        contained =
            (a_in_b && lies_inside(solid_a, solid_b)) || (b_in_a && lies_inside(solid_b, solid_a));
    }
    if (!contained && clearance == 0)
        return std::nullopt;
    const Gap gap = distance(
        pair, {.upper_bound = contained ? std::numeric_limits<double>::infinity() : clearance});
    if (!contained && gap.status != Status::exact)
        return std::nullopt;
    return apart_clash(gap, contained);
}

} // namespace

std::optional<Clash> classify_pair(const ClashPart& a, const ClashPart& b, double clearance,
                                   double touch) {
    if (a.blocks != nullptr || b.blocks != nullptr)
        return classify_blocks(a, b, clearance, touch);
    if (far_apart(a.model->data(), a.world_from_mesh, b.model->data(), b.world_from_mesh,
                  clearance))
        return std::nullopt;
    Counters counters;
    const PlacedPair pair(*a.model, a.world_from_mesh, *b.model, b.world_from_mesh);
    std::vector<Contact> contacts = find_contacts(pair, ContactMode::all, counters);
    return contacts.empty() ? classify_apart(a, b, pair, clearance)
                            : classify_meeting(a, b, std::move(contacts), touch);
}

} // namespace abut
