/// Statuses of clashes in abut review and abut clash; kills, damage and locks.
#include <abut/clash_review.h>
#include <abut/error.h>
#include <abut/store.h>

#include "store/database/sqlite.h"
#include "tests/command/models.h"
#include "tests/command/run_command.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/store/page_queries.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <map>

namespace abut::test {
namespace {

class Review : public testing::Test {
protected:
    /// A site with one clash of each kind: "h", "t", "c", "d" and "n" with their numbers 1 and 2.
    void SetUp() override { import(one_of_each_kind()); }

    void import(const Scene& scene) {
        write_glb(scene, model_);
        const Outcome outcome = run_abut({"import", model_, store_, "--quiet"});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
    }
    static Outcome clash(const std::string& of, std::vector<std::string> options = {}) {
        options.insert(options.begin(), {"clash", of, "--clearance", "0.05"});
        return run_abut(options);
    }
    [[nodiscard]] nlohmann::json report() const {
        const Outcome outcome = clash(store_, {"--json"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.json();
    }
    [[nodiscard]] Outcome review(std::vector<std::string> options) const {
        options.insert(options.begin(), {"review", store_});
        return run_abut(options);
    }
    /// The clashes of a report as sorted lines such as "h1 hard new".
    static std::vector<std::string> words(const nlohmann::json& report) {
        std::vector<std::string> words;
        for (const char* const list : {"clashes", "resolved"})
            for (const auto& clash : report[list])
                words.push_back(fmt::format(
                    "{} {} {}", clash["a"].get<std::string>(), clash["kind"].get<std::string>(),
                    list == std::string("clashes") ? clash["status"].get<std::string>()
                                                   : "resolved"));
        std::sort(words.begin(), words.end());
        return words;
    }
    [[nodiscard]] std::string id_of(const std::string& part) const {
        const auto found = report();
        for (const auto& clash : found["clashes"])
            if (clash["a"] == part)
                return clash["id"];
        return "none";
    }
    [[nodiscard]] int fails_on(const std::string& on) const {
        return clash(store_, {"--quiet", "--fail-on", on}).status;
    }

    TemporaryFolder folder_;
    std::string model_ = folder_ / "site.glb", store_ = folder_ / "site.abut";
};

using Words = std::vector<std::string>;

TEST_F(Review, StatusesOverTheLifeOfASite) {
    EXPECT_EQ(words(report()), (Words{"c1 contained new", "d1 duplicate new", "h1 hard new",
                                      "n1 clearance new", "t1 touch new"}));
    EXPECT_EQ(words(report()), words(report())) << "the same job is the same job";
    const std::string hard = id_of("h1"), touch = id_of("t1");
    EXPECT_EQ(fails_on("hard"), 1);
    EXPECT_EQ(review({"--approve", hard, touch, "--note", "sleeve, A. B."}).status, 0);
    EXPECT_EQ(review({"--reviewed", id_of("n1"), "--quiet"}).out, "");
    const auto marked = report();
    EXPECT_EQ(words(marked), (Words{"c1 contained new", "d1 duplicate new", "h1 hard approved",
                                    "n1 clearance reviewed", "t1 touch approved"}));
    EXPECT_EQ(marked["clashes"][0]["note"], "sleeve, A. B.");
    EXPECT_EQ(marked["statuses"],
              nlohmann::json::parse(
                  R"({"new": 2, "active": 0, "reviewed": 1, "approved": 2, "resolved": 0})"));
    EXPECT_EQ(fails_on("hard"), 0);
    EXPECT_EQ(fails_on("hard,touch"), 0);
    EXPECT_EQ(fails_on("hard,approved"), 1);
    EXPECT_EQ(fails_on("any"), 1);
    EXPECT_EQ(fails_on("new"), 1);
    EXPECT_EQ(fails_on("clearance,new"), 0);
    EXPECT_EQ(fails_on("active"), 0);

    // The touch becomes a hard clash, which is another clash without the mark. The pump leaves the
    // tank.
    Scene scene = one_of_each_kind();
    scene.parts[3].world_from_mesh = placed(10.9, 0.25, 0.25);
    scene.parts[5].world_from_mesh = placed(26, 1, 1);
    import(scene);
    EXPECT_EQ(report()["out_of_core"]["recalled_pairs"], 3); // of h, d and n
    EXPECT_EQ(words(report()),
              (Words{"c1 contained resolved", "d1 duplicate active", "h1 hard approved",
                     "n1 clearance reviewed", "t1 hard new", "t1 touch resolved"}));
    EXPECT_EQ(fails_on("hard"), 1);
    EXPECT_EQ(fails_on("new"), 1);
    EXPECT_EQ(report()["resolved"][0]["resolved"].get<std::string>().size(),
              std::string("2026-11-22T10:00:00Z").size());

    // The site is as before. Returned clashes are new, and the touch's mark has lapsed, because it
    // was made before the touch was gone.
    import(one_of_each_kind());
    EXPECT_EQ(words(report()),
              (Words{"c1 contained new", "d1 duplicate active", "h1 hard approved",
                     "n1 clearance reviewed", "t1 hard resolved", "t1 touch new"}));
    EXPECT_EQ(id_of("t1"), touch);
    EXPECT_EQ(review({"--approve", touch}).status, 0);
    EXPECT_EQ(review({"--clear", hard}).status, 0);
    EXPECT_EQ(words(report()),
              (Words{"c1 contained new", "d1 duplicate active", "h1 hard active",
                     "n1 clearance reviewed", "t1 hard resolved", "t1 touch approved"}));
    EXPECT_EQ(review({"--forget-resolved", "--json"}).json()["forgotten"], 1);
    EXPECT_EQ(report()["resolved"].size(), 0U);
    EXPECT_EQ(run_abut({"info", store_, "--verify", "--quiet"}).status, 0);
}

TEST_F(Review, ClashesOfARemovedModelAreResolved) {
    const std::string other = folder_ / "other.glb";
    write_glb(one_of_each_kind(), other);
    ASSERT_EQ(run_abut({"import", other, store_, "--quiet"}).status, 0);
    const auto both = report();
    ASSERT_GT(both["clashes"].size(), 5U); // across the models
    std::filesystem::remove(other);
    expect_refused(run_abut({"import", "--remove", folder_ / "none.glb", store_}), {"none.glb"});
    expect_refused(run_abut({"import", "--remove", other, folder_ / "none.abut"}), {"none.abut"});
    EXPECT_EQ(
        run_abut({"import", "--remove", other, store_, "--json"}).json()["removed"][0]["parts"],
        10);
    const auto one = report();
    EXPECT_EQ(one["statuses"]["new"], 5) << "of one model, pairs within it are asked for";
    EXPECT_EQ(one["statuses"]["resolved"], both["clashes"].size());
    EXPECT_EQ(clashes_of(clash(model_, {"--json"})), clashes_of(clash(store_, {"--json"})));
}

TEST_F(Review, ListsWhatTheStoreKnows) {
    EXPECT_NE(review({}).out.find("no clash job has finished"), std::string::npos);
    EXPECT_EQ(review({"--json"}).json()["questions"].size(), 0U);
    const std::string hard = id_of("h1");
    ASSERT_EQ(run_abut({"clash", store_, "--quiet"}).status, 0); // another question
    const Outcome marked = review({"--approve", hard, "--note", "as built", "--list", "--json"});
    ASSERT_EQ(marked.status, 0) << marked.err;
    const auto questions = marked.json()["questions"];
    ASSERT_EQ(questions.size(), 2U);
    EXPECT_EQ(questions[0]["clearance"], 0.05);
    EXPECT_EQ(questions[1]["clearance"], 0);
    EXPECT_EQ(questions[0]["clashes"].size(), 5U);
    EXPECT_EQ(questions[1]["clashes"].size(), 4U);
    for (const auto& question : questions) {
        const auto& clashes = question["clashes"];
        const auto found = std::find_if(clashes.begin(), clashes.end(),
                                        [&](const auto& clash) { return clash["id"] == hard; });
        ASSERT_NE(found, clashes.end());
        EXPECT_EQ((*found)["status"], "approved");
        EXPECT_EQ((*found)["note"], "as built");
        EXPECT_EQ((*found)["a_type"], "Wall");
        EXPECT_EQ((*found)["b_name"], "h2");
    }
    EXPECT_EQ(review({"--status", "approved", "--json"}).json()["questions"][0]["clashes"].size(),
              1U);
    const std::string text = review({"--status", "approved"}).out;
    EXPECT_NE(text.find(hard + "  approved  hard"), std::string::npos) << text;
    EXPECT_NE(text.find("\"as built\""), std::string::npos) << text;
}

TEST_F(Review, StatusesAreInEveryReport) {
    ASSERT_EQ(review({"--approve", id_of("h1"), "--note", "=1+1, \"so\""}).status, 0);
    ASSERT_EQ(clash(store_, {"--quiet", "--out", folder_ / "store"}).status, 0);
    ASSERT_EQ(clash(model_, {"--quiet", "--out", folder_ / "model"}).status, 0);
    const std::string csv = read_file(folder_ / "store/report.csv");
    EXPECT_NE(
        csv.find(",rule,severity,volume,volume_error,neighbours,status,note,group,group_name\r\n"),
        std::string::npos);
    EXPECT_NE(csv.find(",,approved,\"'=1+1, \"\"so\"\"\","), std::string::npos) << csv;
    EXPECT_NE(csv.find(",,new,,"), std::string::npos);
    EXPECT_NE(read_file(folder_ / "store/report.html").find("\"statuses\":{\"new\":4"),
              std::string::npos);
    EXPECT_NE(clash(store_).out.find("new 4, active 0, reviewed 0, approved 1, resolved 0"),
              std::string::npos);
    // Reports on model files contain no statuses.
    for (const char* const name : {"report.csv", "report.json"})
        EXPECT_EQ(read_file(folder_ / (std::string("model/") + name)).find("status"),
                  std::string::npos)
            << name;
    expect_refused(clash(model_, {"--fail-on", "new"}), {"--fail-on", "'new'", "store"});
}

TEST_F(Review, RefusesWhatItCannotDo) {
    const std::string hard = id_of("h1");
    expect_refused(review({"--approve", "0123456789abcdef"}), {store_, "0123456789abcdef"});
    expect_refused(review({"--approve", hard, "0123456789abcdef"}), {"0123456789abcdef"});
    EXPECT_EQ(fails_on("approved"), 0) << "none or all";
    expect_refused(review({"--reviewed", "h1"}), {"--reviewed", "'h1'"});
    expect_refused(review({"--approve", hard, "--clear", hard}), {hard, "twice"});
    expect_refused(review({"--note", "alone"}), {"--note"});
    expect_refused(review({"--status", "resolved,gone"}), {"--status", "gone"});
    expect_refused(run_abut({"review", model_}), {model_});
    expect_refused(run_abut({"review", folder_ / "missing.abut"}), {"missing.abut"});
    expect_refused(clash(store_, {"--fail-on", "resolved"}), {"--fail-on", "resolved"});
    Scene scene = one_of_each_kind();
    scene.parts.erase(scene.parts.begin());
    import(scene);
    EXPECT_EQ(report()["statuses"]["resolved"], 1);
    expect_refused(review({"--approve", hard}), {hard, "resolved"});
    {
        Database other(store_, OpenMode::read_write);
        const Transaction transaction(other);
        expect_refused(review({"--clear", hard}), {store_, "in use by another process"});
    }
    EXPECT_EQ(review({"--clear", hard}).status, 0);
}

TEST_F(Review, AReadOnlyStoreIsReadAndNotWritten) {
    ASSERT_EQ(review({"--approve", id_of("h1")}).status, 0);
    const auto words_before = words(report());
    const ReadOnly read_only(folder_);
    if (!ReadOnly::can_run_abut())
        GTEST_SKIP() << "nobody may not run this build";
    EXPECT_EQ(words(report()), words_before);
    EXPECT_EQ(fails_on("hard"), 0);
    EXPECT_EQ(review({}).status, 0);
    expect_refused(review({"--clear", id_of("h1")}), {store_, "read-only"});
}

TEST_F(Review, QueriesOfItsPageWork) {
    ASSERT_EQ(review({"--approve", id_of("h1")}).status, 0);
    // Two statuses, four new clashes, none resolved, one mark.
    EXPECT_EQ(rows_of_page_queries("clash-status.md", store_), (std::vector<int>{2, 4, 0, 1}));
}

/// Balls in rows; some are displaced, depending on `shift`.
Scene balls(int count, int shift) {
    Scene scene;
    for (int i = 0; i < count; ++i) {
        Mesh mesh = ball(8);
        for (Vec3& p : mesh.positions)
            p.x *= 1 + 0.001 * i;
        scene.meshes.push_back(std::move(mesh));
        const int row = i / 20, column = i % 20;
        const double aside = shift > 0 && i % 11 == shift % 11 ? 0.07 * shift : 0;
        scene.parts.push_back(part("ball" + std::to_string(i), "Ball",
                                   static_cast<std::uint32_t>(i),
                                   placed(1.9 * column, 1.9 * row + aside, 0)));
    }
    return scene;
}

/// The status of each clash by id, resolved clashes included.
std::map<std::string, std::string> statuses(const nlohmann::json& report) {
    std::map<std::string, std::string> result;
    for (const char* const list : {"clashes", "resolved"})
        for (const auto& clash : report[list])
            result[clash["id"]] = list == std::string("resolved") ? "resolved" : clash["status"];
    return result;
}

TEST_F(Review, KillsLoseNothing) {
    Random random(7);
    import(balls(160, 0));
    // `calm` is a store without kills; both must have the same statuses.
    const std::string calm = folder_ / "calm.abut";
    ASSERT_EQ(run_abut({"import", model_, calm, "--quiet"}).status, 0);
    const auto whole = clash(store_, {"--quiet"}).processor_time;
    ASSERT_EQ(clash(calm, {"--quiet"}).status, 0);
    std::size_t killed = 0, taken_over = 0;
    const int rounds = many(12);
    for (int round = 1; round <= rounds; ++round) {
        for (const std::string& store : {store_, calm}) {
            const auto ids = statuses(clash(store, {"--json"}).json());
            std::vector<std::string> command{"review", store, "--quiet", "--approve"};
            for (const auto& [id, status] : ids)
                if (status != "resolved" && std::stoull(id, nullptr, 16) % 7 == 0)
                    command.push_back(id);
            if (command.size() > 4) {
                ASSERT_EQ(run_abut(command).status, 0);
            }
        }
        write_glb(balls(160, round), model_);
        for (const std::string& store : {store_, calm})
            ASSERT_EQ(run_abut({"import", model_, store, "--quiet"}).status, 0);
        for (int kills = random.integer(1, 3); kills > 0; --kills) {
            const Outcome outcome = run_abut_and_kill(
                {"clash", store_, "--clearance", "0.05", "--memory", "800K", "--quiet"},
                random.uniform(0, 1) * whole);
            killed += outcome.status != 0 ? 1 : 0;
            ASSERT_EQ(run_abut({"info", store_, "--verify", "--quiet"}).status, 0);
        }
        const Outcome after = clash(store_, {"--json", "--memory", "800K"});
        ASSERT_EQ(clashes_of(after), clashes_of(clash(model_, {"--json"})));
        ASSERT_EQ(statuses(after.json()), statuses(clash(calm, {"--json"}).json()));
        taken_over += after.json()["out_of_core"]["recalled_pairs"] > 0 ? 1 : 0;
    }
    std::cout << killed << " killed, " << taken_over << " took over\n";
    EXPECT_GE(killed, static_cast<std::size_t>(rounds) / 3);
    EXPECT_EQ(taken_over, static_cast<std::size_t>(rounds));
}

TEST_F(Review, DamageIsAnErrorOrDoesNotMatter) {
    Random random(8);
    import(balls(60, 3));
    const auto first = statuses(report());
    std::vector<std::string> command{"--approve"};
    for (const auto& [id, status] : first)
        if (command.size() < 8)
            command.push_back(id);
    ASSERT_EQ(review(command).status, 0);
    import(balls(60, 5));
    const auto truth = statuses(report());
    const auto counts = report()["statuses"];
    for (const char* const status : {"new", "active", "approved", "resolved"})
        ASSERT_GT(counts[status], 0) << status;
    const std::string whole = read_file(store_);
    std::size_t refused = 0, verified = 0;
    for (int round = 0; round < many(60); ++round) {
        std::string bytes = whole;
        for (int i = random.integer(1, 30); i > 0; --i)
            bytes[static_cast<std::size_t>(random.bits() % bytes.size())] ^=
                static_cast<char>(1 << random.integer(0, 7));
        std::ofstream(store_, std::ios::binary | std::ios::trunc) << bytes;
        const Outcome checked = run_abut({"info", store_, "--verify", "--quiet"});
        verified += checked.status == 0 ? 0 : 1;
        const Outcome outcome = clash(store_, {"--json"});
        if (outcome.status == 0) {
            ASSERT_EQ(statuses(outcome.json()), truth);
        } else {
            ++refused;
            expect_refused(outcome, {store_});
            EXPECT_NE(checked.status, 0) << outcome.err;
        }
    }
    std::cout << refused << " refused, " << verified << " found by verify\n";
    EXPECT_GT(refused, static_cast<std::size_t>(many(60)) / 4);
    EXPECT_GE(verified, refused);
}

} // namespace
} // namespace abut::test
