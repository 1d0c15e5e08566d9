#pragma once

#include "geometry/leaf/triangle_leaf.h"
#include "rigid/motion/trajectory.h"
#include "tree/obb_tree.h"

#include <cstdint>
#include <span>

namespace abut {

/// A ball that is fixed in a body, where it is at some time in the world.
struct MovingBall {
    Vec3 centre;
    double radius = 0;
};

/// A ball that holds what is in a child box of a node.
///
/// In          name: of the child; not the root. scale: the world's units in one of the tree's.
MovingBall ball_of_child(const Tree& tree, std::uint32_t name, const Transform& world_from_tree,
                         double scale);

/// How far the ball is from triangles of another body, and for how long they stay apart.
struct BallGap {
    double distance = 0; ///< less the margins; negative: they may meet
    double free_time = 0;
};

/// In          where both are at `time`, in [0, 1]; margin: what rounding can have changed of any
///             distance, and of any way.
/// Accuracy    in double precision, however large the triangles are. Seen from their body they
///             stand still, so that only the ball's speed next to them matters.
BallGap gap_of_ball(const MovingBall& ball, const Trajectory& of_ball,
                    std::span<const Triangle> triangles, const Trajectory& of_triangles,
                    double time, double margin);

} // namespace abut
