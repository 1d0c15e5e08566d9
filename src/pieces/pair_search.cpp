#include "pieces/pair_search.h"

#include "convex/convex_query.h"
#include "convex/hull/climb.h"
#include "core/stop.h"
#include "pieces/contact_proof.h"
#include "pieces/proven_room.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// Limit on measured feature pairs of two hulls that are not both pieces: these walks only give
/// bounds.
constexpr std::uint32_t kPatience = 24;

/// Hulls that overlap along a direction by more than this share of the smaller radius are opened at
/// once: few of them are apart.
constexpr double kDeep = 0.35;

/// Roundings by which a bound may lie below the distance of two pieces, the margin aside: 8 for a
/// proven walk, and 2 for the directions that prove other pairs.
constexpr double kTolerance = 10;

bool is_root(const BoundedPair& pair) {
    return pair.hulls == HullPair{};
}

/// A type, not a function, so that the heap's operations have it inlined.
struct Later {
    bool operator()(const BoundedPair& p, const BoundedPair& q) const { return p.bound > q.bound; }
};

void push(std::vector<BoundedPair>& heap, const BoundedPair& pair) {
    heap.push_back(pair);
    std::push_heap(heap.begin(), heap.end(), Later());
}

BoundedPair pop(std::vector<BoundedPair>& heap) {
    std::pop_heap(heap.begin(), heap.end(), Later());
    const BoundedPair pair = heap.back();
    heap.pop_back();
    return pair;
}

} // namespace

double PiecePairSearch::measure(const HullPair& hulls, const ClosestPointSearch& start) {
    ClosestPointSearch search;
    search.at.a = start.at.a, search.at.b = start.at.b;
    if (start.at.end == WalkEnd::meeting)
        search.simplex = start.simplex;
    const PolytopePair pair = placed_.hulls(hulls);
    ++counters_.hull_pairs;
    if (search.simplex)
        find_closest_points_from_simplex(pair, placed_.rounding, search);
    else
        find_closest_points(pair, placed_.rounding, search);
    return take(hulls, pair, search);
}

/// The lower bound of a distance that the end of a walk proves; 0 if it proves nothing.
double PiecePairSearch::bound_by_walk(const HullPair& hulls, const PolytopePair& pair,
                                      const WalkState& at, double distance) const {
    return (at.proven && is_measurable(at.distance_sq, placed_.rounding)) ||
                   is_proven_across(pair, placed_.rounding, at)
               ? std::max(0.0, distance - 8 * placed_.rounding - placed_.margin(hulls))
               : 0;
}

/// Records the result of a search on a pair of pieces. Returns a proven lower bound of the
/// distance.
double PiecePairSearch::take(const HullPair& hulls, const PolytopePair& pair,
                             const ClosestPointSearch& search) {
    counters_.feature_pairs += search.at.feature_pairs;
    counters_.simplices += search.simplices;
    if (search.at.end == WalkEnd::meeting) {
        best_ = {hulls, search, 0, 0, true, proves_contact(placed_, hulls, search)};
        return 0;
    }
    const double distance = std::sqrt(search.at.distance_sq);
    const double enough =
        std::min(distance, best_.distance) - kTolerance * placed_.rounding - placed_.margin(hulls);
    double at_least = bound_by_walk(hulls, pair, search.at, distance);
    if (at_least < enough) {
        at_least =
            std::max(at_least, proven_room_at(pair, search.at, placed_.a.reach, placed_.b.reach,
                                              placed_.margin(hulls), enough));
        if (at_least < enough)
            unresolved_ = std::min(unresolved_, at_least);
    }
    at_least = std::max(at_least, 0.0);
    if (distance < best_.distance || (first_ && distance <= best_.distance))
        best_ = {hulls, search, distance, at_least, true, false};
    return at_least;
}

bool PiecePairSearch::is_decided() const {
    if (best_.meet())
        return best_.proven;
    return at_least() > placed_.contact_zone() &&
           !(unresolved_ < best_.distance - std::max(slack_, kTolerance * placed_.rounding));
}

void PiecePairSearch::measure_pieces(BoundedPair& pair) {
    ClosestPointSearch search;
    search.at.a = pair.a, search.at.b = pair.b;
    ++counters_.hull_pairs;
    const PolytopePair hulls = placed_.hulls(pair.hulls);
    find_closest_points(hulls, placed_.rounding, search);
    pair.bound = std::max(pair.bound, take(pair.hulls, hulls, search));
    pair.a = search.at.a, pair.b = search.at.b;
}

void PiecePairSearch::measure_hulls(BoundedPair& pair, double floor) {
    WalkState state;
    state.a = pair.a, state.b = pair.b;
    ++counters_.hull_pairs;
    const PolytopePair hulls = placed_.hulls(pair.hulls);
    walk(hulls, placed_.rounding, kPatience, state);
    counters_.feature_pairs += state.feature_pairs;
    pair.a = state.a, pair.b = state.b;
    // If the walk ends early, the hulls most often meet, and are opened anyway.
    pair.bound = floor;
    pair.along = {};
    if (state.end == WalkEnd::closest) {
        const double distance = std::sqrt(state.distance_sq);
        double bound = bound_by_walk(pair.hulls, hulls, state, distance);
        if (bound == 0)
            bound = proven_room(hulls, state.gap, placed_.a.reach, placed_.b.reach,
                                placed_.margin(pair.hulls));
        pair.bound = std::max(floor, bound);
        pair.along = state.gap;
    }
}

/// Sets the features to the vertices that are farthest towards each other along a direction.
/// Returns how far apart the hulls are along it.
double PiecePairSearch::begin(BoundedPair& pair) {
    const PolytopePair hulls = placed_.hulls(pair.hulls);
    const Vec3 along = pair.along == Vec3{} ? placed_.between(pair.hulls) : pair.along;
    const double l = length(along);
    const auto [a, b] =
        l > 0 ? proven_farthest(hulls, along, placed_.a.reach, placed_.b.reach) : VertexPair{};
    pair.a = vertex_feature(a), pair.b = vertex_feature(b);
    pair.begun = true;
    ++counters_.directions;
    return l > 0
               ? dot(along, hulls.b.vertex(b) - hulls.a.vertex(a)) / l - placed_.margin(pair.hulls)
               : 0;
}

bool PiecePairSearch::may_meet(const HullPair& hulls, double room) {
    BoundedPair pair;
    pair.hulls = hulls;
    if (begin(pair) > room)
        return false;
    measure_hulls(pair, 0);
    return !(pair.bound > room);
}

void PiecePairSearch::measure(BoundedPair& pair, double floor) {
    if (placed_.are_pieces(pair.hulls)) {
        pair.bound = floor;
        measure_pieces(pair);
    } else {
        measure_hulls(pair, floor);
    }
}

/// Measures the pieces that own the closest vertices of the root hulls: they are often the closest
/// pieces, and give a good first bound.
void PiecePairSearch::jump(const BoundedPair& roots) {
    const HullPair pieces{placed_.a.tree.leaf_at[roots.a.vertex],
                          placed_.b.tree.leaf_at[roots.b.vertex]};
    BoundedPair pair;
    pair.hulls = pieces;
    pair.along = roots.along;
    begin(pair);
    measure_pieces(pair);
}

void PiecePairSearch::open(const BoundedPair& pair, PairFront& front, bool keep) {
    placed_.for_each_child(pair.hulls, [&](const HullPair& hulls) {
        ++counters_.sphere_pairs;
        const double gap = placed_.sphere_gap(hulls);
        const double bound = pair.bound > 0 ? std::max(pair.bound, gap) : gap;
        if (!keep && !matters(bound)) {
            at_least_ = std::min(at_least_, bound);
            return;
        }
        BoundedPair child;
        child.hulls = hulls;
        child.along = pair.along;
        child.bound = front.drift + bound;
        push(front.heap, child);
    });
}

void PiecePairSearch::run(PairFront& front, bool keep) {
    const bool fresh = front.heap.empty();
    const std::uint64_t before = counters_.hull_pairs;
    if (fresh) {
        front.drift = 0;
        push(front.heap, {});
    }
    front.settled.clear();
    SearchSteps steps;
    while (!front.heap.empty() && !ends()) {
        steps.take();
        const double floor = front.heap.front().bound - front.drift;
        if (!matters(floor))
            break;
        BoundedPair pair = pop(front.heap);
        if (best_.found && pair.hulls == best_.hulls) {
            pair.bound = std::max(floor, best_.at_least);
            pair.a = best_.search.at.a, pair.b = best_.search.at.b;
        } else if (const double apart = pair.begun ? 0 : begin(pair);
                   apart > std::max(floor, 0.0)) {
            // Other pairs may come first now.
            pair.bound = apart + front.drift;
            push(front.heap, pair);
            continue;
        } else if (!placed_.are_pieces(pair.hulls) &&
                   apart < -kDeep * placed_.smaller_radius(pair.hulls)) {
            pair.bound = std::max(floor, 0.0);
            pair.along = {};
        } else {
            measure(pair, std::max(floor, 0.0));
            if (is_root(pair) && !placed_.are_pieces(pair.hulls) && pair.bound > 0)
                jump(pair);
        }
        const bool open_it = matters(pair.bound) && !placed_.are_pieces(pair.hulls);
        if (open_it && !ends()) {
            open(pair, front, keep);
            continue;
        }
        at_least_ = std::min(at_least_, pair.bound);
        if (keep) {
            pair.bound += front.drift;
            front.settled.push_back(pair);
        }
    }
    if (!front.heap.empty())
        at_least_ = std::min(at_least_, std::max(0.0, front.heap.front().bound - front.drift));
    const std::uint64_t measured = counters_.hull_pairs - before;
    for (const BoundedPair& pair : front.settled)
        push(front.heap, pair);
    if (fresh)
        front.fresh_pairs = measured, front.fresh_size = front.heap.size();
    front.worn =
        measured > 2 * front.fresh_pairs + 8 || front.heap.size() > 16 * front.fresh_size + 64;
}

} // namespace abut
