#include <abut/convex_pieces.h>

#include "core/stop.h"
#include "geometry/triangle_triangle_intersect.h"
#include "pieces/pieces_containment.h"
#include "pieces/pieces_query.h"
#include "pieces/placed_triangle.h"

#include <algorithm>

namespace abut {

namespace {

/// Finds all pairs of pieces that meet, or are so near that rounding may hide it.
class MeetingPieces {
public:
    MeetingPieces(const PlacedPieces& placed, PiecesContacts& contacts)
        : placed_(placed), contacts_(contacts) {}

    void find() {
        const double zone = placed_.contact_zone();
        std::vector<HullPair> pending{{0, 0}};
        SearchSteps steps;
        while (!pending.empty()) {
            steps.take();
            const HullPair pair = pending.back();
            pending.pop_back();
            ++contacts_.counters.sphere_pairs;
            if (placed_.sphere_gap(pair) > zone)
                continue;
            PiecePairSearch search(placed_, contacts_.counters);
            if (!placed_.are_pieces(pair)) {
                if (search.may_meet(pair, zone))
                    placed_.for_each_child(pair, [&](const HullPair& p) { pending.push_back(p); });
            } else if (search.measure(pair, {}) <= zone) {
                contacts_.pairs.push_back(
                    {placed_.node_a(pair.a).piece, placed_.node_b(pair.b).piece});
                proven_ = proven_ || search.best().proven;
            }
        }
    }
    /// Returns whether a pair found proves that the solids share a point.
    [[nodiscard]] bool proven() const { return proven_; }

private:
    const PlacedPieces& placed_;
    PiecesContacts& contacts_;
    bool proven_ = false;
};

/// Finds the triangles that meet. Each triangle is in one piece, so no pair occurs twice.
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

void sort_once(std::vector<PiecePair>& pairs) {
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

void find_all(const PlacedPieces& placed, bool triangles, PiecesContacts& contacts) {
    MeetingPieces pieces(placed, contacts);
    pieces.find();
    bool surfaces_meet = false;
    if (triangles || (!contacts.pairs.empty() && !pieces.proven())) {
        Contacts surfaces =
            collide(placed.a.model, placed.world_from_a, placed.b.model, placed.world_from_b,
                    {.mode = triangles ? ContactMode::all : ContactMode::first});
        surfaces_meet = surfaces.meet();
        for (const TrianglePair& t : surfaces.pairs)
            contacts.pairs.push_back({placed.a.piece_of[t.a], placed.b.piece_of[t.b]});
        if (triangles)
            contacts.triangles = std::move(surfaces.pairs);
    }
    // The hulls meet only to rounding, and the solids do not.
    if (!pieces.proven() && !surfaces_meet)
        contacts.pairs.clear();
    sort_once(contacts.pairs);
    contacts.contained = contacts.pairs.empty() && contained_point(placed).has_value();
}

void find_first(const PlacedPieces& placed, PiecesWarmStart* warm_start, PiecesContacts& contacts) {
    PiecesQuery query(placed, warm_start, contacts.counters);
    query.search().set_bound(0);
    query.search().stop_at_first();
    const bool found = query.run();
    if (!query.search().is_decided()) {
        if (const auto t = query.touching_triangles())
            contacts.pairs.push_back({placed.a.piece_of[t->a], placed.b.piece_of[t->b]});
        else
            contacts.contained = query.contained_point(0).has_value();
        return;
    }
    const HullPair& hulls = query.search().best().hulls;
    if (found)
        contacts.pairs.push_back({placed.node_a(hulls.a).piece, placed.node_b(hulls.b).piece});
    else
        contacts.contained = query.contained_point(query.search().at_least()).has_value();
}

} // namespace

PiecesContacts collide(const ConvexPieces& a, const Transform& world_from_a, const ConvexPieces& b,
                       const Transform& world_from_b, const PiecesCollideOptions& options) {
    const StopScope stopping(options.progress);
    PiecesContacts contacts;
    const PlacedPieces placed(a.data(), world_from_a, b.data(), world_from_b);
    if (options.mode == ContactMode::all) {
        find_all(placed, options.triangles, contacts);
    } else {
        find_first(placed, options.warm_start, contacts);
        if (options.triangles)
            add_triangles(placed, contacts);
    }
    contacts.meet = contacts.contained || !contacts.pairs.empty();
    return contacts;
}

} // namespace abut
