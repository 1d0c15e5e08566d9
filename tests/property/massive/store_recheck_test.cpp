// After a re-import, a clash job tests only the pairs with a changed part, and finds what a job
// from scratch finds.

#include <abut/clash.h>
#include <abut/error.h>
#include <abut/store_clash.h>

#include "massive/record/job_rows.h"
#include "massive/record/job_tables.h"
#include "massive/record/work_rows.h"
#include "massive/work/stored_parts.h"
#include "tests/support/clash/clash_scenes.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/sanitizer.h"
#include "tests/support/store/changing_site.h"

#include <atomic>
#include <gtest/gtest.h>
#include <optional>
#include <set>

namespace abut::test {
namespace {

/// Pairs of part rows that the unfinished job in a store has not tested.
std::set<RowPair> pairs_left(const std::string& store) {
    Database database(store, OpenMode::read_only);
    std::set<RowPair> left;
    for (const JobRow& job : read_jobs(database))
        if (job.finished == 0)
            for_each_pair_left(database, job.job, [&](const RowPair& pair) {
                left.insert({std::min(pair.first, pair.second), std::max(pair.first, pair.second)});
            });
    return left;
}

/// Asks one question of a site again and again.
class Recheck {
public:
    Recheck(ChangingSite& site, ClashOptions options) : site_(site), options_(std::move(options)) {}

    /// How many pairs a job would now recall: those without a changed part that the last job
    /// tested.
    [[nodiscard]] std::uint64_t known_pairs() const {
        if (!was_asked_)
            return 0;
        const Store store = open_store(site_.store());
        RuleTable rules(options_);
        const StoredParts stored = gather_parts(store.file(), &rules);
        std::uint64_t known = 0;
        for (const IndexPair& pair : find_candidates(stored, rules, options_)) {
            const StoredPart &a = stored.parts[pair.a()], &b = stored.parts[pair.b()];
            const auto unchanged = [&](const StoredPart& part) {
                return site_.is_unchanged(part.model, store.file().part(part.row).id);
            };
            known += unchanged(a) && unchanged(b) && (within_ || a.model != b.model) &&
                             !left_.contains({std::min(a.row, b.row), std::max(a.row, b.row)})
                         ? 1
                         : 0;
        }
        return known;
    }

    /// Asks the question and checks the answer. The job is stopped after this share of the narrow
    /// phase; returns false then.
    bool ask(double share = 2) {
        const std::uint64_t known = known_pairs();
        std::atomic<bool> stop = false;
        ClashOptions options = options_;
        options.progress.stop = &stop;
        options.progress.report = [&](std::string_view stage, double at) {
            if (stage == "narrow phase" && at >= share)
                stop = true;
        };
        std::optional<StoreClashReport> found;
        try {
            found = find_clashes(open_store(site_.store()), options, {.memory = 700'000});
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::interrupted) << error.what();
        }
        was_asked_ = true;
        within_ = site_.scenes().size() == 1 || options_.self;
        left_ = pairs_left(site_.store());
        site_.begin();
        if (!found)
            return false;
        EXPECT_TRUE(left_.empty());
        EXPECT_EQ(found->counters.recalled_pairs, known);
        tested_ += found->report.candidates - known;
        recalled_ += known;
        clashes_ += found->report.clashes.size();
        expect_equal(found->report, found->models, find_clashes(site_.scenes(), options_),
                     site_.scenes());
        return true;
    }

    std::uint64_t tested_ = 0, recalled_ = 0, clashes_ = 0;

private:
    ChangingSite& site_;
    ClashOptions options_;
    bool was_asked_ = false, within_ = false;
    std::set<RowPair> left_;
};

ClashOptions some_question(Random& random) {
    ClashOptions options;
    options.clearance = random.chance(0.3) ? 0 : random.uniform(0, 0.1);
    options.touch_tolerance = random.chance(0.5) ? 0 : 1e-3;
    options.self = random.chance(0.3);
    options.rules = some_rules(random);
    if (!options.rules.empty() && random.chance(0.5))
        options.rules.front().b.file = {"*/site/*", "model1.glb"};
    return options;
}

TEST(Recheck, TestsOnlyChangedPairsAndFindsAllClashes) {
    Random random(6201);
    std::uint64_t tested = 0, recalled = 0, clashes = 0;
    const int rounds = many(reduced_for_threads(8, 2));
    for (int round = 0; round < rounds; ++round) {
        ChangingSite site(random, random.integer(1, 2), 70);
        Recheck question(site, some_question(random));
        ASSERT_TRUE(question.ask());
        const std::uint64_t at_first = question.tested_;
        for (int again = 0; again < 5; ++again) {
            for (int imports = random.integer(1, 2); imports > 0; --imports)
                site.change();
            ASSERT_TRUE(question.ask());
            if (random.chance(0.2)) { // after a finished job, every pair is known
                ASSERT_TRUE(question.ask());
            }
            if (HasFailure())
                return;
        }
        verify(open_store(site.store()));
        tested += question.tested_ - at_first;
        recalled += question.recalled_;
        clashes += question.clashes_;
    }
    std::cout << recalled << " pairs recalled, " << tested << " tested again, " << clashes
              << " clashes\n";
    EXPECT_GT(recalled, tested / 2);
    EXPECT_GT(tested, static_cast<std::uint64_t>(rounds) * 50);
    EXPECT_GT(clashes, static_cast<std::uint64_t>(rounds) * 50);
}

/// Pairs that a stopped job tested are recalled too, even after imports.
TEST(Recheck, ResumesAStoppedJobAfterAnImport) {
    Random random(6202);
    std::uint64_t recalled = 0, tested = 0;
    int stops = 0;
    const int rounds = many(reduced_for_threads(6, 2));
    for (int round = 0; round < rounds; ++round) {
        ChangingSite site(random, random.integer(1, 2), 120);
        Recheck question(site, some_question(random));
        for (int again = 0; again < 6; ++again) {
            const bool ended = question.ask(random.chance(0.5) ? random.uniform(0.1, 0.9) : 2);
            stops += ended ? 0 : 1;
            if (random.chance(0.7))
                site.change();
            if (HasFailure())
                return;
        }
        ASSERT_TRUE(question.ask());
        verify(open_store(site.store()));
        recalled += question.recalled_;
        tested += question.tested_;
    }
    std::cout << stops << " stops, " << recalled << " pairs recalled, " << tested << " tested\n";
    EXPECT_GE(stops, rounds / 2);
    EXPECT_GT(recalled, tested / 4);
}

/// A job that runs during an import fails, because its further results would be of other parts.
TEST(Recheck, AnImportEndsARunningJob) {
    Random random(6203);
    for (int round = 0; round < many(3); ++round) {
        ChangingSite site(random, 1, 150);
        ClashOptions options;
        options.clearance = 0.02;
        bool begun = false;
        options.progress.report = [&](std::string_view stage, double at) {
            if (stage != "narrow phase" || at < 0.3 || std::exchange(begun, true))
                return;
            const Hash128 before = parts_key(StoreFile(site.store(), true).models());
            do
                site.change();
            while (parts_key(StoreFile(site.store(), true).models()) == before);
        };
        try {
            (void)find_clashes(open_store(site.store()), options, {.memory = 700'000});
            FAIL() << "the job did not notice";
        } catch (const Error& error) {
            ASSERT_TRUE(begun) << error.what();
            ASSERT_NE(std::string(error.what()).find("changed by an import"), std::string::npos)
                << error.what();
        }
        options.progress = {};
        const StoreClashReport found = find_clashes(open_store(site.store()), options);
        expect_equal(found.report, found.models, find_clashes(site.scenes(), options),
                     site.scenes());
    }
}

} // namespace
} // namespace abut::test
