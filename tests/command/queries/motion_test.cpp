// abut motion: an engine with planted clashes, files, faults.

#include <abut/scene.h>

#include "tests/command/models.h"
#include "tests/command/run_command.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

/// A box of size 1 that slides along x from 0 to 10 mm in 2 s, beside a wall.
constexpr const char* kSlide = R"(unit = "mm"
[[parts]]
name = "wall"
model = "box.obj:mm"
move = [5, 0.5, 0.5]
[[parts]]
name = "box"
model = "box.obj:mm"
joint = { type = "prismatic", axis = [1, 0, 0], limits = [0, 20] }
times = [0, 2]
values = [0, 10]
)";

class MotionCommandTest : public ::testing::Test {
protected:
    MotionCommandTest() {
        (void)folder_.write("box.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\n"
                                       "v 1 1 1\nv 0 1 1\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\n"
                                       "f 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
    }

    std::string assembly(std::string text, const std::string& from = {}, const std::string& to = {},
                         const std::string& name = "a.toml") {
        if (!from.empty()) {
            const std::size_t at = text.find(from);
            EXPECT_NE(at, std::string::npos) << from;
            text.replace(at, from.size(), to);
        }
        return folder_.write(name, text);
    }

    /// Replaces a text of the assembly, and expects that it is refused with these words.
    void refuse(const std::string& from, const std::string& to,
                const std::vector<std::string>& words) {
        expect_refused(run_abut({"motion", assembly(kSlide, from, to)}), words);
    }

    nlohmann::json answer(const std::string& file, std::vector<std::string> options = {}) {
        options.insert(options.begin(), {"motion", file, "--json"});
        const Outcome outcome = run_abut(options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.json();
    }

    TemporaryFolder folder_;
};

TEST_F(MotionCommandTest, TheEngineHasThePlantedClashes) {
    const std::string file = folder_ / "engine.toml";
    ASSERT_EQ(run_abut({"scene", "engine", "--out", file}).status, 0);
    const auto json = answer(file);
    ASSERT_EQ(json["clashes"].size(), 2U);
    const auto& screw = json["clashes"][0];
    EXPECT_EQ(screw["a"], "rod 1");
    EXPECT_EQ(screw["b"], "screw");
    // The crank turns by 18,000 degrees a second from 90; rod 1 is at its bottom at 180 and 540.
    ASSERT_EQ(screw["contacts"].size(), 2U);
    for (int i = 0; i < 2; ++i) {
        const double bottom = i == 0 ? 0.005 : 0.025;
        const auto& contact = screw["contacts"][static_cast<std::size_t>(i)];
        EXPECT_NEAR(0.5 * (contact["start"].get<double>() + contact["end"].get<double>()), bottom,
                    1e-5);
    }
    EXPECT_NEAR(screw["depth_time"].get<double>(), 0.005, 1e-4);
    const auto& skirt = json["clashes"][1];
    EXPECT_EQ(skirt["a"], "crank");
    EXPECT_EQ(skirt["b"], "piston 3");
    EXPECT_NEAR(skirt["depth"].get<double>(), 0.004, 1e-4);
    EXPECT_GE(skirt["depth_at_most"].get<double>(), skirt["depth"].get<double>());
    EXPECT_EQ(skirt["status"], "exact");
    EXPECT_EQ(json["pairs"]["joined"], 13);

    ASSERT_EQ(run_abut({"scene", "engine", "--clashes", "0", "--out", file}).status, 0);
    EXPECT_EQ(answer(file)["clashes"].size(), 0U);
    EXPECT_EQ(run_abut({"motion", file, "--fail-on", "contact"}).status, 0);
    const auto near = answer(file, {"--clearance", "4.5mm"})["clashes"];
    EXPECT_EQ(near.size(), 4U); // the crank's counterweights with each piston
    for (const auto& clash : near) {
        EXPECT_EQ(clash["a"], "crank");
        EXPECT_NEAR(clash["gap"].get<double>(), 0.004, 1e-4);
    }
    EXPECT_EQ(run_abut({"motion", file, "--clearance", "4.5mm", "--fail-on", "clearance"}).status,
              1);
}

TEST_F(MotionCommandTest, TextTableAndPage) {
    const std::string file = assembly(kSlide);
    const Outcome text = run_abut({"motion", file, "--clearance", "1mm", "--csv", folder_ / "m.csv",
                                   "--report", folder_ / "m.html", "--fail-on", "contact"});
    EXPECT_EQ(text.status, 1);
    EXPECT_NE(text.out.find("wall and box: meet"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("0 s to 2 s: 1 pair meets"), std::string::npos) << text.out;
    const std::string csv = read_file(folder_ / "m.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3) << csv;
    EXPECT_NE(csv.find("contact,wall,box,0.799"), std::string::npos) << csv;
    const std::string page = read_file(folder_ / "m.html");
    EXPECT_NE(page.find("<svg"), std::string::npos);
    EXPECT_NE(page.find("class=\"hit\""), std::string::npos);
    EXPECT_EQ(page.find("<script"), std::string::npos);
}

TEST_F(MotionCommandTest, NamesAreEscaped) {
    const std::string file = assembly(kSlide, "\"wall\"", "'=<b>&'");
    ASSERT_EQ(run_abut({"motion", file, "--csv", folder_ / "m.csv", "--report", folder_ / "m.html"})
                  .status,
              0);
    EXPECT_NE(read_file(folder_ / "m.csv").find("contact,'=<b>&,box"), std::string::npos);
    EXPECT_NE(read_file(folder_ / "m.html").find("=&lt;b&gt;&amp;"), std::string::npos);
    EXPECT_EQ(read_file(folder_ / "m.html").find("<b>&"), std::string::npos);
}

TEST_F(MotionCommandTest, ATableOfValuesAndPoses) {
    const std::string keys = "times = [0, 2]\nvalues = [0, 10]\n";
    (void)folder_.write("t.csv", "time,box\n0,0\n1,5\n2,10\n");
    const auto json = answer(assembly(std::string("table = \"t.csv\"\n") + kSlide, keys, ""));
    EXPECT_NEAR(json["clashes"][0]["contacts"][0]["start"].get<double>(), 0.8, 1e-2);
    const std::string free =
        std::string("table = \"t.csv\"\n") + kSlide; // a free joint takes poses
    const auto with_poses = [&](const std::string& rows) {
        (void)folder_.write("t.csv", rows);
        std::string text = free;
        text.replace(text.find(keys), keys.size(), "");
        return assembly(text, "{ type = \"prismatic\", axis = [1, 0, 0], limits = [0, 20] }",
                        "{ type = \"free\" }");
    };
    const auto posed = answer(with_poses("time,box.x,box.y,box.z,box.qw,box.qx,box.qy,box.qz\n"
                                         "0,0,0,0,1,0,0,0\n2,10,0,0,1,0,0,0\n"));
    EXPECT_NEAR(posed["clashes"][0]["contacts"][0]["start"].get<double>(), 0.8, 1e-2);
    expect_refused(run_abut({"motion", with_poses("time,box.x\n0,0\n")}), {"t.csv", "line 1"});

    const auto refuse_table = [&](const std::string& rows, const std::vector<std::string>& words) {
        (void)folder_.write("t.csv", rows);
        expect_refused(run_abut({"motion", assembly(free, keys, "")}), words);
    };
    refuse_table("", {"t.csv", "no rows"});
    refuse_table("time,box\n", {"t.csv", "no rows"});
    refuse_table("time,lid\n0,0\n", {"t.csv", "line 1", "'lid'"});
    refuse_table("time,wall\n0,0\n", {"t.csv", "line 1", "fixed"});
    refuse_table("box\n0\n", {"t.csv", "line 1", "'time'"});
    refuse_table("time,box,box\n0,0,0\n", {"t.csv", "line 1", "twice"});
    refuse_table("time,box\n0\n", {"t.csv", "line 2", "1 values"});
    refuse_table("time,box\n0,x\n", {"t.csv", "line 2", "'x'"});
    refuse_table("time,box\n0,nan\n", {"t.csv", "line 2", "'nan'"});
    refuse_table("time,box\n1,0\n1,5\n", {"t.csv", "line 3", "after"});
    refuse_table("time,box\n0,0\n1,50\n", {"a.toml", "'box'", "limits"});
}

TEST_F(MotionCommandTest, PartsOfAModelAndOfAStore) {
    write_glb(crowd(4, 3), folder_ / "pipes.glb");
    ASSERT_EQ(run_abut({"import", folder_ / "pipes.glb", folder_ / "site.abut"}).status, 0);
    std::vector<nlohmann::json> answers;
    for (const std::string model : {"pipes.glb", "site.abut"}) {
        const std::string text = "up = \"z\"\n[[parts]]\nname = \"site\"\nmodel = \"" + model +
                                 "\"\neach = true\n[[parts]]\nname = \"box\"\n"
                                 "model = \"box.obj\"\nmove = [-5, 0, 0]\njoint = { type = "
                                 "\"prismatic\", axis = [1, 0, 0] }\ntimes = [0, 1]\n"
                                 "values = [0, 50]\n";
        auto json = answer(assembly(text));
        EXPECT_GT(json["clashes"].size(), 0U);
        EXPECT_EQ(json["parts"], 5);
        EXPECT_EQ(json["clashes"][0]["a"].get<std::string>().find("site/"), 0U);
        json.erase("seconds");
        answers.push_back(json);
    }
    EXPECT_EQ(answers[0]["clashes"], answers[1]["clashes"]);
    expect_refused(run_abut({"motion", assembly(kSlide, "model = \"box.obj:mm\"",
                                                "model = \"box.obj:mm\"\nselect = 'type = Pump'")}),
                   {"a.toml", "parts[0]", "selects no part"});
}

TEST_F(MotionCommandTest, JsonIsReadToo) {
    const std::string file =
        folder_.write("a.json", R"({"unit": "mm", "parts": [{"name": "wall", "model": "box.obj:mm",
        "move": [5, 0.5, 0.5]}, {"name": "box", "model": "box.obj:mm", "joint": {"type":
        "prismatic", "axis": [1, 0, 0]}, "times": [0, 2], "values": [0, 10]}]})");
    EXPECT_EQ(answer(file)["clashes"][0]["contacts"].size(), 1U);
}

TEST_F(MotionCommandTest, Faults) {
    expect_refused(run_abut({"motion", folder_ / "missing.toml"}), {"missing.toml"});
    refuse("unit = \"mm\"", "unit = \"mile\"", {"a.toml", "unit", "mile"});
    refuse("unit = \"mm\"", "speed = 1", {"a.toml", "unknown key", "speed"});
    refuse("name = \"box\"", "name = \"wall\"", {"a.toml", "parts[1]", "name of another part"});
    refuse("model = \"box.obj:mm\"", "model = \"lid.obj\"",
           {"a.toml", "parts[0] (\"wall\").model", "lid.obj", "does not exist"});
    refuse("model = \"box.obj:mm\"", "model = \"/etc/passwd\"", {"a.toml", "outside"});
    refuse("unit = \"mm\"", "unit = \"mm\"\ntable = \"/etc/passwd\"",
           {"a.toml", "table", "outside"});
    refuse("name = \"box\"", "name = \"box\"\non = \"lid\"", {"a.toml", "parts[1]", ".on", "lid"});
    refuse("name = \"box\"", "name = \"box\"\non = \"box\"", {"a.toml", "'box'", "cycle"});
    refuse("axis = [1, 0, 0]", "axis = [0, 0, 0]", {"a.toml", "joint.axis", "length 0"});
    refuse("axis = [1, 0, 0]", "axis = [nan, 0, 0]", {"a.toml", "joint.axis[0]", "finite"});
    refuse("\"prismatic\"", "\"sliding\"", {"a.toml", "joint.type", "sliding"});
    refuse("times = [0, 2]", "times = [2, 0]", {"a.toml", "'box'", "ascend"});
    refuse("times = [0, 2]", "times = [0, 1, 2]", {"a.toml", "'box'", "for each time"});
    refuse("values = [0, 10]", "values = [0, 30]", {"a.toml", "'box'", "limits"});
    refuse("times = [0, 2]\nvalues = [0, 10]\n", "", {"a.toml", "nothing moves"});
    refuse("values = [0, 10]\n", "values = [0, 10]\n[[loops]]\ncoupler = \"lid\"\n",
           {"a.toml", "loops[0].coupler", "lid"});
    refuse("unit = \"mm\"", "unit = \"mm\"\nignore = [[\"box\", \"lid\"]]",
           {"a.toml", "ignore[0]", "lid"});
    refuse("unit = \"mm\"", "unit = ", {"a.toml", "is not TOML"});
}

} // namespace
} // namespace abut::test
