#include "pieces/pair_search.h"

#include "convex/convex_query.h"

#include <algorithm>

namespace abut {

namespace {

/// Pairs of features of two hulls of many pieces that are measured at most: these only bound.
constexpr std::uint32_t kPatience = 24;

bool later(const BoundedPair& p, const BoundedPair& q) {
    return p.bound > q.bound;
}

void push(std::vector<BoundedPair>& heap, const BoundedPair& pair) {
    heap.push_back(pair);
    std::push_heap(heap.begin(), heap.end(), later);
}

BoundedPair pop(std::vector<BoundedPair>& heap) {
    std::pop_heap(heap.begin(), heap.end(), later);
    const BoundedPair pair = heap.back();
    heap.pop_back();
    return pair;
}

} // namespace

bool PairSearch::try_pair(const HullPair& hulls, const ClosestPointSearch& start) {
    ClosestPointSearch search = start;
    const PolytopePair pair = placed_.hulls(hulls);
    ++counters_.hull_pairs;
    if (search.simplex)
        find_closest_points_from_simplex(pair, placed_.rounding, search);
    else
        find_closest_points(pair, placed_.rounding, search);
    counters_.feature_pairs += search.at.feature_pairs;
    counters_.simplices += search.simplices;
    const double distance =
        search.at.end == WalkEnd::meeting ? 0 : std::sqrt(search.at.distance_sq);
    if (distance < best_.distance || (first_ && distance <= best_.distance))
        best_ = {hulls, search, distance, true};
    return ends();
}

void PairSearch::measure_pieces(BoundedPair& pair) {
    ClosestPointSearch search;
    search.at.a = pair.a, search.at.b = pair.b;
    ++counters_.hull_pairs;
    find_closest_points(placed_.hulls(pair.hulls), placed_.rounding, search);
    counters_.feature_pairs += search.at.feature_pairs;
    counters_.simplices += search.simplices;
    const bool meet = search.at.end == WalkEnd::meeting;
    pair.bound = meet ? 0 : std::sqrt(search.at.distance_sq);
    pair.a = search.at.a, pair.b = search.at.b;
    if (pair.bound < best_.distance || (first_ && pair.bound <= best_.distance))
        best_ = {pair.hulls, search, pair.bound, true};
}

void PairSearch::measure_hulls(BoundedPair& pair, double floor) {
    WalkState state;
    state.a = pair.a, state.b = pair.b;
    ++counters_.hull_pairs;
    walk(placed_.hulls(pair.hulls), placed_.rounding, kPatience, state);
    counters_.feature_pairs += state.feature_pairs;
    pair.a = state.a, pair.b = state.b;
    // Where the walk ends early the hulls meet, mostly, and are opened anyway.
    pair.bound = state.end == WalkEnd::closest
                     ? std::max(floor, std::sqrt(state.distance_sq) - 4 * placed_.rounding)
                     : floor;
}

/// At the vertices that face each other.
void PairSearch::begin(BoundedPair& pair) const {
    const PolytopePair hulls = placed_.hulls(pair.hulls);
    const VertexPair start = facing_vertices(hulls, placed_.between(pair.hulls));
    pair.a = vertex_feature(start.a), pair.b = vertex_feature(start.b);
    pair.measured = true;
}

bool PairSearch::may_meet(const HullPair& hulls) {
    BoundedPair pair;
    pair.hulls = hulls;
    begin(pair);
    measure_hulls(pair, 0);
    return !(pair.bound > 0);
}

void PairSearch::measure(BoundedPair& pair, double floor) {
    if (!pair.measured)
        begin(pair);
    placed_.are_pieces(pair.hulls) ? measure_pieces(pair) : measure_hulls(pair, floor);
}

void PairSearch::open(const BoundedPair& pair, PairFront& front) {
    placed_.for_each_child(pair.hulls, [&](const HullPair& hulls) {
        ++counters_.sphere_pairs;
        BoundedPair child;
        child.hulls = hulls;
        child.bound = front.drift + std::max(pair.bound, placed_.sphere_gap(hulls));
        push(front.heap, child);
    });
}

void PairSearch::run(PairFront& front, bool keep) {
    const bool fresh = front.heap.empty();
    const std::uint64_t before = counters_.hull_pairs;
    if (fresh) {
        front.drift = 0;
        push(front.heap, {});
    }
    std::vector<BoundedPair> settled; ///< measured now, and not of interest
    while (!front.heap.empty() && !ends()) {
        const double floor = front.heap.front().bound - front.drift;
        if (!matters(floor))
            break;
        BoundedPair pair = pop(front.heap);
        measure(pair, std::max(floor, 0.0));
        const bool open_it = matters(pair.bound) && !placed_.are_pieces(pair.hulls);
        if (open_it && !ends()) {
            open(pair, front);
            continue;
        }
        at_least_ = std::min(at_least_, pair.bound);
        if (keep) {
            pair.bound += front.drift;
            settled.push_back(pair);
        }
    }
    if (!front.heap.empty())
        at_least_ = std::min(at_least_, std::max(0.0, front.heap.front().bound - front.drift));
    const std::uint64_t measured = counters_.hull_pairs - before;
    for (const BoundedPair& pair : settled)
        push(front.heap, pair);
    if (fresh)
        front.fresh_pairs = measured;
    front.worn = !fresh && measured > 2 * front.fresh_pairs + 8;
}

} // namespace abut
