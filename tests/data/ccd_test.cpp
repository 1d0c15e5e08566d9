// Elementary tests with known answers: single queries, and all colliding pairs of features between
// two frames of a simulation.

#include <abut/elementary_impact.h>

#include "tests/data/ccd_frames.h"
#include "tests/support/ccd_cases.h"
#include "tests/support/oracle/ccd_oracle.h"
#include "tests/support/paths.h"

#include <filesystem>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

std::string in_ccd(const std::string& name) {
    return std::string(ABUT_SHARED_DATA) + "/ccd/" + name;
}

class Queries : public testing::Test {
protected:
    std::vector<ElementaryPair> pairs_;
    std::vector<bool> truth_;

    void SetUp() override {
        if (!std::filesystem::exists(in_ccd("queries")))
            GTEST_SKIP() << in_ccd("queries") << " is not there";
        for (const auto& entry : std::filesystem::directory_iterator(in_ccd("queries"))) {
            const auto queries = read_elementary_queries(entry.path().string());
            ASSERT_EQ(queries.pairs.size(), queries.truth.size()) << entry.path();
            pairs_.insert(pairs_.end(), queries.pairs.begin(), queries.pairs.end());
            truth_.insert(truth_.end(), queries.truth.begin(), queries.truth.end());
        }
    }
};

TEST_F(Queries, ExactFindsEveryImpactAndNoOther) {
    EXPECT_EQ(pairs_.size(), 3324U);
    const auto impacts = elementary_impacts(pairs_);
    for (std::size_t i = 0; i < pairs_.size(); ++i)
        EXPECT_EQ(impacts[i].meet, truth_[i]) << pairs_[i];
}

TEST_F(Queries, ConservativeMissesNone) {
    for (const double delta : {1e-9, 1e-6, 1e-3}) {
        const auto impacts = elementary_impacts(pairs_, {.absolute_error = delta});
        for (std::size_t i = 0; i < pairs_.size(); ++i)
            EXPECT_TRUE(impacts[i].meet || !truth_[i]) << pairs_[i];
    }
}

TEST_F(Queries, MutatedQueriesAgainstTheOracle) {
    Random random(721);
    int hits = 0, exact = 0;
    for (const ElementaryPair& original : pairs_) {
        const ElementaryPair pair = mutated(random, original);
        const auto truth = CcdOracle<AnyInt>(pair).first();
        const ElementaryImpact impact = elementary_impact(pair);
        ASSERT_EQ(impact.meet, truth.has_value()) << pair;
        hits += impact.meet ? 1 : 0;
        exact += impact.decided_by == ElementaryStage::exact ? 1 : 0;
        if (!truth)
            continue;
        EXPECT_LE(impact.time, truth->high) << pair;
        EXPECT_GE(impact.time, truth->low - 1e-9) << pair;
    }
    std::cout << pairs_.size() << " cases, " << hits << " hits, " << exact << " decided exactly\n";
    EXPECT_GT(hits, 300);
    EXPECT_GT(exact, 100);
}

struct FramePair {
    std::string start, end;
    std::size_t edge_edge, vertex_face; ///< that collide
};

class Frames : public testing::TestWithParam<FramePair> {};

TEST_P(Frames, EveryTrueImpactAndNoNearMiss) {
    const auto& [start, end, edge_edge, vertex_face] = GetParam();
    if (!std::filesystem::exists(in_ccd("frames/" + start + ".ply")))
        GTEST_SKIP() << in_ccd("frames") << " is not there";
    const CcdFrames frames(in_ccd("frames/" + start + ".ply"), in_ccd("frames/" + end + ".ply"));
    for (const auto kind : {ElementaryKind::edge_edge, ElementaryKind::vertex_face}) {
        const bool edges = kind == ElementaryKind::edge_edge;
        const auto truth =
            frames.read_truth(in_ccd("truth/" + start + (edges ? "-ee" : "-vf")), kind);
        const auto impacts = elementary_impacts(truth.pairs);
        std::size_t hits = 0, by_integers = 0;
        for (std::size_t i = 0; i < impacts.size(); ++i) {
            ASSERT_EQ(impacts[i].meet, truth.collides[i]) << truth.pairs[i];
            hits += impacts[i].meet ? 1 : 0;
            by_integers += impacts[i].decided_by == ElementaryStage::exact ? 1 : 0;
        }
        EXPECT_EQ(hits, edges ? edge_edge : vertex_face);
        std::cout << hits << " impacts, " << by_integers << " decided by integers\n";
    }
}

INSTANTIATE_TEST_SUITE_P(Simulations, Frames,
                         testing::Values(FramePair{"cloth-ball-92", "cloth-ball-93", 94822, 19032},
                                         FramePair{"balls16-18", "balls16-19", 41031, 9459}));

} // namespace
} // namespace abut::test
