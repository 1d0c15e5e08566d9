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
    std::optional<PieceTester::Loaded> loaded;
    if (auto first = source.next())
        loaded = tester.load(std::move(*first));
    while (loaded) {
        std::future<PieceTester::Loaded> next; // waits when it goes out of scope
        if (auto piece = source.next())
            next = std::async(policy, [&tester, piece = std::move(*piece)]() mutable {
                return tester.load(std::move(piece));
            });
        PieceResult result = tester.test(*loaded, [&] { source.on_pair(); });
        loaded.reset();
        if (next.valid())
            loaded = next.get();
        result.figures = tester.figures();
        source.done(std::move(result));
    }
}

} // namespace abut
