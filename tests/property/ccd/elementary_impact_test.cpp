// Elementary impact tests of all kinds of pairs, checked against an exact oracle, against each
// other, and against the same pair written differently. Each test prints how many cases it has
// seen. ABUT_TEST_ROUNDS in the environment multiplies them (tools/elementary_soak).

#include <abut/elementary_impact.h>
#include <abut/progress.h>

#include "ccd/elementary_crossing.h"
#include "ccd/elementary_exact.h"
#include "ccd/elementary_filter.h"
#include "ccd/elementary_interval.h"
#include "geometry/point_triangle_distance.h"
#include "geometry/triangle_triangle_distance.h"
#include "tests/support/ccd_cases.h"
#include "tests/support/oracle/ccd_oracle.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/simd_targets.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// Counts the outcomes, so that a test can require enough of each.
struct Tally {
    int cases = 0, hits = 0, intervals = 0, culled = 0;

    ~Tally() {
        std::cout << cases << " cases, " << hits << " hits, " << culled
                  << " decided by the filter, " << intervals << " by intervals\n";
    }
    void add(const ElementaryImpact& impact) {
        ++cases;
        hits += impact.meet ? 1 : 0;
        culled += impact.decided_by == ElementaryStage::filter ? 1 : 0;
        intervals += impact.decided_by == ElementaryStage::interval ? 1 : 0;
    }
    [[nodiscard]] double share(int count) const { return double(count) / cases; }
};

ElementaryPair any_pair(Random& random) {
    switch (random.integer(0, 6)) {
    case 0:
    case 1:
        return random_pair(random);
    case 2:
        return meeting_pair(random);
    case 3:
        return mutated(random, meeting_pair(random));
    case 4: { // far from the origin, where differences are rounded
        const Vec3 away{3000.5, -70000.25, 12};
        return changed(meeting_pair(random), [&](const Vec3& p) { return p + away; });
    }
    case 5: { // products overflow or underflow
        const double scale = std::pow(10, random.uniform(-160, 150));
        return changed(meeting_pair(random), [&](const Vec3& p) { return scale * p; });
    }
    default:
        return lattice_pair(random, 4);
    }
}

void expect_like_oracle(const ElementaryPair& pair, const ElementaryImpact& impact,
                        const std::optional<OracleTime>& truth) {
    ASSERT_EQ(impact.meet, truth.has_value()) << pair;
    EXPECT_EQ(impact.status, Status::exact);
    if (!truth) {
        EXPECT_EQ(impact.time, 1);
        return;
    }
    EXPECT_GE(impact.time, 0);
    EXPECT_LE(impact.time, truth->high) << pair;
    EXPECT_GE(impact.time, truth->low - 1e-9) << pair;
}

TEST(ElementaryImpact, LatticePairsAgainstTheOracle) {
    Random random(701);
    for (const int n : {1, 2, 3, 6}) {
        Tally tally;
        for (int i = 0; i < many(6000) && !HasFatalFailure(); ++i) {
            const ElementaryPair pair = lattice_pair(random, n);
            const auto truth = CcdOracle<BigInt>(pair).first();
            const ElementaryImpact impact = elementary_impact(pair);
            tally.add(impact);
            expect_like_oracle(pair, impact, truth);
            expect_like_oracle(pair, elementary_impact_exact(pair), truth);
            if (const auto interval = elementary_impact_interval(pair, 0))
                expect_like_oracle(pair, *interval, truth);
        }
        EXPECT_GT(tally.share(tally.hits), 0.15);
        EXPECT_LT(tally.share(tally.hits), 0.85);
        EXPECT_LT(tally.share(tally.culled + tally.intervals), 0.95);
    }
}

TEST(ElementaryImpact, PairsInGeneralPositionAgainstTheOracle) {
    Random random(702);
    Tally tally;
    for (int i = 0; i < many(3000) && !HasFatalFailure(); ++i) {
        const ElementaryPair pair =
            i % 3 == 0 ? mutated(random, meeting_pair(random)) : meeting_pair(random);
        const ElementaryImpact impact = elementary_impact(pair);
        tally.add(impact);
        expect_like_oracle(pair, impact, CcdOracle<AnyInt>(pair).first());
    }
    EXPECT_GT(tally.share(tally.hits), 0.5);
    EXPECT_GT(tally.share(tally.intervals), 0.4);
}

TEST(ElementaryImpact, AnswersByFilterAndIntervalsAreExact) {
    Random random(703);
    Tally tally;
    int exact_hits = 0;
    for (int i = 0; i < many(120000) && !HasFatalFailure(); ++i) {
        const ElementaryPair pair = any_pair(random);
        const ElementaryImpact impact = elementary_impact(pair);
        tally.add(impact);
        if (impact.decided_by == ElementaryStage::exact) {
            exact_hits += impact.meet ? 1 : 0;
            continue;
        }
        const ElementaryImpact exact = elementary_impact_exact(pair);
        ASSERT_EQ(impact.meet, exact.meet) << pair;
        // Both times are lower bounds of the exact time, less than 1e-9 below it.
        ASSERT_NEAR(impact.time, exact.time, 1e-9) << pair;
        ASSERT_LE(impact.time, exact.time + 0x1p-44) << pair;
    }
    EXPECT_GT(tally.share(tally.culled), 0.2);
    EXPECT_GT(tally.share(tally.intervals), 0.2);
    EXPECT_GT(tally.share(tally.hits), 0.3);
    EXPECT_GT(tally.share(exact_hits), 0.01);
}

TEST(ElementaryImpact, TheSamePairWrittenDifferently) {
    Random random(704);
    Tally tally;
    for (int i = 0; i < many(250000) && !HasFatalFailure(); ++i) {
        const ElementaryPair pair = i % 8 == 0
                                        ? lattice_pair(random, 1 + i % 5)
                                        : (i % 2 == 0 ? meeting_pair(random) : random_pair(random));
        const ElementaryImpact impact = elementary_impact(pair);
        tally.add(impact);
        const ElementaryImpact same = elementary_impact(rewritten(random, pair));
        ASSERT_EQ(impact.meet, same.meet) << pair;
        ASSERT_NEAR(impact.time, same.time, 1e-9) << pair;
        ASSERT_EQ(impact.meet, elementary_impact(reversed(pair)).meet) << pair;
        if (i % 8 == 0) {
            const Vec3 way{double(random.integer(-9, 9)), double(random.integer(-9, 9)), 1e9};
            ASSERT_EQ(impact.meet,
                      elementary_impact(changed(pair, [&](const Vec3& p) { return p + way; })).meet)
                << pair;
        }
    }
    EXPECT_GT(tally.share(tally.hits), 0.2);
    EXPECT_LT(tally.share(tally.hits), 0.8);
}

TEST(ElementaryImpact, TheFilterOnEverySimdTarget) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(705);
        int cases = 0, culled = 0, different = 0;
        for (int i = 0; i < many(4000) && !HasFatalFailure(); ++i) {
            const ElementaryKind kind = any_kind(random);
            ElementaryBatch batch;
            std::array<ElementaryPair, ElementaryBatch::kLanes> pairs;
            for (std::size_t lane = 0; lane < pairs.size(); ++lane) {
                pairs.at(lane) = any_pair(random);
                pairs.at(lane).kind = kind;
                batch.set(lane, pairs.at(lane));
            }
            const std::uint32_t possible = possible_impacts(batch, kind),
                                reference = possible_impacts_reference(batch, kind);
            for (std::size_t lane = 0; lane < pairs.size(); ++lane) {
                const ElementaryPair& pair = pairs.at(lane);
                const bool is_possible = (possible >> lane & 1) != 0;
                ++cases;
                culled += is_possible ? 0 : 1;
                // Fused operations round differently, so a few answers may differ from the
                // reference.
                different += is_possible != ((reference >> lane & 1) != 0) ? 1 : 0;
                ASSERT_EQ(is_possible, possible_impact(pair)) << pair;
                ASSERT_TRUE(is_possible || !elementary_impact_exact(pair).meet) << pair;
            }
        }
        std::cout << target << ": " << cases << " cases, " << culled << " culled, " << different
                  << " not as the reference\n";
        EXPECT_GT(culled, cases / 4);
        EXPECT_LT(different, cases / 500);
    });
}

TEST(ElementaryImpact, CrossingsOnEverySimdTarget) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(709);
        int cases = 0, decided = 0, meet = 0, different = 0;
        for (int i = 0; i < many(3000) && !HasFatalFailure(); ++i) {
            const ElementaryKind kind = any_kind(random);
            ElementaryBatch batch;
            std::array<ElementaryPair, ElementaryBatch::kLanes> pairs;
            for (std::size_t lane = 0; lane < pairs.size(); ++lane) {
                pairs.at(lane) = any_pair(random);
                pairs.at(lane).kind = kind;
                batch.set(lane, pairs.at(lane));
            }
            CrossingBatch crossings, reference, single;
            decide_crossings(batch, kind, crossings);
            decide_crossings_reference(batch, kind, reference);
            for (std::size_t lane = 0; lane < pairs.size(); ++lane) {
                const ElementaryPair& pair = pairs.at(lane);
                const bool meets = (crossings.meet >> lane & 1) != 0,
                           apart = (crossings.apart >> lane & 1) != 0;
                decide_crossing(pair, single);
                ASSERT_EQ(meets, single.meet != 0) << pair;
                ASSERT_EQ(apart, single.apart != 0) << pair;
                ++cases;
                decided += meets || apart ? 1 : 0;
                meet += meets ? 1 : 0;
                different += ((reference.meet ^ crossings.meet) >> lane & 1) != 0 ? 1 : 0;
                if (!meets && !apart)
                    continue;
                ASSERT_FALSE(meets && apart) << pair;
                const ElementaryImpact exact = elementary_impact_exact(pair);
                ASSERT_EQ(exact.meet, meets) << pair;
                if (!meets)
                    continue;
                ASSERT_EQ(crossings.time[lane], single.time[0]) << pair;
                ASSERT_LE(crossings.time[lane], exact.time + 0x1p-44) << pair;
                ASSERT_GE(crossings.time[lane], exact.time - 1e-9) << pair;
            }
        }
        std::cout << target << ": " << cases << " cases, " << decided << " decided, of them "
                  << meet << " meet; " << different << " not as the reference\n";
        EXPECT_GT(decided, cases / 4);
        EXPECT_GT(meet, cases / 8);
        EXPECT_LT(different, cases / 500);
    });
}

TEST(ElementaryImpact, BatchesEqualSingleTests) {
    Random random(706);
    std::vector<ElementaryPair> pairs(5003);
    std::generate(pairs.begin(), pairs.end(), [&] { return any_pair(random); });
    for (const double delta : {0.0, 1e-3}) {
        const auto impacts = elementary_impacts(pairs, {.absolute_error = delta});
        ASSERT_EQ(impacts.size(), pairs.size());
        int hits = 0;
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            const ElementaryImpact one = elementary_impact(pairs[i], {.absolute_error = delta});
            ASSERT_EQ(impacts[i].meet, one.meet) << pairs[i];
            ASSERT_EQ(impacts[i].time, one.time) << pairs[i];
            ASSERT_EQ(impacts[i].normal, one.normal) << pairs[i];
            ASSERT_EQ(impacts[i].barycentric, one.barycentric) << pairs[i];
            ASSERT_EQ(impacts[i].decided_by, one.decided_by) << pairs[i];
            hits += one.meet ? 1 : 0;
        }
        EXPECT_GT(hits, 1000);
    }
}

double distance_at(const ElementaryPair& pair, double t) {
    std::array<Vec3, 4> p;
    for (std::size_t i = 0; i < 4; ++i)
        p.at(i) = (1 - t) * pair.start.at(i) + t * pair.end.at(i);
    const ClosestPoints closest = pair.kind == ElementaryKind::vertex_face
                                      ? point_triangle_distance(p[0], {p[1], p[2], p[3]})
                                      : segment_segment_distance(p[0], p[1], p[2], p[3]);
    return std::sqrt(closest.distance_sq);
}

TEST(ElementaryImpact, ConservativeMissesNothingAndReportsOnlyNearPairs) {
    Random random(707);
    Tally tally;
    int near = 0;
    for (int i = 0; i < many(60000) && !HasFatalFailure(); ++i) {
        const double delta = std::pow(10, random.uniform(-9, -2));
        ElementaryPair pair = i % 2 == 0 ? lattice_pair(random, 3) : meeting_pair(random);
        if (i % 4 == 1)
            pair.start[0] = pair.start[0] + random.in_cube(delta);
        const ElementaryImpact exact = elementary_impact(pair);
        const ElementaryImpact impact = elementary_impact(pair, {.absolute_error = delta});
        tally.add(impact);
        if (exact.meet) {
            ASSERT_TRUE(impact.meet) << pair;
            ASSERT_LE(impact.time, exact.time + 0x1p-44) << pair;
        }
        if (!impact.meet || impact.status == Status::exact)
            continue;
        ++near;
        ASSERT_LE(distance_at(pair, impact.time), delta + 1e-15 * size_of(pair)) << pair;
    }
    EXPECT_GT(tally.share(near), 0.02);
    EXPECT_GT(tally.share(tally.hits), 0.3);
}

TEST(ElementaryImpact, PointsAndNormalsOfImpacts) {
    Random random(708);
    Tally tally;
    int flat = 0, approaching = 0;
    double worst = 0;
    for (int i = 0; i < many(60000) && !HasFatalFailure(); ++i) {
        const ElementaryPair pair = i % 2 == 0 ? lattice_pair(random, 3) : meeting_pair(random);
        const ElementaryImpact impact = elementary_impact(pair);
        tally.add(impact);
        if (!impact.meet)
            continue;
        const auto& b = impact.barycentric;
        const bool face = pair.kind == ElementaryKind::vertex_face;
        for (const double weight : b) {
            ASSERT_GE(weight, 0) << pair;
            ASSERT_LE(weight, 1) << pair;
        }
        ASSERT_NEAR(face ? b[0] + b[1] + b[2] : 1 + b[2], 1, 1e-15);
        const auto [p, q] = impact_points(pair, impact);
        worst = std::max(worst, length(p - q) / size_of(pair));
        // The normal has unit length, is perpendicular to the features, and opposes the approach.
        const Vec3 n = impact.normal;
        if (n == Vec3{}) {
            ++flat;
            continue;
        }
        ASSERT_NEAR(length(n), 1, 1e-12);
        const double later = std::min(1.0, impact.time + 1e-6);
        ElementaryImpact moved = impact;
        moved.time = later;
        const auto [p1, q1] = impact_points(pair, moved);
        const double approach = dot(n, (p1 - p) - (q1 - q));
        ASSERT_LE(approach, 1e-12) << pair;
        approaching += approach < -1e-12 ? 1 : 0;
    }
    std::cout << "points of impact at most " << worst << " sizes apart, " << flat
              << " without a normal\n";
    EXPECT_LT(worst, 1e-7);
    EXPECT_GT(approaching, tally.hits / 3);
    EXPECT_LT(flat, tally.hits / 3);
}

} // namespace
} // namespace abut::test
