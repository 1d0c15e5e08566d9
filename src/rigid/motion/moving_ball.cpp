#include "rigid/motion/moving_ball.h"

#include "geometry/point_triangle_distance.h"
#include "rigid/motion/motion_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

MovingBall ball_of_child(const Tree& tree, std::uint32_t name, const Transform& world_from_tree,
                         double scale) {
    const Node& node = tree.nodes[node_of(name)];
    const std::size_t i = lane_of(name);
    const Vec3 lower{node.lower[0][i], node.lower[1][i], node.lower[2][i]},
        upper{node.upper[0][i], node.upper[1][i], node.upper[2][i]};
    // The frame's axes are perpendicular to a few parts in 2^24.
    const double off = 0x1p-20 * (length(lower) + length(upper));
    return {apply(world_from_tree, node.frame.point_to_tree(0.5 * lower + 0.5 * upper)),
            (0.5 * length(upper - lower) + off) * scale * (1 + 0x1p-20)};
}

// Relative to the other body, the ball's centre has the velocity u = v + w x r - v' - w' x (c -
// c'), with r its arm, and the acceleration u' = w x (w x r) - w' x (v - v' + w x r).
BallGap gap_of_ball(const MovingBall& ball, const Trajectory& of_ball,
                    std::span<const Triangle> triangles, const Trajectory& of_triangles,
                    double time, double margin, double radius) {
    double distance_sq = std::numeric_limits<double>::infinity();
    for (const Triangle& triangle : triangles)
        distance_sq =
            std::min(distance_sq, point_triangle_distance(ball.centre, triangle).distance_sq);
    BallGap gap;
    gap.distance = std::sqrt(distance_sq) - ball.radius - radius - 2 * margin;
    const double rate = of_ball.speed_of_rotation(),
                 turning = rate * of_ball.axis_distance(ball.centre, time);
    constexpr double kMore = 1 + 0x1p-40;
    const double speed = kMore * length(of_ball.velocity_at(ball.centre, time) -
                                        of_triangles.velocity_at(ball.centre, time));
    const double bend =
        kMore *
        (rate * turning + of_triangles.speed_of_rotation() *
                              (length(of_ball.velocity() - of_triangles.velocity()) + turning));
    // The motion ends at time 1, so the speed never exceeds their sum.
    gap.free_time = free_time(Approach{gap.distance, speed, bend, speed + bend});
    return gap;
}

} // namespace abut
