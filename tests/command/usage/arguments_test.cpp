/// Bad usage gives one line on standard error and status 2, and nothing else.
#include "tests/command/models.h"
#include "tests/command/run_command.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

TEST(Arguments, HelpAndVersionAreNoErrors) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"--help"}, {"clash", "--help"}, {"--version"}}) {
        const Outcome outcome = run_abut(arguments);
        EXPECT_EQ(outcome.status, 0);
        EXPECT_NE(outcome.out, "");
        EXPECT_EQ(outcome.err, "");
    }
}

TEST(Arguments, BadUsageIsRefusedInOneLine) {
    const TemporaryFolder folder;
    const std::string box = folder.write("box.obj", box_obj());
    const std::string out = folder / "out.glb";
    struct Case {
        std::vector<std::string> arguments;
        std::string word;
    };
    const std::vector<Case> cases{
        {{"--json"}, "no verb"},
        {{"explode", box}, "explode"},
        {{"info"}, "MODEL"},
        {{"clash"}, "MODEL"},
        {{"clash", box, "--cleerance", "1"}, "--cleerance"},
        {{"clash", box, "--clearance"}, "--clearance needs a value: LENGTH"},
        {{"clash", box, "--clearance", "-0.1"}, "-0.1"},
        {{"clash", box, "--clearance", "nan"}, "nan"},
        {{"clash", box, "--clearance", "inf"}, "inf"},
        {{"clash", box, "--clearance", "5cubits"}, "5cubits"},
        {{"clash", box, "--touch", "-1"}, "--touch"},
        {{"clash", box, "--unit", "0"}, "--unit"},
        {{"clash", box, "--unit", "-1"}, "--unit"},
        {{"clash", box, "--threads", "-1"}, "--threads"},
        {{"clash", box, "--threads", "two"}, "--threads"},
        {{"clash", box, "--fail-on", "hard,soft"}, "soft"},
        {{"clash", box, "--fail-on", ""}, "--fail-on"},
        {{"clash", box, "--rules", out + ".json"}, out + ".json: no such file"},
        {{"clash", box, box}, "given twice"},
        {{"collide", box}, "B"},
        {{"collide", box, box, box}, "expected"},
        {{"collide", box, box, "--fail-on", "touch"}, "--fail-on"},
        {{"collide", box, box, "--pose-b", "0,0,0,1,0,0"}, "7 numbers"},
        {{"collide", box, box, "--pose-b", "0,0,0,1,0,0,0,0"}, "7 numbers"},
        {{"collide", box, box, "--pose-b", "0,0,nan,1,0,0,0"}, "'nan'"},
        {{"collide", box, box, "--pose-b", "0,0,,1,0,0,0"}, "--pose-b"},
        {{"collide", box, box, "--pose-b", ""}, "--pose-b"},
        {{"collide", box, box, "--pose-a", "1e999,0,0,1,0,0,0"}, "--pose-a"},
        {{"collide", box, box, "--pose-a", "0,0,0,0,0,0,0"}, "zero length"},
        {{"distance", box, box, "--pose-b", "0,0,0,0,-0,0,0"}, "zero length"},
        {{"within", box, box}, "--tolerance"},
        {{"within", box, box, "--tolerance", "-1"}, "--tolerance"},
        {{"scene", "castle", "--out", out}, "castle"},
        {{"scene", "plant"}, "--out"},
        {{"scene", "plant", "--out", folder / "plant.obj"}, "plant.obj"},
        {{"scene", "plant", "--out", out, "--triangles", "-5"}, "--triangles"},
        {{"scene", "plant", "--out", out, "--clashes", "1.5"}, "--clashes"},
        {{"scene", "plant", "--out", out, "--seed", "x"}, "--seed"},
        {{"scene", "plant", "--out", out, "--frames", "2"}, "--frames"},
        {{"scene", "twist"}, "--out"},
        {{"scene", "twist", "--out", out, "--frames", "0"}, "--frames"},
        {{"scene", "twist", "--out", out, "--triangles", "10"}, "triangles"},
        {{"scene", "twist", "--out", out, "--clashes", "5"}, "--clashes"},
        {{"scene", "twist", "--out", out, "--clearance", "0.1"}, "--clearance"},
    };
    for (const Case& each : cases) {
        SCOPED_TRACE(::testing::PrintToString(each.arguments));
        expect_refused(run_abut(each.arguments), {each.word});
    }
    EXPECT_EQ(folder.list(), std::vector<std::string>{"box.obj"});
}

TEST(Arguments, AModelUnderAnotherNameIsStillTheSame) {
    const TemporaryFolder folder;
    const std::string box = folder.write("box.obj", box_obj());
    std::filesystem::create_symlink(box, folder / "link.obj");
    expect_refused(run_abut({"clash", box, folder / "link.obj"}), {"link.obj", "given twice"});
}

TEST(Arguments, QuietPrintsNothing) {
    const TemporaryFolder folder;
    const std::string box = folder.write("box.obj", box_obj());
    const Outcome outcome = run_abut({"info", box, "--quiet", "--progress"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "");
}

} // namespace
} // namespace abut::test
