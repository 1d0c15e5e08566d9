/// abut clash and abut graph of a store, and what may happen to a job: kills, a full disk, damage,
/// locks.
#include <abut/error.h>
#include <abut/store.h>

#include "tests/command/models.h"
#include "tests/command/run_command.h"
#include "tests/support/paths.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

class StoreClash : public testing::Test {
protected:
    /// Writes a model file and its store.
    void make(const Scene& scene) {
        write_glb(scene, model_);
        const Outcome outcome = run_abut({"import", model_, store_});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
    }
    [[nodiscard]] static Outcome clash(const std::string& of,
                                       std::vector<std::string> options = {}) {
        options.insert(options.begin(), {"clash", of, "--clearance", "0.05"});
        return run_abut(options);
    }

    TemporaryFolder folder_;
    std::string model_ = folder_ / "site.glb", store_ = folder_ / "site.abut";
};

TEST_F(StoreClash, EqualsTheJobOnModelFiles) {
    make(one_of_each_kind());
    const Outcome in_core = clash(model_, {"--json"}), out = clash(store_, {"--json"});
    ASSERT_EQ(in_core.status, 0) << in_core.err;
    ASSERT_EQ(out.status, 0) << out.err;
    for (const char* const key : {"models", "clearance", "touch", "candidates", "counts"})
        EXPECT_EQ(in_core.json()[key], out.json()[key]) << key;
    EXPECT_EQ(clashes_of(in_core), clashes_of(out));
    EXPECT_EQ(in_core.json()["clashes"].size(), 5U);
    const auto work = out.json()["out_of_core"];
    EXPECT_EQ(work["kept"], true);
    EXPECT_EQ(work["recalled_pairs"], 0);
    EXPECT_EQ(work["mesh_loads"], work["meshes"]);
    EXPECT_EQ(clash(store_, {"--json"}).json()["out_of_core"]["recalled_pairs"],
              out.json()["candidates"]);
    EXPECT_EQ(clash(store_, {"--fail-on", "hard", "--quiet"}).status, 1);
}

TEST_F(StoreClash, GraphPrintsAndDraws) {
    make(crowd(60, 8));
    const Outcome outcome =
        run_abut({"graph", store_, "--memory", "400K", "--svg", folder_ / "graph.svg", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto graph = outcome.json();
    EXPECT_EQ(graph["nodes"], 60);
    EXPECT_EQ(graph["isolated"], 0);
    EXPECT_EQ(graph["components"], 1);
    EXPECT_EQ(graph["largest_component"], 60);
    EXPECT_EQ(graph["edges"], run_abut({"clash", store_, "--json"}).json()["candidates"]);
    EXPECT_GT(graph["units"].size(), 2U);
    std::uint64_t edges = 0;
    for (const auto& unit : graph["units"])
        edges += unit["edges"].get<std::uint64_t>();
    EXPECT_EQ(graph["edges"], edges);
    EXPECT_LT(graph["cut_edges"], edges);
    const std::string svg = read_file(folder_ / "graph.svg");
    EXPECT_EQ(svg.rfind("<svg ", 0), 0U);
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
    EXPECT_NE(svg.find("<path "), std::string::npos);
    EXPECT_EQ(run_abut({"graph", store_, "--quiet", "--keep"}).out, "");
    EXPECT_EQ(run_abut({"info", store_, "--verify", "--quiet"}).status, 0);
    EXPECT_NE(run_abut({"graph", store_}).out.find("components"), std::string::npos);
}

TEST_F(StoreClash, RefusesWhatItCannotDo) {
    make(crowd(4, 14));
    expect_refused(clash(model_, {"--memory", "64M"}), {"--memory", "store"});
    expect_refused(clash(model_, {"--no-keep-hierarchies"}), {"--no-keep-hierarchies", "store"});
    expect_refused(clash(store_, {"--memory", "many"}), {"--memory"});
    expect_refused(clash(store_, {"--unit", "2"}), {"--unit", "store"});
    expect_refused(clash(store_, {"--memory", "1K"}), {store_, "memory"});
    expect_refused(clash(store_, {"--memory", "80K"}), {store_, "memory"});
    expect_refused(run_abut({"graph", model_}), {model_});
    expect_refused(run_abut({"clash", store_, model_}), {store_});
}

TEST_F(StoreClash, AReadOnlyStoreIsAnsweredButNotKept) {
    make(crowd(30, 8));
    const auto truth = clashes_of(clash(model_, {"--json"}));
    const ReadOnly read_only(folder_);
    if (!ReadOnly::can_run_abut())
        GTEST_SKIP() << "nobody may not run this build";
    const Outcome outcome = clash(store_, {"--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(clashes_of(outcome), truth);
    EXPECT_EQ(outcome.json()["out_of_core"]["kept"], false);
}

TEST_F(StoreClash, SurvivesKillsAtAnyMoment) {
    Random random(5);
    make(crowd(200, 10));
    const auto truth = clashes_of(clash(model_, {"--json"}));
    ASSERT_GT(truth.size(), 100U);
    const std::vector<std::string> command{"clash",    store_, "--clearance", "0.05",
                                           "--memory", "1M",   "--quiet"};
    // Makes the store anew, without any job.
    const auto make_anew = [&] {
        std::filesystem::remove(store_);
        ASSERT_EQ(run_abut({"import", model_, store_, "--quiet"}).status, 0);
    };
    std::size_t killed = 0, went_on = 0;
    const auto whole = clash(store_, {"--memory", "1M", "--quiet"}).processor_time;
    make_anew();
    const int rounds = many(20);
    for (int round = 0; round < rounds; ++round) {
        const Outcome outcome = run_abut_and_kill(command, random.uniform(0, 1) * whole);
        if (outcome.status != 0) {
            ++killed;
            ASSERT_EQ(run_abut({"info", store_, "--verify", "--quiet"}).status, 0);
            if (random.chance(0.5))
                continue;
        }
        const Outcome rest = clash(store_, {"--memory", "1M", "--json"});
        ASSERT_EQ(rest.status, 0) << rest.err;
        ASSERT_EQ(clashes_of(rest), truth);
        const auto recalled = rest.json()["out_of_core"]["recalled_pairs"].get<std::uint64_t>();
        went_on += recalled > 0 && recalled < rest.json()["candidates"] ? 1 : 0;
        make_anew();
    }
    std::cout << killed << " killed, " << went_on << " went on in the middle\n";
    EXPECT_GT(killed, static_cast<std::size_t>(rounds) / 4);
    EXPECT_GT(went_on, 0U);
}

TEST_F(StoreClash, SurvivesAFullDisk) {
    make(crowd(300, 8));
    const auto size = std::filesystem::file_size(store_);
    // Files are limited to this size, so that writes beyond it fail as on a full disk.
    const std::string command =
        fmt::format("trap '' XFSZ; ulimit -f {}; exec {} clash {} --clearance 0.05 2>{}",
                    size / 1024 + 8, ABUT_COMMAND, store_, folder_ / "err");
    EXPECT_EQ(WEXITSTATUS(std::system(("bash -c \"" + command + "\"").c_str())), 2); // NOLINT
    const std::string err = read_file(folder_ / "err");
    EXPECT_NE(err.find("cannot be written"), std::string::npos) << err;
    EXPECT_EQ(run_abut({"info", store_, "--verify"}).status, 0);
    EXPECT_EQ(clashes_of(clash(store_, {"--json"})), clashes_of(clash(model_, {"--json"})));
}

TEST_F(StoreClash, DamageIsAnErrorOrDoesNotMatter) {
    Random random(6);
    make(crowd(40, 6));
    ASSERT_EQ(clash(store_, {"--quiet"}).status, 0); // with a record
    const auto truth = clashes_of(clash(model_, {"--json"}));
    const std::string whole = read_file(store_);
    std::size_t refused = 0;
    for (int round = 0; round < many(40); ++round) {
        std::string bytes = whole;
        if (random.chance(0.2))
            bytes.resize(static_cast<std::size_t>(random.bits() % bytes.size()));
        else
            for (int i = random.integer(1, 40); i > 0; --i)
                bytes[static_cast<std::size_t>(random.bits() % bytes.size())] ^=
                    static_cast<char>(1 << random.integer(0, 7));
        std::ofstream(store_, std::ios::binary | std::ios::trunc) << bytes;
        const Outcome outcome = clash(store_, {"--json"});
        if (outcome.status == 0) {
            ASSERT_EQ(clashes_of(outcome), truth);
        } else {
            ++refused;
            expect_refused(outcome, {store_});
        }
    }
    std::cout << refused << " refused\n";
    EXPECT_GT(refused, static_cast<std::size_t>(many(40)) / 4);
}

} // namespace
} // namespace abut::test
