#include <abut/convex.h>
#include <abut/error.h>

#include "convex/body/convex_data.h"
#include "convex/convex_query.h"
#include "convex/proof/certain_gap.h"
#include "convex/search/closest_points.h"
#include "core/arguments.h"
#include "math/transform.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

/// Two bodies under their transforms, and for each the level of its hulls that answers the query.
struct PlacedBodies {
    const ConvexData &a, &b;
    const Transform &world_from_a, &world_from_b;
    Roundings roundings;
    std::size_t level_a = 0, level_b = 0;

    [[nodiscard]] PolytopePair at(std::size_t of_a, std::size_t of_b) const {
        return {a.levels[of_a].polytope, world_from_a, b.levels[of_b].polytope, world_from_b};
    }
    /// Bounds by how much the distance of the hulls exceeds that of the bodies.
    [[nodiscard]] double deviation() const {
        if (level_a == 0 && level_b == 0)
            return 0;
        return stretch_of(world_from_a).most * a.levels[level_a].deviation +
               stretch_of(world_from_b).most * b.levels[level_b].deviation;
    }
};

/// The coarsest hull of a body whose deviation, once placed, is at most `error`.
std::size_t coarsest_within(const ConvexData& body, const Transform& world, double error) {
    const double most = stretch_of(world).most;
    std::size_t level = body.levels.size() - 1;
    while (level > 0 && !(most * body.levels[level].deviation <= error))
        --level;
    return level;
}

/// If the facing vertices have passed each other by more than this share of the way between the
/// centres, the polytopes are likely to meet, and GJK finds that sooner than a walk. With 0, poses
/// apart are a third slower.
constexpr double kDeep = 0.25;

/// Searches from the vertices that face each other along a direction.
void search_along(const PolytopePair& pair, const Vec3& direction, double rounding,
                  ClosestPointSearch& search) {
    const VertexPair start = facing_vertices(pair, direction);
    const Vec3 room = pair.b.vertex(start.b) - pair.a.vertex(start.a);
    if (dot(room, direction) < -kDeep * length_sq(direction)) {
        search.simplex.emplace();
        search.simplex->corners[0] = start;
        search.simplex->count = 1;
        find_closest_points_from_simplex(pair, rounding, search);
        return;
    }
    search.at.a = vertex_feature(start.a), search.at.b = vertex_feature(start.b);
    find_closest_points(pair, rounding, search);
}

/// Returns whether the bodies' inner balls meet. If so, a point between their centres lies in both.
bool balls_meet(const PlacedBodies& bodies, const PolytopePair& pair, const Vec3& between,
                WalkState& at) {
    const double radius_a = stretch_of(bodies.world_from_a).least * bodies.a.ball.radius,
                 radius_b = stretch_of(bodies.world_from_b).least * bodies.b.ball.radius;
    const double room = radius_a + radius_b - 4 * bodies.roundings.all;
    if (!(room > 0 && length_sq(between) < room * room))
        return false;
    at.point_a = pair.a.place(bodies.a.ball.middle) + radius_a / (radius_a + radius_b) * between;
    at.distance_sq = 0;
    at.end = WalkEnd::meeting;
    at.proven = true;
    return true;
}

/// Searches without a warm start. It begins on hulls that are small enough to walk on from
/// anywhere. Where these are closest, the tables of normals of the finer hulls give the start for
/// those. Returns whether `search.at` (or its simplex) refers to the hulls that are to answer; if
/// not, it refers to the entry hulls.
bool descend(const PlacedBodies& bodies, double rounding, ClosestPointSearch& search) {
    const std::size_t entry_a = std::max(bodies.a.entry, bodies.level_a),
                      entry_b = std::max(bodies.b.entry, bodies.level_b);
    const PolytopePair first = bodies.at(entry_a, entry_b);
    const Vec3 between = between_middles(bodies.a, bodies.b, first);
    if (balls_meet(bodies, first, between, search.at))
        return false;
    search_along(first, between, rounding, search);
    // The entry hulls lie inside the bodies: if they meet, so do the bodies.
    if (entry_a == bodies.level_a && entry_b == bodies.level_b)
        return true;
    if (search.at.end == WalkEnd::meeting)
        return false;
    search_along(bodies.at(bodies.level_a, bodies.level_b), search.at.gap, rounding, search);
    return true;
}

/// Sets the feature of the body that holds a feature of its triangulated surface.
void name(const ConvexData& body, const HullFeature& f, Feature& kind, std::uint32_t& id) {
    kind = f.kind;
    id = f.vertex;
    if (f.kind == Feature::edge)
        id = body.edge_number[f.edge];
    if (f.kind == Feature::face || id == kNoEdge) {
        kind = Feature::face;
        id = body.face_number[f.edge];
    }
}

void remember(const ClosestPointSearch& search, ConvexWarmStart& warm_start) {
    if (search.at.end == WalkEnd::meeting && search.simplex) {
        remember(*search.simplex, warm_start);
        return;
    }
    remember(search.at.a, search.at.b, warm_start);
}

/// Steps that a walk from the last query's end may take. A longer one means that the motion was
/// large.
constexpr std::uint32_t kSmallStep = 4;
/// A walk goes on if no two points are nearer than its distance less this many roundings, which is
/// about a hundredth of the bodies' size, and if the distance is not above four times that. Bodies
/// that slide on each other need it: where they are near, a search that begins anew is longer.
constexpr double kNearEnd = 0x1p43;

/// Continues from where the last query ended, or begins anew if that takes long. Returns as
/// `descend`.
bool go_on(const PlacedBodies& bodies, double rounding, const ConvexWarmStart& last,
           ClosestPointSearch& search) {
    const PolytopePair pair = bodies.at(bodies.level_a, bodies.level_b);
    if (has_simplex(last)) {
        search.simplex = recalled_simplex(pair, last);
        find_closest_points_from_simplex(pair, rounding, search);
        return true;
    }
    recall(pair, last, search.at.a, search.at.b);
    walk(pair, rounding, kSmallStep, search.at);
    const double near_end = kNearEnd * rounding;
    if (search.at.end == WalkEnd::limit && search.at.distance_sq <= 16 * near_end * near_end &&
        search.at.excess * search.at.excess <= near_end * near_end * search.at.distance_sq)
        walk(pair, rounding, 3 * kSmallStep, search.at);
    const bool ended = search.at.end == WalkEnd::closest || search.at.end == WalkEnd::meeting;
    return ended || descend(bodies, rounding, search);
}

/// Proves what the search has found, first by the direction across its features, then by looking at
/// all vertices; or replaces it by an answer in integers. The integers decide for the bodies
/// themselves, whatever error is allowed.
///
/// In          `bodies`: by value, so that the caller need not keep it in memory. `doubt`: what a
///             proven distance may lose to rounding. `is_at_level`: what `descend` returned.
/// Out         `is_decided`: the search now refers to the bodies' own polytopes.
[[gnu::noinline, gnu::cold]] CertainDistance settle(PlacedBodies bodies, double rounding,
                                                    double doubt, ClosestPointSearch& search,
                                                    bool is_at_level, bool& is_decided) {
    const PolytopePair pair = is_at_level ? bodies.at(bodies.level_a, bodies.level_b)
                                          : bodies.at(std::max(bodies.a.entry, bodies.level_a),
                                                      std::max(bodies.b.entry, bodies.level_b));
    is_decided = false;
    if (is_at_level && search.at.distance_sq > 4 * doubt * doubt &&
        bodies.a.outside + bodies.b.outside == 0 && is_proven_across(pair, rounding, search.at)) {
        const double distance = std::sqrt(search.at.distance_sq);
        return {distance, distance - doubt};
    }
    if (!search.simplex && surely_meet(pair, rounding, search.at))
        return {};
    const bool is_simplified = bodies.level_a + bodies.level_b > 0;
    if (search.at.end == WalkEnd::closest && is_simplified) {
        const DistanceBounds bounds = distance_bounds(pair, {}, {}, rounding, search.at);
        const double distance = std::sqrt(search.at.distance_sq);
        if (is_tight(bounds, distance, rounding))
            return {distance, std::min(bounds.certain, distance)};
    }
    if (!is_at_level || is_simplified) {
        // Begin anew: the search has numbers of other polytopes.
        search.at.a = search.at.b = {};
        search.at.end = WalkEnd::stuck;
        search.simplex.reset();
    }
    is_decided = true;
    return settle_gap({bodies.a, bodies.b, bodies.world_from_a, bodies.world_from_b}, rounding,
                      search);
}

} // namespace

ConvexGap distance(const Convex& a, const Transform& world_from_a, const Convex& b,
                   const Transform& world_from_b, const ConvexDistanceOptions& options) {
    PlacedBodies bodies{a.data(), b.data(), world_from_a, world_from_b,
                        roundings_of(a.data(), world_from_a, b.data(), world_from_b)};
    const auto [rounding, all_rounding] = bodies.roundings;
    require_not_negative(options.absolute_error, "absolute error");
    if (options.absolute_error > 0) {
        bodies.level_a = coarsest_within(bodies.a, world_from_a, options.absolute_error / 2);
        bodies.level_b = coarsest_within(bodies.b, world_from_b, options.absolute_error / 2);
    }
    ConvexWarmStart* const warm_start = options.warm_start;
    ClosestPointSearch search;
    bool worth_keeping = true;
    if (warm_start != nullptr && warm_start->kind != ConvexWarmStart::Kind::empty)
        worth_keeping = go_on(bodies, rounding, *warm_start, search);
    else
        worth_keeping = descend(bodies, rounding, search);
    // What the distance may lose to rounding of the search and of coordinates, and to the vertices
    // that the polytopes leave out.
    double doubt = 8 * rounding + all_rounding;
    if (bodies.a.outside + bodies.b.outside > 0)
        doubt += PlacedConvexPair{bodies.a, bodies.b, world_from_a, world_from_b}.outside();
    const bool is_proven = search.at.proven && (search.at.end == WalkEnd::meeting ||
                                                is_measurable(search.at.distance_sq, doubt));
    CertainDistance settled;
    if (!is_proven) {
        bool is_decided = false;
        settled = settle(bodies, rounding, doubt, search, worth_keeping, is_decided);
        if (is_decided)
            bodies.level_a = bodies.level_b = 0, worth_keeping = true;
    }
    if (warm_start != nullptr && worth_keeping)
        remember(search, *warm_start);
    else if (warm_start != nullptr)
        warm_start->kind = ConvexWarmStart::Kind::empty;

    ConvexGap gap;
    const WalkState& at = search.at;
    gap.counters = {at.feature_pairs, search.simplices};
    const Vec3 origin{world_from_a.m[9], world_from_a.m[10], world_from_a.m[11]};
    gap.point_a = origin + at.point_a;
    if (at.end == WalkEnd::meeting) {
        gap.distance = 0;
        gap.point_b = gap.point_a;
        return gap;
    }
    gap.point_b = origin + (at.point_a + at.gap);
    gap.distance = is_proven ? std::sqrt(at.distance_sq) : settled.distance;
    gap.at_least = is_proven ? gap.distance - doubt : settled.at_least;
    if (const double deviation = bodies.deviation(); deviation > 0) {
        gap.at_least = std::max(0.0, gap.at_least - deviation);
        gap.status = Status::converged;
        gap.id_a = bodies.a.levels[bodies.level_a].number[at.a.vertex];
        gap.id_b = bodies.b.levels[bodies.level_b].number[at.b.vertex];
        return gap;
    }
    name(bodies.a, at.a, gap.feature_a, gap.id_a);
    name(bodies.b, at.b, gap.feature_b, gap.id_b);
    return gap;
}

} // namespace abut
