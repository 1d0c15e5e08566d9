#include "rigid/motion/node_motion.h"

#include "rigid/motion/motion_bounds.h"
#include "volume/float_vector.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

namespace {

/// Relative error of sums of a few products in single precision, and of axes whose length is nearly
/// 1: both are about 2^-22.
constexpr double kNodeRounding = 0x1p-20;
constexpr double kMore = 1 + kNodeRounding;
/// Absolute error: above what products lose that underflow in single precision.
constexpr double kTooSmall = 0x1p-100;
/// Path lengths beyond which products may overflow.
constexpr double kTooLarge = 0x1p60;
constexpr double kDiagonal = 1.75; ///< more than the root of 3, for a cube's diagonal
/// Axes that turn are considered only if the error of speeds exceeds this many times the gain.
constexpr double kWorthwhile = 4;

std::array<float, 3> in_node(const Node& node, const Vec3& v) {
    return node.frame.vector_from_tree(to_float(v));
}

/// An upper bound of |n x w| for each axis n.
std::array<float, 3> across_axes(const std::array<float, 3>& w) {
    std::array<float, 3> result{};
    for (std::size_t i = 0; i < 3; ++i) {
        const float u = w[(i + 1) % 3], v = w[(i + 2) % 3];
        result[i] = to_float(kMore) * std::sqrt(u * u + v * v + std::numeric_limits<float>::min());
    }
    return result;
}

/// Bounds on how fast the points of two nodes turn and move, in the own tree's units per unit of
/// time.
struct NodeSpeeds {
    /// Angular speeds of the bodies, and of their difference.
    double rate_own = 0, rate_other = 0, rate_between = 0;
    double radius_own = 0, radius_other = 0; ///< of the nodes
    /// Largest distance of the other node's points from the own origin.
    double reach_other = 0;
    double turning_own = 0, turning_other = 0; ///< speeds about the axes of rotation
    /// Speed of the frames' origins relative to each other.
    double between = 0;
    /// Speed of the centres of rotation relative to each other.
    double of_centres = 0;
};

/// The motion of one body's node in the frame of the other body, which turns at `rate_seen`.
struct SeenMotion {
    double turning = 0; ///< speed about its own axis
    double speed = 0;   ///< relative to the other body
    /// Bounds the second derivative of its points' heights along an axis of the other body.
    [[nodiscard]] double bend(double across_between, double across_seen, double of_centres) const {
        return across_between * turning + across_seen * (of_centres + speed);
    }
};

SeenMotion seen(double turning, double reach, double rate_seen, const NodeSpeeds& x,
                double duration) {
    return {turning,
            kHorizonGrowth * (x.between + x.rate_between * reach +
                              duration * (x.rate_between * turning + rate_seen * x.of_centres))};
}

/// Chooses whether the axes stand still or turn with one of the bodies: the choice with the
/// smallest error of speeds in the middle of the span.
AxesTurn best_turn(NodeSpeeds& x, const Vec3& velocity, double duration, double part) {
    const double half = 0.5 * duration;
    const double standing = part * (x.rate_own * x.radius_own + x.rate_other * x.radius_other) +
                            half * (x.rate_own * x.turning_own + x.rate_other * x.turning_other);
    // Nodes of similar size gain little.
    if (standing < kWorthwhile * part * x.rate_between * std::min(x.radius_own, x.radius_other) ||
        duration * (x.rate_own + x.rate_other) > kHorizonTurn)
        return AxesTurn::none;
    x.between = length(velocity);
    const auto with = [&](double rate, double radius, const SeenMotion& other) {
        return part * x.rate_between * radius +
               half * other.bend(x.rate_between, rate, x.of_centres);
    };
    const double own = x.rate_own > 0
                           ? with(x.rate_own, x.radius_other,
                                  seen(x.turning_other, x.reach_other, x.rate_own, x, duration))
                           : standing;
    const double other = x.rate_other > 0
                             ? with(x.rate_other, x.radius_own,
                                    seen(x.turning_own, x.radius_own, x.rate_other, x, duration))
                             : standing;
    if (standing <= std::min(own, other))
        return AxesTurn::none;
    return own <= other ? AxesTurn::with_own : AxesTurn::with_other;
}

/// In          turning: velocities of the nodes' origins about the bodies' centres.
NodeSpeeds speeds_of(const FrameMotion& frame, const Node& own, const Node& other,
                     const FrameMap& own_from_other, double turning_own, double turning_other) {
    const auto& t = own_from_other.translation;
    NodeSpeeds x;
    x.rate_own = frame.rate_own, x.rate_other = frame.rate_other;
    x.rate_between = frame.rate_between;
    x.radius_own = kDiagonal * own.reach;
    x.radius_other = kDiagonal * frame.own_from_other * other.reach;
    x.reach_other = x.radius_other + length(Vec3{t[0], t[1], t[2]});
    x.turning_own = turning_own + x.rate_own * x.radius_own;
    x.turning_other = turning_other + x.rate_other * x.reach_other;
    x.of_centres = frame.centres;
    return x;
}

/// Sets how far the points may deviate from their linear motion: s^2 / 2 times the acceleration,
/// and s^2 <= s duration.
///
/// In          m: its axes and turns are set.
void set_spread(const FrameMotion& frame, const Node& own, const NodeSpeeds& x, double duration,
                NodeMotion& m) {
    const double half = 0.5 * duration;
    if (m.axes == AxesTurn::none) {
        // |n x spin| |spin x arm|
        const double bend_own = half * x.turning_own, bend_other = half * x.turning_other;
        for (std::size_t i = 0; i < 3; ++i)
            m.spread[i] =
                to_float(kMore * (m.turn_own[i] * bend_own + m.turn_other[i] * bend_other));
        m.spread_any =
            to_float(kMore * duration * (x.rate_own * bend_own + x.rate_other * bend_other));
        return;
    }
    const bool with_own = m.axes == AxesTurn::with_own;
    const double rate = with_own ? x.rate_own : x.rate_other;
    const SeenMotion moving = with_own ? seen(x.turning_other, x.reach_other, rate, x, duration)
                                       : seen(x.turning_own, x.radius_own, rate, x, duration);
    const auto across_seen =
        across_axes(in_node(own, duration * (with_own ? frame.spin_own : frame.spin_other)));
    const auto& across_between = with_own ? m.turn_other : m.turn_own;
    for (std::size_t i = 0; i < 3; ++i) {
        // The axes turn, the difference of the spins does not.
        const double most_between = across_between[i] + duration * x.rate_between * across_seen[i];
        m.spread[i] =
            to_float(kMore * half * moving.bend(most_between, across_seen[i], x.of_centres));
    }
    m.spread_any =
        to_float(kMore * duration * half * moving.bend(x.rate_between, rate, x.of_centres));
}

} // namespace

NodeMotion motion_of(const FrameMotion& frame, double duration, const Node& own, const Node& other,
                     const FrameMap& own_from_other, double part) {
    const auto& o = own.frame.origin;
    const Vec3 origin{o[0], o[1], o[2]};
    const Vec3 turning_own = cross(frame.spin_own, origin - frame.centre_own),
               turning_other = cross(frame.spin_other, origin - frame.centre_other);
    const Vec3 velocity = frame.velocity + turning_other - turning_own;
    NodeMotion m;
    m.velocity = in_node(own, duration * velocity);
    m.own_from_other = to_float(kMore * frame.own_from_other);
    m.turns = frame.rate_own + frame.rate_other > 0;
    double rounding =
        kNodeRounding * (std::abs(velocity.x) + std::abs(velocity.y) + std::abs(velocity.z)) +
        frame.margin;
    if (m.turns) {
        const Vec3 between = frame.spin_other - frame.spin_own;
        NodeSpeeds x = speeds_of(frame, own, other, own_from_other, length(turning_own),
                                 length(turning_other));
        m.axes = best_turn(x, velocity, duration, part);
        Vec3 spin_own = frame.spin_own, spin_other = frame.spin_other;
        double rate_own = x.rate_own, rate_other = x.rate_other;
        if (m.axes == AxesTurn::with_own)
            spin_own = {}, rate_own = 0, spin_other = between, rate_other = x.rate_between;
        if (m.axes == AxesTurn::with_other)
            spin_other = {}, rate_other = 0, spin_own = -between, rate_own = x.rate_between;
        m.spin_own = in_node(own, duration * spin_own);
        m.spin_other = in_node(own, duration * spin_other);
        m.turn_own = across_axes(m.spin_own);
        m.turn_other = across_axes(m.spin_other);
        // The points' positions are exact but for the margin.
        rounding += kNodeRounding * (rate_own * x.radius_own + rate_other * x.reach_other) +
                    kDiagonal * (rate_own + rate_other) * own_from_other.margin;
        set_spread(frame, own, x, duration, m);
    }
    rounding = kMore * (duration * rounding + kTooSmall);
    const float more =
        rounding < kTooLarge ? to_float(rounding) : std::numeric_limits<float>::infinity();
    for (float& spread : m.spread)
        spread += more;
    m.spread_any += more;
    return m;
}

} // namespace abut
