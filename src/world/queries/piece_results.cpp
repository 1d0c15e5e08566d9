#include "world/queries/piece_results.h"

#include "math/vector.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace abut {

namespace {

/// Exchanges what a result says of a and of b.
void turn_round(BodyPair& pair) {
    std::swap(pair.a, pair.b);
}
template <typename Points>
void turn_points_round(Points& points) {
    std::swap(points.point_a, points.point_b);
    std::swap(points.triangle_a, points.triangle_b);
}
template <typename Result>
void turn_bodies_round(Result& result) {
    std::swap(result.a, result.b);
    std::swap(result.piece_a, result.piece_b);
}
void turn_round(BodyGap& gap) {
    turn_bodies_round(gap), turn_points_round(gap);
    gap.normal = -gap.normal;
}
void turn_round(BodyImpact& each) {
    turn_bodies_round(each), turn_points_round(each.impact);
    each.impact.normal = -each.impact.normal;
}
void turn_round(ContactManifold& manifold) {
    turn_bodies_round(manifold);
    std::swap(manifold.user_data_a, manifold.user_data_b);
    manifold.normal = -manifold.normal;
    for (ContactPoint& point : manifold.points)
        turn_points_round(point);
}

template <typename Result>
void turn_a_before_b(std::vector<Result>& results) {
    for (Result& each : results)
        if (each.b < each.a)
            turn_round(each);
}

template <typename Result>
void keep_first_of_pair(std::vector<Result>& results) {
    const auto same = [](const Result& p, const Result& q) { return p.a == q.a && p.b == q.b; };
    results.erase(std::unique(results.begin(), results.end(), same), results.end());
}

/// Sorts by pair, then by a rank within it.
template <typename Result, typename Rank>
void sort_by_pair(std::vector<Result>& results, const Rank& rank) {
    std::stable_sort(results.begin(), results.end(), [&](const Result& p, const Result& q) {
        const BodyPair of_p{p.a, p.b}, of_q{q.a, q.b};
        return of_p == of_q ? rank(p) < rank(q) : of_p < of_q;
    });
}

} // namespace

void unite_pieces(std::vector<BodyPair>& pairs) {
    turn_a_before_b(pairs);
    std::sort(pairs.begin(), pairs.end());
    keep_first_of_pair(pairs);
}

void unite_pieces(std::vector<BodyGap>& gaps) {
    turn_a_before_b(gaps);
    sort_by_pair(gaps,
                 [](const BodyGap& g) { return std::tuple(g.distance, g.piece_a, g.piece_b); });
    // A motion that parts two pieces need not part the others.
    for (std::size_t i = 1; i < gaps.size(); ++i)
        if (gaps[i].a == gaps[i - 1].a && gaps[i].b == gaps[i - 1].b && gaps[i].distance <= 0)
            gaps[i - 1].status = Status::bound_only;
    keep_first_of_pair(gaps);
}

void unite_pieces(std::vector<BodyImpact>& impacts) {
    turn_a_before_b(impacts);
    sort_by_pair(impacts, [](const BodyImpact& each) {
        return std::tuple(each.impact.time, each.piece_a, each.piece_b);
    });
    keep_first_of_pair(impacts);
}

void unite_pieces(std::vector<ContactManifold>& manifolds) {
    turn_a_before_b(manifolds);
    sort_by_pair(manifolds,
                 [](const ContactManifold& m) { return std::tuple(m.piece_a, m.piece_b); });
}

} // namespace abut
