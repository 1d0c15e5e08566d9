// abut robot on an arm of three bars, with answers by hand.

#include "tests/command/run_command.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

constexpr const char* kArm = R"(<robot name="arm">
<link name="base"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.8 0.1 0.1"/></geometry></collision></link>
<link name="upper"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.8 0.1 0.1"/></geometry></collision></link>
<link name="lower"><collision><origin xyz="0.5 0 0"/><geometry><box size="0.8 0.1 0.1"/></geometry></collision></link>
<joint name="shoulder" type="continuous"><origin xyz="1 0 0"/><parent link="base"/><child link="upper"/>
<axis xyz="0 0 1"/></joint>
<joint name="elbow" type="revolute"><origin xyz="1 0 0"/><parent link="upper"/><child link="lower"/>
<axis xyz="0 0 1"/><limit lower="-3.2" upper="3.2"/></joint></robot>)";

class RobotCommandTest : public ::testing::Test {
protected:
    Outcome ask(const std::string& action, std::vector<std::string> options) {
        options.insert(options.begin(), {"robot", action, arm_});
        return run_abut(options);
    }
    nlohmann::json answer(const std::string& action, std::vector<std::string> options) {
        options.emplace_back("--json");
        const Outcome outcome = ask(action, options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.json();
    }
    TemporaryFolder folder_;
    std::string arm_ = folder_.write("arm.urdf", kArm);
};

TEST_F(RobotCommandTest, Info) {
    const auto json = answer("info", {});
    EXPECT_EQ(json["robot"], "arm");
    EXPECT_EQ(json["links"].size(), 3U);
    EXPECT_EQ(json["joints"][1]["type"], "revolute");
    EXPECT_EQ(json["variables"][0]["lower"], nullptr);
    EXPECT_EQ(json["variables"][1]["upper"], 3.2);
    EXPECT_EQ(json["pairs"], 1);
    EXPECT_NE(ask("info", {}).out.find("elbow: -3.2 to 3.2 rad"), std::string::npos);
}

TEST_F(RobotCommandTest, CheckOfConfigurationsAndWays) {
    const std::string file = folder_.write(
        "path.csv", "elbow,shoulder\n1.5707963,1.5707963\n3.14159265,3.14159265\n0,0\n");
    const auto json = answer("check", {"--configurations", file, "--continuous"});
    ASSERT_EQ(json["configurations"].size(), 3U);
    EXPECT_EQ(json["configurations"][0]["meet"], false);
    EXPECT_EQ(json["configurations"][1]["meet"], true);
    EXPECT_EQ(json["configurations"][1]["pairs"][0]["link"], "base");
    EXPECT_EQ(json["configurations"][1]["pairs"][0]["other"], "lower");
    EXPECT_EQ(json["configurations"][1]["way"]["meet"], true);
    EXPECT_GT(json["configurations"][1]["way"]["time"], 0.3);
    EXPECT_EQ(json["configurations"][2]["way"]["time"], 0);
    EXPECT_EQ(ask("check", {"--configurations", file, "--fail-on", "contact"}).status, 1);
    EXPECT_EQ(ask("check", {"--configuration", "0,0", "--fail-on", "contact"}).status, 0);
    const auto beyond = answer("check", {"--configuration", "0,3.3"});
    EXPECT_EQ(beyond["configurations"][0]["beyond_limits"][0], "elbow");
}

TEST_F(RobotCommandTest, DistanceToASceneAndToItself) {
    const std::string wall = folder_.write("wall.obj", "v 4 -1 -1\nv 4 1 -1\nv 4 0 1\nf 1 2 3\n");
    const auto json = answer("distance", {"--configuration", "0,0", "--scene", wall});
    EXPECT_NEAR(json["configurations"][0]["distance"].get<double>(), 1.1, 1e-12);
    EXPECT_EQ(json["configurations"][0]["pair"]["is_obstacle"], true);
    const auto self =
        answer("distance", {"--configuration", "1.5707963267948966,1.5707963267948966"});
    EXPECT_NEAR(self["configurations"][0]["distance"].get<double>(), 0.9, 1e-12);
    EXPECT_EQ(answer("distance", {"--random", "50"})["configurations"].size(), 50U);
}

TEST_F(RobotCommandTest, AllowedPairsGoToAFileAndBack) {
    const std::string out = folder_ / "arm.srdf";
    EXPECT_EQ(ask("allowed", {"--samples", "100", "--out", out}).status, 0);
    const auto json = answer("info", {"--srdf", out});
    EXPECT_EQ(json["allowed"], 2);
    EXPECT_EQ(answer("info", {"--srdf", out, "--all-pairs"})["pairs"], 3);
}

TEST_F(RobotCommandTest, BadInputIsOneLine) {
    const auto fails = [&](const std::vector<std::string>& options, const std::string& text) {
        const Outcome outcome = ask("check", options);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    };
    fails({"--configuration", "0"}, "needs 2 numbers shoulder,elbow");
    fails({"--state", "home"}, "no state 'home'");
    fails({"--configurations", folder_.write("a.csv", "wrist\n0\n")}, "no variable 'wrist'");
    fails({"--configurations", folder_.write("b.csv", "0,1\n0,x\n")}, "line 2: 'x' is not a");
    fails({"--configurations", folder_.write("c.csv", "0,1,2\n")}, "line 1: 3 values");
    fails({"--srdf", folder_ / "none.srdf"}, "none.srdf");
    EXPECT_EQ(run_abut({"robot", "dance", arm_}).status, 2);
    EXPECT_EQ(run_abut({"robot", "info", folder_.write("x.urdf", "<robot")}).status, 2);
}

} // namespace
} // namespace abut::test
