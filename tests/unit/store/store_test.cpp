/// Stores worked by hand, and the queries of docs/store.md.
#include <abut/error.h>
#include <abut/scene.h>
#include <abut/store.h>

#include "io/scene/unique_ids.h"
#include "store/codec/mesh_codec.h"
#include "store/database/exclusive_store.h"
#include "store/database/store_file.h"
#include "store/import/cut_mesh.h"
#include "store/import/mesh_draft.h"
#include "tests/support/folder.h"
#include "tests/support/store/page_queries.h"

#include <chrono>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <future>
#include <gtest/gtest.h>
#include <memory>
#include <sys/wait.h>
#include <unistd.h>

namespace abut::test {
namespace {

class StoreByHand : public testing::Test {
protected:
    /// Two tetrahedra, one of them moved up by 10, and an open triangle.
    void import() {
        Scene scene;
        scene.meshes = {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                         {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}},
                        {{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {9, 9, 9}}, {{0, 1, 2}}}};
        scene.parts = {{"low", "Low one", "Solid", 0, {}},
                       {"high", "High one", "Solid", 0, Pose{.translation = {0, 10, 0}}},
                       {"flat", "Flat one", "Shell", 1, {}}};
        const std::string file = folder_ / "a.glb";
        write_glb(scene, file);
        import_models({file}, store_);
    }
    Folder folder_;
    std::string store_ = folder_ / "s.abut";
};

TEST_F(StoreByHand, ThreePartsAreListed) {
    import();
    const Store store = open_store(store_);
    const StoreSummary found = summary(store);
    EXPECT_TRUE(found.complete);
    EXPECT_EQ(found.version, 4);
    EXPECT_EQ(found.generation, 1U);
    EXPECT_EQ(found.parts, 3U);
    EXPECT_EQ(found.triangles, 9U);
    EXPECT_EQ(found.meshes, 2U);
    EXPECT_EQ(found.stored_triangles, 5U);
    EXPECT_EQ(found.blocks, 2U);
    // The header has 16 bytes, a vertex three floats, a triangle three indices.
    EXPECT_EQ(found.raw_bytes, 16U + 4 * 12 + 4 * 12 + 16 + 4 * 12 + 1 * 12);
    // No triangle uses the vertex at (9, 9, 9).
    EXPECT_EQ(found.bounds, (Box3{{0, 0, 0}, {3, 11, 1}}));

    StoreFile& file = store.file();
    const MeshRow solid = file.mesh(1), shell = file.mesh(2);
    EXPECT_EQ(solid.closed, true);
    EXPECT_EQ(shell.closed, false);
    EXPECT_EQ(shell.vertices, 4U);
    EXPECT_EQ(shell.box, (Box3{{0, 0, 0}, {3, 3, 0}}));
    EXPECT_EQ(file.part(2).box, (Box3{{0, 10, 0}, {1, 11, 1}}));
    EXPECT_EQ(file.bytes_read(), 0U) << "rows alone have been read";
    EXPECT_EQ(file.read_mesh(2).positions.back(), (Vec3{9, 9, 9}));
    EXPECT_EQ(file.bytes_read(), shell.stored_bytes);
    EXPECT_THROW(file.mesh(3), Error);
    EXPECT_THROW(file.part(4), Error);
}

TEST_F(StoreByHand, QueriesOfItsPageWork) {
    import();
    // Rows of the queries: none in the box, two types, one colour (none), two meshes, three parts
    // of the last import, one open shell, none.
    EXPECT_EQ(rows_of_page_queries("store.md", store_), (std::vector<int>{0, 2, 1, 2, 3, 1, 0}));
}

/// An import that fails empties the file that it found empty, also while others read it.
TEST_F(StoreByHand, AFileEmptiedMeanwhileIsReportedEmpty) {
    const auto message = [](const auto& read) -> std::string {
        try {
            read();
        } catch (const Error& error) {
            return error.what();
        }
        return "nothing";
    };
    import();
    StoreFile file(store_, OpenMode::read_only);
    std::filesystem::resize_file(store_, 0);
    const std::string truth = message([&] { (void)open_store(store_); });
    EXPECT_NE(truth.find("is empty"), std::string::npos) << truth;
    EXPECT_EQ(message([&] { file.models(); }), truth);
    // The file was emptied between the look at its size and its opening.
    EXPECT_EQ(message([&] { StoreFile(store_, OpenMode::read_only); }), truth);
}

/// How many descriptors of this process have the file open.
std::size_t descriptors_of(const std::string& path) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
        std::error_code closed;
        count += std::filesystem::read_symlink(entry, closed) == path ? 1 : 0;
    }
    return count;
}

/// A writer that waited for a store that is undone must leave the next store's journal alone: only
/// the journal can mend that store if its import is killed.
TEST_F(StoreByHand, AWriterThatWaitsTakesNoJournalOfANewStore) {
    constexpr auto kCreate = ExclusiveStore::IfMissing::create;
    constexpr std::uint64_t kCache = 1 << 20;
    std::size_t refused = 0;
    for (int round = 0; round < 5; ++round) {
        auto first = std::make_unique<ExclusiveStore>(store_, kCache, kCreate);
        auto waiting = std::async(std::launch::async, [&] {
            try {
                const ExclusiveStore taken(store_, kCache, kCreate);
                return true;
            } catch (const Error&) {
                return false;
            }
        });
        // SQLite keeps one descriptor a connection.
        bool waits = false;
        while (!waits && waiting.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
            waits = descriptors_of(store_) > 1;
        first->undo_creation();
        {
            ExclusiveStore next(store_, kCache, kCreate);
            Transaction transaction(next.database());
            next.database().run("CREATE TABLE begun (a)");
            ASSERT_TRUE(std::filesystem::exists(store_ + "-journal"));
            if (!waiting.get() && waits) {
                ++refused;
                EXPECT_TRUE(std::filesystem::exists(store_ + "-journal"));
            }
            transaction.commit();
        }
        std::filesystem::remove(store_);
    }
    EXPECT_GT(refused, 0U);
}

TEST_F(StoreByHand, AMissingOrEmptyFileIsRefused) {
    EXPECT_THROW(open_store(store_), Error);
    std::ofstream(store_).close();
    EXPECT_THROW(open_store(store_), Error);
    EXPECT_FALSE(is_store(store_));
    EXPECT_THROW(import_models({store_}, store_), Error);
}

TEST(MeshCodec, ASheetInOrderCostsNothingForItsCorners) {
    // New vertices are stored as zeros, which compress to almost nothing. What remains is the
    // positions.
    MeshBlock block;
    for (std::uint32_t i = 0; i < 3000; ++i) {
        block.mesh.positions.push_back({0, 0, 0});
        if (i % 3 == 2)
            block.mesh.triangles.push_back({i - 2, i - 1, i});
    }
    const EncodedBlock encoded = encode_block(block);
    EXPECT_EQ(encoded.raw_bytes, 16U + 3000 * 12 + 1000 * 12);
    EXPECT_LT(encoded.data.size(), 64U);
}

TEST(MeshCodec, RefusesInvalidBlocks) {
    MeshBlock block;
    block.mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    const EncodedBlock encoded = encode_block(block);
    EXPECT_THROW(decode_block(encoded.data, encoded.raw_bytes + 1), std::runtime_error);
    EXPECT_THROW(decode_block(std::span(encoded.data).first(9), encoded.raw_bytes),
                 std::runtime_error);
    EXPECT_THROW(decode_block({}, 0), std::runtime_error);
}

TEST(CutMesh, SmallMeshesStayWholeAndLargeOnesAreCut) {
    const auto strip = [](std::uint32_t triangles) {
        Mesh mesh;
        for (std::uint32_t i = 0; i < triangles + 2; ++i)
            mesh.positions.push_back({static_cast<double>(i), static_cast<double>(i % 2), 0});
        for (std::uint32_t i = 0; i < triangles; ++i)
            mesh.triangles.push_back({i, i + 1, i + 2});
        return mesh;
    };
    std::vector<std::size_t> sizes;
    const auto count = [&](const MeshBlock& block) {
        sizes.push_back(block.mesh.triangles.size());
    };
    cut_mesh(strip(60000), count);
    EXPECT_EQ(sizes, (std::vector<std::size_t>{60000}));
    sizes.clear();
    cut_mesh(strip(70000), count);
    EXPECT_EQ(sizes, (std::vector<std::size_t>{32768, 32768, 70000 - 65536}));
    // Along a strip, the mesh blocks follow each other.
    double end = 0;
    cut_mesh(strip(70000), [&](const MeshBlock& block) {
        EXPECT_EQ(encode_draft(block).row.box.lower.x, end);
        end = encode_draft(block).row.box.upper.x - 1;
    });
}

TEST(UniqueIds, EqualThoseOfAScene) {
    UniqueIds ids;
    const std::vector<std::string> given{"a", "a", "a#2", "a", "b", "b"};
    for (const std::string& id : given)
        ids.announce(id);
    ids.finish();
    std::vector<std::string> unique;
    unique.reserve(given.size());
    for (const std::string& id : given)
        unique.push_back(ids.unique(id));
    EXPECT_EQ(unique, (std::vector<std::string>{"a", "a#3", "a#2", "a#4", "b", "b#2"}));
}

/// Returns whether another process sees a lock on a file.
bool is_locked_for_others(const std::string& path) {
    const pid_t child = fork();
    if (child == 0) {
        const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
        struct flock lock {};
        lock.l_type = F_RDLCK;
        const bool is_locked = fcntl(file, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
        _exit(is_locked ? 1 : 0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 1;
}

// The system releases a process's locks on a file when the process closes any descriptor of it.
TEST_F(StoreByHand, AskingWhetherAFileIsAStoreReleasesNoLock) {
    import();
    Database database(store_, OpenMode::read_write);
    database.run("BEGIN EXCLUSIVE");
    ASSERT_TRUE(is_locked_for_others(store_));
    EXPECT_TRUE(is_store(store_));
    EXPECT_THROW(import_models({store_}, folder_ / "other.abut"), Error);
    EXPECT_TRUE(is_locked_for_others(store_));
    database.run("COMMIT");
    EXPECT_FALSE(is_locked_for_others(store_));
}

} // namespace
} // namespace abut::test
