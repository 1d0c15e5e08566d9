/// Units and axes in the command: models of several formats in one job and in one store.

#include "tests/command/models.h"
#include "tests/command/run_command.h"
#include "tests/support/store/stores.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

using nlohmann::json;

/// The box from (2, 0, 3) to (3, 1, 4) m, z up, as an OBJ file in millimetres.
std::string box_in_millimetres() {
    const Mesh box = unit_box();
    std::string text;
    for (const Vec3& p : box.positions)
        text += fmt::format("v {} {} {}\n", 1000 * p.x + 2000, 1000 * p.y, 1000 * p.z + 3000);
    for (const auto& [a, b, c] : box.triangles)
        text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
    return text;
}

class FrameTest : public ::testing::Test {
protected:
    /// site.glb holds the box from (2.5, 3, -1) to (3.5, 4, 0), y up. With z up it is (2.5, 0, 3)
    /// to (3.5, 1, 4).
    FrameTest() {
        Scene scene;
        scene.meshes = {unit_box()};
        scene.parts = {part("site", "Wall", 0, placed(2.5, 3, -1))};
        write_glb(scene, site_);
        (void)folder_.write("box.obj", box_in_millimetres());
    }

    static json clash_of(const std::vector<std::string>& files) {
        std::vector<std::string> arguments{"clash", "--json"};
        arguments.insert(arguments.end(), files.begin(), files.end());
        const Outcome outcome = run_abut(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.json();
    }

    TemporaryFolder folder_;
    std::string site_ = folder_ / "site.glb", box_ = folder_ / "box.obj";
};

TEST_F(FrameTest, AMetreGlbAndAMillimetreObjMeetInTheFrameOfTheFirst) {
    const json y_up = clash_of({site_, box_ + ":mm"});
    EXPECT_EQ(y_up["frame"], (json{{"up", "y"}, {"unit", "m"}, {"of", site_}}));
    EXPECT_EQ(y_up["models"][0]["unit"], 1.0);
    EXPECT_EQ(y_up["models"][0]["up"], "y");
    EXPECT_EQ(y_up["models"][1]["file"], box_); // without what follows the name
    EXPECT_EQ(y_up["models"][1]["unit"], 0.001);
    EXPECT_EQ(y_up["models"][1]["up"], "z");
    EXPECT_EQ(y_up["warnings"], json::array());
    ASSERT_EQ(y_up["clashes"].size(), 1U);
    EXPECT_EQ(y_up["clashes"][0]["kind"], "hard");
    EXPECT_NEAR(y_up["clashes"][0]["point_a"][1].get<double>(), 3.5, 0.5 + 1e-9);
    EXPECT_NEAR(y_up["clashes"][0]["point_a"][2].get<double>(), -0.5, 0.5 + 1e-9);

    const json z_up = clash_of({box_ + ":mm", site_});
    EXPECT_EQ(z_up["frame"], (json{{"up", "z"}, {"unit", "m"}, {"of", box_}}));
    ASSERT_EQ(z_up["clashes"].size(), 1U);
    EXPECT_EQ(z_up["clashes"][0]["id"], y_up["clashes"][0]["id"]);
    EXPECT_EQ(z_up["clashes"][0]["distance"], y_up["clashes"][0]["distance"]);
    EXPECT_NEAR(z_up["clashes"][0]["point_a"][2].get<double>(), 3.5, 0.5 + 1e-9);
    EXPECT_NEAR(z_up["clashes"][0]["point_a"][1].get<double>(), 0.5, 0.5 + 1e-9);

    // --unit is a default for files without a unit; glTF has one.
    const std::vector<std::string> with_default{site_, box_, "--unit", "0.001"};
    EXPECT_EQ(clash_of(with_default)["clashes"].size(), 1U);
    // With other axes the box is elsewhere.
    EXPECT_EQ(clash_of({site_, box_ + ":mm:y-up"})["clashes"].size(), 0U);
}

TEST_F(FrameTest, TheSummaryNamesTheFrame) {
    const Outcome outcome = run_abut({"clash", site_, box_ + ":mm"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    for (const std::string& text : {std::string("frame       metres, y up, as ") + site_,
                                    std::string("0.001 m a unit, z up")})
        EXPECT_NE(outcome.out.find(text), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("warning"), std::string::npos) << outcome.out;
}

TEST_F(FrameTest, ModelsThatShareNoSpaceAreNamed) {
    // Without its unit the box lies kilometres away.
    const json report = clash_of({site_, box_});
    ASSERT_EQ(report["warnings"].size(), 1U);
    const std::string warning = report["warnings"][0];
    for (const std::string& text : {site_, box_, std::string("3.6 km apart")})
        EXPECT_NE(warning.find(text), std::string::npos) << warning;
    const Outcome outcome = run_abut({"clash", site_, box_});
    EXPECT_NE(outcome.out.find("warning: the boxes of"), std::string::npos) << outcome.out;
    // The clearance spans the gap, so the only doubt is about its own length.
    const json spanned = clash_of({site_, box_, "--clearance", "4000"})["warnings"];
    ASSERT_EQ(spanned.size(), 1U);
    EXPECT_NE(spanned[0].get<std::string>().find("did you mean 4000mm?"), std::string::npos);
    // A store gives the same warning.
    const std::string store = folder_ / "s.abut";
    ASSERT_EQ(run_abut({"import", site_, box_, store}).status, 0);
    EXPECT_EQ(clash_of({store})["warnings"], report["warnings"]);
}

TEST_F(FrameTest, WordsAfterAFileAreUnderstoodOrRefused) {
    expect_refused(run_abut({"clash", site_, box_ + ":miles"}),
                   {"box.obj", "'miles' is neither a unit"});
    expect_refused(run_abut({"clash", site_, box_ + ":mm:cm"}), {"box.obj", "a second time"});
    expect_refused(run_abut({"clash", box_ + ":mm", box_}), {"box.obj", "given twice"});
    expect_refused(run_abut({"info", folder_ / "none.obj:mm"}), {"none.obj: no such file"});
    const json info = run_abut({"info", box_ + ":mm:y-up", "--json"}).json()["files"][0];
    EXPECT_EQ(info["file"], box_);
    EXPECT_EQ(info["unit"], 0.001);
    EXPECT_EQ(info["up"], "y");
    EXPECT_EQ(info["notes"], json::array());
    EXPECT_EQ(info["bounds"]["upper"], (json{3.0, 1.0, 4.0}));
    EXPECT_NE(run_abut({"info", box_ + ":mm", "--up", "x"}).out.find("x  up; metres (0.001"),
              std::string::npos);
}

TEST_F(FrameTest, QueriesOfTwoModelsAnswerInTheFrameOfTheFirst) {
    for (const auto& [first, second, up] :
         {std::tuple{site_, box_ + ":mm", "y"}, std::tuple{box_ + ":mm", site_, "z"}}) {
        const json collide = run_abut({"collide", first, second, "--json"}).json();
        EXPECT_EQ(collide["contact"], true) << first;
        EXPECT_EQ(collide["frame"]["up"], up);
        const json apart = run_abut({"distance", first, second, "--json", "--pose-b",
                                     std::string(up) == "y" ? "0,10,0,1,0,0,0" : "0,0,10,1,0,0,0"})
                               .json();
        EXPECT_DOUBLE_EQ(apart["distance"].get<double>(), 9); // upwards in both
    }
    const json nearest =
        run_abut({"nearest", box_ + ":mm", "--point", "2.5,0.5,10", "--json"}).json();
    EXPECT_EQ(nearest["frame"], (json{{"up", "z"}, {"unit", "m"}, {"of", box_}}));
    EXPECT_EQ(nearest["points"][0]["distance"], 6.0);
}

TEST_F(FrameTest, AStoreKeepsTheFrameOfItsFirstFile) {
    const std::string store = folder_ / "s.abut";
    ASSERT_EQ(run_abut({"import", box_ + ":mm", store}).status, 0);
    ASSERT_EQ(run_abut({"import", site_, store}).status, 0); // later: it joins the frame
    expect_stored(store, read_scene(ModelPath{box_, 0.001}), 0);
    expect_stored(store, read_scene(site_), 1);
    json info = run_abut({"info", store, "--json"}).json()["stores"][0];
    EXPECT_EQ(info["frame"], (json{{"up", "z"}, {"unit", "m"}, {"of", box_}}));
    EXPECT_EQ(info["models"][0]["unit"], 0.001);
    EXPECT_EQ(info["models"][0]["up"], "z");
    EXPECT_EQ(info["models"][1]["up"], "y");
    EXPECT_EQ(info["bounds"]["lower"], (json{2.0, 0.0, 3.0}));
    EXPECT_EQ(info["bounds"]["upper"], (json{3.5, 1.0, 4.0}));
    const std::string text = run_abut({"info", store}).out;
    EXPECT_NE(text.find("0.001 m a unit, z up"), std::string::npos) << text;
    json job = clash_of({store});
    const json in_core = clash_of({box_ + ":mm", site_});
    EXPECT_EQ(job["frame"], in_core["frame"]);
    for (json& clash : job["clashes"])
        clash.erase("status");
    EXPECT_EQ(job["clashes"], in_core["clashes"]);

    // Other axes given for the first file turn that file, not the store.
    ASSERT_EQ(run_abut({"import", box_ + ":mm:y-up", store}).status, 0);
    expect_stored(store, read_scene(ModelPath{box_, 0.001, UpAxis::y}), 0);
    info = run_abut({"info", store, "--json"}).json()["stores"][0];
    EXPECT_EQ(info["frame"]["up"], "z");
    EXPECT_EQ(info["models"][0]["up"], "y");
    // The frame stays when the file that defined it is removed.
    ASSERT_EQ(run_abut({"import", "--remove", box_, store}).status, 0);
    expect_stored(store, read_scene(site_), 0);
    info = run_abut({"info", store, "--json"}).json()["stores"][0];
    EXPECT_EQ(info["frame"], (json{{"up", "z"}, {"unit", "m"}, {"of", site_}}));
    // A file imported again in the same way is not read.
    EXPECT_EQ(run_abut({"import", site_, store, "--json"}).json()["models"][0]["outcome"],
              "unchanged");
    expect_refused(run_abut({"clash", store, "--spaces"}), {"--spaces", "store"});
    expect_refused(run_abut({"clash", store, "--no-map"}), {"--no-map", "store"});
    expect_refused(run_abut({"clash", store, "--up", "y"}), {"--up", "store"});
}

} // namespace
} // namespace abut::test
