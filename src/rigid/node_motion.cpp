#include "rigid/node_motion.h"

#include <cmath>
#include <limits>

namespace abut {

namespace {

/// Relative, of sums of a few products in single precision, and of axes that are of unit length only
/// nearly: both are some 2^-22.
constexpr double kRounding = 0x1p-20;
constexpr double kMore = 1 + kRounding;
/// Absolute: more than products lose that are too small for single precision.
constexpr double kTooSmall = 0x1p-100;
/// Ways beyond which products may overflow, and sums of them be anything.
constexpr double kTooLarge = 0x1p60;
constexpr double kDiagonal = 1.75; ///< of a cube: more than the root of 3

std::array<float, 3> in_node(const Node& node, const Vec3& v) {
    return node.frame.vector_from_tree(
        {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
}

/// |n x w| for each axis n, not less.
std::array<float, 3> across_axes(const std::array<float, 3>& w) {
    std::array<float, 3> result{};
    for (std::size_t i = 0; i < 3; ++i) {
        const float u = w[(i + 1) % 3], v = w[(i + 2) % 3];
        result[i] = static_cast<float>(kMore) *
                    std::sqrt(u * u + v * v + std::numeric_limits<float>::min());
    }
    return result;
}

} // namespace

NodeMotion motion_of(const FrameMotion& frame, double duration, const Node& own, const Node& other,
                     const FrameMap& own_from_other) {
    const auto& o = own.frame.origin;
    const Vec3 origin{o[0], o[1], o[2]};
    const Vec3 turning_own = cross(frame.spin_own, origin - frame.centre_own),
               turning_other = cross(frame.spin_other, origin - frame.centre_other);
    const Vec3 velocity = frame.velocity + turning_other - turning_own;
    NodeMotion m;
    m.velocity = in_node(own, duration * velocity);
    m.own_from_other = static_cast<float>(kMore * frame.own_from_other);
    m.turns = frame.rate_own + frame.rate_other > 0;
    double rounding =
        kRounding * (std::abs(velocity.x) + std::abs(velocity.y) + std::abs(velocity.z)) +
        frame.margin;
    if (m.turns) {
        m.spin_own = in_node(own, duration * frame.spin_own);
        m.spin_other = in_node(own, duration * frame.spin_other);
        m.turn_own = across_axes(m.spin_own);
        m.turn_other = across_axes(m.spin_other);
        // What rotation adds where the nodes' points are farthest from the frame's origin.
        const auto& t = own_from_other.translation;
        const double reach_other =
            kDiagonal * frame.own_from_other * other.reach + length(Vec3{t[0], t[1], t[2]});
        const double more_own = frame.rate_own * kDiagonal * own.reach,
                     more_other = frame.rate_other * reach_other;
        // The points themselves are where they are seen to be but for the margin.
        rounding += kRounding * (more_own + more_other) +
                    kDiagonal * (frame.rate_own + frame.rate_other) * own_from_other.margin;
        // s^2 / 2 |n x spin| |spin x arm|, and s^2 <= s duration.
        const double bend_own = 0.5 * duration * (length(turning_own) + more_own),
                     bend_other = 0.5 * duration * (length(turning_other) + more_other);
        for (std::size_t i = 0; i < 3; ++i)
            m.spread[i] = static_cast<float>(
                kMore * (m.turn_own[i] * bend_own + m.turn_other[i] * bend_other));
        m.spread_any = static_cast<float>(
            kMore * duration * (frame.rate_own * bend_own + frame.rate_other * bend_other));
    }
    rounding = kMore * (duration * rounding + kTooSmall);
    const float more = rounding < kTooLarge ? static_cast<float>(rounding)
                                            : std::numeric_limits<float>::infinity();
    for (float& spread : m.spread)
        spread += more;
    m.spread_any += more;
    return m;
}

} // namespace abut
