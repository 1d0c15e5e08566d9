// Work units for several workers are small enough, handed out once each, in runs of neighbours,
// with their meshes' next uses. Tasks survive encoding as messages.

#include <abut/error.h>

#include "massive/crew/crew_messages.h"
#include "massive/work/unit_size.h"
#include "massive/work/work_schedule.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace abut::test {
namespace {

/// Parts in a row, each paired with some of its neighbours.
struct SomeWork {
    explicit SomeWork(Random& random) {
        const int parts = random.integer(2, 400), meshes = random.integer(1, parts);
        for (int i = 0; i < meshes; ++i)
            stored.meshes.push_back(
                {i + 1, static_cast<std::uint32_t>(random.integer(10'000, 5'000'000)), 1});
        for (int i = 0; i < parts; ++i) {
            StoredPart part;
            part.row = 10 + i;
            part.mesh = static_cast<std::uint32_t>(random.integer(0, meshes - 1));
            const Vec3 at = random.in_cube(5);
            stored.boxes.push_back({at, at});
            stored.parts.push_back(part);
        }
        std::set<IndexPair> all;
        for (int i = random.integer(1, 6 * parts); i > 0; --i) {
            const int a = random.integer(0, parts - 2),
                      b = std::min(parts - 1, a + random.integer(1, 8));
            all.insert(IndexPair(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)));
        }
        pairs.assign(all.begin(), all.end());
    }
    [[nodiscard]] std::vector<WorkUnit> units(std::uint64_t most, std::size_t workers) const {
        return split_long_units(make_work_units(stored, pairs,
                                                unit_budget(stored, pairs, most, workers),
                                                WorkOrder::partition, "s"),
                                stored, workers);
    }

    StoredParts stored;
    std::vector<IndexPair> pairs;
};

TEST(UnitSize, KeepsEveryPairAndFits) {
    Random random(6301);
    std::size_t enough = 0, long_jobs = 0;
    for (int round = 0; round < many(200); ++round) {
        const SomeWork work(random);
        const auto workers = static_cast<std::size_t>(random.integer(1, 8));
        const auto most = static_cast<std::uint64_t>(random.integer(10'000'000, 2'000'000'000));
        const std::vector<WorkUnit> units = work.units(most, workers);
        std::vector<IndexPair> seen;
        for (const WorkUnit& unit : units) {
            ASSERT_LE(unit.bytes, most);
            ASSERT_FALSE(unit.pairs.empty());
            seen.insert(seen.end(), unit.pairs.begin(), unit.pairs.end());
            std::set<std::uint32_t> needed;
            std::uint64_t bytes = 0;
            for (const IndexPair& pair : unit.pairs)
                for (const std::uint32_t part : {pair.a(), pair.b()})
                    if (needed.insert(work.stored.parts[part].mesh).second)
                        bytes += work.stored.meshes[work.stored.parts[part].mesh].bytes;
            ASSERT_EQ(std::vector(needed.begin(), needed.end()), unit.meshes);
            ASSERT_EQ(bytes, unit.bytes);
        }
        std::sort(seen.begin(), seen.end());
        ASSERT_EQ(seen, work.pairs);
        if (workers > 1 && work.pairs.size() > 1000) {
            ++long_jobs;
            enough += units.size() >= 4 * workers ? 1 : 0;
        }
    }
    std::cout << enough << " of " << long_jobs << " long jobs in at least 4 units a worker\n";
    EXPECT_GT(long_jobs, static_cast<std::size_t>(many(200)) / 40);
    EXPECT_GT(enough, long_jobs / 2);
}

TEST(WorkSchedule, HandsOutEveryUnitOnceInRuns) {
    Random random(6302);
    std::size_t handed_out = 0, following = 0, foretold = 0, uses = 0;
    for (int round = 0; round < many(100); ++round) {
        const SomeWork work(random);
        const auto workers = static_cast<std::size_t>(random.integer(1, 6));
        const std::vector<WorkUnit> units = work.units(500'000'000, workers);
        WorkSchedule schedule(work.stored, units, workers);
        std::vector<bool> done(units.size());
        std::vector<std::size_t> last(workers, units.size());
        // For each worker, the next use that it was last told for each mesh.
        std::vector<std::map<std::int64_t, std::uint32_t>> told(workers);
        for (std::size_t left = units.size(); left > 0; --left) {
            // Some workers are faster than others.
            const auto worker = static_cast<std::size_t>(
                std::min(random.integer(0, static_cast<int>(workers) - 1),
                         random.integer(0, static_cast<int>(workers) - 1)));
            const auto task = schedule.next(worker);
            ASSERT_TRUE(task);
            ASSERT_FALSE(done[task->unit]);
            done[task->unit] = true;
            following += last[worker] + 1 == task->unit ? 1 : 0;
            ++handed_out;
            last[worker] = task->unit;
            const WorkUnit& unit = units[task->unit];
            ASSERT_EQ(task->pairs.size(), unit.pairs.size());
            for (std::size_t k = 0; k < unit.pairs.size(); ++k) {
                const Task::PartUse &a = task->parts.at(task->pairs[k].a),
                                    &b = task->parts.at(task->pairs[k].b);
                ASSERT_EQ(a.row, work.stored.parts[unit.pairs[k].a()].row);
                ASSERT_EQ(b.row, work.stored.parts[unit.pairs[k].b()].row);
                ASSERT_EQ(unit.meshes.at(a.mesh), work.stored.parts[unit.pairs[k].a()].mesh);
            }
            for (std::size_t i = 0; i < task->meshes.size(); ++i) {
                const Task::MeshUse& use = task->meshes[i];
                ASSERT_EQ(use.mesh, work.stored.meshes[unit.meshes[i]].mesh);
                if (use.next_use != Task::kNoUse) {
                    // `next_use` is the first later unit that has the mesh.
                    for (std::size_t u = task->unit + 1; u <= use.next_use; ++u)
                        ASSERT_EQ(std::ranges::binary_search(units[u].meshes, unit.meshes[i]),
                                  u == use.next_use);
                }
                const auto before = told[worker].find(use.mesh);
                if (before != told[worker].end()) {
                    ++uses;
                    foretold += before->second == task->unit ? 1 : 0;
                }
                told[worker][use.mesh] = use.next_use;
            }
        }
        for (std::size_t worker = 0; worker < workers; ++worker)
            ASSERT_FALSE(schedule.next(worker));
    }
    std::cout << following << " of " << handed_out << " units follow their worker's last; "
              << foretold << " of " << uses << " uses were foretold\n";
    EXPECT_GT(following, handed_out / 2);
    EXPECT_GT(foretold, uses / 2);
}

std::string some_text(Random& random) {
    return std::string(static_cast<std::size_t>(random.integer(0, 5)), 'x');
}

TaskResult some_result(Random& random) {
    TaskResult result;
    result.unit = static_cast<std::uint32_t>(random.bits());
    result.pairs = random.bits();
    for (int i = random.integer(0, 3); i > 0; --i) {
        Clash clash;
        clash.id = random.bits();
        clash.kind = ClashKind::duplicate;
        clash.distance = random.uniform(-1, 1);
        clash.point_a = random.in_cube();
        clash.rule = some_text(random);
        result.clashes.push_back({static_cast<std::uint32_t>(random.bits()), clash, {}});
        result.named.push_back({static_cast<std::int64_t>(random.bits()),
                                {some_text(random), some_text(random), some_text(random), 0, {}}});
    }
    result.worker.processor_seconds = random.uniform(0, 1);
    return result;
}

TEST(CrewMessages, SurviveEncodingAndDecoding) {
    Random random(6303);
    std::size_t cut_short = 0;
    for (int round = 0; round < many(100); ++round) {
        const TaskResult result = some_result(random);
        const std::vector<std::byte> bytes = encode(result);
        const auto back = std::get<TaskResult>(decode(bytes));
        ASSERT_EQ(encode(back), bytes);
        ASSERT_EQ(back.clashes.size(), result.clashes.size());
        for (std::size_t i = 0; i < back.clashes.size(); ++i) {
            ASSERT_EQ(back.clashes[i].clash.id, result.clashes[i].clash.id);
            ASSERT_EQ(back.clashes[i].clash.point_a, result.clashes[i].clash.point_a);
            ASSERT_EQ(back.clashes[i].clash.rule, result.clashes[i].clash.rule);
            ASSERT_EQ(back.named[i].part.type, result.named[i].part.type);
        }
        const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(random.bits() % bytes.size());
        ASSERT_THROW((void)decode({bytes.begin(), end}), std::length_error);
        cut_short += end != bytes.begin() ? 1 : 0;
    }
    EXPECT_GT(cut_short, 0U);

    Briefing briefing;
    briefing.budget = 99;
    const auto told = std::get<Briefing>(decode(encode(briefing)));
    EXPECT_EQ(told.budget, 99U);

    Task task;
    task.pairs = {{1, 2, 1}};
    task.terms.resize(2);
    task.terms[1].numbers.tolerated = 0.25;
    task.terms[1].numbers.neighbours = Neighbours::covers;
    task.terms[1].rule = "near", task.terms[1].severity = "high";
    const auto asked = std::get<Task>(decode(encode(task)));
    EXPECT_EQ(asked.pairs.at(0).terms, 1U);
    EXPECT_EQ(asked.terms.at(1).numbers.tolerated, 0.25);
    EXPECT_EQ(asked.terms.at(1).numbers.neighbours, Neighbours::covers);
    EXPECT_EQ(asked.terms.at(1).rule, "near");
    EXPECT_EQ(asked.terms.at(1).severity, "high");

    const Error error(ErrorCode::malformed, "a.abut", "is damaged");
    try {
        std::get<Failure>(decode(encode(Failure::of(error)))).rethrow();
    } catch (const Error& again) {
        EXPECT_EQ(again.code(), error.code());
        EXPECT_EQ(again.file(), error.file());
        EXPECT_STREQ(again.what(), error.what());
    }
    EXPECT_THROW(std::get<Failure>(decode(encode(Failure::of(std::bad_alloc())))).rethrow(),
                 std::runtime_error);
}

} // namespace
} // namespace abut::test
