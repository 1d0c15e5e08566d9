#include <abut/batch.h>
#include <abut/error.h>

#include "core/parallel.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>
#include <string>

namespace abut {

namespace {

/// The error of the smallest index, whatever the order in which they come.
class FirstError {
public:
    /// Whether this index need not be looked at any more.
    [[nodiscard]] bool is_behind(std::size_t index) const {
        return index > first_.load(std::memory_order_relaxed);
    }
    void add(std::size_t index, const Error& error) {
        const std::scoped_lock lock(mutex_);
        if (index < first_)
            first_ = index, error_ = error;
    }
    void rethrow() const {
        if (error_)
            throw Error(error_->code(),
                        "placement " + std::to_string(first_) + ": " + error_->what());
    }

private:
    std::atomic<std::size_t> first_{std::numeric_limits<std::size_t>::max()};
    std::mutex mutex_;
    std::optional<Error> error_;
};

/// query(i) for each of `count`; a query is far more work than handing it out.
template <typename Result, typename Query>
std::vector<Result> in_parallel(std::size_t count, const Query& query) {
    std::vector<Result> results(count);
    FirstError failure;
    parallel_for(count, 1, [&](std::size_t i) {
        if (failure.is_behind(i))
            return;
        try {
            results[i] = query(i);
        } catch (const Error& error) {
            failure.add(i, error);
        }
    });
    failure.rethrow();
    return results;
}

/// A workspace is one thread's.
template <typename Options>
Options without_workspace(Options options) {
    options.workspace = nullptr;
    return options;
}

} // namespace

std::vector<Contacts> collide(const Model& a, const Model& b, std::span<const Placement> placements,
                              const CollideOptions& options) {
    const CollideOptions each = without_workspace(options);
    return in_parallel<Contacts>(placements.size(), [&](std::size_t i) {
        return collide(a, placements[i].world_from_a, b, placements[i].world_from_b, each);
    });
}

std::vector<Gap> distance(const Model& a, const Model& b, std::span<const Placement> placements,
                          const DistanceOptions& options) {
    const DistanceOptions each = without_workspace(options);
    return in_parallel<Gap>(placements.size(), [&](std::size_t i) {
        return distance(a, placements[i].world_from_a, b, placements[i].world_from_b, each);
    });
}

std::vector<bool> within(const Model& a, const Model& b, std::span<const Placement> placements,
                         double tolerance) {
    // Bits of a vector<bool> share bytes: threads write to bytes of their own first.
    const auto answers = in_parallel<std::uint8_t>(placements.size(), [&](std::size_t i) {
        const auto& [world_from_a, world_from_b] = placements[i];
        return static_cast<std::uint8_t>(within(a, world_from_a, b, world_from_b, tolerance));
    });
    return {answers.begin(), answers.end()};
}

std::vector<Impact> time_of_impact(const Model& a, const Model& b,
                                   std::span<const MotionPair> motions,
                                   const ImpactOptions& options) {
    return in_parallel<Impact>(motions.size(), [&](std::size_t i) {
        return time_of_impact(a, motions[i].a, b, motions[i].b, options);
    });
}

} // namespace abut
