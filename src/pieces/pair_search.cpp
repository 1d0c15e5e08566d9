#include "pieces/pair_search.h"

#include "convex/climb.h"
#include "convex/convex_query.h"

#include <algorithm>

namespace abut {

namespace {

/// Pairs of features of two hulls of many pieces that are measured at most: these only bound.
constexpr std::uint32_t kPatience = 24;

/// Hulls that overlap along a direction by more than this share of the smaller's radius are opened
/// at once: few of them are apart.
constexpr double kDeep = 0.35;

/// Roundings by which a hull may hold less than what is below it, and some more.
constexpr double kMargin = 32;

bool is_root(const BoundedPair& pair) {
    return pair.hulls == HullPair{};
}

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

bool PiecePairSearch::try_pair(const HullPair& hulls, const ClosestPointSearch& start) {
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
    counters_.feature_pairs += search.at.feature_pairs;
    counters_.simplices += search.simplices;
    const double distance =
        search.at.end == WalkEnd::meeting ? 0 : std::sqrt(search.at.distance_sq);
    if (distance < best_.distance || (first_ && distance <= best_.distance))
        best_ = {hulls, search, distance, true};
    return ends();
}

void PiecePairSearch::measure_pieces(BoundedPair& pair) {
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

void PiecePairSearch::measure_hulls(BoundedPair& pair, double floor) {
    WalkState state;
    state.a = pair.a, state.b = pair.b;
    ++counters_.hull_pairs;
    walk(placed_.hulls(pair.hulls), placed_.rounding, kPatience, state);
    counters_.feature_pairs += state.feature_pairs;
    pair.a = state.a, pair.b = state.b;
    // Where the walk ends early the hulls meet, mostly, and are opened anyway.
    pair.bound = floor;
    pair.along = {};
    if (state.end == WalkEnd::closest) {
        pair.bound = std::max(floor, std::sqrt(state.distance_sq) - kMargin * placed_.rounding);
        pair.along = state.gap;
    }
}

/// Sets the features to the vertices that are farthest towards each other in a direction. Returns
/// how far apart the hulls are along it.
double PiecePairSearch::begin(BoundedPair& pair) {
    const PolytopePair hulls = placed_.hulls(pair.hulls);
    const Vec3 along = pair.along == Vec3{} ? placed_.between(pair.hulls) : pair.along;
    const auto [a, b] = farthest(hulls, along);
    pair.a = vertex_feature(a), pair.b = vertex_feature(b);
    pair.begun = true;
    ++counters_.directions;
    const double l = length(along);
    return l > 0
               ? dot(along, hulls.b.vertex(b) - hulls.a.vertex(a)) / l - kMargin * placed_.rounding
               : 0;
}

bool PiecePairSearch::may_meet(const HullPair& hulls) {
    BoundedPair pair;
    pair.hulls = hulls;
    if (begin(pair) > 0)
        return false;
    measure_hulls(pair, 0);
    return !(pair.bound > 0);
}

void PiecePairSearch::measure(BoundedPair& pair, double floor) {
    placed_.are_pieces(pair.hulls) ? measure_pieces(pair) : measure_hulls(pair, floor);
}

/// To the pieces that have the closest vertices of the whole: they are the closest pieces, often,
/// and never far from it.
void PiecePairSearch::jump(const BoundedPair& roots) {
    const HullPair pieces{placed_.a.tree.leaf_at[roots.a.vertex],
                          placed_.b.tree.leaf_at[roots.b.vertex]};
    BoundedPair pair;
    pair.hulls = pieces;
    pair.along = roots.along;
    begin(pair);
    measure_pieces(pair);
}

void PiecePairSearch::open(const BoundedPair& pair, PairFront& front) {
    placed_.for_each_child(pair.hulls, [&](const HullPair& hulls) {
        ++counters_.sphere_pairs;
        BoundedPair child;
        child.hulls = hulls;
        child.along = pair.along;
        const double gap = placed_.sphere_gap(hulls);
        child.bound = front.drift + (pair.bound > 0 ? std::max(pair.bound, gap) : gap);
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
    while (!front.heap.empty() && !ends()) {
        const double floor = front.heap.front().bound - front.drift;
        if (!matters(floor))
            break;
        BoundedPair pair = pop(front.heap);
        if (best_.found && pair.hulls == best_.hulls) {
            pair.bound = best_.distance;
            pair.a = best_.search.at.a, pair.b = best_.search.at.b;
        } else if (const double apart = pair.begun ? 0 : begin(pair);
                   apart > std::max(floor, 0.0)) {
            // The others may come first now.
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
            open(pair, front);
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
