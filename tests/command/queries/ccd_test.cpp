/// abut ccd: sequences with impacts counted by hand, their output files, and sequences that must be
/// refused.
#include <abut/deformable.h>
#include <abut/frame.h>

#include "tests/command/impact_file.h"
#include "tests/command/models.h"
#include "tests/command/run_command.h"
#include "tests/support/folded_frames.h"
#include "tests/support/random.h"

#include <csignal>
#include <filesystem>
#include <gtest/gtest.h>
#include <initializer_list>

namespace abut::test {
namespace {

namespace fs = std::filesystem;

/// A right triangle in the plane z = 0, and a small one above its interior. The small one's lowest
/// vertex is at (1, 1, height); its other two are one higher.
Mesh small_above_large(double height) {
    return {{{0, 0, 0},
             {4, 0, 0},
             {0, 4, 0},
             {1, 1, height},
             {1.5, 1, height + 1},
             {1, 1.5, height + 1}},
            {{0, 1, 2}, {3, 4, 5}}};
}

/// An upright triangle with its upper edge along x at z = 0, and one with its lower edge along y at
/// z = height. Seen from above, the edges cross at the origin.
Mesh crossed_edges(double height) {
    return {
        {{-1, 0, 0}, {1, 0, 0}, {0, 0, -5}, {0, -1, height}, {0, 1, height}, {0, 0, height + 5}},
        {{0, 1, 2}, {3, 4, 5}}};
}

class CcdCommand : public ::testing::Test {
protected:
    TemporaryFolder folder_;

    [[nodiscard]] std::string frame(const std::string& name, const Mesh& mesh) const {
        write_frame(mesh, folder_ / name);
        return folder_ / name;
    }
    /// Writes each mesh to a file and returns the paths in order.
    [[nodiscard]] std::vector<std::string> frames(const std::vector<Mesh>& meshes) const {
        std::vector<std::string> files;
        files.reserve(meshes.size());
        for (const Mesh& mesh : meshes)
            files.push_back(frame("frame-" + std::to_string(files.size()) + ".ply", mesh));
        return files;
    }
    static Outcome ccd(const std::vector<std::string>& files,
                       const std::vector<std::string>& options = {"--json"}) {
        std::vector<std::string> arguments{"ccd"};
        arguments.insert(arguments.end(), files.begin(), files.end());
        arguments.insert(arguments.end(), options.begin(), options.end());
        return run_abut(arguments);
    }
    static nlohmann::json answer(const std::vector<std::string>& files,
                                 std::vector<std::string> options = {}) {
        options.emplace_back("--json");
        const Outcome outcome = ccd(files, options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.status == 0 ? outcome.json() : nlohmann::json();
    }
    /// Runs a good step and then the bad frame. Expects one line that names the bad frame, and the
    /// good step's impacts on disk.
    void expect_frame_refused(const std::string& bad, const std::vector<std::string>& words) {
        SCOPED_TRACE(bad);
        std::vector<std::string> files =
            frames({small_above_large(1), small_above_large(-2), small_above_large(1)});
        files.insert(files.begin() + 2, bad);
        std::vector<std::string> all{fs::path(bad).filename()};
        all.insert(all.end(), words.begin(), words.end());
        for (const char* const name : {"impacts.csv", "impacts.bin"}) {
            fs::remove(folder_ / name);
            expect_refused(ccd(files, {"--json", "--out", folder_ / name}), all);
            const auto written = read_impacts(folder_ / name);
            ASSERT_EQ(written.size(), 3U);
            EXPECT_EQ(written.back().step, 0U);
        }
        const Outcome table = ccd(files, {});
        EXPECT_EQ(table.status, 2);
        EXPECT_NE(table.out.find("frame-0.ply -> frame-1.ply"), std::string::npos) << table.out;
        EXPECT_EQ(table.out.find("total  "), std::string::npos) << table.out;
    }
};

TEST_F(CcdCommand, ATrianglePassesThroughAnother) {
    const std::string out = folder_ / "impacts.csv";
    const auto report =
        answer(frames({small_above_large(5), small_above_large(1), small_above_large(-2)}),
               {"--out", out});
    ASSERT_EQ(report["steps"].size(), 2U);
    const auto &first = report["steps"][0], &second = report["steps"][1];
    EXPECT_EQ(first["vertex_face"], 0);
    EXPECT_EQ(first["edge_edge"], 0);
    EXPECT_TRUE(first["first_time"].is_null());
    EXPECT_EQ(second["vertex_face"], 3);
    EXPECT_EQ(second["edge_edge"], 0);
    EXPECT_NEAR(second["first_time"].get<double>(), 1.0 / 3, 1e-9);
    EXPECT_EQ(second["vertices"], 6);
    EXPECT_EQ(second["edges"], 6);
    EXPECT_EQ(second["triangles"], 2);
    EXPECT_EQ(report["total"]["steps"], 2);
    EXPECT_EQ(report["total"]["vertex_face"], 3);

    const auto written = read_impacts(out);
    ASSERT_EQ(written.size(), 3U);
    const FeatureImpact& lowest = written[0].impact;
    EXPECT_EQ(written[0].step, 1U);
    EXPECT_EQ(lowest.kind, ElementaryKind::vertex_face);
    EXPECT_EQ(lowest.a, 3U);
    EXPECT_EQ(lowest.b, 0U);
    EXPECT_NEAR(lowest.time, 1.0 / 3, 1e-9);
    EXPECT_NEAR(lowest.barycentric[0], 0.5, 1e-6);
    EXPECT_NEAR(lowest.barycentric[1], 0.25, 1e-6);
    EXPECT_NEAR(lowest.barycentric[2], 0.25, 1e-6);
    EXPECT_NEAR(lowest.normal.z, 1, 1e-6);
    EXPECT_NEAR(written[1].impact.time, 2.0 / 3, 1e-9);
    EXPECT_NEAR(written[2].impact.time, 2.0 / 3, 1e-9);
}

TEST_F(CcdCommand, TwoEdgesCross) {
    const std::string out = folder_ / "impacts.bin";
    const auto report = answer(frames({crossed_edges(1), crossed_edges(-1)}), {"--out", out});
    EXPECT_EQ(report["total"]["vertex_face"], 0);
    EXPECT_EQ(report["total"]["edge_edge"], 1);
    EXPECT_NEAR(report["steps"][0]["first_time"].get<double>(), 0.5, 1e-9);
    const auto written = read_impacts(out);
    ASSERT_EQ(written.size(), 1U);
    EXPECT_EQ(written[0].step, 0U);
    const FeatureImpact& impact = written[0].impact;
    EXPECT_EQ(impact.kind, ElementaryKind::edge_edge);
    // Edges are sorted by their higher, then their lower vertex: 01 02 12 34 35 45.
    EXPECT_EQ(impact.a, 0U);
    EXPECT_EQ(impact.b, 3U);
    EXPECT_NEAR(impact.barycentric[0], 0.5, 1e-6);
    EXPECT_NEAR(impact.barycentric[1], 0.5, 1e-6);
    EXPECT_EQ(impact.barycentric[2], 0.0);
    EXPECT_NEAR(impact.normal.z, -1, 1e-6);
    EXPECT_EQ(impact.status, Status::exact);
}

/// Two sheets that are crumpled anew in every frame.
std::vector<Mesh> crumpled_sheets(Random& random, std::size_t frames) {
    constexpr std::uint32_t kSide = 9;
    Mesh sheets;
    for (std::uint32_t sheet = 0; sheet < 2; ++sheet)
        for (std::uint32_t i = 0; i + 1 < kSide; ++i)
            for (std::uint32_t j = 0; j + 1 < kSide; ++j) {
                const std::uint32_t v = (sheet * kSide + i) * kSide + j;
                sheets.triangles.push_back({v, v + 1, v + kSide});
                sheets.triangles.push_back({v + 1, v + kSide + 1, v + kSide});
            }
    std::vector<Mesh> sequence(frames, sheets);
    for (Mesh& mesh : sequence)
        for (std::uint32_t sheet = 0; sheet < 2; ++sheet)
            for (std::uint32_t i = 0; i < kSide; ++i)
                for (std::uint32_t j = 0; j < kSide; ++j) {
                    const Vec3 jitter = random.in_cube(0.6);
                    mesh.positions.push_back({i + jitter.x, j + jitter.y, 0.3 * sheet + jitter.z});
                }
    return sequence;
}

TEST_F(CcdCommand, WritesWhatTheLibraryFinds) {
    Random random(93);
    const std::vector<Mesh> meshes = crumpled_sheets(random, 4);
    const auto files = frames(meshes);
    std::vector<WrittenImpact> expected;
    Deformable surface(meshes[0]);
    TestCounts sum;
    for (std::size_t step = 0; step + 1 < meshes.size(); ++step) {
        surface.advance(meshes[step + 1].positions);
        for (const FeatureImpact& impact : self_impacts(surface).list) {
            expected.push_back({step, impact});
            ++(impact.kind == ElementaryKind::edge_edge ? sum.edge_edge : sum.vertex_face);
        }
    }
    std::cout << sum.vertex_face << " vertex-face, " << sum.edge_edge << " edge-edge\n";
    EXPECT_GT(sum.vertex_face, 50U);
    EXPECT_GT(sum.edge_edge, 100U);

    const std::string csv = folder_ / "impacts.csv", bin = folder_ / "impacts.bin";
    const auto report = answer(files, {"--out", csv});
    EXPECT_EQ(report["total"]["vertex_face"], sum.vertex_face);
    EXPECT_EQ(report["total"]["edge_edge"], sum.edge_edge);
    EXPECT_EQ(read_impacts(csv), expected);

    std::vector<std::vector<std::string>> choices{{"--threads", "1"}, {"--threads", "2"}};
    for (const char* const scheme :
         {"representative", "database", "markup", "basic", "features", "pairwise"})
        for (const char* const culling : {"tree", "grid", "sweep"})
            choices.push_back({"--scheme", scheme, "--culling", culling});
    for (const char* const assignment :
         {"greedy", "maximal", "uniform-vertex-edge", "uniform-edge-edge", "adaptive"})
        choices.push_back({"--assignment", assignment});
    for (auto options : choices) {
        SCOPED_TRACE(options[0] + " " + options[1]);
        options.insert(options.end(), {"--out", bin, "--quiet"});
        const Outcome outcome = ccd(files, options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_EQ(read_impacts(bin), expected);
    }
}

/// Frames that fold hard; integers say which features meet.
TEST_F(CcdCommand, WritesEveryTrueImpactAndNoOther) {
    Random random(4217);
    const MovingMesh moving = folded_sheet(random, 9, FrameNumbers::floats);
    const SymbolicTruth truth(moving);
    ASSERT_GT(truth.counts.vertex_face, 40U);
    ASSERT_GT(truth.counts.edge_edge, 200U);
    const auto files = frames({moving.mesh, {moving.end, moving.mesh.triangles}});
    const std::string out = folder_ / "impacts.bin";
    const auto step = answer(files, {"--out", out})["steps"].at(0);
    EXPECT_EQ(step["vertex_face"], truth.counts.vertex_face);
    EXPECT_EQ(step["edge_edge"], truth.counts.edge_edge);
    const auto written = read_impacts(out);
    ASSERT_EQ(written.size(), truth.impacts.size());
    for (std::size_t i = 0; i < written.size(); ++i) {
        const auto& [ids, first] = truth.impacts[i];
        ASSERT_EQ(list_order(written[i].impact), list_order(ids)) << i;
        EXPECT_LE(written[i].impact.time, first.high);
        EXPECT_GE(written[i].impact.time, first.low - 1e-9);
    }
}

TEST_F(CcdCommand, ConservativeModeReportsNearPairs) {
    // A vertex passes the edge x + y = 4 of the large triangle at a distance of about 2^-51.
    const auto falling = [](double height) {
        return Mesh{{{0, 0, 0},
                     {4, 0, 0},
                     {0, 4, 0},
                     {2, 2 + 0x1p-51, height},
                     {4, 2, height + 1},
                     {2, 4, height + 1}},
                    {{0, 1, 2}, {3, 4, 5}}};
    };
    const auto files = frames({falling(0.5), falling(-0.5)});
    EXPECT_EQ(answer(files)["total"]["vertex_face"], 0);
    const std::string out = folder_ / "impacts.csv";
    const auto report = answer(files, {"--mode", "conservative", "--delta", "1e-9", "--out", out});
    EXPECT_EQ(report["mode"], "conservative");
    EXPECT_EQ(report["delta"], 1e-9);
    EXPECT_EQ(report["total"]["vertex_face"], 1);
    const auto written = read_impacts(out);
    ASSERT_FALSE(written.empty());
    for (const WrittenImpact& each : written)
        EXPECT_EQ(each.impact.status, Status::bound_only);
}

TEST_F(CcdCommand, AThicknessReportsNearPairs) {
    // The lowest vertex stops at 1/8 above the face, and the edges 1/16 apart.
    const auto falling = frames({small_above_large(2), small_above_large(0.125)});
    EXPECT_EQ(answer(falling)["total"]["vertex_face"], 0);
    EXPECT_EQ(answer(falling, {"--thickness", "0.1"})["total"]["vertex_face"], 0);
    for (const char* const name : {"impacts.csv", "impacts.bin"}) {
        const auto report = answer(falling, {"--thickness", "0.5", "--out", folder_ / name});
        EXPECT_EQ(report["thickness"], 0.5);
        EXPECT_EQ(report["total"]["vertex_face"], 1);
        EXPECT_EQ(report["total"]["edge_edge"], 0);
        EXPECT_NEAR(report["steps"][0]["first_time"].get<double>(), 0.8, 1e-6);
        const auto written = read_impacts(folder_ / name);
        ASSERT_EQ(written.size(), 1U);
        EXPECT_EQ(written[0].impact.status, Status::converged);
        EXPECT_NEAR(written[0].impact.normal.z, 1, 1e-6);
    }
    const auto edges = frames({crossed_edges(1), crossed_edges(0.0625)});
    EXPECT_EQ(answer(edges)["total"]["edge_edge"], 0);
    EXPECT_EQ(answer(edges, {"--thickness", "0.0625"})["total"]["edge_edge"], 1);
}

TEST_F(CcdCommand, APatternIsTakenInTheOrderOfItsNumbers) {
    fs::create_directory(folder_ / "run7");
    for (const auto& [name, height] :
         std::initializer_list<std::pair<const char*, double>>{{"run7/f-1.ply", 9},
                                                               {"run7/f-02.ply", 5},
                                                               {"run7/f-10.ply", 1},
                                                               {"run7/f-100.ply", -2}})
        static_cast<void>(frame(name, small_above_large(height)));
    static_cast<void>(folder_.write("run7/notes.txt", "no frame"));
    const auto report = answer({folder_ / "run*/f-*.ply"});
    ASSERT_EQ(report["steps"].size(), 3U);
    EXPECT_EQ(report["steps"][0]["from"], folder_ / "run7/f-1.ply");
    EXPECT_EQ(report["steps"][0]["to"], folder_ / "run7/f-02.ply");
    EXPECT_EQ(report["steps"][1]["to"], folder_ / "run7/f-10.ply");
    EXPECT_EQ(report["steps"][2]["to"], folder_ / "run7/f-100.ply");
    EXPECT_EQ(report["steps"][2]["vertex_face"], 3);
    EXPECT_EQ(report["total"]["vertex_face"], 3);
}

TEST_F(CcdCommand, HasTheKeysThatTheGuidePromises) {
    const auto report = answer(frames({small_above_large(1), small_above_large(-2)}));
    for (const char* const key :
         {"scheme", "assignment", "culling", "mode", "delta", "thickness", "steps", "total"})
        EXPECT_TRUE(report.contains(key)) << key;
    ASSERT_EQ(report["steps"].size(), 1U);
    const auto &step = report["steps"][0], &total = report["total"];
    for (const char* const key :
         {"from", "to", "topology_changed", "vertices", "edges", "triangles", "first_time"})
        EXPECT_TRUE(step.contains(key)) << key;
    for (const char* const key : {"steps", "topology_changes", "peak_rss_mib", "bytes"})
        EXPECT_TRUE(total.contains(key)) << key;
    for (const auto* const each : {&step, &total}) {
        for (const char* const key : {"vertex_face", "edge_edge", "triangle_pairs", "candidates",
                                      "elementary_tests", "exact_fallbacks", "seconds"})
            EXPECT_TRUE(each->contains(key)) << key;
        for (const char* const counts : {"candidates", "elementary_tests"})
            for (const char* const key : {"vertex_face", "edge_edge"})
                EXPECT_TRUE((*each)[counts].contains(key)) << counts << " " << key;
        for (const char* const key : {"refit", "detect", "total"})
            EXPECT_TRUE((*each)["seconds"].contains(key)) << key;
    }
    EXPECT_EQ(report["scheme"], "representative");
    EXPECT_EQ(step["triangle_pairs"], 1);
    EXPECT_GE(step["candidates"]["vertex_face"], 3);
    EXPECT_GE(step["seconds"]["total"], step["seconds"]["detect"]);
    EXPECT_GT(total["peak_rss_mib"], 0);
    EXPECT_GT(total["bytes"], 0);
}

TEST_F(CcdCommand, TheTableHasALineForEachStep) {
    const Outcome outcome =
        ccd(frames({small_above_large(5), small_above_large(1), small_above_large(-2)}), {});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    for (const char* const text : {"vertex-face", "frame-0.ply -> frame-1.ply",
                                   "frame-1.ply -> frame-2.ply", "0.333333", "total"})
        EXPECT_NE(outcome.out.find(text), std::string::npos) << text << " in " << outcome.out;
    EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 4);
}

TEST_F(CcdCommand, FramesThatPassThroughThemselvesAtRest) {
    // The small triangle begins above the large one, and ends with its lowest vertex below it.
    const auto files =
        frames({small_above_large(1), small_above_large(-0.5), small_above_large(0)});
    const auto report = ccd(files, {"--json", "--intersections"}).json();
    ASSERT_EQ(report["frames"].size(), 3U);
    const auto expect_frame = [&](std::size_t i, int crossing, int touching) {
        const auto& frame = report["frames"][i];
        EXPECT_EQ(frame["frame"], files[i]);
        EXPECT_EQ(frame["crossing"], crossing) << i;
        EXPECT_EQ(frame["touching"], touching) << i;
        EXPECT_EQ(frame["coplanar"], 0) << i;
    };
    expect_frame(0, 0, 0);
    expect_frame(1, 2, 0); // both edges at the lowest vertex
    expect_frame(2, 0, 2);
    EXPECT_FALSE(ccd(files).json().contains("frames"));
    const Outcome table = ccd(files, {"--intersections"});
    EXPECT_NE(table.out.find("at rest: 2 edges cross faces, 0 touch, 0 coplanar"),
              std::string::npos)
        << table.out;
    EXPECT_EQ(ccd(files, {"--quiet", "--fail-on", "intersections"}).status, 1);
    const auto clean = frames({small_above_large(1), small_above_large(2)});
    EXPECT_EQ(ccd(clean, {"--quiet", "--fail-on", "intersections"}).status, 0);
}

TEST_F(CcdCommand, FailOnAsksForImpacts) {
    const auto none = frames({small_above_large(5), small_above_large(1)});
    EXPECT_EQ(ccd(none, {"--quiet", "--fail-on", "impacts"}).status, 0);
    const auto some = frames({crossed_edges(1), crossed_edges(-1)});
    EXPECT_EQ(ccd(some, {"--quiet"}).status, 0);
    EXPECT_EQ(ccd(some, {"--quiet", "--fail-on", "impacts"}).status, 1);
}

TEST_F(CcdCommand, AnotherTopologyIsRefusedByItsFrame) {
    Mesh other = small_above_large(1);
    other.positions.push_back({9, 9, 9});
    expect_frame_refused(frame("more-vertices.ply", other),
                         {"7 vertices, not 6", "frame-1.ply", "--allow-topology-changes"});
    other = small_above_large(1);
    other.triangles.push_back({0, 1, 3});
    expect_frame_refused(frame("more-triangles.ply", other), {"3 triangles, not 2"});
    other = small_above_large(1);
    other.triangles[1] = {3, 5, 4};
    expect_frame_refused(frame("turned.ply", other), {"triangle 1", "3, 5, 4, not 3, 4, 5"});
}

TEST_F(CcdCommand, AnotherTopologyStartsAnewWhereAllowed) {
    Mesh more_before = small_above_large(1), more_after = small_above_large(-2);
    for (Mesh* const mesh : {&more_before, &more_after}) {
        mesh->positions.insert(mesh->positions.end(), {{9, 0, 0}, {9, 1, 0}, {9, 0, 1}});
        mesh->triangles.push_back({6, 7, 8});
    }
    // From frame 1 to 2 the small triangle would pass through the large one again.
    const auto files =
        frames({small_above_large(1), small_above_large(-2), more_before, more_after});
    const std::string out = folder_ / "impacts.csv";
    const auto report = answer(files, {"--allow-topology-changes", "--out", out});
    ASSERT_EQ(report["steps"].size(), 3U);
    EXPECT_EQ(report["steps"][0]["topology_changed"], false);
    EXPECT_EQ(report["steps"][0]["vertex_face"], 3);
    EXPECT_EQ(report["steps"][1]["topology_changed"], true);
    EXPECT_EQ(report["steps"][1]["vertex_face"], 0);
    EXPECT_TRUE(report["steps"][1]["first_time"].is_null());
    EXPECT_EQ(report["steps"][1]["triangles"], 3);
    EXPECT_EQ(report["steps"][2]["topology_changed"], false);
    EXPECT_EQ(report["steps"][2]["vertex_face"], 3);
    EXPECT_EQ(report["total"]["topology_changes"], 1);
    const auto written = read_impacts(out);
    ASSERT_EQ(written.size(), 6U);
    EXPECT_EQ(written[3].step, 2U);
    EXPECT_NE(ccd(files, {"--allow-topology-changes"}).out.find("topology changed"),
              std::string::npos);
}

TEST_F(CcdCommand, ABadFrameIsRefusedAndEarlierStepsStay) {
    expect_frame_refused(folder_ / "missing.ply", {});
    expect_frame_refused(folder_.write("empty.ply", ""), {});
    expect_frame_refused(folder_.write("no-triangles.obj", "v 0 0 0\n"), {"triangles"});
    expect_frame_refused(folder_.write("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"), {});
    expect_frame_refused(folder_.write("frame.stl", "solid\n"), {});
    const std::string whole = read_file(frame("whole.ply", small_above_large(1)));
    expect_frame_refused(folder_.write("short.ply", whole.substr(0, whole.size() - 5)), {});
}

TEST_F(CcdCommand, ABadStartLeavesTheFileOfAnEarlierRun) {
    const std::string out = folder_.write("impacts.csv", "earlier");
    const std::string good = frame("good.ply", small_above_large(1));
    expect_refused(ccd({good}, {"--json", "--out", out}), {"good.ply", "one frame"});
    expect_refused(ccd({folder_ / "none-*.ply"}, {"--json", "--out", out}),
                   {"none-*.ply", "matches no file"});
    expect_refused(ccd({folder_ / "missing.ply", good}, {"--json", "--out", out}), {"missing.ply"});
    expect_refused(ccd({good, good}, {"--json", "--out", out, "--delta", "1"}), {"--delta"});
    EXPECT_EQ(read_file(out), "earlier");
}

TEST_F(CcdCommand, BadOptionsAreRefused) {
    const auto files = frames({crossed_edges(1), crossed_edges(-1)});
    expect_refused(ccd(files, {"--scheme", "clever"}), {"--scheme", "clever"});
    expect_refused(ccd(files, {"--assignment", "uniform"}), {"--assignment"});
    expect_refused(ccd(files, {"--culling", "none"}), {"--culling"});
    expect_refused(ccd(files, {"--mode", "fuzzy"}), {"--mode"});
    expect_refused(ccd(files, {"--mode", "conservative", "--delta", "-1"}), {"--delta"});
    expect_refused(ccd(files, {"--thickness", "-1"}), {"--thickness"});
    expect_refused(ccd(files, {"--out", folder_ / "impacts.txt"}), {"--out", "impacts.txt"});
    expect_refused(ccd(files, {"--json", "--out", folder_ / "none/impacts.csv"}),
                   {"none/impacts.csv", "cannot be written"});
    expect_refused(ccd(files, {"--fail-on", "contact"}), {"--fail-on"});
    expect_refused(ccd({}, {}), {"FRAME"});
}

TEST_F(CcdCommand, AFullDiskIsAnError) {
    if (!fs::exists("/dev/full"))
        GTEST_SKIP() << "no /dev/full";
    fs::create_symlink("/dev/full", folder_ / "full.csv");
    expect_refused(ccd(frames({crossed_edges(1), crossed_edges(-1)}),
                       {"--json", "--out", folder_ / "full.csv"}),
                   {"full.csv", "cannot be written"});
}

TEST_F(CcdCommand, AnInterruptLeavesWholeSteps) {
    Random random(19);
    auto files = frames(crumpled_sheets(random, 2));
    const auto total = answer(files)["total"];
    const auto impacts =
        total["edge_edge"].get<std::size_t>() + total["vertex_face"].get<std::size_t>();
    ASSERT_GT(impacts, 0U);
    for (int i = 0; i < 10000; ++i) // back and forth
        files.push_back(files.at(i));
    files.insert(files.begin(), "ccd");
    const std::string out = folder_ / "impacts.csv";
    files.insert(files.end(), {"--out", out});
    const Outcome outcome = run_abut_and_signal(files, "frame-1.ply -> frame-0.ply", SIGINT);
    EXPECT_EQ(outcome.status, 130);
    EXPECT_NE(outcome.err.find("abut: interrupted\n"), std::string::npos) << outcome.err;
    const auto written = read_impacts(out);
    const std::size_t steps = written.size() / impacts;
    EXPECT_EQ(written.size(), steps * impacts);
    EXPECT_GE(steps, 2U);
    EXPECT_LT(steps, 10001U);
    for (std::size_t i = 0; i < written.size(); ++i)
        ASSERT_EQ(written[i].step, i / impacts);
}

} // namespace
} // namespace abut::test
