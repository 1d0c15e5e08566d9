/// abut import, abut info of stores, and what may happen to a store: kills, a full disk, damage,
/// locks.
#include <abut/error.h>
#include <abut/store.h>

#include "store/database/sqlite.h"
#include "store/import/store_writer.h"
#include "tests/command/models.h"
#include "tests/command/run_command.h"
#include "tests/support/paths.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/store/stores.h"

#include <csignal>
#include <cstring>
#include <fmt/format.h>
#include <fstream>

namespace abut::test {
namespace {

TEST(Import, MakesAStoreAndBringsItUpToDate) {
    const TemporaryFolder folder;
    const std::string model = folder / "boxes.glb", store = folder / "boxes.abut";
    Scene scene;
    scene.meshes = {unit_box(), ball(4), unit_box()};
    for (int i = 0; i < 3; ++i)
        scene.parts.push_back(
            part("box" + std::to_string(i), "Box", i == 2 ? 2 : 0, placed(2 * i, 0, 0)));
    scene.parts.push_back(part("ball", "Ball", 1, placed(0, 5, 0)));
    write_glb(scene, model);

    Outcome outcome = run_abut({"import", model, store, "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    auto report = outcome.json();
    EXPECT_EQ(report["store"], store);
    EXPECT_EQ(report["models"][0]["file"], model);
    EXPECT_EQ(report["models"][0]["outcome"], "added");
    EXPECT_EQ(report["models"][0]["streamed"], true);
    EXPECT_EQ(report["models"][0]["parts"], 4);
    EXPECT_EQ(report["models"][0]["added"], 4);
    EXPECT_EQ(report["new_meshes"], 2); // the two boxes are one
    EXPECT_EQ(folder.list(), (std::vector<std::string>{"boxes.abut", "boxes.glb"}));

    outcome = run_abut({"import", model, store, "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.json()["models"][0]["outcome"], "unchanged");

    scene.parts.pop_back();
    scene.parts[0].type = "Crate";
    write_glb(scene, model);
    outcome = run_abut({"import", model, store, "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    report = outcome.json();
    EXPECT_EQ(report["models"][0]["outcome"], "changed");
    EXPECT_EQ(report["models"][0]["changed"], 1);
    EXPECT_EQ(report["models"][0]["removed"], 1);
    EXPECT_EQ(report["removed_meshes"], 1); // the ball

    outcome = run_abut({"info", store, "--json", "--verify"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto info = outcome.json()["stores"][0];
    EXPECT_EQ(info["store"], store);
    EXPECT_EQ(info["complete"], true);
    EXPECT_EQ(info["verified"], true);
    EXPECT_EQ(info["generation"], 2);
    EXPECT_EQ(info["parts"], 3);
    EXPECT_EQ(info["triangles"], 36);
    EXPECT_EQ(info["meshes"], 1);
    EXPECT_EQ(info["stored_triangles"], 12);
    EXPECT_EQ(info["models"][0]["complete"], true);
    EXPECT_EQ(info["bounds"]["upper"], nlohmann::json({5.0, 1.0, 1.0}));
    EXPECT_NE(run_abut({"info", store}).out.find("complete"), std::string::npos);
}

TEST(Import, KeepsModelsThatAreNotNamedAndTakesAUnit) {
    const TemporaryFolder folder;
    const std::string store = folder / "s.abut";
    const std::string a = folder.write("a.obj", box_obj()), b = folder.write("b.obj", box_obj());
    ASSERT_EQ(run_abut({"import", a, store}).status, 0);
    ASSERT_EQ(run_abut({"import", b, store, "--unit", "0.5"}).status, 0);
    const auto info = run_abut({"info", store, "--json"}).json()["stores"][0];
    EXPECT_EQ(info["models"].size(), 2U);
    EXPECT_EQ(info["meshes"], 1);
    // The same file with another unit has changed.
    const auto again = run_abut({"import", a, store, "--unit", "0.5", "--json"}).json();
    EXPECT_EQ(again["models"][0]["changed"], 1);
    expect_stored(store, read_scene(a, {.unit = 0.5}), 0);
    expect_stored(store, read_scene(b, {.unit = 0.5}), 1);
}

TEST(Import, RefusesWhatItCannotDo) {
    const TemporaryFolder folder;
    const std::string box = folder.write("box.obj", box_obj()), store = folder / "s.abut";
    expect_refused(run_abut({"import", box}), {"MODEL... STORE"});
    expect_refused(run_abut({"import", box, store, "--memory", "1M"}), {"16 MiB"});
    expect_refused(run_abut({"import", box, store, "--memory", "12X"}), {"--memory", "12X"});
    expect_refused(run_abut({"import", folder / "none.obj", store}), {"none.obj", "no such file"});
    expect_refused(run_abut({"import", box, box, store}), {"box.obj", "twice"});
    expect_refused(run_abut({"import", folder.write("bad.obj", "v 0 0 0\nf 1 2 3\n"), store}),
                   {"bad.obj"});
    expect_refused(run_abut({"import", box, folder / "none/s.abut"}), {"s.abut"});
    EXPECT_EQ(folder.list(), (std::vector<std::string>{"bad.obj", "box.obj"}));
    ASSERT_EQ(run_abut({"import", box, store}).status, 0);
    expect_refused(run_abut({"import", store, folder / "t.abut"}), {"s.abut", "is a store"});
    expect_refused(run_abut({"info", store, box}), {"not both"});
    expect_refused(run_abut({"info", box, "--verify"}), {"--verify"});
    // A model whose file has become bad stays in the store.
    (void)folder.write("box.obj", "v 0 0 0\nf 1 2 3\n");
    expect_refused(run_abut({"import", box, store}), {"box.obj"});
    const auto info = run_abut({"info", store, "--json"}).json()["stores"][0];
    EXPECT_EQ(info["complete"], true);
    EXPECT_EQ(info["triangles"], 12);
}

TEST(Import, SaysWhatIsWrongWithAStore) {
    const TemporaryFolder folder;
    const std::string box = folder.write("box.obj", box_obj()), store = folder / "s.abut";
    const auto expect_both_refused = [&](const std::string& path,
                                         const std::vector<std::string>& words) {
        expect_refused(run_abut({"info", path}), words);
        expect_refused(run_abut({"import", box, path}), words);
    };
    expect_both_refused(folder.write("text.abut", std::string(5000, 'x')),
                        {"text.abut", "is not an Abut store"});
    {
        Database other(folder / "other.abut", OpenMode::create);
        other.run("CREATE TABLE t(a)");
    }
    expect_both_refused(folder / "other.abut", {"other.abut", "is not an Abut store"});
    ASSERT_EQ(run_abut({"import", box, store}).status, 0);
    const std::string whole = read_file(store);
    (void)folder.write("short.abut", whole.substr(0, whole.size() / 2));
    expect_both_refused(folder / "short.abut", {"short.abut", "is damaged"});
    {
        Database newer(folder.write("newer.abut", whole), OpenMode::read_write);
        newer.run("PRAGMA user_version = 7");
    }
    expect_both_refused(folder / "newer.abut", {"newer.abut", "version 7", "newer"});
    for (const std::string version : {"1", "2", "3"}) {
        {
            Database older(folder / "newer.abut", OpenMode::read_write);
            older.run(("PRAGMA user_version = " + version).c_str());
        }
        expect_both_refused(folder / "newer.abut",
                            {"newer.abut", "version " + version, "import the models"});
    }
    {
        const StoreWriter writer(store, std::uint64_t{2} << 20, ExclusiveStore::IfMissing::fail);
        expect_both_refused(store, {"s.abut", "in use by another process"});
    }
    EXPECT_EQ(run_abut({"info", store, "--verify"}).status, 0);
}

TEST(Import, AReadOnlyStoreIsReadAndNotWritten) {
    const TemporaryFolder folder;
    const std::string box = folder.write("box.obj", box_obj()), store = folder / "s.abut";
    ASSERT_EQ(run_abut({"import", box, store}).status, 0);
    (void)folder.write("box.obj", box_obj() + "# changed\n");
    const ReadOnly read_only(folder);
    if (!ReadOnly::can_run_abut())
        GTEST_SKIP() << "nobody may not run this build";
    EXPECT_EQ(run_abut({"info", store, "--verify"}).status, 0);
    expect_refused(run_abut({"import", box, store}), {"read-only"});
}

/// Meshes that hardly compress, so that their import takes many transactions.
Scene noise(Random& random, int meshes) {
    Scene scene;
    for (int m = 0; m < meshes; ++m) {
        Mesh mesh;
        for (int i = 0; i < 9000; ++i) {
            const Vec3 p = random.in_cube(1);
            mesh.positions.push_back(
                {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
        }
        for (std::uint32_t i = 0; i + 2 < mesh.positions.size(); i += 3)
            mesh.triangles.push_back({i, i + 1, i + 2});
        scene.parts.push_back(part("part " + std::to_string(m), "Noise",
                                   static_cast<std::uint32_t>(m), placed(m, 0, 0)));
        scene.meshes.push_back(std::move(mesh));
    }
    return scene;
}

TEST(Import, SurvivesAFullDisk) {
    Random random(1);
    const TemporaryFolder folder;
    const std::string model = folder / "noise.glb", store = folder / "s.abut";
    write_glb(noise(random, 60), model);
    const std::string box = folder.write("box.obj", box_obj());
    ASSERT_EQ(run_abut({"import", box, store}).status, 0);
    // Files are limited to 3 MB, so that writes beyond it fail as on a full disk.
    const std::string command = "trap '' XFSZ; ulimit -f 3000; exec " + std::string(ABUT_COMMAND) +
                                " import " + model + " " + store + " 2>" + (folder / "err");
    EXPECT_EQ(WEXITSTATUS(std::system(("bash -c \"" + command + "\"").c_str())), 2); // NOLINT
    const std::string err = read_file(folder / "err");
    EXPECT_NE(err.find("cannot be written"), std::string::npos) << err;
    EXPECT_EQ(run_abut({"info", store, "--verify"}).status, 0);
    expect_stored(store, read_scene(box), 0);
    ASSERT_EQ(run_abut({"import", model, store}).status, 0);
    expect_stored(store, read_scene(model), 1);
    EXPECT_EQ(run_abut({"info", store, "--verify"}).status, 0);
}

TEST(Import, SurvivesKillsAtAnyMoment) {
    Random random(2);
    const TemporaryFolder folder;
    const std::string model = folder / "noise.glb", store = folder / "s.abut";
    write_glb(noise(random, 300), model);
    const Scene scene = read_scene(model);
    std::size_t opened = 0, incomplete = 0, kept = 0, killed = 0;
    const auto whole = run_abut({"import", model, store}).processor_time;
    const int rounds = many(20);
    for (int round = 0; round < rounds; ++round) {
        if (round == 0 || random.chance(0.4)) {
            std::filesystem::remove(store);
            std::filesystem::remove(store + "-journal");
        }
        const Outcome outcome =
            run_abut_and_kill({"import", model, store}, random.uniform(0, 1) * whole);
        if (outcome.status == 0) { // the kill came too late
            expect_stored(store, scene);
            std::filesystem::remove(store);
            continue;
        }
        ++killed;
        std::error_code missing;
        if (std::filesystem::file_size(store, missing) == 0 || missing)
            continue; // the store had not been created
        try {
            const Store found = open_store(store);
            ++opened;
            verify(found);
            const StoreSummary content = summary(found);
            incomplete += content.complete ? 0 : 1;
            kept += content.meshes > 0 && !content.complete ? 1 : 0;
            ASSERT_TRUE(content.models.empty() || !content.complete || content.parts == 300U);
        } catch (const Error& error) {
            // Nothing was committed, not even the tables.
            ASSERT_NE(std::string(error.what()).find("is not an Abut store"), std::string::npos)
                << error.what();
        }
    }
    ASSERT_EQ(run_abut({"import", model, store}).status, 0);
    expect_stored(store, scene);
    const auto info = run_abut({"info", store, "--verify", "--json"}).json()["stores"][0];
    EXPECT_EQ(info["complete"], true);
    EXPECT_EQ(info["meshes"], 300);
    EXPECT_EQ(info["blocks"], 300);
    EXPECT_EQ(folder.list(), (std::vector<std::string>{"noise.glb", "s.abut"}));
    std::cout << killed << " killed, " << opened << " opened, " << incomplete << " incomplete, "
              << kept << " with meshes kept\n";
    EXPECT_GT(killed, static_cast<std::size_t>(rounds) / 3);
    EXPECT_GT(incomplete, 0U);
    EXPECT_GT(kept, 0U) << "no kill came between two transactions";
}

TEST(Import, AnInterruptedImportGoesOn) {
    Random random(3);
    const TemporaryFolder folder;
    const std::string model = folder / "noise.glb", store = folder / "s.abut";
    write_glb(noise(random, 200), model);
    const Outcome outcome =
        run_abut_and_signal({"import", model, store, "--progress"}, "geometry", SIGINT);
    EXPECT_EQ(outcome.status, 130);
    EXPECT_EQ(outcome.out, "");
    const auto info = run_abut({"info", store, "--json"}).json()["stores"][0];
    EXPECT_EQ(info["complete"], false);
    ASSERT_EQ(run_abut({"import", model, store}).status, 0);
    expect_stored(store, read_scene(model));
}

TEST(Import, StaysWithinItsMemory) {
    const TemporaryFolder folder;
    constexpr std::uint32_t kTriangles = 1'200'000;
    {
        std::ofstream file(folder / "sheet.stl", std::ios::binary);
        file << std::string(80, ' ');
        file.write(reinterpret_cast<const char*>(&kTriangles), sizeof kTriangles);
        for (std::uint32_t i = 0; i < kTriangles; ++i) {
            const std::uint32_t row = i / 1000;
            const auto x = static_cast<float>(i % 1000), y = static_cast<float>(row);
            const float values[12] = {0, 0, 1, x, y, 0, x + 1, y, 0, x, y + 1, 0};
            char record[50] = {};
            std::memcpy(record, values, sizeof values);
            file.write(record, sizeof record);
        }
    }
    // The shell forks the command. A fork of this process would start with this process's peak
    // memory.
    const std::string command =
        fmt::format("'{}' import '{}' '{}' --memory 32M --json >'{}'; exit $?", ABUT_COMMAND,
                    folder / "sheet.stl", folder / "s.abut", folder / "out");
    ASSERT_EQ(std::system(command.c_str()), 0); // NOLINT: the shell redirects
    const auto report = nlohmann::json::parse(read_file(folder / "out"));
    EXPECT_EQ(report["models"][0]["streamed"], true);
    EXPECT_EQ(report["models"][0]["triangles"], kTriangles);
    EXPECT_LT(report["peak_rss_mib"], 32 + 64);
    EXPECT_EQ(run_abut({"info", folder / "s.abut", "--verify"}).status, 0);
}

} // namespace
} // namespace abut::test
