#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <queue>

namespace abut {

/// A value of a function of time, and a proven lower bound of the exact value.
struct TimeValue {
    double time = 0;
    double value = 0, at_least = 0;
};

/// Finds the least value of a function of time whose rate is bounded, between values that are known.
///
/// Source      [Piyavskii 1972]: best-first search; the span whose bound is the lowest is halved.
class TimeSearch {
public:
    /// In          measure: the function at a time.
    ///             change: a bound of how much the function changes between two times.
    TimeSearch(std::function<TimeValue(double)> measure,
               std::function<double(double, double)> change);

    /// Adds the span between two times, whose values are known.
    void add(const TimeValue& from, const TimeValue& to);

    /// Halves spans until the best value exceeds the bound of the others by no more than the errors
    /// allowed, or `most` values have been measured.
    void run(double absolute_error, double relative_error, std::size_t most);

    [[nodiscard]] const TimeValue& best() const { return best_; }
    /// A lower bound of the function over all spans.
    [[nodiscard]] double at_least() const;

private:
    struct Span {
        TimeValue from, to;
        double at_least = 0;
        /// The lowest bound comes first, of equal ones the earliest.
        friend bool operator<(const Span& a, const Span& b) {
            return a.at_least != b.at_least ? a.at_least > b.at_least : a.from.time > b.from.time;
        }
    };

    std::function<TimeValue(double)> measure_;
    std::function<double(double, double)> change_;
    std::priority_queue<Span> spans_;
    /// The lowest bound of the spans that are too short to be halved.
    double undivided_ = std::numeric_limits<double>::infinity();
    TimeValue best_{0, std::numeric_limits<double>::infinity(),
                    std::numeric_limits<double>::infinity()};
};

} // namespace abut
