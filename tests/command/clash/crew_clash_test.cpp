/// mpirun -n N abut clash STORE gives the answer of one process. A kill, signal, damage, a full
/// disk or a bad argument ends all processes.
#include "store/database/sqlite.h"
#include "tests/command/models.h"
#include "tests/command/run_command.h"
#include "tests/support/paths.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace abut::test {
namespace {

#ifdef ABUT_MPIEXEC
constexpr const char* kMpiexec = ABUT_MPIEXEC;
#else
constexpr const char* kMpiexec = nullptr;
#endif

/// The child processes of a process, oldest first.
std::vector<pid_t> children_of(pid_t process) {
    std::ifstream list(fmt::format("/proc/{0}/task/{0}/children", process));
    std::vector<pid_t> children;
    for (pid_t child = 0; list >> child;)
        children.push_back(child);
    return children;
}

std::string first_bytes_of_a_block(const std::string& store, int block) {
    Database database(store, OpenMode::read_only);
    Statement row(database, "SELECT substr(data, 1, 32) FROM block WHERE block = ?");
    if (!row.bind(block).step())
        return {};
    const auto bytes = row.bytes(0);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

class CrewClash : public testing::Test {
protected:
    void SetUp() override {
        if (kMpiexec == nullptr)
            GTEST_SKIP() << "this build has no MPI";
    }

    void make(const Scene& scene) {
        write_glb(scene, model_);
        import_anew();
    }
    /// Makes the store anew, without any job.
    void import_anew() {
        std::filesystem::remove(store_);
        ASSERT_EQ(run_abut({"import", model_, store_, "--quiet"}).status, 0);
    }
    [[nodiscard]] std::vector<std::string> arguments(std::vector<std::string> options) const {
        options.insert(options.begin(), {"clash", store_, "--clearance", "0.05"});
        return options;
    }
    [[nodiscard]] Outcome alone(const std::vector<std::string>& options) const {
        return run_abut(arguments(options));
    }
    /// Runs the command by this number of processes, without mpirun's own messages.
    static Outcome run_crew(int processes, const std::vector<std::string>& of,
                            const Watch& watch = {}) {
        std::vector<std::string> command{
            kMpiexec, "--allow-run-as-root",     "--oversubscribe", "--quiet",
            "-n",     std::to_string(processes), ABUT_COMMAND};
        command.insert(command.end(), of.begin(), of.end());
        return run_program(command, watch);
    }
    [[nodiscard]] Outcome crew(int processes, const std::vector<std::string>& options,
                               const Watch& watch = {}) const {
        return run_crew(processes, arguments(options), watch);
    }

    TemporaryFolder folder_;
    std::string model_ = folder_ / "site.glb", store_ = folder_ / "site.abut";
};

/// Acts once, this many seconds after the work has begun.
class OnceAtWork {
public:
    OnceAtWork(double seconds, std::function<void(pid_t)> act)
        : seconds_(seconds), act_(std::move(act)) {}
    void operator()(pid_t process, const Outcome& so_far) {
        if (so_far.err.find("narrow") == std::string::npos)
            return;
        const auto now = std::chrono::steady_clock::now();
        if (!begun_)
            begun_ = now;
        if (act_ && std::chrono::duration<double>(now - *begun_).count() >= seconds_)
            std::exchange(act_, {})(process);
    }

private:
    double seconds_;
    std::function<void(pid_t)> act_;
    std::optional<std::chrono::steady_clock::time_point> begun_;
};

TEST_F(CrewClash, EqualsOneProcess) {
    make(crowd(150, 8));
    const Outcome one = alone({"--memory", "1M", "--json", "--out", folder_ / "one"});
    ASSERT_EQ(one.status, 0) << one.err;
    ASSERT_GT(one.json()["clashes"].size(), 100U);
    for (const int processes : {1, 2, 4}) {
        SCOPED_TRACE(processes);
        import_anew();
        const std::string out = folder_ / fmt::format("of{}", processes);
        const Outcome many = crew(processes, {"--memory", "300K", "--json", "--out", out});
        ASSERT_EQ(many.status, 0) << many.err;
        for (const char* key : {"clearance", "touch", "candidates", "counts", "clashes", "models"})
            EXPECT_EQ(many.json()[key], one.json()[key]) << key;
        EXPECT_EQ(read_file(out + "/report.csv"), read_file(folder_ / "one/report.csv"));
        const auto work = many.json()["out_of_core"];
        EXPECT_EQ(work["kept"], true);
        EXPECT_EQ(work["recalled_pairs"], 0);
        ASSERT_EQ(work["processes"].size(), static_cast<std::size_t>(processes));
        std::uint64_t pairs = 0;
        for (const auto& process : work["processes"]) {
            EXPECT_GT(process["units"], 0);
            pairs += process["pairs"].get<std::uint64_t>();
        }
        EXPECT_EQ(one.json()["candidates"], pairs);
    }
    // Any number of processes recalls what was found before.
    for (const int processes : {1, 3}) {
        const Outcome again = crew(processes, {"--json"});
        EXPECT_EQ(again.json()["clashes"], one.json()["clashes"]);
        EXPECT_EQ(again.json()["out_of_core"]["recalled_pairs"], one.json()["candidates"]);
    }
    EXPECT_EQ(crew(2, {"--fail-on", "hard", "--quiet"}).status, 1);
}

TEST_F(CrewClash, OneKilledEndsAllAndTheJobGoesOn) {
    Random random(31);
    make(crowd(400, 12));
    const auto truth = alone({"--json"}).json()["clashes"];
    std::size_t killed = 0, went_on = 0;
    double longest = 1; // in seconds
    const int rounds = many(4);
    for (int round = 0; round < rounds; ++round) {
        import_anew();
        const auto whom = static_cast<std::size_t>(random.integer(0, 2));
        const Outcome outcome =
            crew(3, {"--memory", "600K", "--progress"},
                 OnceAtWork(random.uniform(0.1, 1) * longest, [&](pid_t mpirun) {
                     const std::vector<pid_t> processes = children_of(mpirun);
                     if (whom < processes.size())
                         kill(processes[whom], SIGKILL);
                 }));
        if (outcome.status == 0) {
            longest *= 0.5;
            continue;
        }
        ++killed;
        ASSERT_EQ(run_abut({"info", store_, "--verify", "--quiet"}).status, 0);
        const Outcome rest = crew(random.integer(1, 3), {"--memory", "600K", "--json"});
        ASSERT_EQ(rest.status, 0) << rest.err;
        ASSERT_EQ(rest.json()["clashes"], truth);
        const auto recalled = rest.json()["out_of_core"]["recalled_pairs"].get<std::uint64_t>();
        went_on += recalled > 0 && recalled < rest.json()["candidates"] ? 1 : 0;
    }
    std::cout << killed << " killed, " << went_on << " went on in the middle\n";
    EXPECT_GT(killed, 0U);
    EXPECT_GT(went_on, 0U);
}

TEST_F(CrewClash, ASignalToOneEndsAll) {
    make(crowd(400, 12));
    for (const std::size_t whom : {std::size_t{0}, std::size_t{1}})
        for (const int signal : {SIGINT, SIGTERM}) {
            SCOPED_TRACE(fmt::format("signal {} to process {}", signal, whom));
            import_anew();
            const Outcome outcome =
                crew(2, {"--memory", "600K", "--progress", "--out", folder_ / "out"},
                     OnceAtWork(0.1, [&](pid_t mpirun) {
                         const std::vector<pid_t> processes = children_of(mpirun);
                         ASSERT_EQ(processes.size(), 2U);
                         kill(processes[whom], signal);
                     }));
            EXPECT_EQ(outcome.status, 130);
            EXPECT_EQ(outcome.out, "");
            const std::size_t said = outcome.err.find("abut: interrupted\n");
            EXPECT_NE(said, std::string::npos) << outcome.err;
            EXPECT_EQ(outcome.err.find("abut: ", said + 1), std::string::npos) << outcome.err;
            EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
        }
    // mpirun passes the signal on, and kills processes that have not ended after a second.
    import_anew();
    EXPECT_NE(
        crew(2, {"--progress"}, OnceAtWork(0.1, [](pid_t mpirun) { kill(mpirun, SIGINT); })).status,
        0);
    EXPECT_EQ(crew(2, {"--json"}).json()["clashes"], alone({"--json"}).json()["clashes"]);
}

TEST_F(CrewClash, DamageIsAnErrorOrDoesNotMatter) {
    Random random(32);
    make(crowd(60, 8));
    const auto truth = alone({"--json"}).json()["clashes"];
    import_anew();
    const std::string whole = read_file(store_);
    const std::string block = first_bytes_of_a_block(store_, random.integer(1, 60));
    const std::size_t place = whole.find(block);
    ASSERT_NE(place, std::string::npos);
    std::size_t refused = 0;
    const int rounds = many(6);
    for (int round = 0; round < rounds; ++round) {
        std::string bytes = whole;
        if (round % 2 == 0) // every process that reads the block notices
            bytes[place + static_cast<std::size_t>(random.bits() % block.size())] ^= 4;
        else
            for (int i = random.integer(1, 20); i > 0; --i)
                bytes[static_cast<std::size_t>(random.bits() % bytes.size())] ^=
                    static_cast<char>(1 << random.integer(0, 7));
        std::ofstream(store_, std::ios::binary | std::ios::trunc) << bytes;
        const Outcome outcome = crew(3, {"--memory", "600K", "--json"});
        if (outcome.status == 0) {
            ASSERT_EQ(outcome.json()["clashes"], truth);
        } else {
            ++refused;
            expect_refused(outcome, {store_});
        }
    }
    std::cout << refused << " refused\n";
    EXPECT_GE(refused, static_cast<std::size_t>(rounds) / 2);
}

TEST_F(CrewClash, AFullDiskIsAnErrorAndTheJobGoesOn) {
    make(crowd(300, 8));
    const auto size = std::filesystem::file_size(store_);
    // The leader's files are limited to this size, so that writes beyond it fail as on a full disk.
    // MPI messages go over TCP, because the other transports need files.
    const std::string leader =
        fmt::format("trap '' XFSZ; ulimit -f {}; exec {} clash {} --clearance 0.05",
                    size / 1024 + 96, ABUT_COMMAND, store_);
    const Outcome outcome = run_program({kMpiexec,
                                         "--allow-run-as-root",
                                         "--oversubscribe",
                                         "--quiet",
                                         "--mca",
                                         "btl",
                                         "tcp,self",
                                         "-n",
                                         "1",
                                         "bash",
                                         "-c",
                                         leader,
                                         ":",
                                         "-n",
                                         "2",
                                         ABUT_COMMAND,
                                         "clash",
                                         store_,
                                         "--clearance",
                                         "0.05"});
    expect_refused(outcome, {store_, "cannot be written"});
    EXPECT_EQ(run_abut({"info", store_, "--verify", "--quiet"}).status, 0);
    EXPECT_EQ(crew(2, {"--json"}).json()["clashes"], alone({"--json"}).json()["clashes"]);
}

TEST_F(CrewClash, AReadOnlyStoreIsAnsweredButNotKept) {
    make(crowd(60, 8));
    const auto truth = clashes_of(run_abut({"clash", model_, "--clearance", "0.05", "--json"}));
    const ReadOnly read_only(folder_);
    if (!ReadOnly::can_run_abut())
        GTEST_SKIP() << "nobody may not run this build";
    const Outcome outcome = crew(2, {"--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(clashes_of(outcome), truth);
    EXPECT_EQ(outcome.json()["out_of_core"]["kept"], false);
}

TEST_F(CrewClash, RefusesWhatOneProcessRefuses) {
    make(crowd(10, 6));
    expect_refused(crew(2, {"--memory", "many"}), {"--memory"});
    expect_refused(crew(2, {"--memory", "1K"}), {store_, "memory"});
    expect_refused(crew(2, {"--rules", folder_ / "missing.json"}), {"missing.json"});
    expect_refused(crew(2, {"--clearance"}), {"--clearance"});
    expect_refused(run_crew(2, {"clash", model_}), {model_, "store"});
    expect_refused(run_crew(2, {"clash", folder_ / "missing.abut"}), {"missing.abut"});
    // Started by an MPI that differs from the build's, the process would take itself for the only
    // one.
    expect_refused(run_program({"env", "PMI_RANK=0", "PMI_SIZE=2", ABUT_COMMAND, "clash", store_}),
                   {"another MPI"});
}

} // namespace
} // namespace abut::test
