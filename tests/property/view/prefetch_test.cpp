// A smooth walk through a store: how many chunks are there when they are needed.
#include <abut/levels.h>
#include <abut/store.h>
#include <abut/tour.h>

#include "math/vector.h"
#include "scenes/plant/plant.h"
#include "store/database/store_file.h"
#include "tests/support/folder.h"
#include "tests/support/sanitizer.h"
#include "view/level_view.h"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <iostream>
#include <set>
#include <vector>

namespace abut::test {
namespace {

/// A tour with turns, up and down through the middle of a box.
Tour tour_through(const Box3& box) {
    const auto at = [&](double x, double y, double z) {
        const Vec3 size = box.upper - box.lower;
        return Vec3{box.lower.x + x * size.x, box.lower.y + y * size.y, box.lower.z + z * size.z};
    };
    Tour tour;
    const std::vector<Vec3> eyes{at(0.3, 0.5, 0.3), at(0.7, 0.5, 0.35), at(0.7, 0.6, 0.7),
                                 at(0.3, 0.6, 0.7), at(0.35, 0.5, 0.4)};
    double seconds = 0;
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        const Vec3 way = eyes[std::min(i + 1, eyes.size() - 1)] - eyes[i == 0 ? 0 : i - 1];
        if (i > 0)
            seconds += length(eyes[i] - eyes[i - 1]) / 1.4; // walking
        tour.points.push_back({seconds, eyes[i], way, {0, 1, 0}, ""});
    }
    return tour;
}

struct PathFigures {
    std::uint64_t lookups = 0, misses = 0;     ///< chunks of all frames
    std::uint64_t first = 0, first_misses = 0; ///< chunks that the frame before did not want
};

/// Replays a tour at 20 frames a second. One chunk is read in every frame; without a plan, only if
/// one is missing.
PathFigures replay(StoreFile& store, const Tour& tour, bool plans) {
    constexpr double kFrame = 1.0 / 20;
    const LevelTree tree = read_level_tree(store);
    ViewOptions options;
    options.triangle_budget = 200'000;
    options.gpu_memory = 0;
    for (const ChunkSize& size : tree.chunks)
        options.gpu_memory += size.bytes() / 2;
    LevelView view(
        tree, [&](std::uint32_t chunk) { return read_level_chunk(store, tree, chunk); },
        store.path(), options, LevelView::Reader::caller);
    Camera before = camera_at(tour, 0);
    PathFigures figures;
    const auto show = [&](const Camera& camera, std::uint32_t reads) {
        const double angle = length(cross(before.forward, camera.forward));
        const Vec3 axis = normalized_or_zero(cross(before.forward, camera.forward));
        const ViewFrame& frame =
            view.frame({camera, (1 / kFrame) * (camera.eye - before.eye), (angle / kFrame) * axis});
        view.loader().work(reads);
        before = camera;
        return frame.loaded;
    };
    while (!show(before, 1))
        continue; // the loading screen
    const ViewStatistics begin = view.statistics();
    std::set<std::uint32_t> wanted_before;
    for (double seconds = 0; seconds < duration(tour); seconds += kFrame) {
        const bool reads = plans || view.statistics().missing > 0;
        (void)show(camera_at(tour, seconds), reads ? 1 : 0);
        std::set<std::uint32_t> wanted, drawn;
        for (const CutEntry& entry : view.cut().entries())
            if (!entry.is_replaced)
                wanted.insert(entry.chunk);
        for (const std::uint32_t at : view.drawn().drawn())
            drawn.insert(view.cut().entries()[at].chunk);
        for (const std::uint32_t chunk : wanted) {
            const bool is_first = !wanted_before.contains(chunk);
            figures.first += is_first ? 1 : 0;
            figures.first_misses += is_first && !drawn.contains(chunk) ? 1 : 0;
        }
        wanted_before = wanted;
    }
    figures.lookups = view.statistics().lookups - begin.lookups;
    figures.misses = view.statistics().misses - begin.misses;
    return figures;
}

TEST(Prefetch, HitsOnASmoothPath) {
    if (reduced_for_threads(false, true))
        GTEST_SKIP() << "the replay has one thread, and a smaller plant has other hit rates";
    const Folder folder;
    const std::string path = folder / "plant.abut";
    write_glb(make_plant({.triangles = 600'000, .clashes = 0, .distinct = true}).scene,
              folder / "plant.glb");
    (void)import_models({folder / "plant.glb"}, path);
    (void)build_levels(path);
    const Store store = open_store(path);
    const Tour tour = tour_through(summary(store).bounds);
    const PathFigures ahead = replay(store.file(), tour, true);
    const PathFigures behind = replay(store.file(), tour, false);
    const auto percent = [](std::uint64_t misses, std::uint64_t of) {
        return 100 - 100 * double(misses) / double(of);
    };
    std::cout << ahead.lookups << " lookups, hits " << percent(ahead.misses, ahead.lookups)
              << " %; " << ahead.first << " chunks wanted anew, hits "
              << percent(ahead.first_misses, ahead.first) << " %\n";
    std::cout << "without a plan: hits " << percent(behind.misses, behind.lookups) << " %; anew "
              << percent(behind.first_misses, behind.first) << " %\n";
    EXPECT_GT(ahead.lookups, 5'000U);
    EXPECT_GT(ahead.first, 50U);
    EXPECT_LT(ahead.misses * 100, ahead.lookups);
    EXPECT_LE(ahead.first_misses * 10, ahead.first);
    EXPECT_GT(behind.first_misses * 5, behind.first); // the path does need a plan
}

} // namespace
} // namespace abut::test
