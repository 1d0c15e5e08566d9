/// Foreign names printed to a terminal; colours; widths.
#include <abut/store.h>

#include "tests/command/models.h"
#include "tests/command/run_command.h"
#include "tests/support/paths.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

// ESC, the C1 control sequence introducer, a right-to-left override, an invalid UTF-8 byte, a
// newline, DEL.
const std::string kHostile = "a\x1b[2Jb\u009b31mc\u202ed\xff"
                             "e\nf\x7fg";
const std::string kShown = "a\\x1b[2Jb\\u009b31mc\\u202ed\\xffe\\nf\\x7fg";
/// Without the invalid byte, which scene readers replace because glTF is JSON.
const std::string kHostileUtf8 = "a\x1b[2Jb\u009b31mc\u202ed\nf\x7fg";
const std::string kShownUtf8 = "a\\x1b[2Jb\\u009b31mc\\u202ed\\nf\\x7fg";

/// Returns whether the text contains no control character except newlines, and no directional mark.
bool is_tame(const std::string& text) {
    const bool no_c0 = std::ranges::none_of(
        text, [](unsigned char c) { return (c < 0x20 && c != '\n') || c == 0x7f || c == 0xff; });
    return no_c0 && text.find("\u009b") == std::string::npos &&
           text.find("\u202e") == std::string::npos;
}

class Terminal : public ::testing::Test {
protected:
    /// A scene whose file, parts and types have such names.
    Terminal() {
        Scene scene = one_of_each_kind();
        for (Part& part : scene.parts) {
            part.name = part.id + kHostileUtf8;
            part.type = kHostileUtf8;
        }
        write_glb(scene, model_);
    }

    TemporaryFolder folder_;
    std::string model_ = folder_ / ("m" + kHostile + ".glb");
};

TEST_F(Terminal, NamesAreEscapedInEveryText) {
    const std::string store = folder_ / ("s" + kHostile + ".abut");
    const std::string box = folder_.write("box" + kHostile + ".obj", box_obj());
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"info", model_, "--parts"},
             {"clash", model_, "--clearance", "0.05", "--out", folder_ / ("r" + kHostile)},
             {"import", model_, store},
             {"info", store},
             {"graph", store},
             {"clash", store, "--clearance", "0.05"},
             {"review", store},
             {"scene", "twist", "--frames", "2", "--triangles", "1000", "--out",
              folder_ / ("f" + kHostile + ".ply")},
             {"ccd", folder_ / ("f" + kHostile + "-0000.ply"),
              folder_ / ("f" + kHostile + "-0001.ply")},
             {"scene", "plant", "--triangles", "10000", "--clashes", "1", "--out",
              folder_ / ("p" + kHostile + ".glb")},
             {"import", "--remove", model_, store},
         }) {
        const Outcome outcome = run_abut(arguments);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_TRUE(is_tame(outcome.out)) << outcome.out;
        // Names of files and of parts begin alike.
        EXPECT_NE(outcome.out.find("a\\x1b[2Jb\\u009b31mc\\u202ed\\"), std::string::npos)
            << outcome.out;
    }
    const Outcome parts = run_abut({"info", model_, "--parts"});
    EXPECT_NE(parts.out.find("h1" + kShownUtf8 + "  " + kShownUtf8 + "\n"), std::string::npos)
        << parts.out;
}

TEST_F(Terminal, NamesAreEscapedInErrors) {
    const std::string missing = folder_ / ("missing" + kHostile + ".obj");
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"info", missing},
                                               {"collide", missing, missing},
                                               {"info", "--" + kHostile, model_},
                                               {kHostile},
                                               {"scene", kHostile, "--out", "x"},
                                               {"nearest", model_, "--point", kHostile},
                                               {"clash", model_, "--clearance", kHostile}}) {
        const Outcome outcome = run_abut(arguments);
        expect_refused(outcome, {kShown});
        EXPECT_TRUE(is_tame(outcome.err)) << outcome.err;
    }
}

TEST_F(Terminal, JsonEscapesNamesWithoutLoss) {
    for (const std::string verb : {"info", "clash"}) {
        const Outcome outcome =
            run_abut(verb == "info" ? std::vector<std::string>{verb, model_, "--parts", "--json"}
                                    : std::vector<std::string>{verb, model_, "--json"});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_TRUE(is_tame(outcome.out)) << outcome.out;
        const auto json = outcome.json();
        const std::string name = verb == "info"
                                     ? json["files"][0]["part_list"][0]["name"].get<std::string>()
                                     : json["clashes"][0]["a_name"].get<std::string>();
        EXPECT_NE(name.find(kHostileUtf8), std::string::npos) << outcome.out;
    }
}

/// Output of `abut ARGUMENTS` on a terminal of this many columns.
std::string on_terminal(int columns, const std::string& settings, const std::string& arguments) {
    return run_program({"script", "-qec",
                        "stty cols " + std::to_string(columns) + "; TERM=xterm " + settings + " " +
                            ABUT_COMMAND + " " + arguments,
                        "/dev/null"})
        .out;
}

std::size_t longest_line(const std::string& text) {
    std::size_t longest = 0, length = 0;
    for (const char c : text)
        longest = std::max(longest, length = c == '\n' ? 0 : length + 1);
    return longest;
}

TEST(Colours, OnlyOnATerminalAndWhereTheyAreWanted) {
    if (run_program({"sh", "-c", "command -v script && command -v stty"}).status != 0)
        GTEST_SKIP() << "script is not installed";
    const TemporaryFolder folder;
    const std::string model = folder / "model.glb";
    write_glb(one_of_each_kind(), model);
    const std::string kRed = "\x1b[31m";
    const std::string clash = "clash --clearance 50mm " + model;
    EXPECT_NE(on_terminal(80, "", clash).find(kRed + "hard "), std::string::npos);
    EXPECT_EQ(on_terminal(80, "NO_COLOR=1", clash).find(kRed), std::string::npos);
    EXPECT_NE(on_terminal(80, "NO_COLOR=", clash).find(kRed), std::string::npos);
    EXPECT_EQ(on_terminal(80, "TERM=dumb", clash).find(kRed), std::string::npos);
    EXPECT_NE(on_terminal(80, "", "colide").find(kRed + "abut:"), std::string::npos);
    EXPECT_EQ(on_terminal(80, "", clash + " --json | cat").find(kRed), std::string::npos);
    for (const Outcome& piped :
         {run_abut({"clash", "--clearance", "50mm", model}), run_abut({"--help"}), run_abut({"x"})})
        EXPECT_EQ((piped.out + piped.err).find('\x1b'), std::string::npos);
}

TEST(Widths, FollowTheTerminal) {
    if (run_program({"sh", "-c", "command -v script && command -v stty"}).status != 0)
        GTEST_SKIP() << "script is not installed";
    const TemporaryFolder folder;
    Scene scene = one_of_each_kind();
    for (Part& part : scene.parts)
        part.name = part.id + " with a name of some length", part.type = "IfcFlowSegment";
    write_glb(scene, folder / "model.glb");
    const auto summary = [&](int columns) {
        return on_terminal(columns, "NO_COLOR=1",
                           "--version; cd " + (folder / "") + "; NO_COLOR=1 " + ABUT_COMMAND +
                               " clash model.glb 2>/dev/null");
    };
    EXPECT_LE(longest_line(summary(80)), 81U) << summary(80); // with its carriage return
    EXPECT_NE(summary(140).find("  |  "), std::string::npos);
    EXPECT_EQ(summary(80).find("  |  "), std::string::npos);
    EXPECT_LE(longest_line(on_terminal(70, "NO_COLOR=1", "")), 71U);
    EXPECT_GT(longest_line(on_terminal(140, "NO_COLOR=1", "")), 81U);
}

} // namespace
} // namespace abut::test
