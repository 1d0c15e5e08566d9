#include <abut/convex_pieces.h>

#include "geometry/triangle_triangle_intersect.h"
#include "pieces/pieces_containment.h"
#include "pieces/pieces_query.h"

#include <algorithm>

namespace abut {

namespace {

/// All pairs of pieces that meet.
class MeetingPieces {
public:
    MeetingPieces(const PlacedPieces& placed, PiecesContacts& contacts)
        : placed_(placed), contacts_(contacts) {}

    void find() {
        std::vector<HullPair> pending{{0, 0}};
        while (!pending.empty()) {
            const HullPair pair = pending.back();
            pending.pop_back();
            ++contacts_.counters.sphere_pairs;
            if (placed_.sphere_gap(pair) > 0)
                continue;
            PiecePairSearch search(placed_, contacts_.counters);
            if (placed_.are_pieces(pair)) {
                if (search.try_pair(pair, {}))
                    contacts_.pairs.push_back(
                        {placed_.node_a(pair.a).piece, placed_.node_b(pair.b).piece});
            } else if (search.may_meet(pair)) {
                placed_.for_each_child(pair, [&](const HullPair& p) { pending.push_back(p); });
            }
        }
        std::sort(contacts_.pairs.begin(), contacts_.pairs.end());
    }

private:
    const PlacedPieces& placed_;
    PiecesContacts& contacts_;
};

struct PlacedTriangle {
    Triangle corners;
    Box3 box;
    std::uint32_t number = 0;
};

std::vector<PlacedTriangle> placed_triangles(const ConvexPiecesData& solid, std::uint32_t piece,
                                             const Transform& world) {
    std::vector<PlacedTriangle> result;
    for (const std::uint32_t t : solid.triangles_of(piece)) {
        PlacedTriangle& placed = result.emplace_back();
        placed.number = t;
        for (std::size_t k = 0; k < 3; ++k) {
            placed.corners[k] = apply(world, solid.mesh().positions[solid.mesh().triangles[t][k]]);
            extend(placed.box, placed.corners[k]);
        }
    }
    return result;
}

/// Each triangle is in one piece, so no pair comes twice.
void add_triangles(const PlacedPieces& placed, PiecesContacts& contacts) {
    std::vector<PlacedTriangle> of_a;
    std::uint32_t piece_a = 0xffffffffU;
    for (const PiecePair& pair : contacts.pairs) {
        if (pair.a != piece_a)
            of_a = placed_triangles(placed.a, pair.a, placed.world_from_a);
        piece_a = pair.a;
        const auto of_b = placed_triangles(placed.b, pair.b, placed.world_from_b);
        for (const PlacedTriangle& s : of_a)
            for (const PlacedTriangle& t : of_b)
                if (overlap(s.box, t.box) &&
                    triangle_triangle_intersect(s.corners, t.corners) != TriangleContact::none)
                    contacts.triangles.push_back({s.number, t.number});
    }
    std::sort(contacts.triangles.begin(), contacts.triangles.end());
}

} // namespace

PiecesContacts collide(const ConvexPieces& a, const Transform& world_from_a, const ConvexPieces& b,
                       const Transform& world_from_b, const PiecesCollideOptions& options) {
    PiecesContacts contacts;
    const PlacedPieces placed(a.data(), world_from_a, b.data(), world_from_b);
    if (options.mode == ContactMode::all) {
        MeetingPieces(placed, contacts).find();
        contacts.contained = contacts.pairs.empty() && contained_point(placed).has_value();
    } else {
        PiecesQuery query(placed, options.workspace, contacts.counters);
        query.search().set_bound(0);
        query.search().stop_at_first();
        if (query.run()) {
            const HullPair& hulls = query.search().best().hulls;
            contacts.pairs.push_back({placed.node_a(hulls.a).piece, placed.node_b(hulls.b).piece});
        } else {
            contacts.contained = query.contained_point(query.search().at_least()).has_value();
        }
    }
    contacts.meet = contacts.contained || !contacts.pairs.empty();
    if (options.triangles)
        add_triangles(placed, contacts);
    return contacts;
}

} // namespace abut
