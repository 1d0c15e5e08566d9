#pragma once

#include <abut/elementary_impact.h>

#include <cstddef>

namespace abut {

/// A batch of eight elementary pairs of one kind, one per lane: the input of one pass of the
/// filter. Lanes that are not set hold points at the origin.
struct alignas(64) ElementaryBatch {
    static constexpr std::size_t kLanes = 8;
    double v[4][2][3][kLanes] = {}; ///< [vertex][0: start, 1: end][axis][lane]

    void set(std::size_t lane, const ElementaryPair& pair) {
        for (std::size_t i = 0; i < 4; ++i)
            set_vertex(lane, i, pair.start[i], pair.end[i]);
    }
    void set_vertex(std::size_t lane, std::size_t i, const Vec3& start, const Vec3& end) {
        set(v[i][0], lane, start);
        set(v[i][1], lane, end);
    }

private:
    static void set(double (&rows)[3][kLanes], std::size_t lane, const Vec3& p) {
        rows[0][lane] = p.x;
        rows[1][lane] = p.y;
        rows[2][lane] = p.z;
    }
};

} // namespace abut
