#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace abut::bench {

/// Milliseconds in a second.
inline constexpr double kMilliseconds = 1e3;

/// Seconds that this thread has computed. Time used by other processes does not count.
double thread_seconds();
/// Seconds of wall time.
double wall_seconds();
/// The typical difference of two consecutive readings of the wall clock.
double clock_seconds();

/// Seconds that all threads of this process have computed.
double process_seconds();

double median(std::vector<double> values);

/// Processes the items [begin, end).
using Work = std::function<void(std::size_t begin, std::size_t end)>;

/// Median seconds of a pass over all items.
struct Turns {
    double ours = 0, theirs = 0;
};

/// Runs both on all items on this thread, in alternating batches, so that changes of the machine's
/// load or clock affect both alike. `theirs` may be empty. Measures thread time.
Turns take_turns(std::size_t items, std::size_t batch, int rounds, const Work& ours,
                 const Work& theirs);

/// Runs both as a whole, in turn. Measures wall time.
Turns take_turns(int rounds, const std::function<void()>& ours,
                 const std::function<void()>& theirs);

/// Processes all items on some threads, batch by batch.
void on_threads(int threads, std::size_t items, std::size_t batch, const Work& work);

} // namespace abut::bench
