#pragma once

#include <abut/error.h>

#include "core/parallel.h"
#include "core/progress.h"

#include <atomic>
#include <cstddef>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Steps that batches of queries share.
namespace abut {

/// Keeps the error with the smallest index, whatever the order in which errors arrive.
class FirstError {
public:
    /// Returns whether a smaller index already has an error, so that this one need not be computed.
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

/// Computes query(i) for each i < count in parallel. A query should be far more work than handing
/// it out. Reports the share done as one stage.
///
/// Errors      the error of the smallest index; Error{interrupted}.
template <typename Result, typename Query>
std::vector<Result> in_parallel(const Progress& progress, std::string_view stage, std::size_t count,
                                const Query& query) {
    const StopScope stopping(progress);
    ProgressMeter meter(progress, stage, count);
    std::vector<Result> results(count);
    FirstError failure;
    parallel_for(count, 1, [&](std::size_t i) {
        if (failure.is_behind(i))
            return;
        try {
            results[i] = query(i);
        } catch (const Error& error) {
            if (error.code() == ErrorCode::interrupted)
                throw;
            failure.add(i, error);
        }
        meter.advance();
    });
    failure.rethrow();
    return results;
}

/// The options of one query of a batch: without the warm start, which belongs to one thread, and
/// without reports, which concern the whole batch.
template <typename Options>
Options of_each(Options options) {
    if constexpr (requires { options.warm_start; })
        options.warm_start = nullptr;
    options.progress = {};
    return options;
}

} // namespace abut
