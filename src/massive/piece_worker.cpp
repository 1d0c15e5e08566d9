#include "massive/piece_worker.h"

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
    const auto load = [&]() -> std::optional<PieceTester::Loaded> {
        if (auto piece = source.next())
            return tester.load(std::move(*piece));
        return std::nullopt;
    };
    for (auto loaded = load(); loaded;) {
        std::future<std::optional<PieceTester::Loaded>> next = std::async(policy, load);
        PieceResult result;
        try {
            result = tester.test(*loaded, [&] { source.on_pair(); });
        } catch (...) {
            source.give_up();
            throw;
        }
        loaded = next.get();
        result.worker = tester.figures();
        source.done(std::move(result));
    }
}

} // namespace abut
