#pragma once

#include "convex/support/support_pair.h"

#include <array>
#include <boost/container/static_vector.hpp>
#include <cstdint>
#include <limits>

namespace abut {

/// The unit directions that a core's feature allows are those with `normal . d = level`.
struct DirectionRule {
    Vec3 normal;
    double level = 0;
};

/// A core near one of its farthest points: a feature on which the farthest point is a smooth function
/// of the direction.
///
/// The point is `fixed`, plus `rim` times the farthest point of the disc across axis[2], or for
/// `curved` that of the ellipsoid.
struct LocalCore {
    const SupportShape* shape = nullptr;
    Vec3 fixed;
    double rim = 0;
    bool curved = false;
    std::array<DirectionRule, 3> rules{};
    std::uint32_t rule_count = 0;
    /// Corners: the point may move by this on the feature without leaving it.
    double room = std::numeric_limits<double>::infinity();

    [[nodiscard]] Vec3 point(const Vec3& direction) const;
    /// The derivative of the point along a vector.
    [[nodiscard]] Vec3 derivative(const Vec3& direction, const Vec3& along) const;
    /// Whether a point of the feature that moves along it stays on the core, up to an error.
    [[nodiscard]] bool may_move(const Vec3& from, const Vec3& by, double error) const;
};

/// Which of a simplex's points are meant.
enum class PairSide : std::uint8_t { a, b };

using LocalCores = boost::container::static_vector<LocalCore, 8>;

/// The features of a core that may hold the simplex's weighted point, the likeliest first: more than one
/// where the point is so near the border of a feature that its rounding decides. Never empty.
///
/// In          direction: unit vector in which the point is farthest, to about 1e-4.
LocalCores local_cores(const SupportPair& pair, PairSide side, const SupportSimplex& nearest,
                       const Vec3& direction);

} // namespace abut
