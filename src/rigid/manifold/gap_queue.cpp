#include "rigid/manifold/gap_queue.h"

#include <algorithm>

namespace abut {

namespace {

/// How far a triangle reaches in each direction, as take_everywhere measures it.
Reaches reaches_of(const Triangle& t, const RegionFrame& frame) {
    Reaches reaches;
    reaches.fill(-kUnreached);
    for (const Vec3& p : t) {
        const Around r = around(frame.right(p), frame.up(p));
        for (std::size_t k = 0; k < kAround / 2; ++k) {
            reaches[k] = std::max(reaches[k], r[k]);
            reaches[k + kAround / 2] = std::max(reaches[k + kAround / 2], -r[k]);
        }
    }
    return reaches;
}

} // namespace

void GapQueue::clear() {
    pairs_.clear();
    reaches_.clear();
}

void GapQueue::add(const TriangleMeeting& m, const Triangle& triangle, const RegionFrame& frame) {
    if (reaches_.empty() || m.face_a != last_face_)
        reaches_.push_back(reaches_of(triangle, frame));
    last_face_ = m.face_a;
    pairs_.push_back({&m, static_cast<std::uint32_t>(reaches_.size() - 1)});
}

void GapQueue::sort(std::size_t direction, double least) {
    heap_.clear();
    for (std::uint32_t i = 0; i < pairs_.size(); ++i)
        if (const double reach = reaches_[pairs_[i].reaches][direction]; reach >= least)
            heap_.emplace_back(reach, i);
    std::make_heap(heap_.begin(), heap_.end());
}

const TriangleMeeting* GapQueue::take(double least) {
    if (heap_.empty() || heap_.front().first < least)
        return nullptr;
    std::pop_heap(heap_.begin(), heap_.end());
    const TriangleMeeting* const taken = pairs_[heap_.back().second].meeting;
    heap_.pop_back();
    return taken;
}

} // namespace abut
