/// abut import --levels, and what may happen meanwhile: kills, a full disk.
#include <abut/error.h>
#include <abut/levels.h>
#include <abut/store.h>

#include "tests/command/run_command.h"
#include "tests/support/paths.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <csignal>
#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

void make_plant_file(const std::string& path, const char* triangles) {
    ASSERT_EQ(run_abut({"scene", "plant", "--triangles", triangles, "--distinct", "--clashes", "0",
                        "--out", path})
                  .status,
              0);
}

TEST(ImportLevels, AreReportedAndUpdated) {
    const TemporaryFolder folder;
    const std::string model = folder / "plant.glb", store = folder / "plant.abut";
    make_plant_file(model, "100000");
    ASSERT_EQ(run_abut({"import", model, store}).status, 0);
    EXPECT_EQ(run_abut({"info", store, "--json"}).json()["stores"][0]["levels"], false);

    const Outcome outcome = run_abut({"import", "--levels", model, store, "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto levels = outcome.json()["levels"];
    EXPECT_EQ(levels["built"], true);
    EXPECT_GT(levels["chunks"], 8);
    EXPECT_EQ(levels["new_chunks"], levels["chunks"]);
    EXPECT_GT(levels["triangles"], 100'000);
    EXPECT_LT(levels["stored_bytes"].get<double>(), 1.5 * levels["geometry_bytes"].get<double>());

    const auto info = run_abut({"info", store, "--json", "--verify"}).json()["stores"][0];
    EXPECT_EQ(info["levels"], true);
    EXPECT_EQ(info["level_chunks"], levels["chunks"]);
    EXPECT_GT(info["level_bytes"], 0);
    EXPECT_NE(run_abut({"info", store}).out.find("levels"), std::string::npos);

    const Outcome again = run_abut({"import", "--levels", model, store, "--json"});
    EXPECT_EQ(again.json()["levels"]["built"], false);
    EXPECT_EQ(again.json()["levels"]["new_chunks"], 0);
    EXPECT_EQ(run_abut({"import", "--levels", "--remove", model, store}).status, 2);
}

TEST(ImportLevels, SurviveAFullDisk) {
    const TemporaryFolder folder;
    const std::string model = folder / "plant.glb", store = folder / "plant.abut";
    make_plant_file(model, "300000");
    ASSERT_EQ(run_abut({"import", model, store}).status, 0);
    const auto kib = std::filesystem::file_size(store) / 1024 + 200;
    // Files are limited to 200 KiB more, so that writes beyond it fail as on a full disk.
    const std::string command =
        fmt::format("bash -c \"trap '' XFSZ; ulimit -f {}; exec {} import --levels {} {} 2>{}\"",
                    kib, ABUT_COMMAND, model, store, folder / "err");
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2); // NOLINT
    const std::string err = read_file(folder / "err");
    EXPECT_NE(err.find("cannot be written"), std::string::npos) << err;
    EXPECT_EQ(run_abut({"info", store, "--verify"}).status, 0);
    EXPECT_FALSE(has_levels(open_store(store)));
    ASSERT_EQ(run_abut({"import", "--levels", model, store}).status, 0);
    EXPECT_TRUE(has_levels(open_store(store)));
    EXPECT_EQ(run_abut({"info", store, "--verify"}).status, 0);
}

TEST(ImportLevels, SurviveKillsAtAnyMoment) {
    Random random(1);
    const TemporaryFolder folder;
    const std::string model = folder / "plant.glb", store = folder / "plant.abut";
    make_plant_file(model, "200000");
    const std::string whole = folder / "whole.abut";
    const Outcome built = run_abut({"import", "--levels", model, whole, "--json"});
    ASSERT_EQ(built.status, 0) << built.err;
    ASSERT_EQ(run_abut({"import", model, store}).status, 0);
    int killed = 0;
    const int rounds = many(8);
    for (int round = 0; round < rounds; ++round) {
        const Outcome outcome = run_abut_and_kill({"import", "--levels", model, store},
                                                  random.uniform(0, 1) * built.processor_time);
        killed += outcome.status == 0 ? 0 : 1;
        const Store found = open_store(store);
        verify(found);
        if (has_levels(found))
            break;
    }
    const Outcome rest = run_abut({"import", "--levels", model, store, "--json"});
    ASSERT_EQ(rest.status, 0) << rest.err;
    for (const char* key : {"chunks", "triangles", "stored_bytes"})
        EXPECT_EQ(rest.json()["levels"][key], built.json()["levels"][key]) << key;
    EXPECT_GT(killed, 0);
}

TEST(ImportLevels, GoOnAfterAnInterrupt) {
    const TemporaryFolder folder;
    const std::string model = folder / "plant.glb", store = folder / "plant.abut";
    make_plant_file(model, "300000");
    const Outcome outcome =
        run_abut_and_signal({"import", "--levels", model, store, "--progress"}, "levels", SIGINT);
    EXPECT_EQ(outcome.status, 130);
    EXPECT_FALSE(has_levels(open_store(store)));
    ASSERT_EQ(run_abut({"import", "--levels", model, store}).status, 0);
    EXPECT_TRUE(has_levels(open_store(store)));
}

} // namespace
} // namespace abut::test
