// Two frames of a cloth that folds hard: every pair of features that meets between them is found,
// and no other. The truth is computed in integers, so nothing need be beside the checkout.

#include <abut/deformable.h>
#include <abut/elementary_impact.h>
#include <abut/progress.h>

#include "tests/support/ccd_cases.h"
#include "tests/support/folded_frames.h"
#include "tests/support/oracle/edge_face_truth.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <iostream>

namespace abut::test {
namespace {

class FoldedFrames : public testing::TestWithParam<FrameNumbers> {
protected:
    Random random_{4211 + static_cast<std::uint64_t>(GetParam())};
    // On the lattice the truth costs less.
    MovingMesh moving_ =
        folded_sheet(random_, GetParam() == FrameNumbers::lattice ? 12 : 9, GetParam());
};

TEST_P(FoldedFrames, EveryTrueImpactAndNoOther) {
    const SymbolicTruth truth(moving_);
    std::cout << truth.pairs.size() << " pairs, " << truth.counts.vertex_face << " vertex-face and "
              << truth.counts.edge_edge << " edge-edge impacts, " << truth.near_misses
              << " near misses\n";
    EXPECT_GT(truth.counts.vertex_face, 60U);
    EXPECT_GT(truth.counts.edge_edge, 250U);
    EXPECT_GT(truth.near_misses, 2500U);

    const auto single = elementary_impacts(truth.pairs);
    std::size_t by_integers = 0;
    for (std::size_t i = 0; i < single.size(); ++i) {
        ASSERT_EQ(single[i].meet, truth.meets[i]) << truth.pairs[i];
        by_integers += single[i].decided_by == ElementaryStage::exact ? 1 : 0;
    }
    std::cout << by_integers << " decided by integers\n";
    EXPECT_GT(by_integers, 30U);

    const auto earliest = std::min_element(
        truth.impacts.begin(), truth.impacts.end(),
        [](const TrueImpact& a, const TrueImpact& b) { return a.first.high < b.first.high; });
    for (const Scheme scheme : {Scheme::representative, Scheme::database, Scheme::markup,
                                Scheme::basic, Scheme::features, Scheme::pairwise}) {
        SCOPED_TRACE(static_cast<int>(scheme));
        const Deformable surface = moving_.deformable({.scheme = scheme});
        const Impacts found = self_impacts(surface);
        ASSERT_EQ(found.list.size(), truth.impacts.size());
        for (std::size_t i = 0; i < found.list.size(); ++i) {
            const auto& [ids, first] = truth.impacts[i];
            ASSERT_EQ(list_order(found.list[i]), list_order(ids));
            EXPECT_EQ(found.list[i].status, Status::exact);
            EXPECT_LE(found.list[i].time, first.high);
            EXPECT_GE(found.list[i].time, first.low - 1e-9);
        }
        EXPECT_FALSE(is_free_of_self_impacts(surface));
        const auto first = self_time_of_impact(surface);
        ASSERT_TRUE(first.has_value());
        EXPECT_LE(first->time, earliest->first.high);
        EXPECT_GE(first->time, earliest->first.low - 1e-9);
    }
}

TEST_P(FoldedFrames, EveryEdgeThroughAFaceAtRest) {
    const Mesh& mesh = moving_.mesh;
    const Deformable surface(mesh);
    const auto found = self_intersections(surface);
    std::size_t pairs = 0, crossing = 0, touching = 0;
    auto next = found.begin();
    for (std::uint32_t e = 0; e < surface.edges().size(); ++e)
        for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
            const auto& [v, w] = surface.edges()[e];
            const auto& t = mesh.triangles[f];
            if (std::find(t.begin(), t.end(), v) != t.end() ||
                std::find(t.begin(), t.end(), w) != t.end())
                continue;
            const auto& at = mesh.positions;
            Box3 edge, face;
            extend(edge, at[v]), extend(edge, at[w]);
            for (const std::uint32_t k : t)
                extend(face, at[k]);
            const bool apart = edge.lower.x > face.upper.x || face.lower.x > edge.upper.x ||
                               edge.lower.y > face.upper.y || face.lower.y > edge.upper.y ||
                               edge.lower.z > face.upper.z || face.lower.z > edge.upper.z;
            const auto contact =
                apart ? std::nullopt : true_contact(at[v], at[w], {at[t[0]], at[t[1]], at[t[2]]});
            const bool listed = next != found.end() && next->edge == e && next->face == f;
            ASSERT_EQ(listed, contact.has_value()) << e << ' ' << f;
            pairs += apart ? 0 : 1;
            if (!listed)
                continue;
            ASSERT_EQ(next->contact, *contact) << e << ' ' << f;
            ++(*contact == EdgeFaceContact::crossing ? crossing : touching);
            ++next;
        }
    EXPECT_EQ(next, found.end());
    std::cout << pairs << " pairs, " << crossing << " cross, " << touching << " touch\n";
    EXPECT_GT(crossing, 100U);
    if (GetParam() == FrameNumbers::lattice) { // rounding parts the others
        EXPECT_GT(touching, 10U);
    }
}

INSTANTIATE_TEST_SUITE_P(Numbers, FoldedFrames,
                         testing::Values(FrameNumbers::lattice, FrameNumbers::floats,
                                         FrameNumbers::far),
                         testing::PrintToStringParamName());

} // namespace
} // namespace abut::test
