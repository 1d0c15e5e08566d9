#pragma once

#include "geometry/leaf/triangle_leaf.h"
#include "rigid/motion/trajectory.h"
#include "tree/obb_tree.h"

#include <cstdint>
#include <span>

namespace abut {

/// A ball that is fixed in a body, at its place in the world at some time.
struct MovingBall {
    Vec3 centre;
    double radius = 0;
};

/// A ball around the contents of a child box of a node.
///
/// In          name: of the child; not the root. scale: the length of the tree's unit in the world.
MovingBall ball_of_child(const Tree& tree, std::uint32_t name, const Transform& world_from_tree,
                         double scale);

/// The distance of the ball from triangles of another body, and how long they stay apart.
struct BallGap {
    double distance = 0; ///< less the margins; negative: they may meet
    double free_time = 0;
};

/// In          both at their places at `time`, in [0, 1]. margin: bounds what rounding can change
///             in any distance or path length. radius: sets that are at most so far apart meet.
/// Accuracy    in double precision, however large the triangles are. In the frame of their body
///             they stand still, so that only the ball's relative speed matters.
BallGap gap_of_ball(const MovingBall& ball, const Trajectory& of_ball,
                    std::span<const Triangle> triangles, const Trajectory& of_triangles,
                    double time, double margin, double radius = 0);

} // namespace abut
