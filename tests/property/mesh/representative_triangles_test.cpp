// Every used vertex and every edge has exactly one representative triangle, for every assignment
// and after every change.

#include "mesh/representative_triangles.h"
#include "tests/support/moving_meshes.h"
#include "tests/support/rounds.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

using Triangles = std::vector<IndexTriangle>;

void expect_each_once(const SurfaceView& surface, const std::vector<Represented>& represented) {
    std::vector<int> vertices(surface.vertices), edges(surface.features.edges.size()),
        used(surface.vertices);
    ASSERT_EQ(represented.size(), surface.triangles.size());
    for (std::size_t i = 0; i < represented.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            used[surface.triangles[i][k]] = 1;
            vertices[surface.triangles[i][k]] += represents_vertex(represented[i], k) ? 1 : 0;
            if (represents_edge(represented[i], k)) {
                ASSERT_NE(surface.features.edges_of[i][k], kNoEdge);
                ++edges[surface.features.edges_of[i][k]];
            }
        }
    EXPECT_EQ(vertices, used);
    EXPECT_EQ(edges, std::vector<int>(edges.size(), 1));
}

TEST(Representatives, EachFeatureHasOne) {
    Random random(1);
    for (int round = 0; round < many(500); ++round) {
        const int vertices = random.integer(1, 20);
        const Triangles triangles = round % 2 == 0
                                        ? any_triangles(random, vertices, random.integer(0, 30))
                                        : crumpled_sheet(random, 4).mesh.triangles;
        const std::size_t count = round % 2 == 0 ? std::size_t(vertices) : 25;
        const SurfaceFeatures features = make_surface_features(count, triangles);
        const SurfaceView surface{count, triangles, features};
        for (const auto assignment :
             {Assignment::greedy, Assignment::maximal, Assignment::uniform_vertex_edge,
              Assignment::uniform_edge_edge, Assignment::adaptive}) {
            std::vector<Represented> represented = assign_features(surface, assignment);
            expect_each_once(surface, represented);

            std::vector<bool> marked(triangles.size());
            for (std::size_t i = 0; i < marked.size(); ++i)
                marked[i] = random.chance(0.3);
            move_features_off(surface, marked, represented);
            expect_each_once(surface, represented);

            for (Represented& bits : represented)
                if (random.chance(0.3))
                    bits = 0;
            complete_assignment(surface, represented);
            expect_each_once(surface, represented);
        }
    }
}

/// How many triangles represent 0, 1, ... 6 of the features that `counted` masks.
std::array<int, 7> loads(const std::vector<Represented>& represented, Represented counted) {
    std::array<int, 7> result{};
    for (const Represented bits : represented)
        ++result[static_cast<std::size_t>(std::popcount(unsigned(bits & counted)))];
    return result;
}

TEST(Representatives, AssignmentsSpreadFeaturesAsNamed) {
    Random random(2);
    const Mesh mesh = crumpled_sheet(random, 30).mesh; // 1,800 triangles, 961 vertices
    const SurfaceFeatures features = make_surface_features(mesh.positions.size(), mesh.triangles);
    const SurfaceView surface{mesh.positions.size(), mesh.triangles, features};
    const auto idle = [&](Assignment assignment) {
        return loads(assign_features(surface, assignment), 0b111111)[0];
    };
    EXPECT_GT(idle(Assignment::maximal), idle(Assignment::greedy));
    EXPECT_EQ(idle(Assignment::uniform_vertex_edge), 0);

    const auto edges = loads(assign_features(surface, Assignment::uniform_edge_edge), 0b111000);
    EXPECT_EQ(edges[0], 0); // 2,760 edges: most triangles have one or two
    EXPECT_LT(edges[3], 60);
    const auto all = loads(assign_features(surface, Assignment::uniform_vertex_edge), 0b111111);
    EXPECT_LT(all[4] + all[5] + all[6], 20); // 3,721 features: most triangles have two or three
}

TEST(Representatives, AdaptiveMovesFeaturesOffCollidingTriangles) {
    const Triangles triangles{{0, 1, 2}, {2, 1, 3}};
    const SurfaceFeatures features = make_surface_features(4, triangles);
    const SurfaceView surface{4, triangles, features};
    std::vector<Represented> represented = assign_features(surface, Assignment::adaptive);
    EXPECT_EQ(represented[0], 0b111111);
    move_features_off(surface, {true, false}, represented);
    EXPECT_EQ(represented[0], 0b101001); // no other triangle has vertex 0 and its edges
}

} // namespace
} // namespace abut::test
