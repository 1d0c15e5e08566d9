// The limit of threads changes while queries run, as another thread of a program may do at any time.
// Answers stay those of one thread. For the thread sanitizer (tools/check_threads, tools/nightly).
#include <abut/batch.h>
#include <abut/clash.h>
#include <abut/convex_pieces.h>
#include <abut/deformable.h>
#include <abut/levels.h>
#include <abut/motion.h>
#include <abut/penetration.h>
#include <abut/scene.h>
#include <abut/shape_queries.h>
#include <abut/store_clash.h>
#include <abut/surface_contacts.h>
#include <abut/world.h>

#include "scenes/bodies.h"
#include "scenes/plant/plant.h"
#include "tests/support/folder.h"
#include "tests/support/moving_meshes.h"
#include "tests/support/rounds.h"
#include "tests/support/sanitizer.h"
#include "tests/support/shapes.h"

#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace abut::test {
namespace {

constexpr int kRounds = reduced_for_threads(6, 3);
constexpr int kClothCells = reduced_for_threads(10, 7);

/// Changes the limit of threads over and over until it is destroyed, and then lifts it.
class ChangingLimit {
public:
    ~ChangingLimit() {
        stop_ = true;
        thread_.join();
        set_threads(0);
    }
    /// Returns when the limit has begun to change.
    ChangingLimit() {
        while (changes_ == 0)
            std::this_thread::yield();
    }
    ChangingLimit(const ChangingLimit&) = delete;
    ChangingLimit& operator=(const ChangingLimit&) = delete;

private:
    void run() {
        // One thread comes most often: there, a search may do without locks.
        constexpr std::array kLimits{1, 4, 1, 2, 1, 0, 1, 3};
        for (std::size_t i = 0; !stop_; i = (i + 1) % kLimits.size(), ++changes_) {
            set_threads(kLimits[i]);
            std::this_thread::yield();
        }
    }

    std::atomic<bool> stop_ = false;
    std::atomic<int> changes_ = 0;
    std::thread thread_{[this] { run(); }};
};

/// Calls `query` with one thread, and then again and again while the limit changes.
template <typename Query>
void expect_same_answers(const Query& query) {
    set_threads(1);
    const auto alone = query();
    const ChangingLimit changing;
    for (int round = 0; round < many(kRounds); ++round)
        ASSERT_TRUE(query() == alone) << "round " << round;
}

/// A cloth that folds onto itself.
MovingMesh folding_cloth(int cells) {
    MovingMesh cloth;
    cloth.mesh = grid_mesh(cells, cells, false, false, [](double u, double v) {
        return Vec3{u, v, 0.02 * std::sin(20 * u) * std::cos(15 * v)};
    });
    for (const Vec3& p : cloth.mesh.positions)
        cloth.end.push_back(p.x < 0.5 ? p : Vec3{1 - p.x, p.y, 0.05 * (1 - p.x) - 0.01});
    return cloth;
}

TEST(SetThreads, BesideSelfImpactsOfEachSchemeAndCulling) {
    const MovingMesh cloth = folding_cloth(kClothCells);
    for (const Scheme scheme : {Scheme::database, Scheme::representative, Scheme::pairwise,
                                Scheme::markup, Scheme::basic, Scheme::features})
        for (const Culling culling : {Culling::tree, Culling::grid, Culling::sweep}) {
            if (scheme == Scheme::features && culling != Culling::tree)
                continue;
            SCOPED_TRACE(testing::Message() << int(scheme) << ' ' << int(culling));
            const Deformable surface = cloth.deformable({.scheme = scheme, .culling = culling});
            ASSERT_FALSE(self_impacts(surface).list.empty());
            expect_same_answers([&] { return self_impacts(surface).list; });
        }
}

std::vector<std::uint8_t> every_third(std::size_t count) {
    std::vector<std::uint8_t> marks(count, 0);
    for (std::size_t i = 0; i < count; i += 3)
        marks[i] = 1;
    return marks;
}

TEST(SetThreads, BesideOtherQueriesOfDeformables) {
    const MovingMesh cloth = folding_cloth(kClothCells);
    const Deformable surface = cloth.deformable(),
                     tested_once = cloth.deformable({.scheme = Scheme::database});
    expect_same_answers([&] { return self_time_of_impact(surface); });
    expect_same_answers([&] { return is_free_of_self_impacts(surface); });
    expect_same_answers([&] { return self_within(surface, 0.02); });
    const std::vector<std::uint8_t> moved = every_third(surface.vertex_count());
    expect_same_answers(
        [&] { return self_within(surface, 0.02, {.at_end = true, .vertices = {.moved = moved}}); });
    expect_same_answers([&] { return within(surface, Sphere{{}, 0.5}, {}, 0.1); });
    expect_same_answers([&] { return self_intersections(surface, {.at_end = true}); });
    expect_same_answers([&] { // a changed surface refits its trees in parallel
        Deformable other = cloth.deformable({.scheme = Scheme::database});
        other.advance(cloth.mesh.positions);
        return impacts(tested_once, other).list;
    });
}

TEST(SetThreads, BesideQueriesOfModels) {
    const Mesh mesh = scenes::boulder(2000, 3);
    const Model a(mesh), b(scenes::knot(2000));
    std::vector<Placement> placements;
    std::vector<Vec3> points;
    for (int i = 0; i < 100; ++i) {
        placements.push_back({{}, translation(0.02 * i, 0.3, 0.01 * i)});
        points.push_back({0.03 * i - 1.5, 0.2, 0.1});
    }
    expect_same_answers([&] { // builds in parallel
        const Model built(mesh);
        return collide(built, {}, b, translation(0.3, 0, 0), {.mode = ContactMode::all}).pairs;
    });
    expect_same_answers([&] {
        std::vector<double> distances;
        for (const Gap& gap : distance(a, b, placements))
            distances.push_back(gap.distance);
        return distances;
    });
    expect_same_answers([&] { return within(a, b, placements, 0.1); });
    expect_same_answers([&] {
        std::vector<std::vector<TrianglePair>> pairs;
        for (const Contacts& contacts : collide(a, b, placements))
            pairs.push_back(contacts.pairs);
        return pairs;
    });
    expect_same_answers([&] {
        std::vector<double> distances;
        for (const Nearest& each : nearest(a, {}, points))
            distances.push_back(each.distance);
        return distances;
    });
    expect_same_answers([&] {
        std::vector<Side> sides;
        for (const Containment& each : contains(a, {}, points))
            sides.push_back(each.side);
        return sides;
    });
    expect_same_answers([&] { return penetration(a, {}, a, translation(0.5, 0.1, 0)).depth; });
}

TEST(SetThreads, BesideConvexPieces) {
    const Mesh mesh = scenes::knot(1000);
    expect_same_answers([&] { // decomposes in parallel
        const ConvexPieces pieces{Model(mesh)};
        return std::pair(pieces.size(),
                         distance(pieces, {}, pieces, translation(3, 0, 0)).distance);
    });
}

TEST(SetThreads, BesideAWorld) {
    const Model boulder(scenes::boulder(300, 5)), knot(scenes::knot(400));
    expect_same_answers([&] {
        World world;
        std::vector<BodyId> bodies;
        for (int i = 0; i < 60; ++i) {
            const int row = i / 8;
            const Pose pose{{0.7 * (i % 8), 0.8 * row, 0.1 * (i % 3)}};
            bodies.push_back(i % 3 == 0   ? world.add(boulder, pose)
                             : i % 3 == 1 ? world.add(knot, pose)
                                          : world.add(Sphere{{0, 0, 0}, 0.4}, pose));
        }
        std::vector<double> answers;
        answers.push_back(double(world.collide().size()));
        for (const BodyGap& gap : world.within(0.3))
            answers.push_back(gap.distance);
        for (const BodyGap& gap : world.penetration())
            answers.push_back(gap.distance);
        answers.push_back(double(world.contact_manifolds().size()));
        world.advance(0);
        return answers;
    });
}

TEST(SetThreads, BesideClashJobsInMemoryAndInAStore) {
    PlantOptions options;
    options.triangles = 20'000;
    options.clashes = 5;
    options.distinct = true;
    const Plant plant = make_plant(options);
    const ClashOptions clash{.clearance = 0.02};
    const auto ids = [](const std::vector<Clash>& clashes) {
        std::vector<std::pair<std::uint64_t, double>> result;
        result.reserve(clashes.size());
        for (const Clash& each : clashes)
            result.emplace_back(each.id, each.distance);
        return result;
    };
    expect_same_answers([&] { return ids(find_clashes({plant.scene}, clash).clashes); });
    const Folder folder;
    write_glb(plant.scene, folder / "a.glb");
    int number = 0;
    expect_same_answers([&] {
        const std::string store = folder / ("a" + std::to_string(number++) + ".abut");
        (void)import_models({folder / "a.glb"}, store);
        auto found = ids(find_clashes(open_store(store), clash).report.clashes);
        if (number == 2)
            (void)build_levels(store);
        return found;
    });
}

} // namespace
} // namespace abut::test
