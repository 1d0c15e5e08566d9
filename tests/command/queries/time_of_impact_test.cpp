/// time-of-impact, and --poses of collide, distance and within: unit boxes, answers by hand.
#include "tests/command/box_test.h"

#include <array>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>

namespace abut::test {
namespace {

class TimeOfImpactCommand : public TwoBoxesTest {};

TEST_F(TimeOfImpactCommand, BoxesApproach) {
    const Outcome outcome = ask(
        "time-of-impact", {"--pose-b", "3,0.5,0,1,0,0,0", "--end-b", "-1,0.5,0,1,0,0,0", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto answer = outcome.json();
    EXPECT_EQ(answer["meet"], true);
    EXPECT_EQ(answer["hit"], true);
    EXPECT_LE(answer["time"], 0.5);
    EXPECT_NEAR(answer["time"], 0.5, 1e-6);
    EXPECT_NEAR(answer["contact_time"], 0.5, 1e-6);
    EXPECT_EQ(answer["status"], "exact");
    EXPECT_NEAR(answer["normal"][0], 1, 1e-6);
    EXPECT_EQ(answer["a"], box_);
    for (const char* key :
         {"gap", "point_a", "point_b", "triangle_a", "triangle_b", "counters", "seconds"})
        EXPECT_TRUE(answer.contains(key)) << key;
}

TEST_F(TimeOfImpactCommand, TheToleranceBoundsTheGap) {
    const Outcome outcome =
        ask("time-of-impact", {"--pose-a", "-3,0.5,0,1,0,0,0", "--end-a", "9,0.5,0,1,0,0,0",
                               "--absolute-error", "1e-9", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_LE(outcome.json()["gap"], 1e-9);
    EXPECT_NEAR(outcome.json()["time"], 1.0 / 6, 1e-9);
}

TEST_F(TimeOfImpactCommand, AScrewTakesAnotherPath) {
    // B makes half a turn about z while its origin moves from (3, 0) to (-1.5, 0). In a straight
    // line B would pass through A; on the screw it circles around A.
    const std::vector<std::string> motion{"--pose-b", "3,0,0,1,0,0,0", "--end-b",
                                          "-1.5,0,0,0,0,0,1", "--json"};
    EXPECT_EQ(ask("time-of-impact", motion).json()["hit"], true);
    std::vector<std::string> screw = motion;
    screw.emplace_back("--screw");
    const auto answer = ask("time-of-impact", screw).json();
    EXPECT_EQ(answer["hit"], false);
    EXPECT_EQ(answer["time"], 1);
}

TEST_F(TimeOfImpactCommand, ALimitOnStepsLeavesAProvenTime) {
    const std::vector<std::string> motion{"--pose-b", "3,0.5,0,1,0,0,0", "--end-b",
                                          "-1,0.5,0,1,0,0.3,0"};
    const auto with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = motion;
        arguments.insert(arguments.end(), more.begin(), more.end());
        return ask("time-of-impact", arguments);
    };
    const auto whole = with({"--json"}).json();
    EXPECT_EQ(whole["hit"], true);
    EXPECT_EQ(whole["out_of_steps"], false);
    EXPECT_GT(whole["steps"], 2);
    const auto limited = with({"--json", "--max-steps", "2"}).json();
    EXPECT_EQ(limited["hit"], true); // to be safe
    EXPECT_EQ(limited["out_of_steps"], true);
    EXPECT_EQ(limited["steps"], 2);
    EXPECT_EQ(limited["status"], "bound_only");
    EXPECT_GT(limited["time"], 0);
    EXPECT_LE(limited["time"], whole["time"]);
    for (const char* key : {"gap", "contact_time", "point_a", "triangle_a", "normal"})
        EXPECT_FALSE(limited.contains(key)) << key;
    const std::string text = with({"--max-steps", "2"}).out;
    EXPECT_EQ(text.rfind("free up to 0.", 0), 0U) << text;
    EXPECT_NE(text.find("; not decided after that: 2 steps were not enough\n"), std::string::npos)
        << text;
    EXPECT_EQ(with({"--max-steps", "2", "--quiet", "--fail-on", "impact"}).status, 1);
    EXPECT_EQ(with({"--max-steps", "1000000", "--json"}).json()["time"], whole["time"]);
}

// Rounded to the nearest sixth digit, 2 / 3 would exceed the proven time.
TEST_F(TimeOfImpactCommand, TheTimeInTextIsRoundedDown) {
    int above = 0;
    for (const char* end : {"0,0.5,0,1,0,0,0", "-4,0.5,0,1,0,0,0", "-8,0.5,0,1,0,0,0",
                            "0.1,0.5,0,1,0,0,0", "-1.5,0.5,0,1,0,0,0"}) {
        const std::vector<std::string> motion{"--pose-b", "3,0.5,0,1,0,0,0", "--end-b", end};
        std::vector<std::string> in_json = motion;
        in_json.emplace_back("--json");
        const double time = ask("time-of-impact", in_json).json()["time"];
        const std::string text = ask("time-of-impact", motion).out, begin = "impact at ";
        ASSERT_EQ(text.rfind(begin, 0), 0U) << text;
        const double shown = std::stod(text.substr(begin.size()));
        EXPECT_LE(shown, time);
        EXPECT_NEAR(shown, time, 1e-5);
        above += std::stod(fmt::format("{:.6g}", time)) > time ? 1 : 0;
    }
    EXPECT_GT(above, 0);
}

TEST_F(TimeOfImpactCommand, FailOnAndSentences) {
    EXPECT_EQ(ask("time-of-impact", {"--fail-on", "impact", "--quiet"}).status, 1);
    EXPECT_EQ(ask("time-of-impact", {"--fail-on", "impact", "--pose-b", "3,0,0,1,0,0,0"}).status,
              0);
    EXPECT_EQ(ask("time-of-impact", {"--pose-b", "3,0,0,1,0,0,0"}).out, "no impact\n");
    EXPECT_EQ(ask("time-of-impact", {}).out.rfind("impact at 0, gap 0 m\n", 0), 0U);
}

TEST_F(TimeOfImpactCommand, BadUsageIsRefused) {
    for (const auto& [option, value, word] : {std::array{"--end-a", "0,0,0", "7 numbers"},
                                              {"--end-b", "0,0,0,0,0,0,0", "zero length"},
                                              {"--end-b", "x,0,0,1,0,0,0", "--end-b"},
                                              {"--tolerance", "-1", "--absolute-error"},
                                              {"--tolerance", "nan", "nan"},
                                              {"--max-steps", "-1", "--max-steps"},
                                              {"--max-steps", "few", "--max-steps"},
                                              {"--fail-on", "contact", "--fail-on"}})
        expect_refused(ask("time-of-impact", {option, value}), {word});
}

TEST_F(TimeOfImpactCommand, ManyPosesInOneRun) {
    const std::string poses = folder_.write(
        "poses.csv", "# far, touching, inside\n3,0,0,1,0,0,0\r\n\n 1, 0, 0, 5, 0, 0, 0\n"
                     "0.5,0.25,0.25,1,0,0,0");
    const auto contacts = ask("collide", {"--poses", poses, "--json"}).json();
    ASSERT_EQ(contacts["poses"].size(), 3U);
    EXPECT_EQ(contacts["poses"][0]["contact"], false);
    EXPECT_EQ(contacts["poses"][1]["contact"], true);
    EXPECT_EQ(contacts["poses"][2]["contact"], true);
    const auto gaps = ask("distance", {"--poses", poses, "--json"}).json();
    ASSERT_EQ(gaps["poses"].size(), 3U);
    EXPECT_EQ(gaps["poses"][0]["distance"], 2.0);
    EXPECT_EQ(gaps["poses"][1]["distance"], 0.0);
    EXPECT_EQ(ask("distance", {"--poses", poses}).out, "2 m\n0 m\n0 m\n");
    // A's pose is used too.
    EXPECT_EQ(ask("distance", {"--poses", poses, "--pose-a", "-1,0,0,1,0,0,0"})
                  .out.rfind("3 m\n1 m\n", 0),
              0U);
    EXPECT_EQ(ask("within", {"--poses", poses, "--tolerance", "1"}).out,
              "farther\nwithin\nwithin\n");
    EXPECT_EQ(ask("collide", {"--poses", poses}).out, "no contact\ncontact\ncontact\n");
    EXPECT_EQ(ask("collide", {"--poses", poses, "--fail-on", "contact", "--quiet"}).status, 1);
    const std::string far = folder_.write("far.csv", "3,0,0,1,0,0,0\n");
    EXPECT_EQ(ask("collide", {"--poses", far, "--fail-on", "contact"}).status, 0);
    EXPECT_EQ(ask("within", {"--poses", far, "--fail-on", "within", "--tolerance", "3"}).status, 1);
}

TEST_F(TimeOfImpactCommand, BadFilesOfPosesAreNamedWithTheLine) {
    const std::string bad = folder_.write("bad.csv", "3,0,0,1,0,0,0\n\n3,0,0,1,0,0\n");
    expect_refused(ask("collide", {"--poses", bad}), {bad, "line 3", "7 numbers"});
    const std::string nan = folder_.write("nan.csv", "3,0,nan,1,0,0,0\n");
    expect_refused(ask("distance", {"--poses", nan}), {nan, "line 1", "nan"});
    expect_refused(ask("within", {"--tolerance", "1", "--poses", folder_ / "none.csv"}),
                   {"none.csv", "no such file"});
    expect_refused(ask("collide", {"--poses", bad, "--pose-b", "0,0,0,1,0,0,0"}), {"--poses"});
}

} // namespace
} // namespace abut::test
