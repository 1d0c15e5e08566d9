#include "measure.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <thread>

namespace abut::bench {

namespace {

double seconds_of(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

} // namespace

double thread_seconds() {
    return seconds_of(CLOCK_THREAD_CPUTIME_ID);
}

double process_seconds() {
    return seconds_of(CLOCK_PROCESS_CPUTIME_ID);
}

double wall_seconds() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(now).count();
}

double clock_seconds() {
    std::vector<double> seconds;
    for (int i = 0; i < 1000; ++i) {
        const double start = wall_seconds();
        seconds.push_back(wall_seconds() - start);
    }
    return median(std::move(seconds));
}

double median(std::vector<double> values) {
    if (values.empty())
        return 0;
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

Turns take_turns(std::size_t items, std::size_t batch, int rounds, const Work& ours,
                 const Work& theirs) {
    std::vector<double> our_seconds, their_seconds;
    for (int round = 0; round < rounds; ++round) {
        double our_sum = 0, their_sum = 0;
        for (std::size_t begin = 0; begin < items; begin += batch) {
            const std::size_t end = std::min(items, begin + batch);
            const double start = thread_seconds();
            ours(begin, end);
            const double between = thread_seconds();
            our_sum += between - start;
            if (!theirs)
                continue;
            theirs(begin, end);
            their_sum += thread_seconds() - between;
        }
        our_seconds.push_back(our_sum);
        their_seconds.push_back(their_sum);
    }
    return {median(our_seconds), median(their_seconds)};
}

Turns take_turns(int rounds, const std::function<void()>& ours,
                 const std::function<void()>& theirs) {
    std::vector<double> our_seconds, their_seconds;
    for (int round = 0; round < rounds; ++round) {
        const double start = wall_seconds();
        ours();
        const double between = wall_seconds();
        our_seconds.push_back(between - start);
        if (!theirs)
            continue;
        theirs();
        their_seconds.push_back(wall_seconds() - between);
    }
    return {median(our_seconds), median(their_seconds)};
}

void on_threads(int threads, std::size_t items, std::size_t batch, const Work& work) {
    std::atomic<std::size_t> next{0};
    const auto take = [&] {
        for (std::size_t begin = next.fetch_add(batch); begin < items;
             begin = next.fetch_add(batch))
            work(begin, std::min(items, begin + batch));
    };
    std::vector<std::jthread> helpers;
    for (int i = 1; i < threads; ++i)
        helpers.emplace_back(take);
    take();
}

} // namespace abut::bench
