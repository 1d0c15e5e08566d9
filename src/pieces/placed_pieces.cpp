#include "pieces/placed_pieces.h"

namespace abut {

namespace {

double rounding_of(const ConvexPiecesData& a, const Transform& world_from_a,
                   const ConvexPiecesData& b, const Transform& world_from_b, const Vec3& shift) {
    const double rounding = 0x1p-51 * (sum_of_sizes(world_from_a) * a.reach +
                                       sum_of_sizes(world_from_b) * b.reach + sum_of_sizes(shift));
    if (!std::isfinite(rounding)) {
        require_finite(world_from_a, "transform of a");
        require_finite(world_from_b, "transform of b");
    }
    return rounding;
}

/// Of a rotation this is 1, found sooner than by its stretch.
double most_stretch(const Transform& t) {
    const auto& m = t.m;
    const Vec3 x{m[0], m[1], m[2]}, y{m[3], m[4], m[5]}, z{m[6], m[7], m[8]};
    // Gershgorin: no eigenvalue of L^T L is larger than a row's sum of sizes.
    const double xy = std::abs(dot(x, y)), yz = std::abs(dot(y, z)), zx = std::abs(dot(z, x));
    const double most =
        std::max({length_sq(x) + xy + zx, length_sq(y) + xy + yz, length_sq(z) + yz + zx});
    return std::sqrt(most) * (1 + 0x1p-48);
}

} // namespace

PlacedPieces::PlacedPieces(const ConvexPiecesData& data_a, const Transform& pose_a,
                           const ConvexPiecesData& data_b, const Transform& pose_b)
    : a(data_a), b(data_b), world_from_a(pose_a),
      world_from_b(pose_b), shift_{pose_b.m[9] - pose_a.m[9], pose_b.m[10] - pose_a.m[10],
                                   pose_b.m[11] - pose_a.m[11]},
      most_a_(most_stretch(pose_a)), most_b_(most_stretch(pose_b)) {
    rounding = rounding_of(a, world_from_a, b, world_from_b, shift_);
}

} // namespace abut
