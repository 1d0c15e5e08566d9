// Hierarchies that a job has kept in the store. Models made of them equal models that are built,
// and later jobs find the same clashes as without them. No row changes the result, whatever it
// contains.

#include <abut/clash.h>
#include <abut/error.h>
#include <abut/model.h>
#include <abut/store_clash.h>

#include "massive/work/large_meshes.h"
#include "rigid/model/model_data.h"
#include "store/codec/hierarchy_codec.h"
#include "store/database/hierarchy_table.h"
#include "store/model_reader.h"
#include "tests/support/clash/clash_scenes.h"
#include "tests/support/folder.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"
#include "tests/support/store/changing_site.h"
#include "tests/support/tree/trees.h"

#include <gtest/gtest.h>
#include <iostream>

namespace abut::test {
namespace {

std::vector<std::int64_t> kept_blocks(const std::string& store) {
    Database database(store, OpenMode::read_only);
    std::vector<std::int64_t> blocks;
    if (has_hierarchies(database)) {
        Statement rows(database, "SELECT block FROM hierarchy ORDER BY block");
        while (rows.step())
            blocks.push_back(rows.integer(0));
    }
    return blocks;
}

/// A store of one random model; some of its meshes may be large.
class StoredModel {
public:
    explicit StoredModel(Random& random, int large = 0) {
        Scene scene = some_scene(random, random.integer(60, 120), 4);
        for (int i = 0; i < large; ++i) {
            scene.meshes.push_back(torus_mesh(2, 1, random.integer(200, 260), 170));
            scene.parts.push_back({"large" + std::to_string(i), "", "",
                                   static_cast<std::uint32_t>(scene.meshes.size() - 1),
                                   random.pose(0.5)});
        }
        write_glb(scene, folder_ / "a.glb");
        (void)import_models({folder_ / "a.glb"}, store());
        scenes_ = read_scenes({folder_ / "a.glb"});
    }
    [[nodiscard]] std::string store() const { return folder_ / "a.abut"; }

    /// Runs the job of the store and expects exactly the result of the in-core job.
    StoreClashReport expect_equal_job(double clearance, const OutOfCoreOptions& how = {}) const {
        ClashOptions options;
        options.clearance = clearance;
        StoreClashReport found = find_clashes(open_store(store()), options, how);
        expect_equal(found.report, found.models, find_clashes(scenes_, options), scenes_);
        return found;
    }

    /// Expects every mesh and mesh block to give the same model from the store as when built.
    /// Returns how many had a hierarchy in the store.
    [[nodiscard]] std::uint64_t expect_models_as_built() const {
        const Store opened = open_store(store());
        ModelReader reader(opened.file(), 0);
        std::vector<MeshRow> meshes;
        opened.file().for_each_mesh([&](const MeshRow& mesh) { meshes.push_back(mesh); });
        for (const MeshRow& mesh : meshes)
            for (const BlockRow& block : opened.file().blocks(mesh)) {
                const Model model = mesh.blocks == 1 ? reader.read_mesh(mesh.mesh)
                                                     : reader.read_block(block.block).model;
                const Model built(opened.file().read_block(block.block).mesh);
                EXPECT_EQ(model.mesh().triangles, built.mesh().triangles);
                expect_same_tree(model.data().tree(), built.data().tree());
            }
        return reader.found();
    }

    /// Like expect_equal_job, except that depths may differ, because they depend on the hierarchy
    /// within their accuracy.
    StoreClashReport expect_like_job(double clearance) const {
        ClashOptions options;
        options.clearance = clearance;
        StoreClashReport found = find_clashes(open_store(store()), options);
        const ClashReport truth = find_clashes(scenes_, options);
        EXPECT_EQ(found.report.counts, truth.counts);
        EXPECT_EQ(found.report.clashes.size(), truth.clashes.size());
        for (std::size_t i = 0; i < truth.clashes.size() && !testing::Test::HasFailure(); ++i) {
            const Clash &a = found.report.clashes[i], &b = truth.clashes[i];
            EXPECT_EQ(a.id, b.id);
            EXPECT_EQ(a.kind, b.kind);
            EXPECT_EQ(a.triangle_pairs, b.triangle_pairs);
            EXPECT_NEAR(a.distance, b.distance, a.distance < 0 ? 0.01 : 1e-12);
        }
        return found;
    }

private:
    Folder folder_;
    std::vector<Scene> scenes_;
};

TEST(KeptHierarchies, LaterJobsReadThemAndFindTheSameClashes) {
    Random random(8401);
    std::uint64_t kept = 0, found = 0, of_blocks = 0;
    for (int round = 0; round < many(4); ++round) {
        const StoredModel model(random, round % 2);
        const double clearance = random.uniform(0, 0.1);
        const StoreClashReport first = model.expect_equal_job(clearance);
        const OutOfCoreCounters& work = first.counters;
        EXPECT_EQ(work.hierarchies_found, 0U);
        EXPECT_EQ(work.hierarchies_kept, work.meshes + work.blocks);
        EXPECT_EQ(kept_blocks(model.store()).size(), work.hierarchies_kept);
        EXPECT_EQ(model.expect_models_as_built(), work.hierarchies_kept);
        // A second job with other options, in any memory, finds every hierarchy that the first one
        // needed.
        OutOfCoreOptions how;
        how.memory = random.chance(0.5) || round % 2 == 1 ? how.memory : 800'000;
        how.keep = random.chance(0.5);
        const OutOfCoreCounters second =
            model.expect_equal_job(clearance * random.uniform(0.2, 0.9), how).counters;
        EXPECT_EQ(second.hierarchies_found, second.mesh_loads + second.block_loads);
        EXPECT_EQ(second.hierarchies_kept, 0U);
        verify(open_store(model.store()));
        if (HasFailure())
            return;
        kept += work.hierarchies_kept;
        found += second.hierarchies_found;
        of_blocks += work.blocks;
    }
    std::cout << kept << " kept, " << of_blocks << " of blocks, " << found << " found\n";
    EXPECT_GT(found, kept / 2);
    EXPECT_GT(of_blocks, static_cast<std::uint64_t>(many(4)) / 2);
}

TEST(KeptHierarchies, AreKeptOnlyIfRequested) {
    Random random(8402);
    const StoredModel model(random);
    EXPECT_EQ(model.expect_equal_job(0.05, {.keep_hierarchies = false}).counters.hierarchies_kept,
              0U);
    EXPECT_EQ(model.expect_equal_job(0.04, {.keep = false}).counters.hierarchies_kept, 0U);
    EXPECT_TRUE(kept_blocks(model.store()).empty());
    EXPECT_GT(model.expect_equal_job(0.03).counters.hierarchies_kept, 0U);
}

/// In little memory only some hierarchies can wait to be kept; later jobs keep more.
TEST(KeptHierarchies, AreKeptByLaterJobsInLittleMemory) {
    Random random(8403);
    const StoredModel model(random);
    std::uint64_t kept = 0;
    for (int job = 0; job < 10; ++job) {
        const OutOfCoreCounters work =
            model.expect_equal_job(0.05 + 1e-6 * job, {.memory = 700'000}).counters;
        kept += work.hierarchies_kept;
        EXPECT_EQ(kept_blocks(model.store()).size(), kept);
    }
    EXPECT_GT(kept, 0U);
    EXPECT_EQ(model.expect_models_as_built(), kept);
}

HierarchyRow row_of(Database& database, std::int64_t block) {
    Statement find(database, kFindHierarchy);
    EXPECT_TRUE(find.bind(block).step());
    const auto data = find.bytes(4);
    return {block, static_cast<std::uint64_t>(find.integer(1)), {data.begin(), data.end()}};
}

void flip(Random& random, HierarchyRow& row) {
    row.data.at(random.bits() % row.data.size()) ^=
        static_cast<std::byte>(1 << random.integer(0, 7));
}

/// Damages a row as may really happen: a bad disk, another version, a block that was replaced.
void damage(Random& random, Database& database, std::int64_t block) {
    HierarchyRow row = row_of(database, block);
    switch (random.integer(0, 3)) {
    case 0:
        flip(random, row);
        Statement(database, "UPDATE hierarchy SET data = ? WHERE block = ?")
            .bind(row.data, block)
            .run();
        return;
    case 1:
        Statement(database, "UPDATE hierarchy SET format = 77 WHERE block = ?").bind(block).run();
        return;
    case 2:
        row.block_checksum += 1;
        break;
    default:
        row.data.resize(random.bits() % row.data.size());
    }
    keep_hierarchies(database, {row});
}

/// Writes a wrong row with a correct checksum, which cannot happen by chance.
void forge(Random& random, Database& database, std::int64_t block, std::int64_t other) {
    HierarchyRow row = row_of(database, block);
    const auto outline =
        decode_hierarchy(row.data, std::uint64_t{1} << 16); // none, unless for exactly 65,536
                                                            // triangles
    EXPECT_FALSE(outline);
    switch (random.integer(0, 2)) {
    case 0:
        flip(random, row);
        break;
    case 1:
        row.data = row_of(database, other).data;
        break;
    default: // well-formed bytes with random contents
        ModelOutline any{static_cast<TreeAxes>(random.integer(0, 3)), {}};
        for (int i = random.integer(0, 30); i > 0; --i)
            any.tree.nodes.push_back(static_cast<std::uint32_t>(random.bits() >> 39));
        for (auto i = static_cast<std::uint32_t>(random.integer(0, 300)); i > 0; --i)
            any.tree.order.push_back(i - 1);
        row.data = encode_hierarchy(any);
    }
    keep_hierarchies(database, {row});
}

/// Calls change(database, block, another block) for some random rows of a store.
template <typename Change>
void change_rows(Random& random, const std::string& store, int rows, const Change& change) {
    const std::vector<std::int64_t> blocks = kept_blocks(store);
    const auto some = [&] {
        return blocks.at(
            static_cast<std::size_t>(random.integer(0, static_cast<int>(blocks.size()) - 1)));
    };
    Database database(store, OpenMode::read_write);
    Transaction transaction(database);
    for (int i = 0; i < rows; ++i)
        change(database, some(), some());
    transaction.commit();
}

TEST(KeptHierarchies, DamagedRowsAreBuiltAndKeptAnew) {
    Random random(8404);
    std::uint64_t again = 0, damaged = 0;
    for (int round = 0; round < many(6); ++round) {
        const StoredModel model(random);
        const double clearance = random.uniform(0.01, 0.1);
        const std::uint64_t all = model.expect_equal_job(clearance).counters.hierarchies_kept;
        for (int job = 1; job < 4; ++job) {
            const int rows = random.integer(1, 20);
            change_rows(random, model.store(), rows,
                        [&](Database& database, std::int64_t block, std::int64_t) {
                            damage(random, database, block);
                        });
            const OutOfCoreCounters work =
                model.expect_equal_job(clearance * (1 - 0.01 * job)).counters;
            EXPECT_EQ(work.hierarchies_found + work.hierarchies_kept, work.mesh_loads);
            EXPECT_EQ(kept_blocks(model.store()).size(), all);
            again += work.hierarchies_kept;
            damaged += static_cast<std::uint64_t>(rows);
            if (HasFailure())
                return;
        }
    }
    std::cout << damaged << " changes, " << again << " built again\n";
    EXPECT_GT(again, damaged / 8);
    EXPECT_LE(again, damaged);
}

TEST(KeptHierarchies, ForgedRowsAreRefusedOrHarmless) {
    Random random(8408);
    std::uint64_t again = 0;
    for (int round = 0; round < many(6); ++round) {
        const StoredModel model(random);
        const double clearance = random.uniform(0.01, 0.1);
        (void)model.expect_equal_job(clearance);
        for (int job = 1; job < 4; ++job) {
            change_rows(random, model.store(), random.integer(1, 20),
                        [&](Database& database, std::int64_t block, std::int64_t other) {
                            forge(random, database, block, other);
                        });
            const OutOfCoreCounters work =
                model.expect_like_job(clearance * (1 - 0.01 * job)).counters;
            EXPECT_EQ(work.hierarchies_found + work.hierarchies_kept, work.mesh_loads);
            again += work.hierarchies_kept;
            if (HasFailure())
                return;
        }
    }
    std::cout << again << " built again\n";
    EXPECT_GT(again, static_cast<std::uint64_t>(many(6)));
}

TEST(KeptHierarchies, AForeignTableIsLeftAlone) {
    Random random(8405);
    const StoredModel model(random);
    Database(model.store(), OpenMode::read_write)
        .run("CREATE TABLE hierarchy(boss TEXT, report TEXT); "
             "INSERT INTO hierarchy VALUES ('a', 'b')");
    (void)model.expect_equal_job(0.05);
    EXPECT_EQ(model.expect_equal_job(0.04).counters.hierarchies_found, 0U);
    EXPECT_EQ(Database(model.store(), OpenMode::read_only)
                  .number("SELECT count(*) FROM hierarchy WHERE boss = 'a'"),
              1);
}

TEST(KeptHierarchies, VerifyFindsDamage) {
    Random random(8406);
    const StoredModel model(random);
    (void)model.expect_equal_job(0.05);
    verify(open_store(model.store()));
    Database(model.store(), OpenMode::read_write)
        .run("UPDATE hierarchy SET data = zeroblob(length(data)) "
             "WHERE block = (SELECT min(block) FROM hierarchy)");
    EXPECT_THROW(verify(open_store(model.store())), Error);
    (void)model.expect_equal_job(0.049); // builds and keeps it anew
    verify(open_store(model.store()));
}

/// Hierarchies are removed with their blocks. Imports change and remove meshes, and numbers of
/// blocks may be used again.
TEST(KeptHierarchies, AreRemovedWithTheirBlocks) {
    Random random(8407);
    std::uint64_t found = 0, kept = 0;
    for (int round = 0; round < many(4); ++round) {
        ChangingSite site(random, random.integer(1, 2), 60);
        for (int change = 0; change < 5; ++change) {
            ClashOptions options;
            options.clearance = random.uniform(0.01, 0.1);
            const StoreClashReport job = find_clashes(open_store(site.store()), options);
            expect_equal(job.report, job.models, find_clashes(site.scenes(), options),
                         site.scenes());
            found += job.counters.hierarchies_found;
            kept += job.counters.hierarchies_kept;
            site.change();
            Database database(site.store(), OpenMode::read_only);
            if (has_hierarchies(database)) {
                ASSERT_EQ(
                    database.number("SELECT count(*) FROM hierarchy LEFT JOIN block "
                                    "USING (block) WHERE data_checksum IS NOT block_checksum"),
                    0);
            }
        }
        verify(open_store(site.store()));
    }
    std::cout << kept << " kept, " << found << " found\n";
    EXPECT_GT(found, kept / 4);
    EXPECT_GT(kept, 0U);
}

} // namespace
} // namespace abut::test
