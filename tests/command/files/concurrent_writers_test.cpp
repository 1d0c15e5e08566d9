// Processes that write the same file at once: one wins and keeps its file, the others wait or
// report why not.
#include <abut/store.h>

#include "tests/command/models.h"
#include "tests/command/run_command.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <fcntl.h>
#include <filesystem>
#include <future>
#include <gtest/gtest.h>
#include <iostream>
#include <sys/file.h>
#include <unistd.h>
#include <vector>

namespace abut::test {
namespace {

bool holds(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

bool has_model(const std::string& store, const std::string& file) {
    for (const StoreSummary::Model& model : summary(open_store(store)).models)
        if (model.file == file && model.complete && model.parts == 1)
            return true;
    return false;
}

TEST(ConcurrentWriters, CreateOneStoreAtOnce) {
    const TemporaryFolder folder;
    const std::string store = folder / "s.abut";
    const std::string bad = folder.write("bad.obj", "v 0 0 0\nf 1 2 3\n");
    const std::vector<std::string> models = {folder.write("a.obj", box_obj()),
                                             folder.write("b.obj", box_obj()), bad, bad};
    std::size_t imported = 0, refused = 0, shared = 0, empty = 0;
    for (int round = 0; round < many(30); ++round) {
        std::filesystem::remove(store);
        std::vector<std::future<Outcome>> imports;
        // Every other round has only one sound model, so that failing imports come first more
        // often.
        const std::size_t first = round % 2 == 0 ? 0 : 1;
        for (std::size_t i = first; i < models.size(); ++i)
            imports.push_back(std::async(std::launch::async, [&, i] {
                return run_abut({"import", models[i], store});
            }));
        auto reader = std::async(std::launch::async, [&] { return run_abut({"info", store}); });
        std::size_t successes = 0;
        for (std::size_t i = first; i < models.size(); ++i) {
            const Outcome outcome = imports[i - first].get();
            if (outcome.status == 0) {
                ASSERT_NE(models[i], bad);
                ASSERT_TRUE(std::filesystem::exists(store)) << "a store is lost";
                ++successes;
                continue;
            }
            ASSERT_EQ(outcome.status, 2);
            const bool is_its_own_fault = models[i] == bad && holds(outcome.err, "bad.obj");
            ASSERT_TRUE(is_its_own_fault || holds(outcome.err, "in use by another process"))
                << outcome.err;
            ++refused;
        }
        const Outcome info = reader.get();
        ASSERT_TRUE(info.status == 0 || holds(info.err, "in use by another process") ||
                    holds(info.err, "no such file") || holds(info.err, "is empty") ||
                    holds(info.err, "was removed by another process"))
            << info.err;
        if (successes == 0) {
            ++empty;
            continue;
        }
        verify(open_store(store));
        std::size_t there = 0;
        for (std::size_t i = first; i < 2; ++i)
            there += has_model(store, models[i]) ? 1 : 0;
        ASSERT_EQ(there, successes) << "an import that succeeded is not there";
        imported += successes;
        shared += successes > 1 ? 1 : 0;
    }
    std::cout << imported << " imported, " << shared << " stores of two processes, " << refused
              << " refused, " << empty << " rounds without a store\n";
    EXPECT_GT(imported, 0U);
    EXPECT_GT(shared, 0U);
    EXPECT_GT(refused, 0U);
    EXPECT_FALSE(std::filesystem::exists(store + "-journal"));
}

TEST(ConcurrentWriters, AStoreThatFailsLeavesWhatWasThere) {
    const TemporaryFolder folder;
    const std::string bad = folder.write("bad.obj", "v 0 0 0\nf 1 2 3\n");
    const std::string empty = folder.write("empty.abut", "");
    EXPECT_EQ(run_abut({"import", bad, empty}).status, 2);
    EXPECT_EQ(std::filesystem::file_size(empty), 0U);
    EXPECT_EQ(run_abut({"import", bad, folder / "new.abut"}).status, 2);
    EXPECT_EQ(folder.list(), (std::vector<std::string>{"bad.obj", "empty.abut"}));
    expect_refused(run_abut({"info", empty}), {"empty.abut", "is empty"});
}

TEST(ConcurrentWriters, LeaveAFileOfImpactsToItsWriter) {
    const TemporaryFolder folder;
    const std::string scene = folder / "frames";
    ASSERT_EQ(
        run_abut({"scene", "twist", "--triangles", "1000", "--frames", "2", "--out", scene}).status,
        0);
    std::vector<std::string> frames;
    for (const auto& entry : std::filesystem::directory_iterator(scene))
        frames.push_back(entry.path());
    std::sort(frames.begin(), frames.end());
    ASSERT_GE(frames.size(), 2U);
    const std::string out = folder.write("impacts.csv", "another process's rows\n");
    const int other = open(out.c_str(), O_WRONLY | O_CLOEXEC);
    ASSERT_EQ(flock(other, LOCK_EX), 0);
    const Outcome refused = run_abut({"ccd", frames[0], frames[1], "--out", out});
    EXPECT_EQ(refused.status, 2);
    EXPECT_TRUE(holds(refused.err, "in use by another process")) << refused.err;
    EXPECT_EQ(read_file(out), "another process's rows\n");
    close(other);
    EXPECT_EQ(run_abut({"ccd", frames[0], frames[1], "--out", out}).status, 0);
    EXPECT_TRUE(read_file(out).starts_with("step,kind"));
}

} // namespace
} // namespace abut::test
