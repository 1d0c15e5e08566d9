// The out-of-core clash job finds what the in-core one finds, in any memory. Its work units hold
// every pair once and fit into memory.

#include <abut/clash.h>
#include <abut/error.h>
#include <abut/model.h>
#include <abut/store_clash.h>

#include "clash/mesh_in_blocks.h"
#include "massive/work/large_meshes.h"
#include "massive/work/stored_parts.h"
#include "massive/work/work_units.h"
#include "tests/support/clash/clash_scenes.h"
#include "tests/support/folder.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/sanitizer.h"
#include "tests/support/shapes.h"
#include "tests/support/store/stored_job.h"

#include <algorithm>
#include <atomic>
#include <gtest/gtest.h>
#include <set>
#include <thread>
#include <utility>

namespace abut::test {
namespace {

TEST(OutOfCore, EqualsTheJobInCore) {
    Random random(6101);
    std::size_t clashes = 0, cut_up = 0, loaded_again = 0, runs = 0;
    for (int round = 0; round < many(3); ++round) {
        const StoredJob job(random);
        clashes += job.truth.clashes.size();
        const Store opened = open_store(job.store);
        std::uint64_t memory = std::uint64_t{4} << 20;
        // Memory shrinks until two models of a pair no longer fit.
        for (bool fits = true; fits; memory = memory / 2 < memory - 100'000 ? memory / 2 : 0) {
            for (const WorkOrder order : {WorkOrder::partition, WorkOrder::random}) {
                try {
                    const StoreClashReport found = find_clashes(
                        opened, job.options, {.memory = memory, .order = order, .keep = false});
                    job.expect(found);
                    ASSERT_LE(found.counters.peak_bytes, memory);
                    ASSERT_GE(found.counters.mesh_loads, found.counters.meshes);
                    ASSERT_GE(found.counters.bytes_read, found.counters.bytes_needed);
                    ++runs;
                    cut_up += found.counters.units > 1 ? 1 : 0;
                    loaded_again += found.counters.mesh_loads > found.counters.meshes ? 1 : 0;
                } catch (const Error& error) {
                    ASSERT_EQ(error.code(), ErrorCode::bad_argument) << error.what();
                    ASSERT_LT(memory, std::uint64_t{2} << 20) << error.what();
                    fits = false;
                }
            }
        }
    }
    std::cout << clashes << " clashes; of " << runs << " runs " << cut_up << " in several units, "
              << loaded_again << " read meshes again\n";
    EXPECT_GT(clashes, 100U);
    EXPECT_GT(cut_up, runs / 4);
    EXPECT_GT(loaded_again, runs / 8);
}

/// A large mesh, a terrain or a ball, with other parts inside its box. It is never loaded as a
/// whole.
Mesh some_large_body(Random& random) {
    const double waves = random.uniform(2, 9);
    switch (random.integer(0, 2)) {
    case 0:
        return sphere_mesh(random.uniform(1, 3), random.integer(250, 400),
                           random.integer(150, 250));
    case 1:
        return torus_mesh(2, 1, random.integer(200, 260), random.integer(170, 190));
    default:
        return grid_mesh(
            random.integer(190, 260), random.integer(190, 260), false, false,
            [&](double u, double v) {
                return Vec3{8 * u - 4, 0.5 * std::sin(waves * u) * std::cos(waves * v), 8 * v - 4};
            });
    }
}

TEST(OutOfCore, LargeMeshesInBlocksEqualTheJobInCore) {
    Random random(6106);
    std::size_t clashes = 0, of_large = 0, runs = 0, again = 0;
    const int rounds = many(reduced_for_threads(2, 1));
    for (int round = 0; round < rounds; ++round) {
        Scene scene = some_scene(random, 40, 3);
        const std::size_t small = scene.parts.size();
        for (int i = 0; i < 4; ++i) {
            if (i < 3) // the last part shows the mesh of the one before
                scene.meshes.push_back(some_large_body(random));
            Transform world = random.pose(0.5);
            if (random.chance(0.3))
                for (std::size_t k = 0; k < 9; ++k)
                    world.m[k] *= 0.7;
            scene.parts.push_back({"large" + std::to_string(i), "", "",
                                   static_cast<std::uint32_t>(scene.meshes.size() - 1), world});
        }
        if (random.chance(0.5)) // a duplicate
            scene.parts.back().world_from_mesh =
                scene.parts[scene.parts.size() - 2].world_from_mesh;
        ClashOptions options;
        options.clearance = random.chance(0.3) ? 0 : random.uniform(0, 0.3);
        options.touch_tolerance = random.chance(0.5) ? 0 : 1e-2;
        const StoredJob job({scene}, options);
        const std::vector<Clash>& truth = job.truth.clashes;
        clashes += truth.size();
        of_large += static_cast<std::size_t>(
            std::count_if(truth.begin(), truth.end(),
                          [&](const Clash& clash) { return clash.part[1] >= small; }));
        const Store opened = open_store(job.store);
        const std::uint64_t least = 2 * least_for_blocks(gather_parts(opened.file()));
        for (const std::uint64_t memory :
             {std::uint64_t{512} << 20, 2 * least, least + (1 << 20)}) {
            const StoreClashReport found =
                find_clashes(opened, options, {.memory = memory, .keep = false});
            job.expect(found);
            ASSERT_LE(found.counters.peak_bytes, memory);
            ASSERT_GT(found.counters.blocks, 0U);
            ++runs;
            again += found.counters.block_loads > found.counters.blocks ? 1 : 0;
        }
        try {
            (void)find_clashes(opened, options, {.memory = least - (1 << 20), .keep = false});
            FAIL() << "too little was let through";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_argument);
        }
    }
    std::cout << clashes << " clashes, " << of_large << " with large meshes; of " << runs
              << " runs " << again << " read blocks again\n";
    EXPECT_GT(of_large, static_cast<std::size_t>(rounds) * 4);
    EXPECT_GT(again, 0U);
}

/// A job that is stopped again and again, each time after some more pairs, ends with the same
/// result.
TEST(OutOfCore, AStoppedJobResumes) {
    Random random(6104);
    std::size_t stops = 0, recalled = 0;
    for (int round = 0; round < many(4); ++round) {
        Scene scene = some_scene(random, 150, 4);
        ClashOptions options;
        options.clearance = 0.02;
        options.rules = some_rules(random);
        const StoredJob job({scene}, options);
        const OutOfCoreOptions little{.memory = 800'000};
        bool first = true;
        for (bool done = false; !done;) {
            std::atomic<bool> stop = false;
            ClashOptions stopped = options;
            stopped.progress.stop = &stop;
            const double share = first ? random.uniform(0.1, 0.9) : random.uniform(0.2, 1.2);
            first = false;
            stopped.progress.report = [&](std::string_view stage, double at) {
                if (stage == "narrow phase" && at >= share)
                    stop = true;
            };
            try {
                const StoreClashReport found = find_clashes(open_store(job.store), stopped, little);
                job.expect(found);
                EXPECT_TRUE(found.counters.kept);
                recalled += found.counters.recalled_pairs > 0 ? 1 : 0;
                done = true;
            } catch (const Error& error) {
                ASSERT_EQ(error.code(), ErrorCode::interrupted) << error.what();
                ++stops;
            }
        }
        // The same question again tests no pair, and neither does one asked after a part was
        // removed.
        const StoreClashReport again = find_clashes(open_store(job.store), options, little);
        job.expect(again);
        EXPECT_EQ(again.counters.recalled_pairs, job.truth.candidates);
        EXPECT_EQ(again.counters.mesh_loads, 0U);
        scene.parts.pop_back();
        write_glb(scene, job.files[0]);
        (void)import_models(job.files, job.store);
        const std::vector<Scene> scenes = read_scenes(job.files);
        const StoreClashReport fewer = find_clashes(open_store(job.store), options, little);
        expect_equal(fewer.report, fewer.models, find_clashes(scenes, options), scenes);
        EXPECT_EQ(fewer.counters.recalled_pairs, fewer.report.candidates); // no part has changed
        verify(open_store(job.store));
    }
    std::cout << stops << " stops, " << recalled << " jobs went on\n";
    EXPECT_GE(stops, static_cast<std::size_t>(many(4)) / 2);
    EXPECT_GT(recalled, 0U);
}

/// Two processes run one job. The later one resumes it, and the earlier one's next task is refused,
/// so nothing is lost or doubled.
TEST(OutOfCore, ASecondJobTakesOver) {
    Random random(6105);
    std::size_t recalled = 0;
    for (int round = 0; round < many(3); ++round) {
        ClashOptions options;
        options.clearance = 0.02;
        const StoredJob job({some_scene(random, 150, 4)}, options);
        const OutOfCoreOptions little{.memory = 800'000};
        StoreClashReport second;
        ClashOptions first = options;
        bool begun = false;
        const double share = random.uniform(0.1, 0.7);
        first.progress.report = [&](std::string_view stage, double at) {
            if (stage != "narrow phase" || at < share || std::exchange(begun, true))
                return;
            std::thread([&] {
                second = find_clashes(open_store(job.store), options, little);
            }).join();
        };
        try {
            (void)find_clashes(open_store(job.store), first, little);
            FAIL() << "both were let through";
        } catch (const Error& error) {
            ASSERT_EQ(error.code(), ErrorCode::unreadable) << error.what();
        }
        ASSERT_TRUE(begun);
        job.expect(second);
        recalled += second.counters.recalled_pairs > 0 ? 1 : 0;
        const StoreClashReport again = find_clashes(open_store(job.store), options, little);
        job.expect(again);
        EXPECT_EQ(again.counters.recalled_pairs, job.truth.candidates);
    }
    std::cout << recalled << " went on with what the first had done\n";
}

TEST(OutOfCore, AModelIsNoLargerThanItsEstimate) {
    Random random(6102);
    for (int round = 0; round < many(3); ++round) {
        const Folder folder;
        Scene scene = some_scene(random, 60, 4);
        scene.meshes.push_back(torus_mesh(1, 0.3, 300, 100));
        scene.parts.front().mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
        scene.meshes.push_back(torus_mesh(1, 0.3, 300, 150)); // large
        scene.parts.back().mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
        write_glb(scene, folder / "a.glb");
        (void)import_models({folder / "a.glb"}, folder / "a.abut");
        const Store store = open_store(folder / "a.abut");
        const StoredParts stored = gather_parts(store.file());
        for (const StoredMesh& mesh : stored.meshes) {
            if (mesh.bytes == 0)
                continue;
            const Model model(store.file().read_mesh(mesh.mesh));
            ASSERT_LE(model.bytes(), mesh.bytes);
            ASSERT_GE(2 * model.bytes() + 2048, mesh.bytes);
        }
        ASSERT_EQ(stored.large.size(), 1U);
        const StoredLargeMesh& large = stored.large.front();
        const std::int64_t row = stored.meshes[large.mesh].mesh;
        const std::vector<StoredBlock> blocks = stored_blocks(store.file(), store.file().mesh(row));
        ASSERT_EQ(blocks.size(), large.blocks);
        for (const StoredBlock& block : blocks) {
            ASSERT_LE(block.bytes, large.largest_block);
            const ModelBlock made = make_model_block(store.file().read_block(block.row));
            const std::uint64_t bytes = made.model.bytes() + 4 * made.numbers.size();
            ASSERT_LE(bytes, block.bytes);
            ASSERT_GE(2 * bytes, block.bytes);
        }
    }
}

TEST(OverlapGraph, IsKeptForSqlAndCountsLargeMeshes) {
    Random random(6107);
    for (int round = 0; round < many(4); ++round) {
        const Folder folder;
        const std::string store = folder / "a.abut";
        Scene scene = some_scene(random, random.integer(60, 120), 4);
        if (round % 2 == 1) {
            scene.meshes.push_back(torus_mesh(1, 0.3, 300, 150)); // large
            scene.parts.back().mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
        }
        write_glb(scene, folder / "a.glb");
        (void)import_models({folder / "a.glb"}, store);
        const Store opened = open_store(store);
        const StoredParts stored = gather_parts(opened.file());
        for (const double clearance : {0.0, 0.05}) { // the second graph replaces the first
            ClashOptions options;
            options.clearance = clearance;
            options.touch_tolerance = 0; // the table below knows no precisions
            const OutOfCoreOptions limits{.memory =
                                              round % 2 == 1 ? std::uint64_t{64} << 20 : 800'000};
            const GraphReport graph = overlap_graph(opened, options, limits, 0, true);
            std::uint64_t bytes = 0, large = 0;
            std::set<std::uint32_t> needed;
            std::set<std::pair<std::int64_t, std::int64_t>> pairs;
            for (const IndexPair& pair : find_candidates(stored, RuleTable(options), options)) {
                const StoredPart &a = stored.parts[pair.a()], &b = stored.parts[pair.b()];
                pairs.insert({a.row, b.row});
                needed.insert({a.mesh, b.mesh});
            }
            for (const std::uint32_t mesh : needed) {
                const MeshRow row = opened.file().mesh(stored.meshes[mesh].mesh);
                std::uint64_t of_blocks = 0;
                for (const StoredBlock& block : stored_blocks(opened.file(), row))
                    of_blocks += block.bytes;
                large += row.blocks > 1 ? of_blocks : 0;
                bytes += row.blocks > 1 ? of_blocks : stored.meshes[mesh].bytes;
            }
            EXPECT_EQ(graph.bytes, bytes);
            EXPECT_EQ(graph.large_bytes, large);
            EXPECT_EQ(graph.large_meshes, large > 0 ? 1U : 0U);
            Database database(store, OpenMode::read_only);
            Statement edges(database, "SELECT part_a, part_b FROM overlap_edge JOIN overlap_unit "
                                      "USING (unit)");
            std::size_t found = 0;
            for (; edges.step(); ++found)
                ASSERT_TRUE(pairs.contains({edges.integer(0), edges.integer(1)}));
            EXPECT_EQ(found, pairs.size());
            EXPECT_GT(found, 20U);
            const auto number = [&](const char* sql) {
                return static_cast<std::uint64_t>(database.number(sql));
            };
            EXPECT_EQ(number("SELECT count(*) FROM overlap_graph"), 1U);
            EXPECT_EQ(number("SELECT edges FROM overlap_graph"), pairs.size());
            EXPECT_EQ(number("SELECT count(*) FROM overlap_unit"), graph.units.size());
            EXPECT_EQ(number("SELECT sum(edges) FROM overlap_unit"), pairs.size());
            EXPECT_EQ(number("SELECT count(*) FROM overlap_graph WHERE generation = "
                             "(SELECT max(generation) FROM model)"),
                      1U);
            if (round % 2 == 0) {
                EXPECT_GT(graph.units.size(), 1U);
            }
        }
        verify(opened);
    }
}

TEST(OverlapGraph, ForeignTablesAreNotTouched) {
    Random random(6108);
    const Folder folder;
    write_glb(some_scene(random, 20, 4), folder / "a.glb");
    (void)import_models({folder / "a.glb"}, folder / "a.abut");
    Database(folder / "a.abut", OpenMode::read_write).run("CREATE TABLE overlap_edge(mine TEXT)");
    const Store opened = open_store(folder / "a.abut");
    EXPECT_GT(overlap_graph(opened, {}).nodes, 0U);
    try {
        (void)overlap_graph(opened, {}, {}, 0, true);
        FAIL() << "kept";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_argument);
        EXPECT_NE(std::string(error.what()).find("overlap_edge"), std::string::npos);
    }
}

TEST(WorkUnits, HoldEveryPairOnceAndFit) {
    Random random(6103);
    std::size_t units = 0, alone = 0, refused = 0;
    for (int round = 0; round < many(200); ++round) {
        StoredParts stored;
        const int parts = random.integer(2, 300), meshes = random.integer(1, parts);
        for (int i = 0; i < meshes; ++i)
            stored.meshes.push_back(
                {i + 1, static_cast<std::uint32_t>(random.integer(1, 1000)), 1});
        const int large = random.chance(0.5) ? random.integer(1, std::min(3, meshes)) : 0;
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(large); ++i) {
            stored.meshes[i].bytes = 0;
            stored.large.push_back({i, static_cast<std::uint64_t>(random.integer(1, 50)), 1});
        }
        for (int i = 0; i < parts; ++i) {
            StoredPart part;
            part.mesh = static_cast<std::uint32_t>(random.integer(0, meshes - 1));
            const Vec3 at = random.in_cube(5);
            stored.boxes.push_back({at, at});
            stored.parts.push_back(part);
        }
        std::set<IndexPair> pairs;
        const int wanted = random.integer(0, 4 * parts);
        for (int i = 0; i < wanted; ++i) {
            const int a = random.integer(0, parts - 1),
                      b = random.chance(0.8) ? std::min(parts - 1, a + random.integer(1, 5))
                                             : random.integer(0, parts - 1);
            if (a != b)
                pairs.insert(
                    IndexPair(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)));
        }
        std::uint64_t largest = 0;
        for (const IndexPair& pair : pairs) {
            const std::uint32_t a = stored.parts[pair.a()].mesh, b = stored.parts[pair.b()].mesh;
            largest = std::max<std::uint64_t>(largest, stored.meshes[a].bytes +
                                                           (a == b ? 0 : stored.meshes[b].bytes));
        }
        const auto budget = static_cast<std::uint64_t>(random.integer(1, 20'000));
        const WorkOrder order = random.chance(0.3) ? WorkOrder::random : WorkOrder::partition;
        try {
            std::set<IndexPair> seen;
            for (const WorkUnit& unit :
                 make_work_units(stored, {pairs.begin(), pairs.end()}, budget, order, "s")) {
                ++units;
                ASSERT_LE(unit.bytes, 2 * budget);
                ASSERT_EQ(unit.alone, unit.bytes > budget);
                alone += unit.alone ? 1 : 0;
                ASSERT_TRUE(std::is_sorted(unit.pairs.begin(), unit.pairs.end()));
                std::set<std::uint32_t> needed;
                for (const IndexPair& pair : unit.pairs) {
                    ASSERT_TRUE(seen.insert(pair).second);
                    for (const std::uint32_t part : {pair.a(), pair.b()})
                        if (stored.find_large(stored.parts[part].mesh) == nullptr)
                            needed.insert(stored.parts[part].mesh);
                }
                ASSERT_EQ(std::vector(needed.begin(), needed.end()), unit.meshes);
                std::uint64_t bytes = 0;
                for (const std::uint32_t mesh : unit.meshes)
                    bytes += stored.meshes[mesh].bytes;
                ASSERT_EQ(bytes, unit.bytes);
            }
            ASSERT_EQ(seen, pairs);
            ASSERT_LE(largest, 2 * budget);
        } catch (const Error& error) {
            ASSERT_EQ(error.code(), ErrorCode::bad_argument);
            ASSERT_GT(largest, 2 * budget);
            ++refused;
        }
    }
    std::cout << units << " units, " << alone << " of them alone, " << refused << " refused\n";
    EXPECT_GT(alone, static_cast<std::size_t>(many(200)) / 20);
    EXPECT_GT(units, static_cast<std::size_t>(many(200)) * 5);
    EXPECT_GT(refused, static_cast<std::size_t>(many(200)) / 100);
}

} // namespace
} // namespace abut::test
