// Flat-region culling never leaves out an impact, and it does leave out some pairs.

#include "deform/deformable_data.h"
#include "mesh/disc_boundary.h"
#include "tests/support/moving_meshes.h"
#include "tests/support/rounds.h"

#include <gtest/gtest.h>
#include <iostream>
#include <numbers>
#include <numeric>

namespace abut::test {
namespace {

/// A sheet of 2 n^2 triangles that waves, is rough, turns, shears and folds up within the step.
/// Some of it stays flat, and some meets itself.
MovingMesh folding_sheet(Random& random, int n) {
    MovingMesh moving;
    const double wave = random.uniform(0, 0.2), rough = random.uniform(0, 0.2) / n;
    moving.mesh = grid_mesh(n, n, false, false, [&](double u, double v) {
        return Vec3{u, v, wave * std::sin(5 * u) * std::cos(4 * v)} + random.in_cube(rough);
    });
    const double angle = random.uniform(0, std::numbers::pi), shear = random.uniform(0, 1.5),
                 fold = random.uniform(0, 2.5), crease = random.uniform(0.2, 0.8);
    const double further = random.uniform(0, 0.3) / n;
    for (Vec3 p : moving.mesh.positions) {
        if (p.x > crease) { // folds about the line x = crease
            const double x = p.x - crease, z = p.z;
            p.x = crease + std::cos(fold) * x - std::sin(fold) * z;
            p.z = std::sin(fold) * x + std::cos(fold) * z;
        }
        p.x += shear * p.y;
        moving.end.push_back(Vec3{std::cos(angle) * p.x - std::sin(angle) * p.y,
                                  std::sin(angle) * p.x + std::cos(angle) * p.y, p.z} +
                             random.in_cube(further));
    }
    return moving;
}

TEST(FlatRegions, HoldNoImpacts) {
    Random random(1994);
    std::size_t flat = 0, nodes = 0, hits = 0, folded = 0;
    for (int round = 0; round < many(150); ++round) {
        const MovingMesh moving = folding_sheet(random, 9);
        const Deformable surface = moving.deformable();
        for (const std::uint8_t each : surface.data().flat_regions.flat()) {
            flat += each;
            ++nodes;
        }
        const BruteForceImpacts truth(moving, moving);
        ASSERT_EQ(self_impacts(surface).list, truth.list);
        hits += truth.list.size();
        folded += truth.list.empty() ? 0 : 1;
    }
    std::cout << flat << " of " << nodes << " nodes are flat, " << hits << " impacts in " << folded
              << " sheets\n";
    EXPECT_GT(flat, nodes / 20);
    EXPECT_LT(flat, nodes * 9 / 10);
    EXPECT_GT(hits, 1000U);
    EXPECT_GT(folded, std::size_t(many(150)) / 5);
}

/// A spiral staircase faces upwards everywhere, yet lies above itself.
TEST(FlatRegions, SpiralIsNotFlat) {
    const MovingMesh moving = [] {
        MovingMesh m;
        constexpr int kSteps = 28;
        for (int i = 0; i <= kSteps; ++i) {
            const double a = 2 * std::numbers::pi * i / 12;
            for (const double r : {1.0, 2.0})
                m.mesh.positions.push_back({r * std::cos(a), r * std::sin(a), 0.002 * i});
        }
        for (std::uint32_t i = 0; i < kSteps; ++i) {
            m.mesh.triangles.push_back({2 * i, 2 * i + 1, 2 * i + 3});
            m.mesh.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 2});
        }
        m.end = m.mesh.positions;
        for (std::size_t i = m.end.size() / 2; i < m.end.size(); ++i)
            m.end[i].z -= 0.1; // the upper turn falls onto the lower one
        return m;
    }();
    const BruteForceImpacts truth(moving, moving);
    EXPECT_GT(truth.list.size(), 10U);
    EXPECT_EQ(self_impacts(moving.deformable()).list, truth.list);
}

using Triangles = std::vector<IndexTriangle>;

/// The boundary of the disc that all triangles form together; empty if they form none.
std::vector<std::uint32_t> boundary(const Triangles& triangles) {
    constexpr std::size_t kVertices = 64;
    const SurfaceFeatures features = make_surface_features(kVertices, triangles);
    std::vector<std::uint32_t> all(triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    return disc_boundary({kVertices, triangles, features}, all);
}

TEST(DiscBoundary, DiscsHaveABoundaryLoop) {
    const auto loop = boundary(Triangles{{5, 6, 7}, {7, 6, 8}});
    EXPECT_EQ(loop, (std::vector<std::uint32_t>{5, 6, 8, 7}));
    const Mesh sheet = grid_mesh(4, 3, false, false, [](double, double) { return Vec3{}; });
    EXPECT_EQ(boundary(sheet.triangles).size(), 14U);
}

TEST(DiscBoundary, OtherSurfacesHaveNone) {
    const auto mesh = [](bool u, bool v) {
        return grid_mesh(5, 5, u, v, [](double, double) { return Vec3{}; }).triangles;
    };
    EXPECT_TRUE(boundary({}).empty());
    EXPECT_TRUE(boundary(mesh(true, false)).empty()) << "a tube";
    EXPECT_TRUE(boundary(mesh(true, true)).empty()) << "a torus";
    EXPECT_TRUE(boundary(Triangles{{0, 1, 2}, {3, 4, 5}}).empty()) << "two pieces";
    EXPECT_TRUE(boundary(Triangles{{0, 1, 2}, {2, 3, 4}}).empty()) << "joined at a vertex";
    EXPECT_TRUE(boundary(Triangles{{0, 1, 2}, {0, 1, 3}}).empty()) << "flipped";
    EXPECT_TRUE(boundary(Triangles{{0, 1, 2}, {2, 1, 3}, {1, 2, 4}}).empty()) << "a fin";
    EXPECT_TRUE(boundary(Triangles{{0, 1, 2}, {0, 1, 2}}).empty()) << "twice";
    EXPECT_TRUE(boundary(Triangles{{0, 0, 2}}).empty()) << "an index twice";
    Triangles holed = mesh(false, false);
    holed.erase(holed.begin() + 24, holed.begin() + 26);
    EXPECT_TRUE(boundary(holed).empty()) << "a hole";
    Mesh box = box_mesh({}, {1, 1, 1});
    EXPECT_TRUE(boundary(box.triangles).empty()) << "closed";
    box.triangles.pop_back();
    EXPECT_EQ(boundary(box.triangles).size(), 3U);
}

} // namespace
} // namespace abut::test
