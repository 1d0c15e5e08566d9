/// The programs of examples/ on small models, and the lines of them that docs/start.md quotes.
#include "tests/command/models.h"
#include "tests/command/run_command.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>
#include <sstream>

namespace abut::test {
namespace {

Outcome run_example(const std::string& name, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), std::string(ABUT_BINARY_DIR) + "/bin/abut-" + name);
    return run_program(arguments);
}

class ExamplePrograms : public ::testing::Test {
protected:
    TemporaryFolder folder_;
    std::string box_ = folder_.write("box.obj", box_obj());
};

TEST_F(ExamplePrograms, RawArrays) {
    EXPECT_EQ(run_example("raw-arrays", {}).out, "distance 2 m\n");
}

TEST_F(ExamplePrograms, TwoModels) {
    const std::string out = run_example("two-models", {box_, box_}).out;
    EXPECT_EQ(out.rfind("contact\nat most 5 mm apart\ndistance 0 m, ", 0), 0U) << out;
    EXPECT_NE(out.find("depth 0.100 m, apart when B moves by (0.100, 0.000, 0.000) m\n"),
              std::string::npos)
        << out;
}

TEST_F(ExamplePrograms, ShapeQueries) {
    const std::string out = run_example("shape-queries", {box_}).out;
    EXPECT_EQ(out.rfind("nearest 2 m, on triangle ", 0), 0U) << out;
    EXPECT_NE(out.find("below at z = 1 m\n"), std::string::npos) << out;
    // All triangles but the two of the bottom reach up to the plane z = 1.
    EXPECT_NE(out.find("triangles meet the ball\nnot inside\n"), std::string::npos) << out;
}

TEST_F(ExamplePrograms, Clashes) {
    write_glb(one_of_each_kind(), folder_ / "site.glb");
    const std::string page = folder_ / "report.html";
    const Outcome outcome = run_example("clashes", {page, folder_ / "site.glb"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("hard -0.1 m: h1 and h2\n"), std::string::npos) << outcome.out;
    EXPECT_NE(read_file(page).find("</html>"), std::string::npos);
}

TEST_F(ExamplePrograms, StoresAndCrews) {
    write_glb(one_of_each_kind(), folder_ / "site.glb");
    const std::string store = folder_ / "site.abut";
    const Outcome alone = run_example("store-clashes", {store, folder_ / "site.glb"});
    EXPECT_EQ(alone.out, "5 clashes, found by 1 processes\n") << alone.err;
    if (!std::filesystem::exists(std::string(ABUT_BINARY_DIR) + "/bin/abut-mpi.so") ||
        run_program({"sh", "-c", "command -v mpirun"}).status != 0)
        GTEST_SKIP() << "no mpirun: the crew is not tried";
    const Outcome crew =
        run_program({"mpirun", "--allow-run-as-root", "--oversubscribe", "--quiet", "-n", "2",
                     std::string(ABUT_BINARY_DIR) + "/bin/abut-store-clashes", store});
    EXPECT_EQ(crew.out, "5 clashes, found by 2 processes\n") << crew.err;
}

TEST_F(ExamplePrograms, Trajectory) {
    EXPECT_EQ(run_example("trajectory", {box_, box_}).out,
              "2.000 m\n2.236 m\n2.236 m\n2.000 m\n"
              "motion 0: free for 100.0 %\nmotion 1: free for 100.0 %\n"
              "motion 2: free for 100.0 %\nthe direct way: free for 33.3 %\n");
}

TEST_F(ExamplePrograms, FallingBall) {
    EXPECT_EQ(run_example("falling-ball", {}).out, "the ball rests at z = 0.50 m\n");
}

TEST_F(ExamplePrograms, AnyCulling) {
    const std::string out = run_example("any-culling", {}).out;
    EXPECT_EQ(out, "132126 triangle pairs, 12543 tests, 2850 impacts\n");
    EXPECT_NE(read_file(std::string(ABUT_SOURCE_DIR) + "/docs/any-culling.md").find(out),
              std::string::npos);
}

TEST_F(ExamplePrograms, SayWhatIsWrong) {
    for (const char* name :
         {"two-models", "shape-queries", "clashes", "store-clashes", "trajectory"}) {
        EXPECT_EQ(run_example(name, {}).status, 2) << name;
        EXPECT_NE(run_example(name, {}).err.find("usage: "), std::string::npos) << name;
    }
    EXPECT_NE(run_example("shape-queries", {folder_ / "none.obj"}).err.find("none.obj"),
              std::string::npos);
}

/// The lines of each C++ block on the page, without indentation.
std::vector<std::vector<std::string>> blocks_of_cpp(const std::string& page) {
    std::vector<std::vector<std::string>> blocks;
    std::istringstream stream(page);
    bool inside = false;
    for (std::string line; std::getline(stream, line);) {
        if (line == "```cpp")
            blocks.emplace_back();
        if (line == "```cpp" || line == "```") {
            inside = line == "```cpp";
            continue;
        }
        const std::size_t text = line.find_first_not_of(' ');
        if (inside && text != std::string::npos)
            blocks.back().push_back(line.substr(text));
    }
    return blocks;
}

TEST(StartPage, ShowsTheLinesOfTheExamples) {
    const std::string source = ABUT_SOURCE_DIR;
    std::vector<std::string> lines;
    for (const auto& entry : std::filesystem::directory_iterator(source + "/examples")) {
        if (entry.path().extension() != ".cpp")
            continue;
        std::istringstream stream(read_file(entry.path()));
        for (std::string line; std::getline(stream, line);)
            if (const std::size_t text = line.find_first_not_of(' '); text != std::string::npos)
                lines.push_back(line.substr(text));
        lines.emplace_back("end of " + entry.path().string());
    }
    const auto blocks = blocks_of_cpp(read_file(source + "/docs/start.md"));
    EXPECT_GE(blocks.size(), 5U);
    for (const auto& block : blocks) {
        ASSERT_FALSE(block.empty());
        EXPECT_NE(std::search(lines.begin(), lines.end(), block.begin(), block.end()), lines.end())
            << "no example has these lines: " << ::testing::PrintToString(block);
    }
}

} // namespace
} // namespace abut::test
