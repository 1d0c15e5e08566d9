#include "massive/classify_pair.h"

#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_penetration.h"
#include "rigid/contacts.h"
#include "rigid/local_penetration.h"
#include "rigid/meeting.h"
#include "rigid/separating_plane.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace abut {

namespace {

/// Of either surface, at most, for the depth: docs/clash.md says how near that comes.
constexpr int kSamples = 200;

bool less(const Vec3& p, const Vec3& q) {
    return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
}

/// The world triangles, each by its least vertex, all sorted: equal for equal sets.
std::vector<Triangle> canonical_triangles(const ClashPart& part) {
    const Mesh& mesh = part.model.mesh();
    std::vector<Triangle> triangles;
    triangles.reserve(mesh.triangles.size());
    for (const auto& t : mesh.triangles) {
        Triangle w{apply(part.world_from_mesh, mesh.positions[t[0]]),
                   apply(part.world_from_mesh, mesh.positions[t[1]]),
                   apply(part.world_from_mesh, mesh.positions[t[2]])};
        std::sort(w.begin(), w.end(), less);
        triangles.push_back(w);
    }
    std::sort(triangles.begin(), triangles.end(), [](const Triangle& s, const Triangle& t) {
        return std::lexicographical_compare(s.begin(), s.end(), t.begin(), t.end(), less);
    });
    return triangles;
}

bool same_triangles(const ClashPart& a, const ClashPart& b) {
    return a.box == b.box && a.model.mesh().triangles.size() == b.model.mesh().triangles.size() &&
           canonical_triangles(a) == canonical_triangles(b);
}

/// Whether every component of `inner` lies inside `outer`. In: their surfaces do not meet.
bool lies_inside(const PlacedSolid& inner, const PlacedSolid& outer) {
    return std::all_of(inner.solid().components.begin(), inner.solid().components.end(),
                       [&](std::uint32_t triangle) {
                           const std::uint32_t v = inner.model().mesh().triangles[triangle][0];
                           return outer.winds_around(inner.world_vertex(v));
                       });
}

Clash touching(const PlacedSolid& a, const PlacedSolid& b, const Contact& contact) {
    const Triangle ta = a.world_triangle(contact.pair.a), tb = b.world_triangle(contact.pair.b);
    const ClosestPoints common = triangle_triangle_distance(ta, tb);
    Clash clash;
    clash.kind = ClashKind::touch;
    clash.point_a = common.a, clash.point_b = common.b;
    clash.direction = triangle_triangle_penetration(ta, tb).direction;
    return clash;
}

Clash classify_meeting(const ClashPart& a, const ClashPart& b, std::vector<Contact> contacts,
                       double touch) {
    // The order of the traversal depends on the hardware's lanes in nothing, but sorted is plainly
    // the same everywhere.
    std::sort(contacts.begin(), contacts.end(),
              [](const Contact& c, const Contact& d) { return c.pair < d.pair; });
    const PlacedSolid solid_a(a.model, a.model.data().solid(), a.world_from_mesh);
    const PlacedSolid solid_b(b.model, b.model.data().solid(), b.world_from_mesh);
    Clash clash = touching(solid_a, solid_b, contacts.front());
    clash.triangle_pairs = contacts.size();
    if (same_triangles(a, b)) {
        clash.kind = ClashKind::duplicate;
        clash.direction = {};
        return clash;
    }
    const Meeting meeting = examine_meeting(solid_a, solid_b, contacts);
    if (meeting.parting != Vec3{})
        clash.direction = meeting.parting;
    if (meeting.interpenetrate) {
        DepthSearch options;
        options.threshold = touch;
        options.accuracy_budget = kSamples;
        const LocalPenetration p = penetration_depth(solid_a, solid_b, contacts, options);
        // Not proven shallow enough: hard.
        clash.kind = touch == 0 || p.at_most > touch ? ClashKind::hard : ClashKind::touch;
        if (p.depth > 0) {
            clash.distance = -p.depth;
            clash.point_a = p.point_a, clash.point_b = p.point_b;
            clash.direction = p.direction;
        }
    }
    return clash;
}

std::optional<Clash> apart(const ClashPart& a, const ClashPart& b, const PlacedPair& pair,
                           double clearance) {
    Clash clash;
    const bool a_in_b = encloses(b.box, a.box);
    const bool b_in_a = encloses(a.box, b.box);
    bool contained = false;
    if (a_in_b || b_in_a) {
        const PlacedSolid solid_a(a.model, a.model.data().solid(), a.world_from_mesh);
        const PlacedSolid solid_b(b.model, b.model.data().solid(), b.world_from_mesh);
        contained =
            (a_in_b && lies_inside(solid_a, solid_b)) || (b_in_a && lies_inside(solid_b, solid_a));
    }
    if (!contained && clearance == 0)
        return std::nullopt;
    const Gap gap = distance(
        pair, {.upper_bound = contained ? std::numeric_limits<double>::infinity() : clearance});
    if (!contained && gap.status != Status::exact)
        return std::nullopt;
    clash.kind = contained ? ClashKind::contained : ClashKind::clearance;
    clash.distance = contained ? -gap.distance : gap.distance;
    clash.point_a = gap.point_a, clash.point_b = gap.point_b;
    const Vec3 away = normalized_or_zero(gap.point_b - gap.point_a);
    clash.direction = contained ? -away : away;
    return clash;
}

} // namespace

std::optional<Clash> classify_pair(const ClashPart& a, const ClashPart& b, double clearance,
                                   double touch) {
    if (far_apart(a.model.data(), a.world_from_mesh, b.model.data(), b.world_from_mesh, clearance))
        return std::nullopt;
    Counters counters;
    const PlacedPair pair(a.model, a.world_from_mesh, b.model, b.world_from_mesh);
    std::vector<Contact> contacts = find_contacts(pair, ContactMode::all, counters);
    return contacts.empty() ? apart(a, b, pair, clearance)
                            : classify_meeting(a, b, std::move(contacts), touch);
}

} // namespace abut
