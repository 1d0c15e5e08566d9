/// nearest, ray, overlap and contains on the unit box, with answers by hand.
#include "tests/command/box_test.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

class OneModelTest : public BoxTest {
protected:
    Outcome ask(const std::string& verb, std::vector<std::string> options) {
        options.insert(options.begin(), {verb, box_});
        return run_abut(options);
    }
    nlohmann::json answer(const std::string& verb, std::vector<std::string> options) {
        options.emplace_back("--json");
        const Outcome outcome = ask(verb, options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        nlohmann::json json = outcome.json();
        EXPECT_EQ(json["model"], box_);
        EXPECT_TRUE(json["seconds"].contains("query"));
        return json;
    }
};

TEST_F(OneModelTest, NearestOfPointsFromTheLineAndAFile) {
    const std::string file = folder_.write("points.csv", "# x,y,z\n0.5,0.5,0.75\r\n\n2,2,1\n");
    const auto json =
        answer("nearest", {"--point", "-3,0.5,0.5", "--point", "0.5,0.5,1", "--points", file});
    ASSERT_EQ(json["points"].size(), 4U);
    EXPECT_EQ(json["points"][0]["distance"], 3.0);
    EXPECT_EQ(json["points"][0]["nearest"], (std::vector{0.0, 0.5, 0.5}));
    EXPECT_EQ(json["points"][1]["distance"], 0.0);
    EXPECT_EQ(json["points"][2]["distance"], 0.25);
    EXPECT_EQ(json["points"][3]["feature"], "vertex");
    for (const char* key : {"point", "triangle", "index", "barycentric"})
        EXPECT_TRUE(json["points"][0].contains(key)) << key;
    EXPECT_EQ(answer("nearest", {"--points", file, "--signed"})["points"][0]["distance"], -0.25);
    EXPECT_EQ(answer("nearest",
                     {"--point", "9,0.5,0.5", "--pose", "3,0,0,1,0,0,0"})["points"][0]["distance"],
              5.0);
}

TEST_F(OneModelTest, RayFirstAndAll) {
    const std::vector<std::string> ray{"--origin", "0.25,0.5,3", "--direction", "-0,0,-2"};
    const auto first = answer("ray", ray);
    EXPECT_EQ(first["meet"], true);
    EXPECT_EQ(first["hit"], true);
    ASSERT_EQ(first["hits"].size(), 1U);
    EXPECT_EQ(first["hits"][0]["t"], 1.0);
    EXPECT_EQ(first["hits"][0]["side"], "front");
    EXPECT_EQ(first["hits"][0]["point"], (std::vector{0.25, 0.5, 1.0}));
    const auto all = answer("ray", {ray[0], ray[1], ray[2], ray[3], "--all"});
    ASSERT_EQ(all["hits"].size(), 2U);
    EXPECT_EQ(all["hits"][1]["t"], 1.5);
    EXPECT_EQ(all["hits"][1]["side"], "back");
    EXPECT_EQ(answer("ray", {ray[0], ray[1], ray[2], ray[3], "--range", "1.25,9"})["hits"][0]["t"],
              1.5);
    EXPECT_EQ(answer("ray", {ray[0], ray[1], ray[2], ray[3], "--range", "-1,0.5"})["hit"], false);
}

TEST_F(OneModelTest, OverlapOfEachShape) {
    const auto overlap = [&](std::vector<std::string> options) {
        return answer("overlap", std::move(options))["overlap"];
    };
    EXPECT_EQ(overlap({"--sphere", "3,0.5,0.5,2"}), true);
    EXPECT_EQ(overlap({"--sphere", "3,0.5,0.5,1.9"}), false);
    EXPECT_EQ(overlap({"--box", "1,1,1,2,2,2"}), true);
    EXPECT_EQ(overlap({"--box", "0.1,0.1,0.1,0.9,0.9,0.9"}), false);
    EXPECT_EQ(overlap({"--box", "-1,-1,-1,1,1,1", "--box-pose", "2.4,0.5,0,0.92388,0,0,0.382683"}),
              true);
    EXPECT_EQ(overlap({"--box", "-1,-1,-1,1,1,1", "--box-pose", "2.5,0.5,0,0.92388,0,0,0.382683"}),
              false);
    EXPECT_EQ(overlap({"--segment", "0.5,0.5,0.5,0.5,0.5,2"}), true);
    EXPECT_EQ(overlap({"--segment", "0.5,0.5,0.5,0.5,0.5,0.9"}), false);
    EXPECT_EQ(answer("overlap", {"--sphere", "0.5,0.5,0.5,9", "--all"})["triangles"].size(), 12U);
}

TEST_F(OneModelTest, Contains) {
    const auto json =
        answer("contains", {"--point", "0.5,0.5,0.5", "--point", "1,0.5,0.5", "--point", "2,0,0"});
    EXPECT_EQ(json["method"], "crossings");
    EXPECT_EQ(json["points"][0]["side"], "inside");
    EXPECT_EQ(json["points"][1]["side"], "on_surface");
    EXPECT_EQ(json["points"][2]["side"], "outside");
    // The box without its last triangle is open.
    std::string text = box_obj();
    text.erase(text.rfind("f "));
    const Outcome open = run_abut(
        {"contains", folder_.write("open.obj", text), "--point", "0.5,0.5,0.25", "--json"});
    EXPECT_EQ(open.json()["method"], "winding");
    EXPECT_EQ(open.json()["points"][0]["side"], "inside");
    EXPECT_GT(open.json()["points"][0]["winding_number"], 0.5);
}

TEST_F(OneModelTest, FailOnTurnsAYesIntoStatusOne) {
    EXPECT_EQ(ask("contains", {"--point", "0.5,0.5,0.5", "--fail-on", "inside"}).status, 1);
    EXPECT_EQ(ask("contains", {"--point", "0.5,0.5,0.5", "--fail-on", "outside"}).status, 0);
    EXPECT_EQ(ask("overlap", {"--sphere", "0,0,0,1", "--fail-on", "overlap"}).status, 1);
    EXPECT_EQ(ask("overlap", {"--sphere", "9,0,0,1", "--fail-on", "overlap"}).status, 0);
}

TEST_F(OneModelTest, TextAnswersAreSentences) {
    EXPECT_EQ(ask("nearest", {"--point", "3,0.5,0.5"})
                  .out.rfind("distance 2 m, point (1, 0.5, 0.5) m", 0),
              0U);
    EXPECT_EQ(ask("ray", {"--origin", "3,0,0", "--direction", "1,0,0"}).out, "no hit\n");
    EXPECT_EQ(ask("overlap", {"--sphere", "9,0,0,1"}).out, "no overlap\n");
    EXPECT_EQ(ask("contains", {"--point", "0.5,0.5,0.5"}).out, "inside\n");
    EXPECT_EQ(ask("contains", {"--point", "0.5,0.5,0.5", "--quiet"}).out, "");
}

TEST_F(OneModelTest, BadUsageIsRefusedInOneLine) {
    const std::string broken = folder_.write("broken.csv", "1,2,3\n1,2\n");
    const std::string empty = folder_.write("empty.csv", "# none\n");
    const std::string open = folder_.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
        {{"nearest", box_}, "--point"},
        {{"nearest", box_, "--point", "1,2"}, "3 numbers"},
        {{"nearest", box_, "--point", "1,2,x"}, "'x'"},
        {{"nearest", box_, "--point", "1,2,1e19"}, "1e18"},
        {{"nearest", box_, "--points", broken}, "broken.csv: line 2"},
        {{"nearest", box_, "--points", empty}, "--points"},
        {{"nearest", box_, "--points", folder_ / "no.csv"}, "no.csv"},
        {{"nearest", open, "--point", "0,0,0", "--signed"}, "closed"},
        {{"nearest", folder_ / "missing.obj", "--point", "0,0,0"}, "missing.obj"},
        {{"ray", box_, "--origin", "0,0,0"}, "--direction"},
        {{"ray", box_, "--origin", "0,0,0", "--direction", "0,0,0"}, "zero"},
        {{"ray", box_, "--origin", "0,0,0", "--direction", "0,0,1", "--range", "1"}, "2 numbers"},
        {{"overlap", box_}, "--sphere"},
        {{"overlap", box_, "--sphere", "0,0,0,1", "--box", "0,0,0,1,1,1"}, "--sphere"},
        {{"overlap", box_, "--sphere", "0,0,0,-1"}, "negative"},
        {{"overlap", box_, "--box", "0,0,0,1,1,-1"}, "--box"},
        {{"overlap", box_, "--sphere", "0,0,0,1", "--box-pose", "0,0,0,1,0,0,0"}, "--box"},
        {{"contains", box_, "--point", "0,0,0", "--pose", "0,0,0,0,0,0,0"}, "zero length"},
    };
    for (const auto& [arguments, word] : cases) {
        SCOPED_TRACE(::testing::PrintToString(arguments));
        expect_refused(run_abut(arguments), {word});
    }
}

} // namespace
} // namespace abut::test
