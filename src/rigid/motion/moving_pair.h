#pragma once

#include "math/transform.h"
#include "rigid/motion/trajectory.h"
#include "tree/obb_tree.h"
#include "tree/pair_frame.h"

namespace abut {

/// Two bodies in motion: their trees, and how each frame moves.
struct MovingPair {
    struct Body {
        Trajectory trajectory;
        const Tree& tree;
        double scale = 1;              ///< the model's units in one of the tree's
        Transform model_from_tree;     ///< with the scale
        Vec3 centre, angular_velocity; ///< in the axes of the tree, where both stand still
        double reach = 0;              ///< of the tree's points from its origin
    };
    Body a, b;
    double speed = 0;  ///< no two points approach each other faster
    double bend = 0;   ///< no two points' velocities change faster
    double margin = 0; ///< what rounding can have changed of any distance, many times over

    /// Errors      Error{bad_argument}.
    MovingPair(const Tree& tree_a, const Transform& model_from_tree_a, const Motion& motion_a,
               const Tree& tree_b, const Transform& model_from_tree_b, const Motion& motion_b);

    /// From `time` on, balls around the models do not meet for at least this long; infinite: not
    /// for as long as `horizon`.
    [[nodiscard]] double free_time_of_balls(double time, double horizon) const;
};

/// The bodies' motion at one time as a tree's frame sees it that stands still from then on: in its
/// axes and units, per unit of time.
struct FrameMotion {
    Vec3 centre_own, centre_other; ///< on the axes of rotation
    Vec3 velocity;                 ///< of the other's centre minus that of the own
    Vec3 spin_own, spin_other;     ///< angular velocities
    double rate_own = 0, rate_other = 0;
    double rate_between = 0;   ///< of the difference of the spins
    double centres = 0;        ///< speed of the centres relative to each other
    double own_from_other = 1; ///< units of the own tree in one of the other's
    double margin = 0;         ///< as the pair's
};

/// Both bodies at one time.
class Moment {
public:
    Moment() = default;
    Moment(const MovingPair& pair, double time);

    double time = -1;
    Transform world_from_a, world_from_b; ///< of the models
    PairFrame frame;                      ///< of the trees
    FrameMotion in_a, in_b;
};

} // namespace abut
