#pragma once

#include "walk/part_cache.h"
#include "walk/part_table.h"
#include "walk/predicted_path.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace abut {

/// A thread that reads the parts that a walk will need. It reads requested entries first, then
/// entries near the predicted path, nearest first, until nothing in memory is farther than the next
/// one.
class Prefetcher {
public:
    /// In          cache, table: must outlive this object.
    Prefetcher(PartCache& cache, const PartTable& table);
    ~Prefetcher();
    Prefetcher(const Prefetcher&) = delete;
    Prefetcher& operator=(const Prefetcher&) = delete;

    /// Sets the path to read ahead along.
    /// In          moved: moved entries near the path, nearest first; are_missing: whether some of
    ///             them are not in memory.
    void follow(const PredictedPath& path, std::vector<std::uint32_t> moved, bool are_missing);
    /// Asks for an entry, which is read before all planned ones.
    void request(std::uint32_t entry);
    /// Waits until there is nothing left to do.
    void wait();

private:
    void run();
    /// Carries out the plan. Returns false if the path has changed so much that a new plan is
    /// needed.
    bool carry_out(const std::vector<std::uint32_t>& moved);
    void serve_requests();
    /// Reads an entry. Returns false if the memory is full of nearer entries, or cannot be
    /// allocated.
    bool bring(std::uint32_t entry, PartCache::Urgency urgency);
    /// Whether there is work to do. The caller holds the lock.
    [[nodiscard]] bool has_news() const;

    PartCache& cache_;
    const PartTable& table_;
    std::mutex mutex_;
    std::condition_variable news_, idle_;
    PredictedPath path_;
    std::vector<std::uint32_t> moved_, requests_;
    bool follows_ = false, are_missing_ = false, is_busy_ = false;
    std::atomic<bool> stop_{false}, requested_{false};
    std::atomic<bool> followed_{false}; ///< follow() has set a path that carry_out() has not seen
    // Used by the thread only, or with the lock held:
    PredictedPath planned_;
    float tolerance_ = 0; ///< largest difference from planned_ that needs no new plan
    std::thread thread_;
};

} // namespace abut
