#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace abut::bench {

/// Seconds that this thread has computed: what other processes take from it does not count.
double thread_seconds();
/// Seconds on the wall.
double wall_seconds();
/// What two readings of the wall's clock are apart when nothing lies between them.
double clock_seconds();

/// Seconds that all threads of this process have computed.
double process_seconds();

double median(std::vector<double> values);

/// Does items [begin, end).
using Work = std::function<void(std::size_t begin, std::size_t end)>;

/// Median seconds of a pass over all items.
struct Turns {
    double ours = 0, theirs = 0;
};

/// Lets both do all items on this thread, block by block in turn, so that a change of the machine's
/// load or clock meets both alike. `theirs` may be empty. Measures thread time.
Turns take_turns(std::size_t items, std::size_t block, int rounds, const Work& ours,
                 const Work& theirs);

/// Runs both whole, in turn. Measures wall time.
Turns take_turns(int rounds, const std::function<void()>& ours,
                 const std::function<void()>& theirs);

/// All items on some threads, block by block.
void on_threads(int threads, std::size_t items, std::size_t block, const Work& work);

} // namespace abut::bench
