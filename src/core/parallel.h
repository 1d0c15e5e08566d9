#pragma once

#include <cstddef>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace abut {

/// Calls body(i) for every i in [0, count), in parallel, in chunks of at least `grain`.
///
/// The order of calls is not fixed: write results to slot i. Exceptions leave through the caller;
/// of several, one.
template <typename Body>
void parallel_for(std::size_t count, std::size_t grain, const Body& body) {
    if (count <= grain) {
        for (std::size_t i = 0; i < count; ++i)
            body(i);
        return;
    }
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i != range.end(); ++i)
                              body(i);
                      });
}

} // namespace abut
