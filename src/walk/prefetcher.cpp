#include "walk/prefetcher.h"

#include <exception>
#include <new>
#include <tbb/task_arena.h>
#include <utility>

namespace abut {

Prefetcher::Prefetcher(PartCache& cache, const PartTable& table)
    : cache_(cache), table_(table), thread_([this] {
          // Building models in parallel would take threads away from the caller.
          tbb::task_arena alone(1);
          alone.execute([this] { run(); });
      }) {}

Prefetcher::~Prefetcher() {
    {
        const std::scoped_lock lock(mutex_);
        stop_ = true;
    }
    news_.notify_all();
    thread_.join();
}

void Prefetcher::follow(const PredictedPath& path, std::vector<std::uint32_t> moved,
                        bool are_missing) {
    {
        const std::scoped_lock lock(mutex_);
        path_ = path;
        moved_ = std::move(moved);
        are_missing_ = are_missing;
        follows_ = true;
        followed_ = true;
    }
    news_.notify_one();
}

void Prefetcher::request(std::uint32_t entry) {
    {
        const std::scoped_lock lock(mutex_);
        requests_.push_back(entry);
        requested_ = true;
    }
    news_.notify_one();
}

void Prefetcher::wait() {
    std::unique_lock lock(mutex_);
    idle_.wait(lock, [&] { return !is_busy_ && !has_news(); });
}

bool Prefetcher::has_news() const {
    return !requests_.empty() ||
           (follows_ && (are_missing_ || path_.difference(planned_) > tolerance_));
}

void Prefetcher::run() {
    std::unique_lock lock(mutex_);
    for (;;) {
        news_.wait(lock, [&] { return stop_ || has_news(); });
        if (stop_)
            return;
        const bool replan = follows_ && (are_missing_ || path_.difference(planned_) > tolerance_);
        planned_ = replan ? path_ : planned_;
        are_missing_ = false;
        is_busy_ = true;
        const std::vector<std::uint32_t> moved = moved_;
        lock.unlock();
        serve_requests();
        const bool done = !replan || carry_out(moved);
        lock.lock();
        if (!done)
            tolerance_ = -1; // a new plan is needed even if the path changes back
        is_busy_ = false;
        idle_.notify_all();
    }
}

void Prefetcher::serve_requests() {
    std::vector<std::uint32_t> requests;
    {
        const std::scoped_lock lock(mutex_);
        requests = std::exchange(requests_, {});
        requested_ = false;
    }
    for (const std::uint32_t entry : requests)
        bring(entry, PartCache::Urgency::asked_for);
}

bool Prefetcher::bring(std::uint32_t entry, PartCache::Urgency urgency) {
    try {
        return cache_.prefetch(entry, urgency);
    } catch (const std::bad_alloc&) {
        return false;
    } catch (const std::exception&) {
        return true; // a query that needs the entry will report the error
    }
}

bool Prefetcher::carry_out(const std::vector<std::uint32_t>& moved) {
    // The plan stays valid while the path changes by less than this share of the reach so far.
    constexpr float kShare = 1.0F / 16;
    cache_.begin_plan();
    for (const std::uint32_t entry : moved)
        bring(entry, PartCache::Urgency::planned);
    NearestLanes lanes(table_.tree(), planned_);
    float reach = 0;
    while (const auto lane = lanes.next()) {
        if (stop_)
            return true;
        if (requested_)
            serve_requests();
        reach = lane->key;
        if (!bring(lane->lane, PartCache::Urgency::at_its_place))
            break;
        if (!followed_.exchange(false))
            continue;
        const std::scoped_lock lock(mutex_);
        if (path_.difference(planned_) > kShare * reach)
            return false;
    }
    const std::scoped_lock lock(mutex_);
    tolerance_ = kShare * reach;
    return true;
}

} // namespace abut
