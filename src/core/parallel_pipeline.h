#pragma once

#include <cstddef>
#include <tbb/parallel_pipeline.h>

#ifdef __SANITIZE_THREAD__
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#endif

namespace abut {

/// Takes items one at a time, processes them in parallel, and passes them on one at a time in the
/// order in which they were taken. At most `tokens` items are in flight. Taking and giving may
/// overlap.
///
/// In          take() returns a pointer, null at the end; work(item), give(item).
/// Errors      if the three functions throw, one of the exceptions reaches the caller.
template <typename Pointer, typename Take, typename Work, typename Give>
void parallel_pipeline(std::size_t tokens, const Take& take, const Work& work, const Give& give) {
#ifdef __SANITIZE_THREAD__
    // Plain threads, which the thread sanitizer can see into; see parallel.h.
    std::mutex taking, giving;
    std::condition_variable turn;
    std::size_t taken = 0, given = 0;
    bool ended = false;
    std::exception_ptr failure;
    const auto run = [&] {
        try {
            for (;;) {
                std::unique_lock take_lock(taking);
                const Pointer item = ended ? Pointer{} : take();
                ended = ended || !item;
                if (ended)
                    return;
                const std::size_t number = taken++;
                take_lock.unlock();
                work(item);
                std::unique_lock give_lock(giving);
                turn.wait(give_lock, [&] { return given == number || failure; });
                if (failure)
                    return;
                give(item);
                ++given;
                turn.notify_all();
            }
        } catch (...) {
            const std::scoped_lock lock(giving);
            failure = std::current_exception();
            turn.notify_all();
        }
    };
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < tokens; ++i)
        threads.emplace_back(run);
    for (std::thread& thread : threads)
        thread.join();
    if (failure)
        std::rethrow_exception(failure);
#else
    const auto serial = tbb::filter_mode::serial_in_order;
    tbb::parallel_pipeline(
        tokens,
        tbb::make_filter<void, Pointer>(serial,
                                        [&](tbb::flow_control& control) {
                                            Pointer item = take();
                                            if (!item)
                                                control.stop();
                                            return item;
                                        }) &
            tbb::make_filter<Pointer, Pointer>(tbb::filter_mode::parallel,
                                               [&](const Pointer& item) {
                                                   work(item);
                                                   return item;
                                               }) &
            tbb::make_filter<Pointer, void>(serial, [&](const Pointer& item) { give(item); }));
#endif
}

} // namespace abut
