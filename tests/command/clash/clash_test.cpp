#include "tests/command/models.h"
#include "tests/command/run_command.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

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
    EXPECT_NE(clash({}).out.find("\ntouch is    the rounding of the coordinates of site.glb\n"),
              std::string::npos);
    EXPECT_NE(clash({"--touch", "1mm"}).out.find("touch 1 mm; "), std::string::npos);
    EXPECT_NE(clash({"--touch", "0"}).out.find("touch 0 m; "), std::string::npos);
}

TEST_F(ClashTest, SaysThatClearancesComeFromRules) {
    const std::string rules = folder_.write(
        "rules.json", R"({"rules": [{"name": "all", "clearance": 0.05, "a": {}, "b": {}}]})");
    const std::string text = clash({"--rules", rules}).out;
    EXPECT_NE(text.find("\nclearance of the rules (else 0 m), touch "), std::string::npos) << text;
    EXPECT_NE(text.find("  clearance          1\n"), std::string::npos) << text;
    EXPECT_NE(clash({"--preset", "clearances"}).out.find("\nclearance of the rules (else 0 m), "),
              std::string::npos);
    const std::string none = folder_.write(
        "none.json", R"({"rules": [{"name": "all", "severity": "high", "a": {}, "b": {}}]})");
    EXPECT_NE(clash({"--rules", none}).out.find("\nclearance 0 m, touch "), std::string::npos);
}

/// The lines under a title, up to an empty one.
std::vector<std::string> lines_under(const std::string& text, const std::string& title) {
    std::vector<std::string> lines;
    std::size_t at = text.find("\n" + title + "\n");
    if (at == std::string::npos)
        return lines;
    for (at += title.size() + 2; at < text.size() && text[at] != '\n';) {
        const std::size_t end = text.find('\n', at);
        lines.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return lines;
}

/// Boxes as one OBJ file; `from` to `to`, of a part each. A flat box is a rectangle without an inside.
struct ObjBox {
    std::string name;
    std::array<double, 3> from, to;
    bool is_open = false; ///< without its last two triangles
};
std::string obj_of(const std::vector<ObjBox>& boxes) {
    const Mesh unit = unit_box();
    std::string text;
    std::size_t first = 1;
    for (const ObjBox& box : boxes) {
        text += "o " + box.name + "\n";
        for (const Vec3& p : unit.positions)
            text +=
                fmt::format("v {} {} {}\n", p.x == 0 ? box.from[0] : box.to[0],
                            p.y == 0 ? box.from[1] : box.to[1], p.z == 0 ? box.from[2] : box.to[2]);
        for (std::size_t t = 0; t < unit.triangles.size() - (box.is_open ? 2 : 0); ++t) {
            const auto& [a, b, c] = unit.triangles[t];
            text += fmt::format("f {} {} {}\n", first + a, first + b, first + c);
        }
        first += unit.positions.size();
    }
    return text;
}

TEST_F(ClashTest, SurfacesWithoutAnInsideHaveNoDepthWithoutATolerance) {
    const std::string file =
        folder_.write("surfaces.obj", obj_of({{"wall", {0, 0, 0}, {4, 1, 4}, true},
                                              {"duct", {1, -1, 1}, {2, 2, 2}, true},
                                              {"beam", {10, 0, 0}, {14, 1, 1}},
                                              {"pipe", {13.9, 0.25, 0.25}, {16, 0.75, 0.75}},
                                              {"shelf", {20, 0, 0}, {22, 1, 1}, true},
                                              {"post", {21.9, 0.4, 0.4}, {23, 0.6, 0.6}}}));
    const std::string exact = run_abut({"clash", file, "--touch", "0"}).out;
    const std::vector<std::string> rows = lines_under(exact, "deepest");
    ASSERT_EQ(rows.size(), 3U) << exact;
    EXPECT_NE(rows[0].find(" m  beam  |  pipe"), std::string::npos) << exact;
    // A surface in a solid has a depth.
    EXPECT_NE(rows[1].find(" m  shelf [no solid]  |  post"), std::string::npos) << exact;
    EXPECT_EQ(rows[2], "  hard            no inside  wall [no solid]  |  duct [no solid]");
    // With a tolerance, the depth is how far they go beyond each other: between the two faces of the
    // wall, the duct is up to 0.5 m from them.
    const std::string text = run_abut({"clash", file, "--touch", "1mm"}).out;
    const std::vector<std::string> deepest = lines_under(text, "deepest");
    ASSERT_EQ(deepest.size(), 3U) << text;
    EXPECT_EQ(deepest[0], "  hard               -0.5 m  wall [no solid]  |  duct [no solid]")
        << text;
}

TEST_F(ClashTest, ADepthThatRoundingMayHaveMadeIsToldInWords) {
    // The common part is a nanometre thick. The meshes are in single precision, so that they may be off by
    // more.
    Scene scene;
    scene.meshes = {unit_box()};
    scene.parts = {part("a", "", 0, placed(0, 0, 0)),
                   part("b", "", 0, placed(1 - 1e-9, 0.25, 0.25, 0.5))};
    const std::string file = folder_ / "flush.glb";
    write_glb(scene, file);
    const std::string text = run_abut({"clash", file, "--touch", "0"}).out;
    const std::vector<std::string> rows = lines_under(text, "deepest");
    ASSERT_EQ(rows.size(), 1U) << text;
    EXPECT_EQ(rows[0], "  hard       below rounding  a  |  b");
}

TEST_F(ClashTest, TheTableHasNoDigitsThatRoundingMade) {
    Scene scene = one_of_each_kind();
    const double c = std::cos(0.5), s = std::sin(0.5);
    for (Part& each : scene.parts) { // turned about z
        const auto m = each.world_from_mesh.m;
        for (std::size_t k = 0; k < 12; k += 3) {
            each.world_from_mesh.m.at(k) = c * m.at(k) - s * m.at(k + 1);
            each.world_from_mesh.m.at(k + 1) = s * m.at(k) + c * m.at(k + 1);
        }
    }
    const std::string file = folder_ / "turned.glb", out = folder_ / "report";
    write_glb(scene, file);
    ASSERT_EQ(run_abut({"clash", file, "--clearance", "0.05", "--out", out}).status, 0);
    const json report = json::parse(read_file(out + "/report.json"));
    std::istringstream table(read_file(out + "/report.csv"));
    std::string line;
    std::getline(table, line);
    std::size_t row = 0, shorter = 0;
    for (; std::getline(table, line); ++row) {
        std::istringstream cells(line);
        std::vector<std::string> values;
        for (std::string cell; std::getline(cells, cell, ',');)
            values.push_back(cell);
        const json& clash = report["clashes"][row];
        for (std::size_t i = 0; i < 6; ++i) {
            const std::string& cell = values.at(11 + i);
            const double exact = clash[i < 3 ? "point_a" : "point_b"][i % 3].get<double>();
            EXPECT_EQ(cell.find('e'), std::string::npos) << line;
            EXPECT_LE(cell.size(), 12U) << line;
            // The coordinates are in single precision, at most 50 m from the origin.
            EXPECT_NEAR(std::stod(cell), exact, 1e-5) << line;
            shorter += cell.size() < fmt::format("{}", exact).size() ? 1 : 0;
        }
    }
    EXPECT_EQ(row, report["clashes"].size());
    EXPECT_GT(shorter, 0U);
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
