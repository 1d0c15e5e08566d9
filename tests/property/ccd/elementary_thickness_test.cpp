// Elementary tests with a thickness, checked against exact arithmetic at single times, against the
// same pair written differently, and one lane against many. Each test prints how many cases it has
// seen. ABUT_TEST_ROUNDS in the environment multiplies them (tools/elementary_soak).

#include <abut/elementary_impact.h>

#include "ccd/elementary_filter.h"
#include "ccd/feature_distance.h"
#include "tests/support/ccd_cases.h"
#include "tests/support/oracle/thickness_oracle.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/simd_targets.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

struct ThicknessTally {
    int cases = 0, hits = 0, late = 0, culled = 0, found = 0, bound_only = 0;

    ~ThicknessTally() {
        std::cout << cases << " cases, " << hits << " hits, " << late << " after the start, "
                  << bound_only << " bounds only, " << culled << " decided by the filter, " << found
                  << " found by the oracle\n";
    }
    void add(const ElementaryImpact& impact) {
        ++cases;
        hits += impact.meet ? 1 : 0;
        late += impact.meet && impact.time > 0 ? 1 : 0;
        culled += impact.decided_by == ElementaryStage::filter ? 1 : 0;
        bound_only += impact.status == Status::bound_only ? 1 : 0;
    }
    [[nodiscard]] double share(int count) const { return double(count) / cases; }
};

/// The largest absolute coordinate difference between two of the vertices.
double size_between(const ElementaryPair& pair) {
    Box3 start, end;
    for (std::size_t i = 0; i < 4; ++i)
        extend(start, pair.start.at(i)), extend(end, pair.end.at(i));
    return std::max(max_abs(start.upper - start.lower), max_abs(end.upper - end.lower));
}

/// Checks that the features are within the promised distance at the reported time, and never within
/// the thickness before it.
void expect_as_promised(Random& random, const ElementaryPair& pair, const ElementaryImpact& impact,
                        const ElementaryOptions& options) {
    const double d = options.thickness;
    const ThicknessOracle oracle(pair);
    ASSERT_GE(impact.time, 0);
    ASSERT_LE(impact.time, 1);
    if (impact.meet) {
        const double tolerance =
            impact.status == Status::converged
                ? 1e-6 * d
                : std::max({1e-6 * d, options.absolute_error, 6e-12 * size_between(pair)});
        ASSERT_TRUE(oracle.within(d + tolerance, impact.time)) << d << ' ' << pair;
    } else {
        ASSERT_EQ(impact.status, Status::exact);
    }
    for (int i = 0; i < 3 && impact.time > 0; ++i) {
        const double earlier = std::nextafter(impact.time, 0) * std::pow(random.uniform(0, 1), i);
        ASSERT_FALSE(oracle.within(d, earlier)) << d << " at " << earlier << ' ' << pair;
    }
}

/// Edges that are nearly parallel, or a needle-shaped face, with all vertices near each other.
ElementaryPair thin_pair(Random& random) {
    ElementaryPair pair = random_pair(random);
    const double width = std::pow(10, random.uniform(-15, -1)),
                 gap = std::pow(10, random.uniform(-15, -1));
    for (auto* points : {&pair.start, &pair.end}) {
        auto& [a, b, c, d] = *points;
        const auto beside = [&](const Vec3& from, const Vec3& to) {
            return from + random.uniform(-0.5, 1.5) * (to - from) + random.in_cube(width);
        };
        c = beside(a, b), d = beside(a, b);
        const Vec3 way = random.in_cube(gap);
        c = c + way, d = d + way;
        if (pair.kind == ElementaryKind::vertex_face)
            a = beside(b, c) + random.in_cube(gap);
    }
    return pair;
}

ElementaryPair any_near_pair(Random& random) {
    switch (random.integer(0, 7)) {
    case 7:
        return thin_pair(random);
    case 0:
        return random_pair(random);
    case 1:
    case 2:
        return meeting_pair(random);
    case 3:
        return mutated(random, meeting_pair(random));
    case 4: { // far from the origin, where differences are rounded
        const Vec3 away{3000.5, -70000.25, 12};
        return changed(meeting_pair(random), [&](const Vec3& p) { return p + away; });
    }
    default:
        return lattice_pair(random, 4);
    }
}

/// Moves the first feature by 0 to 2 times `length` in a random direction.
ElementaryPair moved_off(Random& random, ElementaryPair pair, double length) {
    const Vec3 way = random.uniform(0, 2) * length * random.direction();
    for (std::size_t i = 0; i < (pair.kind == ElementaryKind::vertex_face ? 1U : 2U); ++i) {
        pair.start.at(i) = pair.start.at(i) + way;
        pair.end.at(i) = pair.end.at(i) + way;
    }
    return pair;
}

TEST(ElementaryThickness, ImpactsAreAsNearAsPromised) {
    Random random(801);
    ThicknessTally tally;
    for (int i = 0; i < many(8000) && !HasFatalFailure(); ++i) {
        ElementaryOptions options;
        options.thickness = std::pow(10, random.uniform(-9, 0));
        options.absolute_error =
            i % 4 == 0 ? options.thickness * std::pow(10, random.uniform(-7, 1)) : 0;
        const ElementaryPair pair = moved_off(random, any_near_pair(random), options.thickness);
        const ElementaryImpact impact = elementary_impact(pair, options);
        tally.add(impact);
        expect_as_promised(random, pair, impact, options);
    }
    EXPECT_GT(tally.share(tally.hits), 0.3);
    EXPECT_LT(tally.share(tally.hits), 0.9);
    EXPECT_GT(tally.share(tally.late), 0.1);
    EXPECT_GT(tally.share(tally.culled), 0.1);
    EXPECT_GT(tally.bound_only, 0);
}

TEST(ElementaryThickness, NoContactIsMissed) {
    Random random(802);
    ThicknessTally tally;
    for (int i = 0; i < many(3000) && !HasFatalFailure(); ++i) {
        const bool lattice = i % 2 == 0;
        const double d = lattice ? random.integer(1, 8) / 8.0 : std::pow(10, random.uniform(-4, 0));
        const ElementaryPair pair =
            lattice ? lattice_pair(random, 4) : moved_off(random, any_near_pair(random), d);
        const ElementaryImpact impact = elementary_impact(pair, {.thickness = d});
        tally.add(impact);
        const auto time = ThicknessOracle(pair).early_time(d);
        if (!time)
            continue;
        ++tally.found;
        ASSERT_TRUE(impact.meet) << d << ' ' << pair;
        ASSERT_LE(impact.time, *time) << d << ' ' << pair;
    }
    EXPECT_GT(tally.share(tally.late), 0.1);
    EXPECT_GT(tally.found, 0.95 * tally.hits);
    EXPECT_LT(tally.share(tally.hits), 0.9);
}

/// A corner of the first feature moves along a straight line past a corner of the second. Their
/// distance is least at t = 1/2, where it is exactly `distance`. All other points are farther
/// apart.
struct Grazing {
    ElementaryPair pair;
    double distance = 0;

    explicit Grazing(Random& random) {
        struct Leg {
            Vec3 gap, way; ///< perpendicular
            double length = 0;
        };
        const std::array<Leg, 4> legs{{{{3, 4, 0}, {4, -3, 5}, 5},
                                       {{1, 2, 2}, {2, -2, 1}, 3},
                                       {{2, 3, 6}, {-3, 2, 0}, 7},
                                       {{0, 0, 2}, {1, 5, 0}, 2}}};
        const Leg& leg = legs.at(static_cast<std::size_t>(random.integer(0, 3)));
        distance = leg.length;
        pair.kind = any_kind(random);
        // Other vertices lie beyond the plane across the gap: the first feature's above it, the
        // second's below.
        const auto beyond = [&](double sign) {
            const Vec3 p = random.on_lattice(8) - Vec3{4, 4, 4};
            const double along = sign * dot(p, leg.gap);
            return along == 0 ? sign * leg.gap : along < 0 ? -p : p;
        };
        const std::size_t first = pair.kind == ElementaryKind::vertex_face ? 1 : 2;
        for (std::size_t i = 0; i < 4; ++i) {
            const bool of_first = i < first, corner = i == 0 || i == first;
            const Vec3 at = corner ? Vec3{} : beyond(of_first ? 1 : -1);
            const Vec3 half_way = of_first ? 2 * leg.way : Vec3{};
            pair.start.at(i) = at + (of_first ? leg.gap : Vec3{}) - half_way;
            pair.end.at(i) = at + (of_first ? leg.gap : Vec3{}) + half_way;
        }
    }
};

TEST(ElementaryThickness, GrazingAtExactlyTheThickness) {
    Random random(803);
    ThicknessTally tally;
    int early = 0;
    for (int i = 0; i < many(4000) && !HasFatalFailure(); ++i) {
        const Grazing grazing(random);
        const ElementaryPair pair = i % 2 == 0 ? grazing.pair : rewritten(random, grazing.pair);
        const double scale = size_between(pair) / size_between(grazing.pair),
                     d = scale * grazing.distance;
        const ElementaryImpact impact = elementary_impact(pair, {.thickness = d});
        tally.add(impact);
        ASSERT_TRUE(impact.meet) << d << pair;
        ASSERT_LE(impact.time, 0.5) << pair;
        expect_as_promised(random, pair, impact, {.thickness = d});
        early += impact.time < 0.4 ? 1 : 0;
        ASSERT_FALSE(elementary_impact(pair, {.thickness = (1 - 1.1e-6) * d}).meet) << pair;
        for (const double almost : {std::nextafter(d, 0.0), (1 - 0.5e-6) * d}) {
            const ElementaryImpact near = elementary_impact(pair, {.thickness = almost});
            expect_as_promised(random, pair, near, {.thickness = almost});
        }
    }
    EXPECT_EQ(early, 0);
}

TEST(ElementaryThickness, TheSamePairWrittenDifferently) {
    Random random(804);
    ThicknessTally tally;
    int different = 0;
    for (int i = 0; i < many(30000) && !HasFatalFailure(); ++i) {
        const double d = std::pow(10, random.uniform(-5, 0));
        const ElementaryPair pair = moved_off(random, any_near_pair(random), d);
        const ElementaryPair same = rewritten(random, pair);
        const double scale = size_between(pair) > 0 ? size_between(same) / size_between(pair) : 1;
        const ElementaryImpact one = elementary_impact(pair, {.thickness = d}),
                               two = elementary_impact(same, {.thickness = scale * d});
        tally.add(one);
        // Both answers are right for a pair whose distance lies between the thickness and the
        // thickness plus the allowed error.
        different += one.meet != two.meet ? 1 : 0;
        if (one.meet != two.meet) {
            const auto& [hit, of] = one.meet ? std::pair(one, pair) : std::pair(two, same);
            ASSERT_FALSE(ThicknessOracle(of).within(one.meet ? d : scale * d, hit.time)) << pair;
        } else if (one.meet) {
            const double tolerance = 2e-6 * d + 2e-11 * size_between(pair);
            ASSERT_TRUE(ThicknessOracle(pair).within(d + tolerance, two.time)) << pair;
        }
    }
    EXPECT_GT(tally.share(tally.hits), 0.2);
    EXPECT_LT(tally.share(tally.hits), 0.9);
    EXPECT_LT(different, tally.cases / 500);
}

TEST(ElementaryThickness, AnySizeOfCoordinates) {
    Random random(805);
    ThicknessTally tally;
    for (int i = 0; i < many(2000) && !HasFatalFailure(); ++i) {
        const int exponent =
            random.chance(0.3) ? (random.chance(0.5) ? 1021 : -1050) : random.integer(-1000, 1000);
        const double d = std::pow(2, random.integer(-6, 0));
        const ElementaryPair pair = lattice_pair(random, 3);
        const ElementaryPair scaled =
            changed(pair, [&](const Vec3& p) { return std::ldexp(1, exponent) * p; });
        const ElementaryImpact one = elementary_impact(pair, {.thickness = d}),
                               two = elementary_impact(scaled,
                                                       {.thickness = std::ldexp(d, exponent)});
        tally.add(two);
        ASSERT_EQ(one.meet, two.meet) << d << pair;
        ASSERT_EQ(one.time, two.time) << d << pair;
        // For touching features the normal depends on a velocity, which loses digits to underflow.
        if (exponent >= -1000) {
            ASSERT_EQ(one.normal, two.normal) << exponent << ' ' << d << pair;
        }
    }
    // Coordinates and thickness of very different sizes.
    for (int i = 0; i < many(1000) && !HasFatalFailure(); ++i) {
        ElementaryPair pair = lattice_pair(random, 2);
        for (auto* points : {&pair.start, &pair.end})
            for (Vec3& p : *points)
                p = std::pow(10, random.integer(-150, 150)) * p;
        const double d = std::pow(10, random.integer(-150, 150));
        const ElementaryImpact impact = elementary_impact(pair, {.thickness = d});
        tally.add(impact);
        expect_as_promised(random, pair, impact, {.thickness = d});
    }
    EXPECT_GT(tally.share(tally.hits), 0.2);
    EXPECT_LT(tally.share(tally.hits), 0.9);
}

TEST(ElementaryThickness, PointsAndNormals) {
    Random random(806);
    ThicknessTally tally;
    int without = 0;
    for (int i = 0; i < many(20000) && !HasFatalFailure(); ++i) {
        const double d = std::pow(10, random.uniform(-4, 0));
        const ElementaryPair pair = moved_off(random, any_near_pair(random), d);
        const ElementaryImpact impact = elementary_impact(pair, {.thickness = d});
        tally.add(impact);
        if (!impact.meet)
            continue;
        const auto [p, q] = impact_points(pair, impact);
        const double gap = length(p - q), rounding = 1e-14 * (1 + size_of(pair));
        ASSERT_LE(gap, (1 + 1e-6) * d + rounding) << pair;
        if (impact.time > 0) {
            ASSERT_GE(gap, d - rounding) << pair;
        }
        if (gap < 1e3 * rounding) {
            without += impact.normal == Vec3{} ? 1 : 0;
            continue;
        }
        ASSERT_NEAR(length(impact.normal), 1, 1e-12);
        ASSERT_NEAR(dot(impact.normal, p - q), gap, 1e-6 * gap + rounding) << pair;
    }
    EXPECT_GT(tally.share(tally.late), 0.1);
    EXPECT_LT(without, tally.hits / 10);
}

TEST(ElementaryThickness, TheFilterOnEverySimdTarget) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(807);
        int cases = 0, culled = 0, different = 0, culled_without = 0;
        for (int i = 0; i < many(1000) && !HasFatalFailure(); ++i) {
            const ElementaryKind kind = any_kind(random);
            const double d = std::pow(10, random.uniform(-6, 0));
            ElementaryBatch batch;
            std::array<ElementaryPair, ElementaryBatch::kLanes> pairs;
            for (std::size_t lane = 0; lane < pairs.size(); ++lane) {
                ElementaryPair& pair = pairs.at(lane);
                pair = moved_off(random, any_near_pair(random), 2 * d);
                pair.kind = kind;
                batch.set(lane, pair);
            }
            const std::uint32_t possible = possible_impacts(batch, kind, d),
                                reference = possible_impacts_reference(batch, kind, d),
                                touching = possible_impacts(batch, kind);
            ASSERT_EQ(touching & ~possible, 0U);
            for (std::size_t lane = 0; lane < pairs.size(); ++lane) {
                const ElementaryPair& pair = pairs.at(lane);
                const bool is_possible = (possible >> lane & 1) != 0;
                ++cases;
                culled += is_possible ? 0 : 1;
                culled_without += (touching >> lane & 1) != 0 ? 0 : 1;
                different += is_possible != ((reference >> lane & 1) != 0) ? 1 : 0;
                ASSERT_EQ(is_possible, possible_impact(pair, d)) << pair;
                if (!is_possible) {
                    ASSERT_FALSE(ThicknessOracle(pair).within(d, random.uniform(0, 1))) << pair;
                    ASSERT_FALSE(ThicknessOracle(pair).within(d, 1)) << pair;
                }
            }
        }
        std::cout << target << ": " << cases << " cases, " << culled << " culled, "
                  << culled_without << " without thickness, " << different
                  << " not as the reference\n";
        EXPECT_GT(culled, cases / 8);
        EXPECT_LE(different, cases / 500);
    });
}

TEST(ElementaryThickness, BatchesEqualSingleTests) {
    Random random(808);
    std::vector<ElementaryPair> pairs(3001);
    std::generate(pairs.begin(), pairs.end(), [&] { return any_near_pair(random); });
    const ElementaryOptions options{.thickness = 0.01};
    const auto impacts = elementary_impacts(pairs, options);
    int hits = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const ElementaryImpact one = elementary_impact(pairs[i], options);
        ASSERT_EQ(impacts[i].meet, one.meet) << pairs[i];
        ASSERT_EQ(impacts[i].status, one.status) << pairs[i];
        ASSERT_EQ(impacts[i].time, one.time) << pairs[i];
        ASSERT_EQ(impacts[i].normal, one.normal) << pairs[i];
        ASSERT_EQ(impacts[i].barycentric, one.barycentric) << pairs[i];
        ASSERT_EQ(impacts[i].decided_by, one.decided_by) << pairs[i];
        hits += one.meet ? 1 : 0;
    }
    EXPECT_GT(hits, 1000);
}

TEST(FeatureDistance, BoundsHoldAndAreTight) {
    Random random(809);
    int cases = 0, apart = 0;
    double widest = 0;
    for (int i = 0; i < many(20000) && !HasFatalFailure(); ++i) {
        ElementaryPair pair = any_near_pair(random);
        if (i % 3 == 0)
            pair = mutated(random, pair);
        pair.end = pair.start;
        const FeatureDistance d = feature_distance(pair.kind, pair.start);
        const ThicknessOracle oracle(pair);
        ++cases;
        ASSERT_TRUE(oracle.within(d.upper, 0)) << pair;
        if (d.lower > 0) {
            ++apart;
            ASSERT_FALSE(oracle.within(std::nextafter(d.lower, 0), 0)) << pair;
        }
        ASSERT_LE(d.lower, d.upper);
        ASSERT_LE(d.distance_sq, d.upper * d.upper);
        const double size = size_between(pair);
        ASSERT_LE(d.upper - d.lower, 1e-12 * size + 1e-300) << pair;
        widest = std::max(widest, size > 1e-200 ? (d.upper - d.lower) / size : 0);
        ElementaryImpact at;
        at.time = 0, at.barycentric = d.barycentric;
        const auto [p, q] = impact_points(pair, at);
        ASSERT_NEAR(length(p - q), std::sqrt(d.distance_sq), 1e-14 * (1 + size_of(pair))) << pair;
    }
    std::cout << cases << " cases, " << apart << " apart, bounds at most " << widest
              << " sizes apart\n";
    EXPECT_GT(apart, cases / 2);
}

TEST(FeatureDistance, AreWithinIsExact) {
    Random random(810);
    int within = 0, beyond = 0, open = 0;
    for (int i = 0; i < many(8000) && !HasFatalFailure(); ++i) {
        ElementaryPair pair = i % 4 == 0 ? lattice_pair(random, 4) : any_near_pair(random);
        if (i % 3 == 0)
            pair = mutated(random, pair);
        if (i % 5 == 0) { // squares underflow at these sizes
            const double scale = std::ldexp(1, random.integer(-1010, -500));
            for (Vec3& p : pair.start)
                p = scale * p;
        }
        pair.end = pair.start;
        const FeatureDistance d = feature_distance(pair.kind, pair.start);
        const ThicknessOracle oracle(pair);
        for (const double limit : {d.distance, std::nextafter(d.distance, HUGE_VAL),
                                   std::max(0.0, std::nextafter(d.distance, 0)), d.lower, d.upper,
                                   0.5 * d.distance, 2 * d.distance}) {
            if (!(limit < HUGE_VAL))
                continue;
            const bool expected = oracle.within(limit, 0);
            ASSERT_EQ(are_within(pair.kind, pair.start, d, limit), expected) << pair;
            (expected ? within : beyond) += 1;
            open += d.lower <= limit && limit < d.upper ? 1 : 0;
        }
    }
    std::cout << within << " within, " << beyond << " beyond, " << open << " by exact arithmetic\n";
    EXPECT_GT(within, many(8000));
    EXPECT_GT(beyond, many(8000));
    EXPECT_GT(open, many(8000));
}

} // namespace
} // namespace abut::test
