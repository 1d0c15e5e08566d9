// Near pairs of surfaces with vertices of different thickness: none is lost, and a thick vertex
// costs what is near it. Each test prints its seed and what it has seen.

#include <abut/deformable.h>

#include "deform/rest/rest_search.h"
#include "tests/support/moving_meshes.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <iostream>
#include <span>
#include <tuple>
#include <vector>

namespace abut::test {
namespace {

double thickest(std::span<const std::uint32_t> vertices, const std::vector<double>& thickness) {
    double most = 0;
    for (const std::uint32_t v : vertices)
        most = std::max(most, thickness[v]);
    return most;
}

/// The limit of a pair by the thickness of the vertices of both features.
double limit_of(const FeaturePair& pair, double distance, const std::vector<double>& a,
                const std::vector<double>& b) {
    const std::span<const std::uint32_t> vertices(pair.vertices);
    const std::size_t split = pair.kind == ElementaryKind::edge_edge ? 2 : 1;
    return distance + (thickest(vertices.first(split), pair.face_first ? b : a) +
                       thickest(vertices.subspan(split), pair.face_first ? a : b));
}

/// A few thick vertices among thin ones. With some, all others have the same thickness.
std::vector<double> few_thick(Random& random, std::size_t vertices, int most) {
    std::vector<double> thickness(vertices, random.chance(0.5) ? 0 : random.uniform(0, 0.02));
    for (int i = random.integer(0, most); i > 0; --i)
        thickness[std::size_t(random.integer(0, int(vertices) - 1))] = random.uniform(0, 0.6);
    return thickness;
}

/// The pairs of `all`, which is listed with one thickness for all vertices, that are near with
/// their own. Distances are rounded, so no pair is to be nearer to its limit than that.
std::vector<FeaturePair> select(const std::vector<FeaturePair>& all, double distance,
                                const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<FeaturePair> near;
    for (FeaturePair pair : all) {
        pair.limit = limit_of(pair, distance, a, b);
        EXPECT_TRUE(pair.distance == 0 || std::abs(pair.distance - pair.limit) > 1e-13);
        if (pair.distance <= pair.limit)
            near.push_back(pair);
    }
    return near;
}

TEST(ThickVertices, OneOfASheetAgainstOneThicknessForAll) {
    Random random(2026);
    std::size_t all = 0, listed = 0, thick = 0, two = 0;
    for (int round = 0; round < many(8); ++round) {
        const MovingMesh sheet = crumpled_sheet(random, random.integer(4, 9)),
                         other = crumpled_sheet(random, random.integer(4, 9));
        const DeformableOptions lean{.lean = random.chance(0.3)};
        const Deformable a = sheet.deformable(lean), b = other.deformable(lean);
        const std::vector<double> of_a = few_thick(random, a.vertex_count(), 2),
                                  of_b = few_thick(random, b.vertex_count(), 2);
        const double distance = random.chance(0.3) ? 0 : random.uniform(0, 0.03);
        const bool at_end = random.chance(0.5);
        const double most = *std::max_element(of_a.begin(), of_a.end()),
                     most_b = *std::max_element(of_b.begin(), of_b.end());
        const auto own = self_within(a, distance + 2 * most, {.at_end = at_end});
        const auto found =
            self_within(a, distance, {.at_end = at_end, .vertices = {.thickness = of_a}});
        ASSERT_EQ(found, select(own, distance, of_a, of_a));
        const auto both = within(a, b, distance + most + most_b, {.at_end = at_end});
        const auto found_of_two = within(
            a, b, distance,
            {.at_end = at_end, .vertices = {.thickness = of_a}, .vertices_b = {.thickness = of_b}});
        ASSERT_EQ(found_of_two, select(both, distance, of_a, of_b));
        all += own.size() + both.size();
        listed += found.size() + found_of_two.size();
        two += found_of_two.size();
        for (const FeaturePair& pair : found)
            thick += pair.distance > distance + 2 * of_a[0] + 1e-12 ? 1 : 0;
    }
    std::cout << listed << " of " << all << " pairs listed, " << two << " of two surfaces, "
              << thick << " by a thick vertex\n";
    EXPECT_GT(listed, all / 100);
    EXPECT_LT(listed, all / 2);
    EXPECT_GT(two, listed / 20);
    EXPECT_GT(thick, listed / 20);
}

/// With marks of moved vertices too: the marks select pairs of the full list.
TEST(ThickVertices, MarksSelectPairs) {
    Random random(7);
    std::size_t all = 0, listed = 0;
    for (int round = 0; round < many(8); ++round) {
        const MovingMesh sheet = crumpled_sheet(random, 9);
        const Deformable surface = sheet.deformable();
        const std::vector<double> thickness = few_thick(random, surface.vertex_count(), 3);
        std::vector<std::uint8_t> moved(surface.vertex_count(), 0);
        for (int i = random.integer(1, 8); i > 0; --i)
            moved[std::size_t(random.integer(0, int(moved.size()) - 1))] = 1;
        std::vector<FeaturePair> expected;
        for (const FeaturePair& pair :
             self_within(surface, 0.02, {.vertices = {.thickness = thickness}})) {
            ++all;
            if (std::any_of(pair.vertices.begin(), pair.vertices.end(),
                            [&](std::uint32_t v) { return moved[v] == 1; }))
                expected.push_back(pair);
        }
        listed += expected.size();
        ASSERT_EQ(
            self_within(surface, 0.02, {.vertices = {.thickness = thickness, .moved = moved}}),
            expected);
    }
    std::cout << listed << " of " << all << " pairs have a vertex that moved\n";
    EXPECT_GT(listed, all / 40);
    EXPECT_LT(listed, all / 2);
}

/// A sink of candidate pairs that counts them.
struct CandidateCount {
    std::size_t pairs = 0;
    void add(PairKind /*kind*/, FeatureIds /*ids*/, bool wanted) { pairs += wanted ? 1 : 0; }
    static bool is_done() { return false; }
};

std::size_t candidates(const Deformable& surface, double distance,
                       const std::vector<double>& thickness) {
    const RestSearch search(surface.data(), surface.data(), StepEnd::start, distance,
                            {.thickness = thickness}, {});
    CandidateCount count;
    for (std::size_t task = 0; task < search.tasks(); ++task)
        search.run(task, count);
    return count.pairs;
}

/// Where the search widens all boxes by the greatest thickness, one thick vertex has all pairs of
/// features within twice that tested: here some two million.
TEST(ThickVertices, OneCostsNoMoreThanWhatIsNearIt) {
    constexpr std::uint32_t kSide = 48;
    Mesh mesh;
    for (std::uint32_t i = 0; i <= kSide; ++i)
        for (std::uint32_t j = 0; j <= kSide; ++j)
            mesh.positions.push_back({double(i), double(j), 0.2 * std::sin(0.3 * i + 0.2 * j)});
    for (std::uint32_t i = 0; i < kSide; ++i)
        for (std::uint32_t j = 0; j < kSide; ++j) {
            const std::uint32_t at = i * (kSide + 1) + j;
            mesh.triangles.push_back({at, at + kSide + 1, at + 1});
            mesh.triangles.push_back({at + 1, at + kSide + 1, at + kSide + 2});
        }
    const Deformable surface(mesh);
    std::vector<double> thickness(surface.vertex_count(), 0.1);
    const std::size_t thin = candidates(surface, 0.1, thickness);
    EXPECT_EQ(thin, candidates(surface, 0.3, {}));
    thickness[thickness.size() / 2] = 8;
    const std::size_t pairs =
        self_within(surface, 0.1, {.vertices = {.thickness = thickness}}).size();
    const std::size_t one_thick = candidates(surface, 0.1, thickness);
    std::cout << thin << " candidates of a thin sheet, " << one_thick << " with one thick vertex, "
              << pairs << " pairs\n";
    EXPECT_GT(pairs, 5000U);
    EXPECT_GE(one_thick, pairs);
    // The leaves of the thick vertex have some more features than it has itself.
    EXPECT_LT(one_thick, thin + 20 * pairs);
}

} // namespace
} // namespace abut::test
