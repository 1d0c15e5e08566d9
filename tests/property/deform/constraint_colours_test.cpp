// Colours of constraints: no two of a colour share a vertex that moves, and there are not many.

#include <abut/constraint_colours.h>
#include <abut/error.h>

#include "tests/support/moving_meshes.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <iostream>
#include <set>
#include <vector>

namespace abut::test {
namespace {

using Vertices = std::vector<std::uint32_t>; ///< of a constraint

/// Every constraint has one colour; those of a colour share no moving vertex; no constraint could
/// have had an earlier colour; and the number of colours is within its bounds.
void check_colours(const ConstraintColours& colours, const std::vector<Vertices>& constraints,
                   const std::vector<std::uint8_t>& fixed) {
    ASSERT_EQ(colours.order.size(), constraints.size());
    ASSERT_EQ(colours.begins.back(), constraints.size());
    std::vector<std::size_t> colour_of(constraints.size(), colours.count());
    const auto moves = [&](std::uint32_t v) { return fixed.empty() || fixed[v] == 0; };
    for (std::size_t colour = 0; colour < colours.count(); ++colour) {
        const auto list = colours.of(colour);
        ASSERT_FALSE(list.empty());
        ASSERT_TRUE(std::is_sorted(list.begin(), list.end()));
        std::set<std::uint32_t> used;
        for (const std::uint32_t i : list) {
            ASSERT_EQ(colour_of[i], colours.count());
            colour_of[i] = colour;
            const std::set<std::uint32_t> own(constraints[i].begin(), constraints[i].end());
            for (const std::uint32_t v : own) {
                ASSERT_TRUE(!moves(v) || used.insert(v).second);
            }
        }
    }
    std::size_t most = 0, largest_degree = 0, slots = 0;
    std::vector<std::size_t> degree(1000, 0);
    for (std::size_t i = 0; i < constraints.size(); ++i) {
        most = std::max(most, colour_of[i]);
        slots = std::max(slots, constraints[i].size());
        const std::set<std::uint32_t> own(constraints[i].begin(), constraints[i].end());
        for (const std::uint32_t v : own)
            if (moves(v))
                largest_degree = std::max(largest_degree, ++degree[v]);
        // Each earlier colour is that of an earlier constraint that shares a vertex.
        std::set<std::size_t> earlier;
        for (std::size_t k = 0; k < i; ++k)
            for (const std::uint32_t v : constraints[k])
                if (moves(v) && own.contains(v))
                    earlier.insert(colour_of[k]);
        for (std::size_t colour = 0; colour < colour_of[i]; ++colour)
            ASSERT_TRUE(earlier.contains(colour));
    }
    if (!constraints.empty()) {
        ASSERT_LT(most, colours.count());
        ASSERT_GE(colours.count(), largest_degree);
        ASSERT_LE(colours.count(), slots * (std::max<std::size_t>(largest_degree, 1) - 1) + 1);
    }
}

template <std::size_t N>
void check_random(Random& random, std::size_t& most_colours, std::size_t& shared) {
    const int vertices = random.chance(0.1) ? random.integer(1, 3) : random.integer(4, 60),
              count = random.integer(0, 180);
    std::vector<std::array<std::uint32_t, N>> constraints(static_cast<std::size_t>(count));
    std::vector<Vertices> lists;
    for (auto& constraint : constraints) {
        for (std::uint32_t& v : constraint)
            v = static_cast<std::uint32_t>(random.integer(0, vertices - 1));
        lists.emplace_back(constraint.begin(), constraint.end());
    }
    std::vector<std::uint8_t> fixed;
    if (random.chance(0.5))
        for (int v = 0; v < vertices; ++v)
            fixed.push_back(random.chance(0.3) ? 1 : 0);
    const ConstraintColours colours = colour_constraints(constraints, fixed);
    ASSERT_NO_FATAL_FAILURE(check_colours(colours, lists, fixed));
    most_colours = std::max(most_colours, colours.count());
    shared += colours.count() > 1 ? 1 : 0;
}

TEST(ConstraintColours, OfRandomConstraints) {
    Random random(31);
    std::size_t most = 0, shared = 0;
    for (int round = 0; round < many(100); ++round) {
        ASSERT_NO_FATAL_FAILURE(check_random<2>(random, most, shared));
        ASSERT_NO_FATAL_FAILURE(check_random<3>(random, most, shared));
        ASSERT_NO_FATAL_FAILURE(check_random<4>(random, most, shared));
    }
    std::cout << "at most " << most << " colours; " << shared << " lists with more than one\n";
    EXPECT_GT(most, 128U); // more than two rounds of 64 colours
    EXPECT_GT(shared, std::size_t(many(100)));
}

TEST(ConstraintColours, OfPairsOfOneSurfaceAndOfTwo) {
    Random random(32);
    std::size_t pairs_seen = 0, face_first = 0;
    for (int round = 0; round < many(30); ++round) {
        const Deformable a = crumpled_sheet(random, 4).deformable(),
                         b = crumpled_sheet(random, 4).deformable();
        const auto self = self_within(a, 0.1);
        std::vector<Vertices> lists;
        lists.reserve(self.size());
        for (const FeaturePair& pair : self)
            lists.emplace_back(pair.vertices.begin(), pair.vertices.end());
        ASSERT_NO_FATAL_FAILURE(check_colours(colour_constraints(self), lists, {}));

        const auto two = within(a, b, 0.1);
        const auto offset = static_cast<std::uint32_t>(a.vertex_count());
        lists.clear();
        for (const FeaturePair& pair : two) {
            const std::uint32_t split = pair.kind == ElementaryKind::edge_edge ? 2 : 1;
            Vertices list(pair.vertices.begin(), pair.vertices.end());
            for (std::uint32_t i = 0; i < 4; ++i)
                if ((i < split) == pair.face_first)
                    list[i] += offset;
            lists.push_back(list);
            face_first += pair.face_first ? 1 : 0;
        }
        // The second surface is an obstacle.
        std::vector<std::uint8_t> fixed(a.vertex_count() + b.vertex_count(), 0);
        std::fill(fixed.begin() + offset, fixed.end(), std::uint8_t{1});
        ASSERT_NO_FATAL_FAILURE(
            check_colours(colour_constraints(two, a.vertex_count()), lists, {}));
        ASSERT_NO_FATAL_FAILURE(
            check_colours(colour_constraints(two, a.vertex_count(), fixed), lists, fixed));
        pairs_seen += self.size() + two.size();
    }
    std::cout << pairs_seen << " pairs\n";
    EXPECT_GT(pairs_seen, 1000U);
    EXPECT_GT(face_first, 50U);
}

TEST(ConstraintColours, EdgesOfAFanHaveAColourEach) {
    std::vector<std::array<std::uint32_t, 2>> spokes;
    for (std::uint32_t i = 1; i <= 200; ++i)
        spokes.push_back({0, i});
    EXPECT_EQ(colour_constraints(spokes).count(), 200U);
    std::vector<std::uint8_t> fixed(201, 0);
    fixed[0] = 1;
    EXPECT_EQ(colour_constraints(spokes, fixed).count(), 1U);
    EXPECT_EQ(colour_constraints(std::span(spokes).first(0)), ConstraintColours());
}

TEST(ConstraintColours, Errors) {
    const auto fails = [](const auto& query) {
        try {
            query();
        } catch (const Error& error) {
            return error.code() == ErrorCode::bad_argument;
        }
        return false;
    };
    const std::vector<std::array<std::uint32_t, 2>> edges{{0, 3}}, beyond{{0, 1U << 31}};
    const std::vector<std::uint8_t> three(3, 0), four(4, 0);
    EXPECT_TRUE(fails([&] { colour_constraints(edges, three); }));
    EXPECT_FALSE(fails([&] { colour_constraints(edges, four); }));
    EXPECT_TRUE(fails([&] { colour_constraints(beyond); }));
    FeaturePair pair;
    pair.vertices = {4, 0, 1, 2};
    const std::vector<FeaturePair> pairs{pair};
    EXPECT_TRUE(fails([&] { colour_constraints(pairs, 4); }));
    EXPECT_TRUE(fails([&] { colour_constraints(pairs, std::size_t{0}); }));
    EXPECT_FALSE(fails([&] { colour_constraints(pairs, 5); }));
}

} // namespace
} // namespace abut::test
