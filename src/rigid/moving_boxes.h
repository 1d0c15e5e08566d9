#pragma once

#include "math/transform.h"
#include "rigid/trajectory.h"
#include "tree/tree.h"

#include <array>

namespace abut {

/// What the time of impact knows of a tree's nodes: boxes, here in the axes of the tree's frame but
/// in the model's units. The one place that depends on how nodes store them.
struct TreeBox {
    Vec3 centre, half;
    double radius = 0; ///< half the diagonal of the box in its own axes
};

/// In          scale: the model's units in one of the tree's.
TreeBox root_box(const Tree& tree, double scale);
TreeBox child_box(const Node& node, std::size_t child, double scale);

/// Two bodies in motion: their trees, and how each frame moves.
struct MovingPair {
    struct Body {
        Trajectory trajectory;
        double scale = 1;              ///< the model's units in one of the tree's
        Transform model_from_tree;     ///< without the scale
        Vec3 centre, angular_velocity; ///< in the frame of the tree, where both stand still
        Vec3 axis;                     ///< of length 1, or zero
        double reach = 0;              ///< of the tree's points from its origin
    };
    Body a, b;
    double speed = 0;  ///< no two points approach each other faster
    double margin = 0; ///< what rounding can have changed of any distance, many times over

    /// Errors      Error{bad_argument}.
    MovingPair(const Tree& tree_a, const Transform& model_from_tree_a, const Motion& motion_a,
               const Tree& tree_b, const Transform& model_from_tree_b, const Motion& motion_b);
};

/// Both bodies at one time. Vectors are in the axes of a's tree; velocities are the world's, turned
/// into them.
class Moment {
public:
    Moment() = default;
    Moment(const MovingPair& pair, double time);

    double time = -1;
    Transform world_from_a, world_from_b; ///< of the models
    Transform a_from_b;                   ///< of the trees
    std::array<double, 9> magnitude{};    ///< |linear part|, for half extents
    Vec3 centre_a, centre_b, velocity;    ///< velocity: of b's centre minus that of a's
    Vec3 spin_a, spin_b;                  ///< angular velocities
};

/// A box at a moment.
struct MovingBox {
    Vec3 centre, velocity;     ///< axes of a
    Vec3 half_in_a, half_in_b; ///< half extents of its hull in the axes of a and of b
    double radius = 0;         ///< half its diagonal
    double centre_arm = 0;     ///< distance of its centre from the axis of rotation
};

MovingBox box_of_a(const MovingPair& pair, const Moment& moment, const TreeBox& box);
MovingBox box_of_b(const MovingPair& pair, const Moment& moment, const TreeBox& box);

/// From the moment on, the boxes' contents do not meet for at least this long; infinite: not for
/// as long as `horizon`. What is found to be more than `enough` is not improved further.
double free_time(const MovingPair& pair, const Moment& moment, const MovingBox& a,
                 const MovingBox& b, double enough, double horizon);

} // namespace abut
