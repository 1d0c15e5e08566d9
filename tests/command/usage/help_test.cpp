/// Help, manual pages and completion name all that exists, and their examples work.
#include <abut/clash.h>
#include <abut/store.h>

#include "tests/command/models.h"
#include "tests/command/run_command.h"
#include "tests/support/paths.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <sstream>
#include <utility>

namespace abut::test {
namespace {

const std::vector<std::string> kVerbs{
    "info",           "import",  "picture",   "collide", "distance", "within", "penetration",
    "time-of-impact", "nearest", "ray",       "overlap", "contains", "clash",  "review",
    "graph",          "ccd",     "ccd-query", "robot",   "motion",   "scene"};

std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

/// The lines of a section of the help, without their indentation of two spaces.
std::vector<std::string> section_of(const std::string& help, const std::string& title) {
    std::vector<std::string> section;
    bool inside = false;
    for (const std::string& line : lines_of(help)) {
        if (line.empty() || line.front() != ' ')
            inside = line == title + ":";
        else if (inside)
            section.push_back(line.substr(2));
    }
    return section;
}

/// The examples in a verb's help, as typed. Explanations are indented further.
std::vector<std::string> examples_of(const std::vector<std::string>& verb) {
    std::vector<std::string> arguments = verb;
    arguments.emplace_back("--help");
    std::vector<std::string> examples = section_of(run_abut(arguments).out, "Examples");
    std::erase_if(examples, [](const std::string& line) { return line.front() == ' '; });
    return examples;
}

/// How often a text has a word.
std::size_t count_of(const std::string& text, const std::string& word) {
    std::size_t count = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
        ++count;
    return count;
}

TEST(Help, ListsChoicesOnce) {
    const std::string clash = run_abut({"clash", "--help"}).out;
    EXPECT_EQ(count_of(clash, "mep-structure"), 1U) << clash;
    EXPECT_EQ(count_of(clash, "part (default)"), 1U) << clash;
    EXPECT_EQ(count_of(clash, "One of part, volume"), 0U) << clash;
    const std::string scene = run_abut({"scene", "--help"}).out;
    EXPECT_EQ(count_of(scene, "One of plant"), 0U) << scene;
    EXPECT_EQ(count_of(run_abut({"contains", "--help"}).out, "on_surface"), 1U);
    // Choices that the description does not tell are listed.
    EXPECT_NE(clash.find("One of"), std::string::npos);
    EXPECT_EQ(count_of(run_abut({"collide", "--help"}).out, "kdop18"), 1U);
}

/// A folder with a small file for each name that the examples use.
class Examples : public ::testing::Test {
protected:
    Examples() {
        const std::string box = folder_.write("a.obj", box_obj());
        EXPECT_EQ(shell("cp a.obj b.obj").status, 0);
        (void)folder_.write("b.stl",
                            "solid b\nfacet normal 0 0 1\nouter loop\nvertex 0.2 0.2 0.5\n"
                            "vertex 2 0.2 0.5\nvertex 0.2 2 0.5\nendloop\nendfacet\nendsolid b\n");
        write_glb(one_of_each_kind(), folder_ / "model.glb");
        write_glb(one_of_each_kind(), folder_ / "design.glb");
        write_glb(crowd(4, 3), folder_ / "pipes.glb");
        import_models({folder_ / "model.glb"}, folder_ / "site.abut");
        (void)folder_.write("poses.csv", "3,0,0,1,0,0,0\n1m,20cm,30mm,1,0,0,0\n");
        (void)folder_.write("points.csv", "# x,y,z\n5,5,5\n2,2,2\n");
        const std::string frame = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                                  "property float y\nproperty float z\nelement face 2\n"
                                  "property list uchar int vertex_indices\nend_header\n";
        for (const char* number : {"0", "1"})
            (void)folder_.write(std::string("frame-") + number + ".ply",
                                frame + "0 0 0\n1 0 0\n1 1 0\n0 1 " + number +
                                    "\n3 0 1 2\n3 0 2 3\n");
        // A vertex comes down through a face: x, y and z as fractions, and the answer.
        const std::string face = "0,1,0,1,0,1,1\n1,1,0,1,0,1,1\n0,1,1,1,0,1,1\n";
        const std::string rows = "1,4,1,4,1,1,1\n" + face + "1,4,1,4,-1,1,1\n" + face;
        (void)folder_.write("queries-vertex-face.csv", rows);
        (void)folder_.write("queries.csv", rows);
        write_arm();
        EXPECT_EQ(shell("abut scene engine --out engine.toml >engine.txt").status, 0);
    }

    /// A robot of four bars, and what its examples need.
    void write_arm() {
        std::string urdf = "<robot name='arm'>";
        for (const std::string link : {"0", "1", "2", "3"})
            urdf += "<link name='" + link +
                    "'><collision><origin xyz='0.5 0 0'/><geometry><box size='0.8 0.1 0.1'/>"
                    "</geometry></collision></link>";
        for (const auto& [parent, child] : {std::pair{"0", "1"}, {"1", "2"}, {"2", "3"}})
            urdf += std::string("<joint name='to ") + child +
                    "' type='continuous'><origin xyz='1 0 0'/><axis xyz='0 0 1'/><parent link='" +
                    parent + "'/><child link='" + child + "'/></joint>";
        (void)folder_.write("arm.urdf", urdf + "</robot>");
        (void)folder_.write("arm.srdf", "<robot name='arm'/>");
        (void)folder_.write("path.csv", "0,0,0\n0,0.5,0.5\n");
        write_glb(one_of_each_kind(), folder_ / "cell.glb");
    }

    Outcome shell(const std::string& line) const {
        return run_program({"sh", "-c",
                            "cd " + (folder_ / "") + " && PATH=" + ABUT_BINARY_DIR +
                                "/bin:$PATH && export OMPI_ALLOW_RUN_AS_ROOT=1 "
                                "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
                                "OMPI_MCA_rmaps_base_oversubscribe=1 && " +
                                line});
    }

    TemporaryFolder folder_;
};

TEST_F(Examples, EveryExampleOfTheHelpRuns) {
    const bool has_mpi =
        std::filesystem::exists(std::string(ABUT_BINARY_DIR) + "/bin/abut-mpi.so") &&
        shell("command -v mpirun >mpirun.txt").status == 0;
    std::vector<std::vector<std::string>> helps{{}};
    for (const std::string& verb : kVerbs)
        helps.push_back({verb});
    for (const auto& help : helps) {
        const std::vector<std::string> examples = examples_of(help);
        EXPECT_GE(examples.size(), 2U) << ::testing::PrintToString(help);
        for (std::string example : examples) {
            if (!help.empty()) {
                EXPECT_NE(example.find("abut " + help[0] + " "), std::string::npos) << example;
            }
            if (example.starts_with("mpirun") && !has_mpi)
                continue;
            if (const std::size_t at = example.find("0123456789abcdef"); at != std::string::npos) {
                const Outcome job = run_abut({"clash", folder_ / "site.abut", "--json"});
                const std::string id = job.json()["clashes"][0]["id"];
                example.replace(at, id.size(), id);
            }
            const Outcome outcome = shell(example);
            EXPECT_EQ(outcome.err, "") << example;
            EXPECT_NE(outcome.out, "") << example;
            const bool may_be_1 = example.find("--fail-on") != std::string::npos;
            EXPECT_TRUE(outcome.status == 0 || (may_be_1 && outcome.status == 1))
                << example << ": " << outcome.status;
        }
    }
}

TEST(Help, NamesTheExitStatuses) {
    for (const std::string& verb : kVerbs) {
        const std::string help = run_abut({verb, "--help"}).out;
        const bool has_problem = help.find("--fail-on") != std::string::npos;
        std::string statuses;
        for (const std::string& line : section_of(help, "Exit status"))
            statuses += line.front() == ' ' ? "" : line.substr(0, line.find(' ')) + " ";
        EXPECT_EQ(statuses, has_problem ? "0 1 2 130 " : "0 2 130 ") << verb;
    }
}

TEST(Help, OfClashListsAllKindsThatItMayFailOn) {
    const std::string help = run_abut({"clash", "--help"}).out;
    const std::string words = help.substr(help.find("--fail-on WORDS"));
    for (const ClashKind kind : kClashKinds)
        EXPECT_LT(words.find(to_string(kind)), words.find("docs/selecting.md")) << to_string(kind);
}

TEST(Help, FitsEightyColumns) {
    for (const std::string& verb : kVerbs) {
        std::vector<std::string> lines = lines_of(run_abut({verb, "--help"}).out);
        // Long lines are allowed for examples, which are copied as one line.
        for (const std::string& example : examples_of({verb}))
            std::erase(lines, "  " + example);
        for (const std::string& line : lines)
            EXPECT_LE(line.size(), 80U) << verb << ": " << line;
    }
}

TEST(Help, WithoutAVerbListsTheVerbsInGroups) {
    const Outcome alone = run_abut({});
    EXPECT_EQ(alone.status, 0);
    EXPECT_EQ(alone.err, "");
    EXPECT_EQ(alone.out, run_abut({"--help"}).out);
    EXPECT_EQ(alone.out, run_abut({"help"}).out);
    for (const char* group : {"Models and stores", "Two models", "One model and a shape"})
        EXPECT_FALSE(section_of(alone.out, group).empty()) << group;
    for (const std::string& verb : kVerbs)
        EXPECT_NE(alone.out.find("\n  " + verb + " "), std::string::npos) << verb;
    EXPECT_EQ(alone.out.find("generate"), std::string::npos);
    EXPECT_EQ(run_abut({"help", "clash"}).out, run_abut({"clash", "--help"}).out);
}

/// The files that `abut generate` writes, in a folder of their own.
class Documents : public ::testing::Test {
protected:
    Documents() { EXPECT_EQ(run_abut({"generate", folder_ / ""}).status, 0); }

    /// Sorted completions that bash finds at the end of the line.
    std::vector<std::string> complete(const std::string& line) const {
        const std::string script =
            "source " + (folder_ / "bash/abut") + "; line='" + line + "'; COMP_WORDS=($line); " +
            "[[ $line == *' ' ]] && COMP_WORDS+=(''); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); " +
            "_abut; printf '%s\\n' \"${COMPREPLY[@]}\"";
        const Outcome outcome = run_program({"bash", "--norc", "-c", script});
        EXPECT_EQ(outcome.err, "");
        std::vector<std::string> words = lines_of(outcome.out);
        std::erase(words, "");
        std::ranges::sort(words);
        return words;
    }

    TemporaryFolder folder_;
};

TEST_F(Documents, OnePageForEachVerbWithAllOfItsOptions) {
    std::vector<std::string> names{"abut.1"};
    for (const std::string& verb : kVerbs)
        names.push_back("abut-" + verb + ".1");
    for (const std::string& name : names)
        EXPECT_NE(read_file(folder_ / ("man1/" + name)), "") << name;
    const std::string page = read_file(folder_ / "man1/abut-collide.1");
    for (const char* text : {"\\-\\-pose\\-b", "\\-\\-segments", "EXIT STATUS", "EXAMPLES"})
        EXPECT_NE(page.find(text), std::string::npos) << text;
}

TEST_F(Documents, PagesRenderWithoutWarnings) {
    if (run_program({"sh", "-c", "command -v man && command -v groff"}).status != 0)
        GTEST_SKIP() << "man is not installed";
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "man1")) {
        const Outcome page = run_program({"env", "LC_ALL=C.UTF-8", "MANWIDTH=80", "MANPAGER=cat",
                                          "man", "--warnings", "-l", entry.path().string()});
        EXPECT_EQ(page.status, 0);
        EXPECT_EQ(page.err, "") << entry.path();
        EXPECT_NE(page.out.find("EXIT STATUS"), std::string::npos) << entry.path();
    }
}

TEST_F(Documents, BashCompletesVerbsOptionsAndWords) {
    EXPECT_EQ(complete("abut cl"), std::vector<std::string>{"clash"});
    EXPECT_EQ(complete("abut ").size(), kVerbs.size());
    EXPECT_EQ(complete("abut --json cla"), std::vector<std::string>{"clash"});
    EXPECT_EQ(complete("abut collide --seg"), std::vector<std::string>{"--segments"});
    EXPECT_EQ(complete("abut collide a.obj b.obj --volume rs"), std::vector<std::string>{"rss"});
    EXPECT_EQ(complete("abut scene pl"), std::vector<std::string>{"plant"});
    EXPECT_TRUE(complete("abut collide --pose-b ").empty());
    EXPECT_EQ(complete("abut info --parts --ver"), std::vector<std::string>{"--verify"});
}

TEST_F(Documents, CompletionKnowsEveryOptionOfTheHelp) {
    const std::string zsh = read_file(folder_ / "zsh/_abut");
    for (const std::string& verb : kVerbs) {
        const std::vector<std::string> known = complete("abut " + verb + " -");
        std::size_t found = 0;
        for (const std::string& line : lines_of(run_abut({verb, "--help"}).out)) {
            const std::size_t at = line.find("--");
            if (line.size() < 4 || line.substr(0, 2) != "  " || line[2] != '-')
                continue;
            const std::string option = line.substr(at, line.find_first_of(" .,", at) - at);
            EXPECT_TRUE(std::ranges::binary_search(known, option)) << verb << " " << option;
            EXPECT_NE(zsh.find(option + "["), std::string::npos) << verb << " " << option;
            ++found;
        }
        EXPECT_GE(found, 5U) << verb;
    }
}

TEST_F(Documents, ZshAcceptsTheCompletion) {
    if (run_program({"sh", "-c", "command -v zsh"}).status != 0)
        GTEST_SKIP() << "zsh is not installed";
    EXPECT_EQ(run_program({"zsh", "-n", folder_ / "zsh/_abut"}).err, "");
}

} // namespace
} // namespace abut::test
