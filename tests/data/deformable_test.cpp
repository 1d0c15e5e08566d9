// Steps of simulations with all colliding pairs of features known, through the library and the
// command.

#include <abut/broad_phase.h>
#include <abut/deformable.h>
#include <abut/frame.h>

#include "tests/command/impact_file.h"
#include "tests/command/run_command.h"
#include "tests/data/ccd_frames.h"
#include "tests/support/oracle/edge_face_truth.h"
#include "tests/support/paths.h"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <iostream>

namespace abut::test {
namespace {

struct KnownStep {
    std::string start, end;
    std::size_t edge_edge, vertex_face; ///< that collide
    std::size_t at_rest;                ///< edges and faces that share a point in the first frame
};

class Deforming : public testing::TestWithParam<KnownStep> {
protected:
    using Pairs = std::vector<std::array<std::uint32_t, 2>>;

    KnownStep step_ = GetParam();
    std::string start_ = in_ccd("frames/" + step_.start + ".ply"),
                end_ = in_ccd("frames/" + step_.end + ".ply");

    void SetUp() override {
        if (!std::filesystem::exists(start_))
            GTEST_SKIP() << start_ << " is not there";
    }
    static std::string in_ccd(const std::string& name) {
        return std::string(ABUT_SHARED_DATA) + "/ccd/" + name;
    }
    /// The pairs that collide, sorted.
    [[nodiscard]] Pairs truth(ElementaryKind kind) const {
        const std::string stem =
            "truth/" + step_.start + (kind == ElementaryKind::edge_edge ? "-ee" : "-vf");
        const auto listed = CcdFrames(start_, end_).read_truth(in_ccd(stem), kind);
        Pairs pairs;
        for (std::size_t i = 0; i < listed.features.size(); ++i)
            if (listed.collides[i])
                pairs.push_back(listed.features[i]);
        std::sort(pairs.begin(), pairs.end());
        return pairs;
    }
};

TEST_P(Deforming, EverySchemeFindsEveryTruePairAndNoOther) {
    const Pairs edge_edge = truth(ElementaryKind::edge_edge),
                vertex_face = truth(ElementaryKind::vertex_face);
    ASSERT_EQ(edge_edge.size(), step_.edge_edge);
    ASSERT_EQ(vertex_face.size(), step_.vertex_face);
    const Mesh start = read_frame(start_), end = read_frame(end_);
    for (const Scheme scheme : {Scheme::representative, Scheme::database, Scheme::markup,
                                Scheme::basic, Scheme::features, Scheme::pairwise}) {
        SCOPED_TRACE(static_cast<int>(scheme));
        Deformable surface(start, {.scheme = scheme});
        surface.advance(end.positions);
        Pairs found_edge_edge, found_vertex_face;
        for (const FeatureImpact& impact : self_impacts(surface).list) {
            EXPECT_EQ(impact.status, Status::exact);
            (impact.kind == ElementaryKind::edge_edge ? found_edge_edge : found_vertex_face)
                .push_back({impact.a, impact.b});
        }
        EXPECT_TRUE(found_edge_edge == edge_edge) << found_edge_edge.size() << " found";
        EXPECT_TRUE(found_vertex_face == vertex_face) << found_vertex_face.size() << " found";
    }
}

TEST_P(Deforming, TheCommandWritesTheTruePairs) {
    const TemporaryFolder folder;
    const std::string out = folder / "impacts.bin";
    const Outcome outcome = run_abut({"ccd", start_, end_, "--json", "--out", out});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto report = outcome.json();
    ASSERT_EQ(report["steps"].size(), 1U);
    EXPECT_EQ(report["steps"][0]["edge_edge"], step_.edge_edge);
    EXPECT_EQ(report["steps"][0]["vertex_face"], step_.vertex_face);
    Deformable surface(read_frame(start_));
    surface.advance(read_frame(end_).positions);
    const Impacts impacts = self_impacts(surface);
    const auto written = read_impacts(out);
    ASSERT_EQ(written.size(), impacts.list.size());
    for (std::size_t i = 0; i < written.size(); ++i)
        ASSERT_EQ(written[i], (WrittenImpact{0, impacts.list[i]})) << i;
}

/// Calls visit(edge, face) for every edge and face of a mesh whose boxes overlap.
template <typename Visit>
void for_each_near_edge_and_face(const std::vector<std::array<std::uint32_t, 2>>& edges,
                                 const Mesh& mesh, const Visit& visit) {
    std::vector<Box3> boxes;
    const auto add = [&](const auto& vertices) {
        Box3 box;
        for (const std::uint32_t v : vertices)
            extend(box, mesh.positions[v]);
        boxes.push_back(box);
    };
    for (const auto& edge : edges)
        add(edge);
    for (const auto& triangle : mesh.triangles)
        add(triangle);
    const auto count = static_cast<std::uint32_t>(edges.size());
    for (const IndexPair pair :
         overlapping_boxes(boxes, 0, [&](auto i, auto k) { return i < count && k >= count; }))
        visit(pair.a(), pair.b() - count);
}

TEST_P(Deforming, EveryEdgeThroughAFaceAtRest) {
    const Mesh mesh = read_frame(start_);
    const Deformable surface(mesh);
    const auto found = self_intersections(surface);
    EXPECT_EQ(found.size(), step_.at_rest);
    std::size_t met = 0, pairs = 0;
    for_each_near_edge_and_face(surface.edges(), mesh, [&](std::uint32_t e, std::uint32_t f) {
        const std::uint32_t v = surface.edges()[e][0], w = surface.edges()[e][1];
        const auto& face = mesh.triangles[f];
        if (std::any_of(face.begin(), face.end(), [&](auto i) { return i == v || i == w; }))
            return;
        ++pairs;
        // The pairs are not visited in the list's order.
        const auto listed = std::lower_bound(found.begin(), found.end(), std::pair(e, f),
                                             [](const auto& each, const auto& key) {
                                                 return std::pair(each.edge, each.face) < key;
                                             });
        const bool is_listed = listed != found.end() && listed->edge == e && listed->face == f;
        const auto& at = mesh.positions;
        const Triangle triangle{at[face[0]], at[face[1]], at[face[2]]};
        ASSERT_EQ(is_listed, segment_triangle_intersect(at[v], at[w], triangle)) << e << ' ' << f;
        if (is_listed && met++ % 16 == 0) {
            ASSERT_EQ(listed->contact, true_contact(at[v], at[w], triangle));
        }
    });
    std::cout << pairs << " pairs, " << met << " meet\n";
    EXPECT_EQ(met, found.size());
}

INSTANTIATE_TEST_SUITE_P(Simulations, Deforming,
                         testing::Values(KnownStep{"cloth-ball-92", "cloth-ball-93", 94822, 19032,
                                                   62655},
                                         KnownStep{"balls16-18", "balls16-19", 41031, 9459, 6556}));

} // namespace
} // namespace abut::test
