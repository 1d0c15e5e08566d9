#include "massive/piece_worker.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <tbb/global_control.h>
#include <utility>

namespace abut {

void work(PieceTester& tester, WorkSource& source) {
    // On one thread, that thread does all.
    const auto policy =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism) > 1
            ? std::launch::async
            : std::launch::deferred;
    using Clock = std::chrono::steady_clock;
    Clock::time_point given; // the last piece
    const auto load = [&]() -> std::optional<PieceTester::Loaded> {
        auto piece = source.next();
        given = Clock::now();
        if (piece)
            return tester.load(std::move(*piece));
        return std::nullopt;
    };
    double waiting = 0;
    for (auto loaded = load(); loaded;) {
        std::future<std::optional<PieceTester::Loaded>> next = std::async(policy, load);
        PieceResult result;
        try {
            result = tester.test(*loaded, [&] { source.on_pair(); });
        } catch (...) {
            source.give_up();
            throw;
        }
        const auto tested = Clock::now();
        loaded = next.get();
        waiting += std::max(0.0, std::chrono::duration<double>(given - tested).count());
        result.worker = tester.figures();
        result.worker.waiting_seconds = waiting;
        source.done(std::move(result));
    }
}

} // namespace abut
