// Files that appear together or not at all, with several writers too.
#include <abut/error.h>

#include "apps/abut/arguments/output_files.h"
#include "tests/command/run_command.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <thread>
#include <vector>

namespace abut::test {
namespace {

using command::OutputFiles;

TEST(OutputFiles, StayUnchangedIfOneCannotBeMoved) {
    const TemporaryFolder folder;
    (void)folder.write("a", "earlier");
    OutputFiles files(folder / "", {"a", "b", "c"});
    for (const char* const name : {"a", "b", "c"})
        files.stage_text(name, "new");
    std::filesystem::create_directory(folder / "c");
    EXPECT_THROW(files.commit(), Error);
    EXPECT_EQ(read_file(folder / "a"), "earlier");
    EXPECT_FALSE(std::filesystem::exists(folder / "b"));
    EXPECT_TRUE(std::filesystem::is_directory(folder / "c"));
}

TEST(OutputFiles, FilesOfSeveralWritersStayTogether) {
    const TemporaryFolder folder;
    constexpr int kWriters = 4, kRounds = 50;
    std::vector<std::thread> writers;
    writers.reserve(kWriters);
    for (int writer = 0; writer < kWriters; ++writer)
        writers.emplace_back([&folder, writer] {
            for (int round = 0; round < kRounds; ++round) {
                const std::string text = std::to_string(writer) + " " + std::to_string(round);
                OutputFiles files(folder / "", {"a", "b"});
                files.stage_text("a", text);
                files.stage_text("b", text);
                files.commit();
            }
        });
    for (std::thread& writer : writers)
        writer.join();
    EXPECT_EQ(folder.list(), (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(read_file(folder / "a"), read_file(folder / "b"));
}

} // namespace
} // namespace abut::test
