#include "walk/path_clearance.h"

#include <algorithm>
#include <queue>

namespace abut {

namespace {

/// A part of one motion, with lower bounds of the distances at its ends.
struct TimeStretch {
    std::size_t motion = 0;
    double begin = 0, end = 1;
    double gap_begin = 0, gap_end = 0;
    double least = 0; ///< lower bound of all distances within

    friend bool operator<(const TimeStretch& a, const TimeStretch& b) { return a.least > b.least; }
};

class ClearanceSearch {
public:
    ClearanceSearch(Walk& walk, const Probe& probe, const std::vector<Motion>& motions,
                    const std::vector<double>& speeds, const std::vector<WalkPart>& ignored,
                    const PathOptions& options)
        : walk_(walk), probe_(probe), motions_(motions), speeds_(speeds), ignored_(ignored),
          options_(options), best_(options.largest_clearance) {}

    PathClearance run() {
        double last = measure(0, 0, best_);
        for (std::size_t i = 0; i < motions_.size(); ++i) {
            const double next = measure(i, 1, options_.largest_clearance);
            push({i, 0, 1, last, next});
            last = next;
        }
        while (!queue_.empty() && queue_.top().least < best_ - options_.clearance_error &&
               queries_ < options_.max_queries) {
            const TimeStretch top = queue_.top();
            queue_.pop();
            split(top);
        }
        result_.at_least = queue_.empty() ? best_ : std::min(best_, queue_.top().least);
        result_.at_least = std::max(0.0, result_.at_least);
        return result_;
    }

private:
    void push(TimeStretch s) {
        const double changed = speeds_[s.motion] * (s.end - s.begin);
        s.least = std::min({s.gap_begin, s.gap_end, 0.5 * (s.gap_begin + s.gap_end - changed)});
        queue_.push(s);
    }

    void split(const TimeStretch& s) {
        // The cones of both ends meet here.
        const double speed = speeds_[s.motion];
        const double lean = speed > 0 ? 0.5 * (s.gap_begin - s.gap_end) / speed : 0;
        const double width = s.end - s.begin;
        const double middle =
            std::clamp(0.5 * (s.begin + s.end) + lean, s.begin + 0.1 * width, s.end - 0.1 * width);
        // Farther parts than this would not be looked at in the next step either.
        const double bound = std::min(options_.largest_clearance, best_ + speed * width);
        const double gap = measure(s.motion, middle, bound);
        push({s.motion, s.begin, middle, s.gap_begin, gap});
        push({s.motion, middle, s.end, gap, s.gap_end});
    }

    /// A lower bound of the distance at a time: the distance, if it is at most `bound`.
    double measure(std::size_t motion, double time, double bound) {
        ++queries_;
        WalkQuery query;
        query.except = options_.except;
        double gap = bound;
        for (const WalkGap& near :
             walk_.within(probe_, at(motions_[motion], time), bound, query).parts) {
            if (std::binary_search(ignored_.begin(), ignored_.end(), near.part))
                continue;
            const double distance = std::max(0.0, near.distance);
            gap = std::min(gap, distance);
            if (distance < best_ || (distance == best_ && !result_.found)) {
                best_ = distance;
                result_ = {true,
                           distance,
                           0,
                           double(motion) + time,
                           near.part,
                           near.point_part,
                           near.point_probe};
            }
        }
        return gap;
    }

    Walk& walk_;
    const Probe& probe_;
    const std::vector<Motion>& motions_;
    const std::vector<double>& speeds_;
    const std::vector<WalkPart>& ignored_;
    const PathOptions& options_;
    double best_;
    std::uint64_t queries_ = 0;
    std::priority_queue<TimeStretch> queue_;
    PathClearance result_;
};

} // namespace

PathClearance least_clearance(Walk& walk, const Probe& probe, const std::vector<Motion>& motions,
                              const std::vector<double>& speeds,
                              const std::vector<WalkPart>& ignored, const PathOptions& options) {
    return ClearanceSearch(walk, probe, motions, speeds, ignored, options).run();
}

} // namespace abut
