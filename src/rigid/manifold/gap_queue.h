#pragma once

#include "rigid/manifold/point_extremes.h"
#include "rigid/manifold/region_frame.h"

#include <utility>
#include <vector>

namespace abut {

/// Pairs of triangles that are only near, by how far they reach in a direction: those that reach
/// farthest come first, and most are never looked at.
class GapQueue {
public:
    void clear();
    /// In          triangle: of a.
    void add(const TriangleMeeting& m, const Triangle& triangle, const RegionFrame& frame);
    /// Sorts the pairs that reach at least so far in a direction.
    void sort(std::size_t direction, double least);
    /// The sorted pair that reaches farthest and has not been taken; nullptr if none reaches at least so
    /// far.
    const TriangleMeeting* take(double least);

private:
    struct Pair {
        const TriangleMeeting* meeting = nullptr;
        std::uint32_t reaches = 0; ///< in reaches_
    };
    std::vector<Pair> pairs_;
    std::vector<Reaches>
        reaches_; ///< of a triangle, for the pairs that were added one after another
    std::uint32_t last_face_ = 0;
    std::vector<std::pair<double, std::uint32_t>> heap_; ///< reach, and place in pairs_
};

} // namespace abut
