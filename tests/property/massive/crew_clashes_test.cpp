// A store's clash job with several workers, here threads that share only messages. The answer
// equals that of one process, whichever worker does which task. An error anywhere ends all workers,
// and the job can be resumed.

#include <abut/error.h>
#include <abut/store.h>
#include <abut/store_clash.h>

#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/sanitizer.h"
#include "tests/support/store/stored_job.h"
#include "tests/support/thread_crew.h"

#include <atomic>
#include <functional>
#include <future>
#include <gtest/gtest.h>
#include <iostream>
#include <string>
#include <thread>

namespace abut::test {
namespace {

using Helper = std::function<void(std::size_t rank, std::unique_ptr<Crew>)>;

/// Calls find_clashes with a crew; the helpers are threads.
StoreClashReport find_together(const std::string& store, const ClashOptions& options,
                               OutOfCoreOptions out_of_core, std::size_t size,
                               const Helper& helper = {}) {
    std::vector<std::unique_ptr<Crew>> crew = ThreadCrew::of(size);
    std::vector<std::thread> helpers;
    for (std::size_t rank = 1; rank < size; ++rank)
        helpers.emplace_back([&, rank, own = std::move(crew[rank])]() mutable {
            if (helper)
                helper(rank, std::move(own));
            else
                help_find_clashes(store, *own);
        });
    struct Joining {
        std::unique_ptr<Crew>& leader;
        std::vector<std::thread>& helpers;
        ~Joining() {
            leader.reset(); // the helpers wait until the leader has left
            for (std::thread& thread : helpers)
                thread.join();
        }
    } const joining{crew[0], helpers};
    out_of_core.crew = crew[0].get();
    return find_clashes(open_store(store), options, out_of_core);
}

TEST(CrewClashes, EqualThoseOfOneProcess) {
    Random random(6201);
    std::size_t clashes = 0, runs = 0, shared = 0;
    for (int round = 0; round < many(reduced_for_threads(6, 3)); ++round) {
        const StoredJob job(random);
        clashes += job.truth.clashes.size();
        for (int run = 0; run < 3; ++run) {
            const auto size = static_cast<std::size_t>(random.integer(1, 5));
            const OutOfCoreOptions out_of_core{
                .memory = static_cast<std::uint64_t>(random.integer(800'000, 3'000'000)),
                .order = random.chance(0.3) ? WorkOrder::random : WorkOrder::partition,
                .keep = false};
            const StoreClashReport found = find_together(job.store, job.options, out_of_core, size);
            job.expect(found);
            const OutOfCoreCounters& counters = found.counters;
            ASSERT_EQ(counters.workers.size(), size);
            std::uint64_t units = 0, pairs = 0, busy = 0;
            for (const OutOfCoreCounters::Worker& worker : counters.workers) {
                units += worker.units;
                pairs += worker.pairs;
                busy += worker.units > 0 ? 1 : 0;
                ASSERT_LE(worker.peak_bytes, out_of_core.memory);
            }
            ASSERT_EQ(units, counters.units);
            ASSERT_EQ(pairs, found.report.candidates);
            ASSERT_LE(counters.peak_bytes, out_of_core.memory);
            runs += size > 1 ? 1 : 0;
            shared += busy > 1 ? 1 : 0;
        }
    }
    std::cout << clashes << " clashes; of " << runs << " runs by several, " << shared
              << " were shared\n";
    EXPECT_GT(clashes, 100U);
    EXPECT_GT(shared, runs / 3);
}

/// The leader or a helper is stopped again and again, each time after some more pairs.
TEST(CrewClashes, ResumeAfterAStop) {
    Random random(6202);
    std::size_t stops = 0, recalled = 0;
    for (int round = 0; round < many(reduced_for_threads(4, 2)); ++round) {
        const StoredJob job(random, 150);
        for (bool done = false; !done;) {
            std::atomic<bool> stop = false;
            ClashOptions options = job.options;
            const double share = random.uniform(0.1, 1.2);
            options.progress.report = [&](std::string_view stage, double at) {
                if (stage == "narrow phase" && at >= share)
                    stop = true;
            };
            const bool is_leader = random.chance(0.5);
            if (is_leader)
                options.progress.stop = &stop;
            try {
                const StoreClashReport found = find_together(
                    job.store, options, {.memory = 800'000}, 3,
                    [&](std::size_t rank, const std::unique_ptr<Crew>& crew) {
                        help_find_clashes(
                            job.store, *crew,
                            {.report = {}, .stop = !is_leader && rank == 1 ? &stop : nullptr});
                    });
                job.expect(found);
                EXPECT_TRUE(found.counters.kept);
                recalled += found.counters.recalled_pairs > 0 ? 1 : 0;
                done = true;
            } catch (const Error& error) {
                ASSERT_EQ(error.code(), ErrorCode::interrupted) << error.what();
                ++stops;
            }
        }
        const StoreClashReport again =
            find_together(job.store, job.options, {.memory = 800'000}, 2);
        job.expect(again);
        EXPECT_EQ(again.counters.recalled_pairs, job.truth.candidates);
        verify(open_store(job.store));
    }
    std::cout << stops << " stops, " << recalled << " jobs went on\n";
    EXPECT_GT(stops, 0U);
    EXPECT_GT(recalled, 0U);
}

TEST(CrewClashes, FailWithTheErrorOfAHelper) {
    Random random(6203);
    const StoredJob job(random, 100);
    const std::string other = job.folder / "other.abut", missing = job.folder / "missing.abut";
    write_glb(some_scene(random, 20, 4), job.folder / "other.glb");
    (void)import_models({job.folder / "other.glb"}, other);
    for (const std::string& store : {other, missing}) {
        // The first helper begins its task only after the second has reported its error, so the job
        // cannot end before.
        std::promise<void> told;
        const auto help = [&](std::size_t rank, const std::unique_ptr<Crew>& crew) {
            if (rank == 1)
                told.get_future().wait();
            help_find_clashes(rank == 2 ? store : job.store, *crew);
            if (rank == 2)
                told.set_value();
        };
        try {
            (void)find_together(job.store, job.options, {}, 3, help);
            FAIL() << "with another store";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(),
                      store == other ? ErrorCode::bad_argument : ErrorCode::file_not_found)
                << error.what();
            EXPECT_EQ(error.file(), store);
        }
    }
    // A helper that leaves without a message, again before the job can end.
    std::promise<void> left;
    EXPECT_THROW((void)find_together(job.store, job.options, {}, 3,
                                     [&](std::size_t rank, std::unique_ptr<Crew> crew) {
                                         if (rank == 1) {
                                             left.get_future().wait();
                                             help_find_clashes(job.store, *crew);
                                         } else {
                                             crew.reset();
                                             left.set_value();
                                         }
                                     }),
                 std::runtime_error);
    job.expect(find_together(job.store, job.options, {}, 3));
}

TEST(CrewClashes, FailWithTheErrorOfTheLeader) {
    Random random(6204);
    const StoredJob job(random, 100);
    EXPECT_THROW((void)find_together(job.store, job.options, {.memory = 1000}, 3), Error);
    ClashOptions negative = job.options;
    negative.clearance = -1;
    EXPECT_THROW((void)find_together(job.store, negative, {}, 3), Error);
}

/// An import while the job runs would mix two states of the store, so the job must fail.
TEST(CrewClashes, FailIfAnImportComesInBetween) {
    Random random(6205);
    for (const std::size_t size : {std::size_t{1}, std::size_t{3}}) {
        const StoredJob job(random, 150);
        ClashOptions options = job.options;
        bool begun = false;
        options.progress.report = [&](std::string_view stage, double at) {
            if (stage != "narrow phase" || at < 0.3 || std::exchange(begun, true))
                return;
            write_glb(some_scene(random, 100, 4), job.files.front());
            (void)import_models({job.files.front()}, job.store);
        };
        try {
            (void)find_together(job.store, options, {.memory = 800'000}, size);
            FAIL() << "the answer is of no state of the store";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::unreadable) << error.what();
            EXPECT_EQ(error.file(), job.store);
        }
        ASSERT_TRUE(begun);
    }
}

} // namespace
} // namespace abut::test
