#include "tests/command/models.h"
#include "tests/command/run_command.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>
#include <tuple>

namespace abut::test {
namespace {

using nlohmann::json;

class ClashTest : public ::testing::Test {
protected:
    TemporaryFolder folder_;
    std::string file_ = folder_ / "site.glb";

    ClashTest() { write_glb(one_of_each_kind(), file_); }

    Outcome clash(std::vector<std::string> options) {
        options.insert(options.begin(), {"clash", file_});
        return run_abut(options);
    }

    static json counts(int hard, int touch, int contained, int duplicate, int clearance) {
        return {{"hard", hard},           {"touch", touch},         {"contained", contained},
                {"duplicate", duplicate}, {"clearance", clearance}, {"undecided", 0}};
    }
};

/// The clash of these two parts, which must be in the report.
json between(const json& report, const std::string& one, const std::string& other) {
    for (const json& clash : report["clashes"])
        if (std::set<std::string>{clash["a"], clash["b"]} == std::set<std::string>{one, other})
            return clash;
    ADD_FAILURE() << "no clash between " << one << " and " << other;
    return {};
}

TEST_F(ClashTest, FindsOneOfEachKind) {
    const Outcome outcome = clash({"--clearance", "0.05", "--touch", "0", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const json report = outcome.json();
    EXPECT_EQ(report["counts"], counts(1, 1, 1, 1, 1));
    EXPECT_EQ(report["clearance"], 0.05);
    EXPECT_EQ(report["touch"], 0.0);
    EXPECT_EQ(report["touch_source"], "option");
    ASSERT_EQ(report["clashes"].size(), 5U);

    const json hard = between(report, "h1", "h2");
    EXPECT_EQ(hard["kind"], "hard");
    EXPECT_LT(hard["distance"], 0.0);
    EXPECT_GT(hard["triangle_pairs"], 0);
    EXPECT_EQ(between(report, "t1", "t2")["kind"], "touch");
    EXPECT_EQ(between(report, "c1", "c2")["kind"], "contained");
    EXPECT_NEAR(between(report, "c1", "c2")["distance"].get<double>(), -1, 1e-6);
    EXPECT_EQ(between(report, "d1", "d2")["kind"], "duplicate");
    const json near = between(report, "n1", "n2");
    EXPECT_EQ(near["kind"], "clearance");
    EXPECT_NEAR(near["distance"].get<double>(), 0.03, 1e-6);
    EXPECT_NEAR(near["point_a"][0].get<double>(), near["a"] == "n1" ? 41 : 41.03, 1e-6);
    EXPECT_EQ(near["triangle_pairs"], 0);
    EXPECT_EQ(near["a_type"], "Pipe");
    EXPECT_EQ(near["a_file"], file_);
}

TEST_F(ClashTest, TouchesToWhatTheFileTellsApartUnlessATouchToleranceIsGiven) {
    const Outcome outcome = clash({"--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const json report = outcome.json();
    // Parts in single precision, some 40 m from the origin of their meshes at most.
    EXPECT_EQ(report["touch_source"], "rounding");
    EXPECT_EQ(report["touch_file"], file_);
    EXPECT_GT(report["touch"].get<double>(), 1e-9);
    EXPECT_LT(report["touch"].get<double>(), 2e-5);
    EXPECT_LE(report["touch_least"], report["touch"]);
    EXPECT_EQ(report["models"][0]["precision"], 0.0);
    EXPECT_GT(report["models"][0]["rounding"], 0.0);
    EXPECT_NE(clash({}).out.find(", rounding of " + file_ + "; "), std::string::npos);
    EXPECT_NE(clash({"--touch", "1mm"}).out.find("touch 1 mm; "), std::string::npos);
    EXPECT_NE(clash({"--touch", "0"}).out.find("touch 0 m; "), std::string::npos);
}

TEST_F(ClashTest, ALengthLikeAUnitForgottenIsAskedBack) {
    EXPECT_NE(clash({"--clearance", "50"}).out.find("50 m: did you mean 50mm?"), std::string::npos);
    EXPECT_NE(clash({"--touch", "20"}).out.find("20 m: did you mean 20mm?"), std::string::npos);
    EXPECT_EQ(clash({"--clearance", "50mm"}).out.find("did you mean"), std::string::npos);
}

TEST_F(ClashTest, HasTheKeysThatTheGuidePromises) {
    const Outcome outcome = clash({"--clearance", "0.05", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const json report = outcome.json();
    for (const char* key : {"models", "clearance", "touch", "candidates", "counts", "clashes",
                            "seconds", "peak_rss_mib"})
        EXPECT_TRUE(report.contains(key)) << key;
    EXPECT_EQ(report["models"].size(), 1U);
    EXPECT_EQ(report["models"][0]["file"], file_);
    EXPECT_EQ(report["models"][0]["parts"], 10);
    EXPECT_EQ(report["models"][0]["triangles"], 120);
    for (const char* key : {"import", "build", "broad", "narrow", "total"})
        EXPECT_TRUE(report["seconds"].contains(key)) << key;
    EXPECT_GT(report["seconds"]["import"], 0.0);
    EXPECT_GE(report["seconds"]["total"], report["seconds"]["import"]);
    EXPECT_GT(report["peak_rss_mib"], 0.0);
    ASSERT_FALSE(report["clashes"].empty());
    for (const char* key :
         {"id", "kind", "a", "b", "a_name", "b_name", "a_type", "b_type", "a_file", "b_file",
          "distance", "point_a", "point_b", "direction", "triangle_pairs"})
        EXPECT_TRUE(report["clashes"][0].contains(key)) << key;
}

TEST_F(ClashTest, AnswersTheSameWhateverTheThreads) {
    const Outcome one = clash({"--clearance", "0.05", "--threads", "1", "--json"});
    const Outcome two = clash({"--clearance", "0.05", "--threads", "2", "--json"});
    ASSERT_EQ(one.status, 0) << one.err;
    ASSERT_EQ(two.status, 0) << two.err;
    ASSERT_FALSE(one.json()["clashes"].empty());
    EXPECT_EQ(one.json()["clashes"].dump(), two.json()["clashes"].dump());
}

TEST_F(ClashTest, FailOnAsksForKinds) {
    EXPECT_EQ(clash({"--quiet"}).status, 0);
    EXPECT_EQ(clash({"--quiet", "--fail-on", "any"}).status, 1);
    EXPECT_EQ(clash({"--quiet", "--fail-on", "touch,hard"}).status, 1);
    EXPECT_EQ(clash({"--quiet", "--fail-on", "clearance"}).status, 0); // no clearance asked for
    EXPECT_EQ(clash({"--quiet", "--fail-on", "clearance", "--clearance", "0.05"}).status, 1);
}

TEST_F(ClashTest, WritesAllThreeReportsOrNone) {
    const std::string out = folder_ / "new/reports";
    const Outcome outcome = clash({"--clearance", "0.05", "--out", out});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("report.html"), std::string::npos);
    EXPECT_EQ(folder_.list(),
              (std::vector<std::string>{"new", "new/reports", "new/reports/report.csv",
                                        "new/reports/report.html", "new/reports/report.json",
                                        "site.glb"}));
    EXPECT_EQ(json::parse(read_file(out + "/report.json"))["counts"], counts(1, 1, 1, 1, 1));
    const std::string csv = read_file(out + "/report.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 6); // a header and five rows
    EXPECT_NE(read_file(out + "/report.html").find("</html>"), std::string::npos);
}

TEST_F(ClashTest, AFailedRunLeavesTheReportsOfTheLastOne) {
    const std::string out = folder_ / "out";
    ASSERT_EQ(clash({"--out", out, "--quiet"}).status, 0);
    const std::string before = read_file(out + "/report.json");
    ASSERT_NE(before, "");
    const auto files = folder_.list();
    expect_refused(run_abut({"clash", folder_ / "missing.glb", "--out", out}), {"missing.glb"});
    EXPECT_EQ(read_file(out + "/report.json"), before);
    EXPECT_EQ(folder_.list(), files);
}

TEST_F(ClashTest, PairsAreThoseAcrossFilesUnlessSelfIsGiven) {
    const std::string other = folder_ / "other.glb";
    Scene scene;
    scene.meshes = {unit_box()};
    scene.parts = {part("x", "Duct", 0, placed(0.5, 0.5, 0.5))};
    write_glb(scene, other);
    const Outcome across = run_abut({"clash", file_, other, "--json"});
    ASSERT_EQ(across.status, 0) << across.err;
    EXPECT_EQ(across.json()["counts"], counts(2, 0, 0, 0, 0)); // x against h1 and h2
    const Outcome self = run_abut({"clash", file_, other, "--json", "--self"});
    ASSERT_EQ(self.status, 0) << self.err;
    EXPECT_EQ(self.json()["counts"], counts(3, 1, 1, 1, 0));
}

TEST_F(ClashTest, ATouchToleranceTurnsShallowContactsIntoTouches) {
    const Outcome outcome = clash({"--touch", "0.2", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.json()["counts"], counts(0, 3, 1, 1, 0));
}

TEST_F(ClashTest, FindsExactlyWhatAPlantWasGiven) {
    const std::string plant = folder_ / "plant.glb";
    const Outcome scene = run_abut({"scene", "plant", "--triangles", "30000", "--clashes", "15",
                                    "--seed", "7", "--out", plant, "--json"});
    ASSERT_EQ(scene.status, 0) << scene.err;
    EXPECT_EQ(scene.out, read_file(folder_ / "plant.truth.json"));
    using Found = std::tuple<std::string, std::string, std::string>;
    const auto sorted = [](const json& clashes) {
        std::set<Found> found;
        for (const json& clash : clashes) {
            const std::string a = clash["a"], b = clash["b"];
            found.insert({clash["kind"], std::min(a, b), std::max(a, b)});
        }
        return found;
    };
    const std::set<Found> planted = sorted(scene.json()["clashes"]);
    EXPECT_EQ(planted.size(), 15U);
    const Outcome outcome = run_abut({"clash", plant, "--clearance", "0.05", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(sorted(outcome.json()["clashes"]), planted);
}

TEST_F(ClashTest, TheSummaryShowsCountsAndTheDeepest) {
    const Outcome outcome = clash({"--clearance", "0.05"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    for (const char* text : {"site.glb", "10 parts", "120 triangles", "candidate pairs", "deepest",
                             "nearest", "n1 (Pipe)", "peak memory"})
        EXPECT_NE(outcome.out.find(text), std::string::npos) << text << " in " << outcome.out;
}

} // namespace
} // namespace abut::test
