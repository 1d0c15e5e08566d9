#pragma once

#include <abut/rigid.h>

#include "math/vector.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace abut {

inline constexpr double kUnreached = std::numeric_limits<double>::infinity();
/// Points are sought in this many directions around the centre.
inline constexpr std::size_t kAround = 8;

/// A place where a contact point may be.
struct PointCandidate {
    enum class Kind : std::uint8_t { none, vertex_a, vertex_b, line, fixed };
    Kind kind = Kind::none;
    Vec3 at;                   ///< the vertex; a point of the line along the normal; fixed: on a
    Vec3 on_b;                 ///< of a fixed one
    TrianglePair pair;         ///< that it comes from
    std::uint64_t feature = 0; ///< its name
    bool was_chosen = false;   ///< in the last step
};

/// Names of the last step's points.
class LastNames {
public:
    explicit LastNames(std::span<const std::uint64_t> names) : names_(names) {
        for (const std::uint64_t name : names)
            hashes_.set(hash_of(name));
    }
    [[nodiscard]] bool has(std::uint64_t name) const {
        return hashes_[hash_of(name)] &&
               std::find(names_.begin(), names_.end(), name) != names_.end();
    }

private:
    static constexpr std::size_t kHashes = 1024;
    static std::size_t hash_of(std::uint64_t name) { return name * 0x9E3779B97F4A7C15U >> 54U; }

    std::span<const std::uint64_t> names_;
    std::bitset<kHashes> hashes_; ///< most names that are not there are not in this either
};

/// The candidate that is farthest in a direction.
struct Extreme {
    double reach = -kUnreached;
    PointCandidate candidate;
    void take(double other_reach, const PointCandidate& other) {
        if (other_reach > reach || (other_reach == reach && other.feature < candidate.feature))
            reach = other_reach, candidate = other;
    }
};

using Extremes = std::array<Extreme, kAround>;

/// A candidate of the last step stays until another one exceeds it by this factor: rounding and
/// small motions do not change the choice.
inline constexpr double kLoyalty = 1.1;

inline double favoured(double size, const PointCandidate& candidate) {
    return !candidate.was_chosen ? size : size > 0 ? kLoyalty * size : size / kLoyalty;
}

/// How far something reaches in each direction.
using Reaches = std::array<double, kAround>;
/// As Reaches, for the first half of the directions. In the opposite one a place reaches the negative.
using Around = std::array<double, kAround / 2>;

inline Around around(double x, double y) {
    constexpr double kHalf = 0.70710678118654752;
    return {x, kHalf * (x + y), y, kHalf * (y - x)};
}

inline void take_everywhere(Extremes& extremes, double x, double y,
                            const PointCandidate& candidate) {
    const Around reach = around(x, y);
    for (std::size_t k = 0; k < kAround / 2; ++k) {
        extremes[k].take(favoured(reach[k], candidate), candidate);
        extremes[k + kAround / 2].take(favoured(-reach[k], candidate), candidate);
    }
}

} // namespace abut
