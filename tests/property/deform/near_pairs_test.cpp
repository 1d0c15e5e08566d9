// Pairs of near features against exact arithmetic and 100 digits: which are listed under options, and
// what they tell. Each test prints its seed and what it has seen.

#include <abut/deformable.h>

#include "ccd/near_filter.h"
#include "math/vector.h"
#include "tests/support/ccd_cases.h"
#include "tests/support/moving_meshes.h"
#include "tests/support/oracle/precise_distance.h"
#include "tests/support/oracle/thickness_oracle.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/simd_targets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <iostream>
#include <tuple>
#include <vector>

namespace abut::test {
namespace {

MovingMesh near_soup(Random& random) {
    if (random.chance(0.3))
        return needle_soup(random, random.integer(2, 6));
    const int vertices = random.integer(4, 14), triangles = random.integer(1, 14);
    return random.chance(0.5) ? lattice_soup(random, vertices, triangles, random.integer(1, 4))
                              : random_soup(random, vertices, triangles);
}

/// How many of a pair's vertices belong to its first feature.
std::size_t split_of(ElementaryKind kind) {
    return kind == ElementaryKind::edge_edge ? 2 : 1;
}

std::array<Vec3, 4> points_of(const FeaturePair& pair, const std::vector<Vec3>& a,
                              const std::vector<Vec3>& b) {
    std::array<Vec3, 4> points;
    for (std::size_t i = 0; i < 4; ++i)
        points[i] = ((i < split_of(pair.kind)) != pair.face_first ? a : b)[pair.vertices[i]];
    return points;
}

double size_of(const std::array<Vec3, 4>& points) {
    double size = 0;
    for (const Vec3& p : points)
        for (const Vec3& q : points)
            size = std::max(size, max_abs(p - q));
    return size;
}

PrecisePoint cross(const PrecisePoint& a, const PrecisePoint& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The features' directions, and a difference of them.
struct PreciseSides {
    PrecisePoint u, v, between;

    PreciseSides(ElementaryKind kind, const std::array<Vec3, 4>& p) {
        const auto at = [&](std::size_t i) { return precise(p[i]); };
        if (kind == ElementaryKind::edge_edge) {
            u = at(1) - at(0), v = at(3) - at(2), between = at(0) - at(2);
        } else {
            u = at(2) - at(1), v = at(3) - at(1), between = at(0) - at(1);
        }
    }
    [[nodiscard]] int side() const {
        const Precise volume = dot(cross(u, v), between);
        return volume > 0 ? 1 : volume < 0 ? -1 : 0;
    }
};

Precise true_distance(ElementaryKind kind, const std::array<Vec3, 4>& p) {
    if (kind == ElementaryKind::vertex_face)
        return precise_distance(p[0], Triangle{p[1], p[2], p[3]});
    return precise_root(
        segment_segment_sq(precise(p[0]), precise(p[1]), precise(p[2]), precise(p[3])));
}

/// The least difference of the features' vertices along the normal: no two points of them are
/// nearer along it.
Precise gap_along(const Vec3& normal, ElementaryKind kind, const std::array<Vec3, 4>& p) {
    const PrecisePoint n = precise(normal);
    const std::size_t split = split_of(kind);
    Precise least = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < split; ++i)
        for (std::size_t k = split; k < 4; ++k)
            keep_least(least, dot(n, precise(p[i]) - precise(p[k])));
    return least;
}

struct Seen {
    std::size_t pairs = 0, touching = 0, in_plane = 0, degenerate = 0;
    double distance_error = 0, gap_error = 0, point_error = 0, across_error = 0;
};

void check_measures(const FeaturePair& pair, const std::array<Vec3, 4>& p, Seen& seen) {
    const double size = size_of(p);
    double largest = 0;
    for (const Vec3& each : p)
        largest = std::max(largest, max_abs(each));
    ++seen.pairs;
    const PreciseSides sides(pair.kind, p);
    ASSERT_EQ(pair.side, sides.side());
    ASSERT_LE(pair.distance, pair.limit);
    const double distance = static_cast<double>(true_distance(pair.kind, p));
    seen.distance_error = std::max(seen.distance_error, std::abs(pair.distance - distance) / size);

    // The weights are those of the points, and of points on the features.
    const std::size_t split = split_of(pair.kind);
    Vec3 difference, a;
    for (std::size_t i = 0; i < 4; ++i) {
        difference = difference + pair.weights[i] * p[i];
        if (i < split)
            a = a + pair.weights[i] * p[i];
        ASSERT_GE((i < split ? 1 : -1) * pair.weights[i], 0);
    }
    double sum_a = 0, sum_b = 0;
    for (std::size_t i = 0; i < 4; ++i)
        (i < split ? sum_a : sum_b) += pair.weights[i];
    ASSERT_NEAR(sum_a, 1, 1e-15);
    ASSERT_NEAR(sum_b, -1, 1e-15);
    seen.point_error = std::max({seen.point_error, length(pair.point_a - a) / largest,
                                 length(pair.point_a - pair.point_b - difference) / largest,
                                 std::abs(length(difference) - pair.distance) / largest});

    ASSERT_NEAR(length(pair.normal), 1, 1e-15);
    const double gap = static_cast<double>(gap_along(pair.normal, pair.kind, p));
    seen.gap_error = std::max(seen.gap_error, (distance - gap) / size);
    if (distance > 1e-13 * size)
        return;
    // The features touch: the normal is across both, on the side that the pair names.
    ++seen.touching;
    const PrecisePoint area = cross(sides.u, sides.v), n = precise(pair.normal);
    const Precise uu = dot(sides.u, sides.u), vv = dot(sides.v, sides.v);
    seen.degenerate += dot(area, area) == 0 ? 1 : 0;
    if (dot(area, area) > 1e-12 * uu * vv) {
        ASSERT_GT((pair.side < 0 ? -1 : 1) * dot(area, n), 0);
    }
    seen.in_plane += pair.side == 0 ? 1 : 0;
    for (const auto& [side, sq] : {std::pair(sides.u, uu), std::pair(sides.v, vv)})
        if (sq > 0 && distance == 0)
            seen.across_error = std::max(
                seen.across_error, std::abs(static_cast<double>(dot(side, n) / precise_root(sq))));
}

/// The normal is the gradient of the distance: a direction along which the features are as far apart
/// as their distance.
TEST(NearPairs, MeasuresAgainstManyDigits) {
    Random random(4711);
    Seen seen;
    for (int round = 0; round < many(60); ++round) {
        MovingMesh a = near_soup(random), b = near_soup(random);
        if (round % 4 == 0) // needles, flat and far from the origin
            for (MovingMesh* m : {&a, &b})
                for (Vec3& p : m->mesh.positions)
                    p = {p.x + 100, 1e-5 * p.y, 1e-7 * p.z};
        const double distance = random.uniform(0, 0.5) * (round % 4 == 0 ? 0.01 : 1);
        const Deformable first = a.deformable(), second = b.deformable();
        for (const FeaturePair& pair : self_within(first, distance))
            ASSERT_NO_FATAL_FAILURE(
                check_measures(pair, points_of(pair, a.mesh.positions, a.mesh.positions), seen));
        for (const FeaturePair& pair : within(first, second, distance))
            ASSERT_NO_FATAL_FAILURE(
                check_measures(pair, points_of(pair, a.mesh.positions, b.mesh.positions), seen));
    }
    std::cout << seen.pairs << " pairs, " << seen.touching << " touch, " << seen.in_plane
              << " of them in one plane, " << seen.degenerate << " on lines; distance off by "
              << seen.distance_error << ", along the normal " << seen.gap_error << ", points "
              << seen.point_error << ", across " << seen.across_error << '\n';
    EXPECT_LT(seen.distance_error, 1e-12);
    EXPECT_LT(seen.gap_error, 1e-12);
    EXPECT_LT(seen.point_error, 2e-15);
    EXPECT_LT(seen.across_error, 1e-14);
    EXPECT_GT(seen.pairs, std::size_t(many(60)) * 20);
    EXPECT_GT(seen.touching, seen.pairs / 30);
    EXPECT_LT(seen.touching, seen.pairs * 4 / 5);
    EXPECT_GT(seen.degenerate, std::size_t(many(60)) / 4);
}

/// Small moves of the vertices change the distance by the sum of weights * normal . move.
TEST(NearPairs, WeightsTimesNormalIsTheGradient) {
    Random random(815);
    std::size_t pairs = 0;
    double worst = 0;
    constexpr double kMove = 1e-7;
    for (int round = 0; round < many(40); ++round) {
        MovingMesh moving = random_soup(random, 9, 6);
        for (std::size_t i = 0; i < moving.end.size(); ++i)
            moving.end[i] = moving.mesh.positions[i] + random.in_cube(kMove);
        const auto after = self_within(moving.deformable(), 1, {.at_end = true});
        for (const FeaturePair& before : self_within(moving.deformable(), 0.5)) {
            const auto same = std::find_if(after.begin(), after.end(), [&](const FeaturePair& p) {
                return std::tuple(p.kind, p.a, p.b) == std::tuple(before.kind, before.a, before.b);
            });
            ASSERT_NE(same, after.end());
            if (before.distance < 0.05)
                continue;
            double expected = 0;
            for (std::size_t i = 0; i < 4; ++i) {
                const std::uint32_t v = before.vertices[i];
                expected += before.weights[i] *
                            dot(before.normal, moving.end[v] - moving.mesh.positions[v]);
            }
            worst = std::max(worst, std::abs(same->distance - before.distance - expected));
            ++pairs;
        }
    }
    std::cout << pairs << " pairs, worst " << worst / kMove << " of the move\n";
    EXPECT_LT(worst, 1e-4 * kMove);
    EXPECT_GT(pairs, std::size_t(many(40)) * 20);
}

/// Random thicknesses, groups, masks and marks of a surface's vertices.
struct VertexFacts {
    std::vector<double> thickness;
    std::vector<std::uint32_t> groups, masks;
    std::vector<std::uint8_t> moved;

    VertexFacts(Random& random, std::size_t vertices) {
        const double moves = random.chance(0.5) ? 0.1 : 0.6;
        for (std::size_t i = 0; i < vertices; ++i) {
            thickness.push_back(random.chance(0.3) ? 0 : random.uniform(0, 0.2));
            groups.push_back(1U << random.integer(0, 2));
            masks.push_back(static_cast<std::uint32_t>(random.integer(0, 7)) | 1U);
            moved.push_back(random.chance(moves) ? 1 : 0);
        }
        if (random.chance(0.3)) { // one thick vertex among thin ones
            std::fill(thickness.begin(), thickness.end(), random.chance(0.5) ? 0 : 0.01);
            thickness[std::size_t(random.integer(0, int(vertices) - 1))] = random.uniform(0.1, 1);
        }
        if (random.chance(0.3))
            thickness.clear();
        if (random.chance(0.5))
            groups.clear();
        if (random.chance(0.5))
            masks.clear();
        if (random.chance(0.4))
            moved.clear();
    }
    [[nodiscard]] NearVertices view() const { return {thickness, groups, masks, moved}; }
};

/// What the rules say of one feature.
struct FeatureFacts {
    double thickness = 0;
    std::uint32_t groups = 0, masks = ~0U;
    bool moved = false;

    FeatureFacts(const VertexFacts& facts, const std::vector<std::uint32_t>& vertices) {
        for (const std::uint32_t v : vertices) {
            if (!facts.thickness.empty() && facts.thickness[v] > thickness)
                thickness = facts.thickness[v];
            groups |= facts.groups.empty() ? 1 : facts.groups[v];
            masks &= facts.masks.empty() ? ~0U : facts.masks[v];
            moved = moved || (!facts.moved.empty() && facts.moved[v] == 1);
        }
    }
};

using PairKey = std::tuple<ElementaryKind, bool, std::uint32_t, std::uint32_t>;
PairKey key_of(const FeaturePair& p) {
    return {p.kind, p.face_first, p.a, p.b};
}

/// All pairs that the rules admit, by exact arithmetic.
std::vector<PairKey> expected_pairs(const MovingMesh& a, const MovingMesh& b,
                                    const VertexFacts& of_a, const VertexFacts& of_b,
                                    double distance, bool at_end,
                                    const std::vector<FeaturePair>& all) {
    std::vector<PairKey> keys;
    for (const FeaturePair& pair : all) {
        const std::size_t split = split_of(pair.kind);
        const std::vector<std::uint32_t> first(pair.vertices.begin(),
                                               pair.vertices.begin() + std::ptrdiff_t(split)),
            second(pair.vertices.begin() + std::ptrdiff_t(split), pair.vertices.end());
        const FeatureFacts f(pair.face_first ? of_b : of_a, first),
            g(pair.face_first ? of_a : of_b, second);
        const bool marked = !of_a.moved.empty() || !of_b.moved.empty();
        if ((f.groups & g.masks) == 0 || (g.groups & f.masks) == 0 ||
            (marked && !f.moved && !g.moved))
            continue;
        const auto points =
            points_of(pair, at_end ? a.end : a.mesh.positions, at_end ? b.end : b.mesh.positions);
        const double limit = distance + (f.thickness + g.thickness);
        if (ThicknessOracle({pair.kind, points, points}).within(limit, 0))
            keys.push_back(key_of(pair));
    }
    return keys;
}

TEST(NearPairs, OptionsAgainstExactArithmetic) {
    Random random(99);
    std::size_t all = 0, listed = 0, rounds_with_marks = 0;
    for (int round = 0; round < many(120); ++round) {
        const MovingMesh a = near_soup(random), b = near_soup(random);
        const VertexFacts of_a(random, a.mesh.positions.size()),
            of_b(random, b.mesh.positions.size());
        const double distance = random.chance(0.2) ? 0 : random.uniform(0, 0.3);
        const bool at_end = random.chance(0.5);
        const DeformableOptions lean{.lean = random.chance(0.3)};
        const Deformable first = a.deformable(lean), second = b.deformable(lean);
        rounds_with_marks += of_a.moved.empty() ? 0 : 1;
        const auto check = [&](const std::vector<FeaturePair>& found,
                               const std::vector<PairKey>& expected) {
            std::vector<PairKey> keys(found.size());
            std::transform(found.begin(), found.end(), keys.begin(), key_of);
            ASSERT_EQ(keys, expected);
            listed += keys.size();
        };
        // Everything is within a large distance.
        const auto own = self_within(first, 100, {.at_end = at_end});
        const auto both = within(first, second, 100, {.at_end = at_end});
        all += own.size() + both.size();
        ASSERT_NO_FATAL_FAILURE(
            check(self_within(first, distance, {.at_end = at_end, .vertices = of_a.view()}),
                  expected_pairs(a, a, of_a, of_a, distance, at_end, own)));
        ASSERT_NO_FATAL_FAILURE(
            check(within(first, second, distance,
                         {.at_end = at_end, .vertices = of_a.view(), .vertices_b = of_b.view()}),
                  expected_pairs(a, b, of_a, of_b, distance, at_end, both)));
    }
    std::cout << listed << " of " << all << " pairs listed, " << rounds_with_marks
              << " rounds with marks\n";
    EXPECT_GT(listed, all / 50);
    EXPECT_LT(listed, all / 2);
    EXPECT_GT(rounds_with_marks, std::size_t(many(120)) / 3);
}

/// A larger surface, whose hierarchy has many leaves: the marks select pairs of the full list.
TEST(NearPairs, MovedVerticesOfASheet) {
    Random random(5);
    std::size_t all = 0, listed = 0;
    for (int round = 0; round < many(12); ++round) {
        const MovingMesh sheet = crumpled_sheet(random, 12);
        std::vector<std::uint8_t> moved(sheet.mesh.positions.size(), 0);
        for (int i = random.integer(1, 12); i > 0; --i)
            moved[std::size_t(random.integer(0, int(moved.size()) - 1))] = 1;
        for (const bool at_end : {false, true}) {
            const Deformable surface = sheet.deformable();
            std::vector<FeaturePair> expected;
            for (const FeaturePair& pair : self_within(surface, 0.05, {.at_end = at_end})) {
                ++all;
                for (const std::uint32_t v : pair.vertices)
                    if (moved[v] == 1) {
                        expected.push_back(pair);
                        break;
                    }
            }
            listed += expected.size();
            ASSERT_EQ(self_within(surface, 0.05, {.at_end = at_end, .vertices = {.moved = moved}}),
                      expected);
        }
    }
    std::cout << listed << " of " << all << " pairs have a vertex that moved\n";
    EXPECT_GT(listed, all / 40);
    EXPECT_LT(listed, all / 2);
}

/// A surface at rest: every impact within a thickness is a pair within that distance. Impacts may be
/// farther apart by the excess that ElementaryOptions allows.
TEST(NearPairs, NeverFewerThanImpactsWithAThickness) {
    Random random(31);
    std::size_t impacts_seen = 0, excess = 0;
    for (int round = 0; round < many(40); ++round) {
        MovingMesh moving = round % 3 == 0 ? crumpled_sheet(random, 8) : near_soup(random);
        moving.end = moving.mesh.positions;
        const Deformable surface = moving.deformable();
        const double thickness = random.uniform(0.01, 0.2);
        std::vector<PairKey> near;
        for (const FeaturePair& pair : self_within(surface, thickness))
            near.push_back(key_of(pair));
        for (const FeatureImpact& impact : self_impacts(surface, {.thickness = thickness}).list) {
            ++impacts_seen;
            ASSERT_EQ(impact.time, 0);
            const PairKey key{impact.kind, impact.face_first, impact.a, impact.b};
            if (std::binary_search(near.begin(), near.end(), key))
                continue;
            ++excess;
            bool is_within_excess = false;
            for (const FeaturePair& pair : self_within(surface, (1 + 1e-6) * thickness + 1e-11))
                is_within_excess = is_within_excess || key_of(pair) == key;
            ASSERT_TRUE(is_within_excess);
        }
    }
    std::cout << impacts_seen << " impacts, " << excess << " of them beyond the thickness\n";
    EXPECT_GT(impacts_seen, std::size_t(many(40)) * 10);
    EXPECT_LT(excess, impacts_seen / 100);
}

/// The filter says nothing wrong, is the same with any SIMD target, and decides most pairs.
TEST(NearPairs, FilterAgainstExactArithmetic) {
    Random random(64);
    std::size_t cases = 0, near = 0, undecided = 0, in_general = 0, undecided_in_general = 0;
    for (int round = 0; round < many(2500); ++round) {
        NearBatch batch;
        std::array<ElementaryPair, NearBatch::kLanes> pairs;
        const ElementaryKind kind = any_kind(random);
        const bool general = random.chance(0.6);
        for (std::size_t lane = 0; lane < NearBatch::kLanes; ++lane) {
            ElementaryPair& pair = pairs[lane];
            pair.kind = kind;
            const double scale = random.chance(0.2) ? std::ldexp(1, random.integer(-1000, 900)) : 1;
            for (Vec3& p : pair.start)
                p = scale * (general ? random.in_cube() : random.on_lattice(2));
            pair.end = pair.start;
            // Half of the limits are the distance itself, nudged.
            double limit = scale * random.uniform(0, general ? 0.5 : 1.5);
            if (!general && random.chance(0.5)) {
                limit = static_cast<double>(true_distance(kind, pair.start));
                limit = std::max(0.0, random.nudge(limit, 3));
            }
            batch.set(lane, pair.start, limit);
        }
        const NearBits bits = near_filter(batch, kind);
        ASSERT_EQ(bits.certain & ~bits.possible, 0U);
        for (std::size_t lane = 0; lane < NearBatch::kLanes; ++lane) {
            const bool is_near = ThicknessOracle(pairs[lane]).within(batch.limit[lane], 0);
            const bool possible = (bits.possible >> lane & 1) != 0,
                       certain = (bits.certain >> lane & 1) != 0;
            ASSERT_TRUE(is_near ? possible : !certain);
            ++cases;
            near += is_near ? 1 : 0;
            undecided += possible && !certain ? 1 : 0;
            in_general += general ? 1 : 0;
            undecided_in_general += general && possible && !certain ? 1 : 0;
        }
        if (round % 8 == 0)
            for_each_simd_target([&](const std::string& name) {
                // Fused operations round less: what is undecided may differ.
                const NearBits other = near_filter(batch, kind);
                ASSERT_EQ(other.certain & ~bits.possible, 0U) << name;
                ASSERT_EQ(bits.certain & ~other.possible, 0U) << name;
            });
        const NearBits reference = near_filter_reference(batch, kind);
        ASSERT_EQ(reference.certain & ~bits.possible, 0U);
        ASSERT_EQ(bits.certain & ~reference.possible, 0U);
    }
    std::cout << cases << " pairs, " << near << " near, " << undecided << " undecided; "
              << undecided_in_general << " of " << in_general << " in general position\n";
    EXPECT_GT(near, cases / 5);
    EXPECT_LT(near, cases * 4 / 5);
    EXPECT_LT(undecided, cases / 3); // a quarter, about
    EXPECT_LT(undecided_in_general, in_general / 10);
}

} // namespace
} // namespace abut::test
