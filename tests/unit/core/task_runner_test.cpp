// A thread pool of the caller's in place of Abut's own threads.

#include <abut/error.h>
#include <abut/progress.h>
#include <abut/world.h>

#include "core/parallel.h"
#include "tests/support/random.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <gtest/gtest.h>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace abut {
namespace {

/// A pool as an engine has it: a queue of tasks, and threads that take them up.
class QueuePool {
public:
    explicit QueuePool(int count) {
        for (int i = 0; i < count; ++i)
            threads_.emplace_back([this] { serve(); });
    }
    ~QueuePool() {
        {
            const std::scoped_lock lock(mutex_);
            ends_ = true;
        }
        changed_.notify_all();
        for (std::thread& thread : threads_)
            thread.join();
    }
    QueuePool(const QueuePool&) = delete;
    QueuePool& operator=(const QueuePool&) = delete;

    void run(std::size_t count, const std::function<void(std::size_t)>& task) {
        std::size_t left = count;
        std::unique_lock lock(mutex_);
        for (std::size_t i = 0; i < count; ++i)
            waiting_.emplace_back([&, i] {
                task(i);
                const std::scoped_lock ended(mutex_);
                --left;
                changed_.notify_all();
            });
        tasks_ += count;
        changed_.notify_all();
        changed_.wait(lock, [&] { return left == 0; });
    }
    [[nodiscard]] std::set<std::thread::id> ids() const {
        std::set<std::thread::id> ids;
        for (const std::thread& thread : threads_)
            ids.insert(thread.get_id());
        return ids;
    }
    [[nodiscard]] std::size_t tasks() {
        const std::scoped_lock lock(mutex_);
        return tasks_;
    }

private:
    void serve() {
        std::unique_lock lock(mutex_);
        for (;;) {
            changed_.wait(lock, [&] { return ends_ || !waiting_.empty(); });
            if (waiting_.empty())
                return;
            const std::function<void()> next = std::move(waiting_.front());
            waiting_.pop_front();
            lock.unlock();
            next();
            lock.lock();
        }
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> waiting_;
    std::vector<std::thread> threads_;
    std::size_t tasks_ = 0;
    bool ends_ = false;
};

/// Hands work to a pool until the end of the scope.
struct Handed {
    QueuePool pool;
    explicit Handed(int threads) : pool(threads) {
        set_task_runner([this](std::size_t count, const auto& task) { pool.run(count, task); },
                        threads);
    }
    ~Handed() { set_task_runner({}, 0); }
    Handed(const Handed&) = delete;
    Handed& operator=(const Handed&) = delete;
};

TEST(TaskRunner, EachIndexIsVisitedOnceOnThePoolsThreads) {
    Handed handed(3);
    const auto ids = handed.pool.ids();
    for (const std::size_t count : {2UL, 17UL, 1000UL, 100003UL})
        for (const std::size_t grain : {1UL, 16UL, 5000UL}) {
            std::vector<std::atomic<int>> visits(count);
            std::atomic<int> elsewhere = 0, nested = 0;
            const bool is_handed = count > grain;
            parallel_for(count, grain, [&](std::size_t i) {
                ++visits[i];
                if (is_handed && !ids.contains(std::this_thread::get_id()))
                    ++elsewhere;
                if (i % 500 == 0) // work inside of a task stays on its thread
                    parallel_for(64, 1, [&, mine = std::this_thread::get_id()](std::size_t) {
                        nested += is_handed && std::this_thread::get_id() != mine ? 1 : 0;
                    });
            });
            EXPECT_EQ(elsewhere, 0);
            EXPECT_EQ(nested, 0);
            EXPECT_TRUE(std::all_of(visits.begin(), visits.end(),
                                    [](const auto& each) { return each == 1; }));
        }
    isolated([&] {
        parallel_for(100, 1, [mine = std::this_thread::get_id()](std::size_t) {
            EXPECT_EQ(std::this_thread::get_id(), mine); // its locks are held
        });
    });
}

TEST(TaskRunner, Sorts) {
    test::Random random(811);
    for (const int threads : {1, 2, 3, 5}) {
        const Handed handed(threads);
        for (const int count : {0, 1, 5000, 20011}) {
            std::vector<int> values(static_cast<std::size_t>(count));
            for (int& value : values)
                value = random.integer(0, 1000);
            std::vector<int> expected = values;
            std::sort(expected.begin(), expected.end());
            parallel_sort(values.begin(), values.end());
            EXPECT_EQ(values, expected) << threads << " threads, " << count;
        }
    }
}

/// Boxes and balls that overlap here and there.
World crowd() {
    test::Random random(812);
    World world;
    for (int i = 0; i < 3000; ++i) {
        const Pose pose{random.in_cube(12), {1, 0, 0, 0}};
        if (i % 2 == 0)
            world.add(Box3{{-.4, -.4, -.4}, {.4, .4, .4}}, pose);
        else
            world.add(Sphere{{}, .5}, pose);
    }
    return world;
}

void expect_equal(const std::vector<ContactManifold>& found,
                  const std::vector<ContactManifold>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].a, expected[i].a);
        EXPECT_EQ(found[i].b, expected[i].b);
        EXPECT_EQ(found[i].normal, expected[i].normal);
        EXPECT_EQ(found[i].count, expected[i].count);
    }
}

TEST(TaskRunner, AWorldHandsItsWorkIn) {
    const auto expected = crowd().contact_manifolds(0.01);
    ASSERT_GT(expected.size(), 1000U);
    Handed handed(2);
    expect_equal(crowd().contact_manifolds(0.01), expected);
    EXPECT_GT(handed.pool.tasks(), 0U);
}

TEST(TaskRunner, TasksMayRunInAnyOrderOnTheThreadThatAsks) {
    const auto expected = crowd().contact_manifolds(0.01);
    std::size_t tasks = 0;
    set_task_runner(
        [&](std::size_t count, const auto& task) {
            for (std::size_t i = count; i-- > 0; ++tasks)
                task(i);
        },
        4);
    const auto found = crowd().contact_manifolds(0.01);
    set_task_runner({}, 0);
    expect_equal(found, expected);
    EXPECT_GT(tasks, 0U);
}

TEST(TaskRunner, APoolThatTakesNoTasksLeavesTheWorkToTheThreadThatAsks) {
    const auto expected = crowd().contact_manifolds(0.01);
    int calls = 0;
    set_task_runner(
        [&](std::size_t, const auto&) {
            if (++calls % 2 == 0)
                throw std::runtime_error("the queue is full");
        },
        4);
    World world = crowd();
    const auto found = world.contact_manifolds(0.01);
    set_task_runner({}, 0);
    expect_equal(found, expected);
    EXPECT_GT(calls, 1);
}

TEST(TaskRunner, FaultsAndStopsReachTheCaller) {
    const Handed handed(2);
    EXPECT_THROW(parallel_for(100, 1,
                              [](std::size_t i) {
                                  if (i == 37)
                                      throw std::runtime_error("fault");
                              }),
                 std::runtime_error);
    std::atomic<bool> stop = false;
    const StopScope scope(&stop);
    std::atomic<int> visits = 0;
    try {
        parallel_for(100000, 1, [&](std::size_t) {
            if (++visits == 50)
                stop = true;
        });
        ADD_FAILURE() << "not interrupted";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::interrupted);
    }
    EXPECT_LT(visits, 100000);
}

TEST(TaskRunner, SeveralThreadsAskAtOnce) {
    Handed handed(2);
    std::vector<std::thread> askers;
    std::atomic<std::size_t> sum = 0;
    askers.reserve(4);
    for (int i = 0; i < 4; ++i)
        askers.emplace_back([&] {
            for (int round = 0; round < 50; ++round)
                parallel_for(1000, 1, [&](std::size_t k) { sum += k; });
        });
    for (std::thread& asker : askers)
        asker.join();
    EXPECT_EQ(sum, 4U * 50U * (999U * 1000U / 2));
}

TEST(TaskRunner, NeedsAThread) {
    const auto nothing = [](std::size_t, const std::function<void(std::size_t)>&) {};
    EXPECT_THROW(set_task_runner(nothing, 0), Error);
    EXPECT_THROW(set_task_runner(nothing, -1), Error);
    set_task_runner({}, 0);
}

} // namespace
} // namespace abut
