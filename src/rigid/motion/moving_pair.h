#pragma once

#include "math/transform.h"
#include "rigid/motion/trajectory.h"
#include "tree/obb_tree.h"
#include "tree/pair_frame.h"

namespace abut {

/// The factor by which a transform scales all lengths, if it only rotates, mirrors, scales and
/// moves, to single precision; else 0. Only such a transform may be the start of a moving pair.
double uniform_scale(const Transform& t);

/// Two bodies in motion, with their trees. They meet where they are at most `radius` apart.
struct MovingPair {
    struct Body {
        Trajectory trajectory;
        const Tree& tree;
        double scale = 1;              ///< the length of the tree's unit in the world
        Transform model_from_tree;     ///< with the scale
        Vec3 centre, angular_velocity; ///< in the axes of the tree, where both are constant
        double sign = 1;               ///< -1: the world mirrors the tree
        double reach = 0;              ///< largest distance of the tree's points from its origin
    };
    Body a, b;
    double speed = 0;  ///< bound on the speed at which two points approach each other
    double bend = 0;   ///< bound on the change of two points' relative velocity
    double margin = 0; ///< far above what rounding can change in any distance
    double radius = 0;

    /// In          the starts have a uniform scale.
    /// Errors      Error{bad_argument}.
    MovingPair(const Tree& tree_a, const Transform& model_from_tree_a, const Trajectory& of_a,
               const Tree& tree_b, const Transform& model_from_tree_b, const Trajectory& of_b,
               double radius);
    MovingPair(const Tree& tree_a, const Transform& model_from_tree_a, const Motion& motion_a,
               const Tree& tree_b, const Transform& model_from_tree_b, const Motion& motion_b)
        : MovingPair(tree_a, model_from_tree_a, Trajectory(motion_a), tree_b, model_from_tree_b,
                     Trajectory(motion_b), 0) {}

    /// The bodies certainly do not meet at a computed distance above this.
    [[nodiscard]] double reach() const { return radius + margin; }
    /// From `time` on, balls around the models do not meet for at least this long. Infinite if they
    /// do not meet within `horizon`.
    [[nodiscard]] double free_time_of_balls(double time, double horizon) const;
};

/// Both bodies' velocities at one time, in a tree's frame frozen at that time: in its axes and
/// units, per unit of time.
struct FrameMotion {
    Vec3 centre_own, centre_other; ///< points on the axes of rotation
    Vec3 velocity;                 ///< velocity of the other's centre relative to the own
    Vec3 spin_own, spin_other;     ///< angular velocities
    double rate_own = 0, rate_other = 0;
    double rate_between = 0;   ///< size of the difference of the spins
    double centres = 0;        ///< speed of the centres relative to each other
    double own_from_other = 1; ///< length of the other tree's unit in the own tree
    double margin = 0;         ///< the pair's margin, in the own tree's units
    double radius = 0;         ///< an upper bound of the pair's radius, in the own tree's units
};

/// The poses and motions of both bodies at one time.
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
