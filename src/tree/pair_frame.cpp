#include "tree/pair_frame.h"

#include "math/rounding.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

double reach(const Tree& tree) {
    double r = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        r = std::max({r, std::abs(double{tree.bounds.lower[axis]}),
                      std::abs(double{tree.bounds.upper[axis]})});
    return r;
}

double largest_row_sum(const Transform& t) {
    double largest = 0;
    for (std::size_t row = 0; row < 3; ++row)
        largest =
            std::max(largest, std::abs(t.m[row]) + std::abs(t.m[row + 3]) + std::abs(t.m[row + 6]));
    return largest;
}

double translation_reach(const Transform& t) {
    return std::max({std::abs(t.m[9]), std::abs(t.m[10]), std::abs(t.m[11])});
}

/// `world_size` bounds all world coordinates involved.
TreeMap make_map(const Transform& to_from, const Transform& world_from_to, double world_size) {
    TreeMap map;
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 4; ++column)
            map.to_from[column][row] = to_from.m[3 * column + row];
        for (std::size_t column = 0; column < 3; ++column)
            map.linear[row][column] = to_float(to_from.m[3 * column + row]);
    }
    map.row_sum = round_up(largest_row_sum(to_from));
    // The margin covers the rounding of the composed transforms and of the positions in the world
    // and in the trees' frames, as if all error fell on one axis.
    const auto [least, most] = stretch_of(world_from_to);
    map.margin = round_up(64 * 0x1p-53 * world_size / least);
    // Nodes' axes have unit length only to a few parts in 2^24, and squares are summed and compared
    // in single precision.
    map.stretch_sq = round_down(least * least * (1 - 64 * 0x1p-24));
    map.most_stretch_sq = round_up(most * most * (1 + 64 * 0x1p-24));
    return map;
}

/// Upper bound of the distance of two points of the trees, on each axis of a's frame.
double reach_between(const Tree& a, const Tree& b, const Transform& a_from_b) {
    return reach(a) + translation_reach(a_from_b) + largest_row_sum(a_from_b) * reach(b);
}

} // namespace

PairFrame make_pair_frame(const Tree& a, const Transform& world_from_a, const Tree& b,
                          const Transform& world_from_b) {
    PairFrame frame;
    frame.world_from_a = world_from_a, frame.world_from_b = world_from_b;
    const Transform a_from_b = compose(inverse(world_from_a), world_from_b);
    const Transform b_from_a = compose(inverse(world_from_b), world_from_a);
    const double world_size =
        translation_reach(world_from_a) + largest_row_sum(world_from_a) * reach(a) +
        translation_reach(world_from_b) + largest_row_sum(world_from_b) * reach(b);
    frame.a_from_b = make_map(a_from_b, world_from_a, world_size);
    frame.b_from_a = make_map(b_from_a, world_from_b, world_size);
    const double reach = reach_between(a, b, a_from_b);
    frame.reach_sq = round_up(4 * reach * reach * double{frame.a_from_b.most_stretch_sq});
    const auto usable = [](const TreeMap& m) {
        // A margin or stretch that is not a number, or is too small to square, would prune wrongly
        // or prune nothing.
        return std::isfinite(m.margin) && std::isfinite(m.most_stretch_sq) &&
               std::isfinite(m.row_sum) && m.stretch_sq > 0x1p-100F;
    };
    frame.valid = usable(frame.a_from_b) && usable(frame.b_from_a);
    return frame;
}

} // namespace abut
