/// collide, distance and within: two placed unit boxes, answers by hand.
#include "tests/command/box_test.h"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <set>

namespace abut::test {
namespace {

class TwoModelsTest : public TwoBoxesTest {};

TEST_F(TwoModelsTest, DistanceUnderATranslation) {
    const Outcome outcome = ask("distance", {"--pose-b", "3,0,0,1,0,0,0", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto answer = outcome.json();
    EXPECT_EQ(answer["distance"], 2.0);
    EXPECT_EQ(answer["point_a"][0], 1.0);
    EXPECT_EQ(answer["point_b"][0], 3.0);
    EXPECT_EQ(answer["status"], "exact");
    EXPECT_EQ(answer["a"], box_);
    for (const char* key : {"triangle_a", "triangle_b", "counters", "seconds"})
        EXPECT_TRUE(answer.contains(key)) << key;
}

TEST_F(TwoModelsTest, ConvexHulls) {
    const auto answer = ask("distance", {"--pose-b", "3,0.5,0,1,0,0,0", "--convex", "--json"});
    ASSERT_EQ(answer.status, 0) << answer.err;
    EXPECT_EQ(answer.json()["distance"], 2.0);
    EXPECT_EQ(answer.json()["status"], "exact");
    EXPECT_TRUE(answer.json()["feature_a"].contains("id"));
    EXPECT_NE(ask("distance", {"--convex"}).out.find("the hulls meet"), std::string::npos);
    const auto depth = ask("penetration", {"--pose-b", "0.75,0,0,1,0,0,0", "--convex", "--json",
                                           "--fail-on", "penetration"});
    EXPECT_EQ(depth.status, 1);
    EXPECT_EQ(depth.json()["depth"], 0.25);
    EXPECT_EQ(depth.json()["direction"][0], 1.0);
    EXPECT_EQ(ask("penetration", {"--pose-b", "3,0,0,1,0,0,0", "--convex"}).out, "apart\n");
    EXPECT_EQ(ask("distance", {"--convex", "--signed"}).status, 2);
}

TEST_F(TwoModelsTest, DistanceNamesTheFeaturesOfThePoints) {
    // The corner (1, 1, 1) of A and the corner (2, 2, 2) of B.
    const auto answer = ask("distance", {"--pose-b", "2,2,2,1,0,0,0", "--json"}).json();
    EXPECT_LT(answer["at_least"], answer["distance"]);
    EXPECT_NEAR(answer["at_least"], answer["distance"], 1e-12);
    const Mesh box = unit_box();
    for (const auto& [side, corner] : {std::pair{"a", Vec3{1, 1, 1}}, {"b", Vec3{0, 0, 0}}}) {
        const auto& feature = answer[std::string("feature_") + side];
        ASSERT_EQ(feature["kind"], "vertex");
        const auto triangle = answer[std::string("triangle_") + side].get<std::size_t>();
        const std::uint32_t vertex = box.triangles.at(triangle).at(feature["index"]);
        EXPECT_EQ(box.positions.at(vertex), corner);
    }
}

TEST_F(TwoModelsTest, DistanceWithinAnError) {
    for (const auto& [option, error] :
         {std::pair{"--absolute-error", "0.5"}, {"--relative-error", "0.25"}}) {
        const auto answer = ask("distance", {"--pose-b", "3,0,0,1,0,0,0", "--json", option, error});
        ASSERT_EQ(answer.status, 0) << answer.err;
        EXPECT_EQ(answer.json()["status"], "converged");
        const double distance = answer.json()["distance"];
        const double at_least = answer.json()["at_least"];
        EXPECT_LE(at_least, 2);
        EXPECT_GE(distance, 2);
        const bool absolute = option == std::string("--absolute-error");
        EXPECT_NEAR(at_least, distance - (absolute ? 0.5 : 0.25 * distance), 1e-12);
        EXPECT_NE(
            ask("distance", {"--pose-b", "3,0,0,1,0,0,0", option, error}).out.find("at least"),
            std::string::npos);
    }
}

TEST_F(TwoModelsTest, DistanceBeyondItsBoundHasNoPoints) {
    const std::vector<std::string> near{"--pose-b", "3,0,0,1,0,0,0", "--upper-bound", "2.5"};
    const std::vector<std::string> far{"--pose-b", "3,0,0,1,0,0,0", "--upper-bound", "1.5"};
    EXPECT_EQ(ask("distance", near).out.rfind("distance 2 m\n", 0), 0U);
    EXPECT_EQ(ask("distance", far).out, "distance at least 1.5 m\n");
    auto with_json = far;
    with_json.emplace_back("--json");
    const auto answer = ask("distance", with_json).json();
    EXPECT_EQ(answer["status"], "bound_only");
    EXPECT_EQ(answer["distance"], 1.5);
    EXPECT_LE(answer["at_least"], 1.5);
    EXPECT_NEAR(answer["at_least"], 1.5, 1e-12);
    for (const char* key : {"point_a", "triangle_a", "feature_a"})
        EXPECT_FALSE(answer.contains(key)) << key;
}

TEST_F(TwoModelsTest, ALimitOnStepsLeavesProvenBounds) {
    const std::vector<std::string> apart{"--pose-b", "3,0.25,0.5,1,0,0,0"},
        inside{"--pose-b", "0.5,0.25,0.5,1,0,0,0"};
    const auto with = [&](const std::string& verb, std::vector<std::string> arguments,
                          const std::vector<std::string>& more) {
        arguments.insert(arguments.end(), more.begin(), more.end());
        return ask(verb, arguments);
    };
    const auto gap = with("distance", apart, {"--json", "--max-steps", "0"}).json();
    EXPECT_EQ(gap["out_of_steps"], true);
    EXPECT_EQ(gap["steps"], 0);
    EXPECT_EQ(gap["status"], "bound_only");
    EXPECT_LE(gap["at_least"], 2);
    EXPECT_GE(gap["distance"], 2);
    const auto whole = with("distance", apart, {"--json", "--max-steps", "100000"}).json();
    EXPECT_EQ(whole["out_of_steps"], false);
    EXPECT_EQ(whole["distance"], 2);
    const std::string text = with("distance", apart, {"--max-steps", "0"}).out;
    EXPECT_EQ(text.rfind("distance at least ", 0), 0U) << text;
    EXPECT_NE(text.find(": 0 steps were not enough\n"), std::string::npos) << text;

    const auto depth = with("penetration", inside, {"--json", "--max-steps", "0"}).json();
    EXPECT_EQ(depth["out_of_steps"], true);
    EXPECT_EQ(depth["interpenetrate"], true); // to be safe
    EXPECT_EQ(depth["status"], "bound_only");
    EXPECT_GE(depth["depth_at_most"], 0.5);
    EXPECT_LT(depth["depth_at_most"], 0.51);
    const std::string words = with("penetration", inside, {"--max-steps", "0"}).out;
    EXPECT_EQ(words.rfind("not decided whether they meet; depth at most 0.5", 0), 0U) << words;
    for (const char* verb : {"distance", "penetration"}) {
        expect_refused(with(verb, inside, {"--max-steps", "-1"}), {"--max-steps"});
        expect_refused(with(verb, inside, {"--convex", "--max-steps", "1"}), {"--max-steps"});
    }
}

TEST_F(TwoModelsTest, SignedDistanceIsMinusTheDepth) {
    const std::string poses =
        folder_.write("poses.csv", "0.9,0.2,0.3,1,0,0,0\n3,0,0,1,0,0,0\n1,0,0,1,0,0,0\n");
    const Outcome outcome = ask("distance", {"--signed", "--poses", poses, "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto answers = outcome.json()["poses"];
    EXPECT_NEAR(answers[0]["distance"], -0.1, 1e-3);
    EXPECT_LE(answers[0]["at_least"], answers[0]["distance"]);
    EXPECT_TRUE(answers[0].contains("point_a"));
    EXPECT_FALSE(answers[0].contains("feature_a"));
    EXPECT_EQ(answers[1]["distance"], 2.0);
    EXPECT_EQ(answers[2]["distance"], 0.0);
    EXPECT_EQ(ask("distance", {"--poses", poses, "--json"}).json()["poses"][0]["distance"], 0.0);
}

TEST_F(TwoModelsTest, RefusesBadErrorsAndBounds) {
    for (const char* option : {"--absolute-error", "--relative-error", "--upper-bound"})
        for (const char* value : {"-1", "nan", "inf", "x"})
            expect_refused(ask("distance", {option, value}), {option});
}

TEST_F(TwoModelsTest, TheVolumeChangesTheWorkAndNotTheAnswer) {
    const std::string ball = folder_ / "ball.glb";
    Scene scene;
    scene.meshes = {test::ball(8)};
    scene.parts = {part("ball", "", 0, placed(0, 0, 0))};
    write_glb(scene, ball);
    const auto run = [&](const std::string& verb, std::vector<std::string> options) {
        options.insert(options.begin(),
                       {verb, ball, ball, "--json", "--pose-b", "2.5,1,0,5,0,1,0"});
        return run_abut(options);
    };
    const double distance = run("distance", {}).json()["distance"];
    EXPECT_GT(distance, 0.5);
    std::set<std::uint64_t> work;
    for (const char* kind : {"automatic", "aabb", "sphere", "kdop14", "kdop18", "kdop26", "obb",
                             "pss", "lss", "rss", "ssv"}) {
        const Outcome one = run("distance", {"--volume", kind});
        ASSERT_EQ(one.status, 0) << one.err;
        EXPECT_NEAR(one.json()["distance"], distance, 1e-12);
        EXPECT_EQ(one.json()["counters"]["volume"], kind);
        work.insert(one.json()["counters"]["volume_tests"].get<std::uint64_t>());
        EXPECT_EQ(run("collide", {"--volume", kind}).json()["contact"], false);
        EXPECT_EQ(run("within", {"--volume", kind, "--tolerance", "2"}).json()["within"], true);
    }
    EXPECT_GT(work.size(), 3U);
    expect_refused(ask("distance", {"--volume", "cube"}), {"--volume", "cube"});
    expect_refused(ask("collide", {"--volume", ""}), {"--volume"});
    expect_refused(ask("within", {"--tolerance", "1", "--volume", "AABB"}), {"--volume", "AABB"});
}

TEST_F(TwoModelsTest, DistanceUnderARotation) {
    // A quarter turn about z maps B to x in [-1, 0]; the quaternion does not have unit length. A
    // begins at x = 2.
    const Outcome outcome =
        ask("distance", {"--pose-a", "2,0,0,1,0,0,0", "--pose-b", "0,0,0,5,0,0,5", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NEAR(outcome.json()["distance"], 2.0, 1e-12);
}

TEST_F(TwoModelsTest, CollideSaysNoAndYes) {
    const Outcome apart = ask("collide", {"--pose-b", "1.5,0,0,1,0,0,0", "--json", "--all"});
    ASSERT_EQ(apart.status, 0) << apart.err;
    EXPECT_EQ(apart.json()["contact"], false);
    EXPECT_TRUE(apart.json()["triangle_pairs"].empty());

    const Outcome touching = ask("collide", {"--pose-b", "1,0,0,1,0,0,0", "--json"});
    ASSERT_EQ(touching.status, 0) << touching.err;
    EXPECT_EQ(touching.json()["meet"], true);
    EXPECT_EQ(touching.json()["contact"], true);
    EXPECT_EQ(touching.json()["triangle_pairs"].size(), 1U);

    const Outcome all = ask("collide", {"--pose-b", "0.5,0.25,0.25,1,0,0,0", "--json", "--all"});
    ASSERT_EQ(all.status, 0) << all.err;
    EXPECT_GT(all.json()["triangle_pairs"].size(), 1U);
}

TEST_F(TwoModelsTest, CollideListsWhereEachPairMeets) {
    const Outcome outcome =
        ask("collide", {"--pose-b", "0.5,0.21,0.34,1,0,0,0", "--json", "--all", "--segments"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto answer = outcome.json();
    ASSERT_EQ(answer["segments"].size(), answer["triangle_pairs"].size());
    for (const auto& segment : answer["segments"]) {
        ASSERT_EQ(segment.size(), 2U);
        EXPECT_EQ(segment[0].size(), 3U);
    }
    EXPECT_FALSE(ask("collide", {"--json"}).json().contains("segments"));
}

TEST_F(TwoModelsTest, PenetrationGivesDepthAndSeparatingMotion) {
    const Outcome outcome = ask("penetration", {"--pose-b", "0.9,0.2,0.3,1,0,0,0", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto answer = outcome.json();
    EXPECT_EQ(answer["meet"], true);
    EXPECT_EQ(answer["interpenetrate"], true);
    EXPECT_NEAR(answer["depth"], 0.1, 1e-3);
    EXPECT_NEAR(answer["separation"][0], 0.1, 1e-3);
    ASSERT_EQ(answer["regions"].size(), 1U);
    EXPECT_NEAR(answer["regions"][0]["area"], std::hypot(0.56, 0.1 * 0.7, 0.1 * 0.8), 1e-12);
    for (const char* key : {"a", "b", "depth_at_most", "direction", "point_a", "point_b", "status",
                            "counters", "seconds"})
        EXPECT_TRUE(answer.contains(key)) << key;
    for (const char* key : {"touching", "normal", "depth", "depth_at_most", "direction", "point_a",
                            "point_b", "triangle_pairs"})
        EXPECT_TRUE(answer["regions"][0].contains(key)) << key;

    // Moved by the separation, B is not in contact.
    const auto& s = answer["separation"];
    const std::string pose = std::to_string(0.9 + s[0].get<double>()) + "," +
                             std::to_string(0.2 + s[1].get<double>()) + "," +
                             std::to_string(0.3 + s[2].get<double>()) + ",1,0,0,0";
    EXPECT_EQ(ask("collide", {"--pose-b", pose}).out, "no contact\n");
}

TEST_F(TwoModelsTest, PenetrationOfModelsApartAndTouching) {
    const Outcome apart = ask("penetration", {"--pose-b", "9,0,0,1,0,0,0", "--json"});
    ASSERT_EQ(apart.status, 0) << apart.err;
    EXPECT_EQ(apart.json()["meet"], false);
    EXPECT_EQ(apart.json()["interpenetrate"], false);
    EXPECT_TRUE(apart.json()["regions"].empty());
    EXPECT_EQ(ask("penetration", {"--pose-b", "9,0,0,1,0,0,0"}).out, "apart\n");
    EXPECT_EQ(ask("penetration", {"--pose-b", "1,0,0,1,0,0,0"}).out.rfind("touching\n", 0), 0U);
    const std::vector<std::string> fail{"--fail-on", "penetration", "--quiet", "--no-separation"};
    EXPECT_EQ(ask("penetration", fail).status, 1);
    auto touching = fail;
    touching.insert(touching.end(), {"--pose-b", "1,0,0,1,0,0,0"});
    EXPECT_EQ(ask("penetration", touching).status, 0);
    EXPECT_EQ(ask("penetration", {"--accuracy", "-1"}).status, 2);
}

TEST_F(TwoModelsTest, PiecesAreSolids) {
    const Outcome apart =
        ask("distance", {"--pose-b", "1.5,0.25,0.25,1,0,0,0", "--pieces", "--json"});
    ASSERT_EQ(apart.status, 0) << apart.err;
    const auto answer = apart.json();
    EXPECT_EQ(answer["distance"], 0.5);
    for (const char* key :
         {"a", "b", "at_least", "point_a", "point_b", "piece_a", "piece_b", "triangle_a",
          "triangle_b", "feature_a", "feature_b", "status", "counters", "seconds"})
        EXPECT_TRUE(answer.contains(key)) << key;
    EXPECT_EQ(
        ask("distance", {"--pose-b", "0.5,0,0,1,0,0,0", "--pieces", "--json"}).json()["distance"],
        0);
    const auto meeting =
        ask("collide", {"--pose-b", "0.5,0.25,0.25,1,0,0,0", "--pieces", "--all", "--json"}).json();
    EXPECT_EQ(meeting["contact"], true);
    EXPECT_EQ(meeting["contained"], false);
    EXPECT_EQ(meeting["piece_pairs"], nlohmann::json({{0, 0}}));
    EXPECT_GT(meeting["triangle_pairs"].size(), 1U);
    EXPECT_EQ(ask("collide", {"--pose-b", "9,0,0,1,0,0,0", "--pieces"}).out, "no contact\n");
    const std::vector<std::string> near{"--pieces", "--fail-on",       "within",
                                        "--pose-b", "1.5,0,0,1,0,0,0", "--tolerance"};
    for (const auto& [tolerance, status] : {std::pair{"0.499", 0}, {"0.5", 1}}) {
        auto arguments = near;
        arguments.push_back(tolerance);
        EXPECT_EQ(ask("within", arguments).status, status) << tolerance;
    }
    EXPECT_EQ(ask("distance", {"--pieces", "--convex"}).status, 2);
}

TEST_F(TwoModelsTest, PenetrationOfPieces) {
    const auto ask_at = [&](const char* pose, std::vector<std::string> more) {
        more.insert(more.end(), {"--pieces", "--pose-b", pose});
        return ask("penetration", more);
    };
    const Outcome deep = ask_at("0.75,0.1,0.1,1,0,0,0", {"--json"});
    ASSERT_EQ(deep.status, 0) << deep.err;
    const auto answer = deep.json();
    EXPECT_EQ(answer["meet"], true);
    EXPECT_LE(answer["depth"], 0.25); // a bound from below
    EXPECT_NEAR(answer["depth"], 0.25, 1e-12);
    EXPECT_EQ(answer["direction"], nlohmann::json({1, 0, 0}));
    EXPECT_GE(answer["separation"][0], 0.25);
    EXPECT_EQ(answer["status"], "exact");
    for (const char* key : {"point_a", "point_b", "piece_a", "piece_b", "counters"})
        EXPECT_TRUE(answer.contains(key)) << key;
    EXPECT_FALSE(
        ask_at("0.75,0,0,1,0,0,0", {"--json", "--no-separation"}).json().contains("separation"));
    EXPECT_EQ(ask_at("9,0,0,1,0,0,0", {}).out, "apart\n");
    EXPECT_EQ(ask_at("0.75,0.1,0.1,1,0,0,0", {"--no-separation"}).out, "depth 0.25 m\n");
    EXPECT_EQ(ask_at("0.75,0,0,1,0,0,0", {"--fail-on", "penetration", "--quiet"}).status, 1);
    EXPECT_EQ(ask_at("9,0,0,1,0,0,0", {"--fail-on", "penetration", "--quiet"}).status, 0);
    EXPECT_EQ(ask("penetration", {"--pieces", "--convex"}).status, 2);
}

TEST_F(TwoModelsTest, WithinIncludesItsBound) {
    for (const auto& [tolerance, near] : {std::pair{"0.499", false}, {"0.5", true}, {"2", true}}) {
        const Outcome outcome =
            ask("within", {"--pose-b", "1.5,0,0,1,0,0,0", "--tolerance", tolerance, "--json"});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.json()["within"], near) << tolerance;
    }
}

TEST_F(TwoModelsTest, TheUnitScalesTheModelsAndNotThePoses) {
    const Outcome outcome =
        ask("distance", {"--pose-b", "3,0,0,1,0,0,0", "--unit", "0.5", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.json()["distance"], 2.5);
}

TEST_F(TwoModelsTest, FailOnTurnsAYesIntoStatusOne) {
    EXPECT_EQ(ask("collide", {"--fail-on", "contact", "--quiet"}).status, 1);
    EXPECT_EQ(ask("collide", {"--quiet"}).status, 0);
    EXPECT_EQ(ask("collide", {"--fail-on", "contact", "--pose-b", "9,0,0,1,0,0,0"}).status, 0);
    EXPECT_EQ(ask("within", {"--fail-on", "within", "--tolerance", "0"}).status, 1);
    EXPECT_EQ(
        ask("within", {"--fail-on", "within", "--tolerance", "1", "--pose-b", "9,0,0,1,0,0,0"})
            .status,
        0);
}

TEST_F(TwoModelsTest, TextAnswersAreSentences) {
    EXPECT_EQ(ask("collide", {"--pose-b", "9,0,0,1,0,0,0"}).out, "no contact\n");
    EXPECT_EQ(ask("collide", {}).out.rfind("contact: triangle ", 0), 0U);
    EXPECT_EQ(ask("distance", {"--pose-b", "3,0,0,1,0,0,0"}).out.rfind("distance 2 m\n", 0), 0U);
    EXPECT_EQ(ask("within", {"--tolerance", "1"}).out, "within 1 m\n");
}

} // namespace
} // namespace abut::test
