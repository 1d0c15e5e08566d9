// A large mesh in blocks gives the same classification of a pair as the whole mesh, however it is
// cut.

#include "clash/classify_pair.h"
#include "clash/mesh_in_blocks.h"
#include "mesh/used_positions.h"
#include "rigid/model/model_data.h"
#include "rigid/solid/placed_blocks.h"
#include "rigid/solid/placed_solid.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <gtest/gtest.h>
#include <memory>

namespace abut::test {
namespace {

/// A wavy sheet.
Mesh terrain_mesh(Random& random, int n) {
    const double waves = random.uniform(1, 6), height = random.uniform(0.02, 0.3);
    return grid_mesh(n, n, false, false, [&](double u, double v) {
        return Vec3{2 * u - 1, 2 * v - 1, height * std::sin(waves * u) * std::cos(waves * v)};
    });
}

/// Two components in one mesh; the second often lies within the first.
Mesh two_bodies(Random& random) {
    Mesh mesh = sphere_mesh(1, random.integer(6, 24), random.integer(4, 12));
    const Mesh inner = box_mesh({-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2});
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const Vec3 by = random.in_cube(1);
    for (const Vec3& p : inner.positions)
        mesh.positions.push_back(p + by);
    for (const auto& t : inner.triangles)
        mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    return mesh;
}

/// Gives each triangle vertices of its own, so that edges meet by position alone.
Mesh taken_apart(const Mesh& mesh) {
    Mesh result;
    for (const auto& t : mesh.triangles) {
        const auto first = static_cast<std::uint32_t>(result.positions.size());
        for (const std::uint32_t v : t)
            result.positions.push_back(mesh.positions[v]);
        result.triangles.push_back({first, first + 1, first + 2});
    }
    return result;
}

Mesh some_mesh(Random& random) {
    switch (random.integer(0, 7)) {
    case 0:
        return box_mesh({-1, -1, -1}, {1, 1, 1});
    case 1:
        return open_box_mesh({-1, -1, -1}, {1, 1, 1});
    case 2:
        return sphere_mesh(1, random.integer(5, 30), random.integer(4, 20));
    case 3:
        return torus_mesh(1, 0.4, random.integer(6, 40), random.integer(5, 20));
    case 4:
        return soup_mesh(random, random.integer(2, 60), 1, 0.5);
    case 5:
        return two_bodies(random);
    case 6:
        return taken_apart(torus_mesh(1, 0.4, random.integer(6, 20), random.integer(5, 10)));
    default:
        return terrain_mesh(random, random.integer(2, 16));
    }
}

/// One mesh at one place, as a whole model and in blocks.
struct Body {
    Body(const Mesh& mesh, const Transform& world, std::uint64_t most)
        : model(mesh), blocks(in_blocks(mesh, most)), world_from_mesh(world),
          box(world_box(UsedPositions(mesh).get(), world)) {}

    [[nodiscard]] ClashPart whole() const { return {&model, nullptr, world_from_mesh, box}; }
    [[nodiscard]] ClashPart cut() const { return {nullptr, blocks.get(), world_from_mesh, box}; }

    Model model;
    std::unique_ptr<const ModelBlocks> blocks;
    Transform world_from_mesh;
    Box3 box;
};

Transform some_place(Random& random) {
    Transform world = random.pose(random.chance(0.5) ? 1.5 : 0.3);
    if (random.chance(0.3)) { // gives coplanar faces and shared edges
        world = {};
        world.m[9] = random.integer(-2, 2), world.m[10] = random.integer(-1, 1);
    }
    if (random.chance(0.4)) {
        const double scale = random.uniform(0.2, 2), mirror = random.chance(0.3) ? -1 : 1;
        for (std::size_t i = 0; i < 9; ++i)
            world.m[i] *= i < 3 ? mirror * scale : scale;
    }
    if (random.chance(0.02)) // flattened
        for (std::size_t i = 6; i < 9; ++i)
            world.m[i] = 0;
    return world;
}

TEST(ClassifyBlocks, EqualsTheClassificationOfWholeMeshes) {
    Random random(6201);
    std::array<std::size_t, 5> kinds{};
    std::size_t pairs = 0, deeper = 0, far_off = 0;
    for (int round = 0; round < many(900); ++round) {
        const Mesh mesh_a = some_mesh(random);
        const bool same_mesh = random.chance(0.1),
                   same_place = random.chance(same_mesh ? 0.4 : 0.02);
        const Mesh mesh_b = same_mesh ? mesh_a : some_mesh(random);
        const Transform place_a = some_place(random),
                        place_b = same_place ? place_a : some_place(random);
        const auto most = [&] { return static_cast<std::uint64_t>(random.integer(1, 80)); };
        const Body a(mesh_a, place_a, most()), b(mesh_b, place_b, most());
        const double clearance = random.chance(0.3) ? 0 : random.uniform(0, 1),
                     touch = random.chance(0.5) ? 0 : random.uniform(0, 0.1);
        const auto truth = classify_pair(a.whole(), b.whole(), clearance, touch);
        const int cut = random.integer(1, 3);
        const auto found = classify_pair((cut & 1) != 0 ? a.cut() : a.whole(),
                                         (cut & 2) != 0 ? b.cut() : b.whole(), clearance, touch);
        ASSERT_EQ(found.has_value(), truth.has_value()) << "round " << round;
        if (!truth)
            continue;
        ++pairs;
        ++kinds.at(static_cast<std::size_t>(truth->kind));
        ASSERT_EQ(found->kind, truth->kind) << "round " << round;
        ASSERT_EQ(found->triangle_pairs, truth->triangle_pairs);
        if (truth->kind == ClashKind::hard || truth->distance < 0) {
            if (truth->kind != ClashKind::contained) {
                // The trees differ, so each search reaches its own depth, to 2^-20. It does not look for
                // depths below a 128th of the tolerance.
                const double least = std::min(-found->distance, -truth->distance),
                             largest = std::max(-found->distance, -truth->distance);
                deeper += least < largest ? 1 : 0;
                far_off += least < (1 - 0x1p-19) * largest && largest > touch / 128 ? 1 : 0;
                continue;
            }
        }
        ASSERT_EQ(found->distance, truth->distance) << "round " << round;
        ASSERT_EQ(found->point_a, truth->point_a) << "round " << round;
        ASSERT_EQ(found->point_b, truth->point_b) << "round " << round;
    }
    std::cout << pairs << " clashes; hard, touch, contained, duplicate, clearance:";
    for (const std::size_t count : kinds) {
        std::cout << ' ' << count;
        EXPECT_GT(count, pairs / 200);
    }
    std::cout << "; depths that differ " << deeper << ", by more than 2^-19 " << far_off << '\n';
    EXPECT_LE(far_off, kinds[0] / 50); // searches that ran out, and diameters of some ball in both
}

/// Translations are multiples of the grid, so they move every vertex exactly.
TEST(ClassifyBlocks, DepthsAreInvariantUnderTranslation) {
    Random random(6204);
    constexpr double kGrid = 0x1p-12;
    const auto on_grid = [](const Vec3& p) {
        const auto round = [](double v) { return std::round(v / kGrid) * kGrid; };
        return Vec3{round(p.x), round(p.y), round(p.z)};
    };
    const int rounds = many(300);
    int deep = 0;
    for (int round = 0; round < rounds; ++round) {
        const auto mesh_on_grid = [&] {
            Mesh mesh = some_mesh(random);
            for (Vec3& p : mesh.positions)
                p = on_grid(p);
            return mesh;
        };
        const Mesh mesh_a = mesh_on_grid(), mesh_b = mesh_on_grid();
        const auto most = static_cast<std::uint64_t>(random.integer(1, 80));
        const Vec3 off = on_grid(random.in_cube(0.8));
        const int cut = random.integer(1, 3);
        const auto clash_at = [&](const Vec3& by) {
            const Vec3 of_b = by + off;
            const Body a(mesh_a, translation(by.x, by.y, by.z), most),
                b(mesh_b, translation(of_b.x, of_b.y, of_b.z), most);
            return classify_pair((cut & 1) != 0 ? a.cut() : a.whole(),
                                 (cut & 2) != 0 ? b.cut() : b.whole(), 0, 0);
        };
        const auto here = clash_at({});
        if (!here || !(here->distance < 0))
            continue;
        ++deep;
        const auto there =
            clash_at(on_grid(std::ldexp(1, random.integer(0, 20)) * random.in_cube(1)));
        ASSERT_TRUE(there.has_value()) << "round " << round;
        ASSERT_EQ(there->kind, here->kind) << "round " << round;
        ASSERT_NEAR(there->distance, here->distance, -0x1p-19 * here->distance)
            << "round " << round;
    }
    std::cout << deep << " of " << rounds << " pairs deep\n";
    EXPECT_GT(deep, rounds / 4);
}

/// The solid found from blocks equals that of the whole mesh.
TEST(ClassifyBlocks, TheSolidEqualsThatOfTheWholeMesh) {
    Random random(6202);
    std::size_t closed = 0, solid = 0, on_disk = 0;
    for (int round = 0; round < many(900); ++round) {
        Mesh mesh = some_mesh(random);
        if (random.chance(0.2)) // some or all triangles reversed
            for (auto& t : mesh.triangles)
                if (random.chance(0.9))
                    std::swap(t[0], t[1]);
        const Solid truth = examine_solid(mesh);
        const auto blocks = in_blocks(mesh, static_cast<std::uint64_t>(random.integer(1, 50)));
        // The memory is so small that the union-find sets and edges lie on disk.
        const bool little = random.chance(0.5);
        on_disk += little ? 1 : 0;
        const BlocksSolid found =
            examine_solid(*blocks, std::filesystem::temp_directory_path().string(),
                          little ? 1 : std::size_t{1} << 24);
        ASSERT_EQ(found.closed, truth.closed) << "round " << round;
        ASSERT_EQ(found.solid, truth.solid);
        ASSERT_EQ(found.outward, truth.outward) << "round " << round;
        ASSERT_EQ(found.component_points.size(), truth.components.size());
        closed += truth.closed ? 1 : 0;
        solid += truth.solid ? 1 : 0;
    }
    const auto all = static_cast<std::size_t>(many(900));
    EXPECT_GT(closed, all / 4);
    EXPECT_LT(solid, all - all / 8);
    EXPECT_GT(on_disk, all / 4);
}

/// Queries of points, in blocks and on the whole mesh, agree.
TEST(ClassifyBlocks, InsideAndNearestEqualThoseOfTheWholeMesh) {
    Random random(6203);
    std::size_t inside = 0, asked = 0;
    for (int round = 0; round < many(900); ++round) {
        const Mesh mesh = some_mesh(random);
        const Body body(mesh, some_place(random),
                        static_cast<std::uint64_t>(random.integer(1, 50)));
        const PlacedSolid whole(body.model, body.model.data().solid(), body.world_from_mesh);
        const PlacedBlocks cut(*body.blocks, body.world_from_mesh);
        for (int i = 0; i < 20; ++i) {
            const Vec3 p = random.chance(0.1)
                               ? whole.model().world_vertex(mesh.triangles[0][0])
                               : whole.middle() + whole.reach() * random.in_cube(0.6);
            ASSERT_EQ(cut.on_surface(p), whole.on_surface(p));
            ASSERT_EQ(cut.nearest(p, HUGE_VAL).distance, whole.nearest(p, HUGE_VAL).distance);
            if (!whole.closed())
                continue;
            ASSERT_EQ(cut.contains(p), whole.contains(p));
            ASSERT_EQ(cut.winds_around(p), whole.winds_around(p));
            ++asked;
            inside += whole.contains(p) ? 1 : 0;
        }
    }
    std::cout << inside << " of " << asked << " inside\n";
    EXPECT_GT(inside, asked / 20);
    EXPECT_LT(inside, asked - asked / 4);
}

} // namespace
} // namespace abut::test
