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

/// A thread that brings into memory what a walk will need: first what was asked for, then what is near to
/// the predicted path, nearest first, until memory holds nothing that is farther.
class Prefetcher {
public:
    /// In          cache, table: must outlive it.
    Prefetcher(PartCache& cache, const PartTable& table);
    ~Prefetcher();
    Prefetcher(const Prefetcher&) = delete;
    Prefetcher& operator=(const Prefetcher&) = delete;

    /// In          moved: some entries that are not where the table has them, nearest first; are_missing:
    ///             some of these are not in memory.
    void follow(const PredictedPath& path, std::vector<std::uint32_t> moved, bool are_missing);
    /// Before everything else.
    void request(std::uint32_t entry);
    /// Waits until there is nothing left to do.
    void wait();

private:
    void run();
    /// False if there is something newer to do.
    bool carry_out(const std::vector<std::uint32_t>& moved);
    void serve_requests();
    /// False if memory holds nothing that is farther.
    bool bring(std::uint32_t entry, PartCache::Urgency urgency);
    /// In: the lock is held.
    [[nodiscard]] bool has_news() const;

    PartCache& cache_;
    const PartTable& table_;
    std::mutex mutex_;
    std::condition_variable news_, idle_;
    PredictedPath path_;
    std::vector<std::uint32_t> moved_, requests_;
    bool follows_ = false, are_missing_ = false, is_busy_ = false;
    std::atomic<bool> stop_{false}, requested_{false};
    std::atomic<bool> followed_{false}; ///< the path is another than a moment ago
    // Of the thread alone, or with the lock:
    PredictedPath planned_;
    float tolerance_ = 0; ///< the path may differ by so much from the one that was planned for
    std::thread thread_;
};

} // namespace abut
