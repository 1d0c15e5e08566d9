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

struct SquaredStretch {
    double least, most;
};

/// Bounds on the squares of the stretch factors. For a rotation both are 1, without computing
/// eigenvalues.
SquaredStretch squared_stretch(const Transform& t) {
    const auto& m = t.m;
    const Vec3 x{m[0], m[1], m[2]}, y{m[3], m[4], m[5]}, z{m[6], m[7], m[8]};
    // Gershgorin: all eigenvalues of L^T L lie in these discs.
    const double xx = length_sq(x), yy = length_sq(y), zz = length_sq(z);
    const double xy = std::abs(dot(x, y)), yz = std::abs(dot(y, z)), zx = std::abs(dot(z, x));
    const double rx = xy + zx, ry = xy + yz, rz = yz + zx;
    return {std::min({xx - rx, yy - ry, zz - rz}), std::max({xx + rx, yy + ry, zz + rz})};
}

} // namespace

double PlacedPieces::least_stretch(double least_sq, const Transform& t) {
    return least_sq > 0.5 ? std::sqrt(least_sq) * (1 - 0x1p-40) : stretch_of(t).least;
}

PlacedPieces::PlacedPieces(const ConvexPiecesData& data_a, const Transform& pose_a,
                           const ConvexPiecesData& data_b, const Transform& pose_b)
    : a(data_a), b(data_b), world_from_a(pose_a),
      world_from_b(pose_b), shift_{pose_b.m[9] - pose_a.m[9], pose_b.m[10] - pose_a.m[10],
                                   pose_b.m[11] - pose_a.m[11]} {
    const SquaredStretch of_a = squared_stretch(pose_a), of_b = squared_stretch(pose_b);
    most_a_ = std::sqrt(of_a.most) * (1 + 0x1p-48), most_b_ = std::sqrt(of_b.most) * (1 + 0x1p-48);
    least_sq_a_ = of_a.least, least_sq_b_ = of_b.least;
    rounding = rounding_of(a, world_from_a, b, world_from_b, shift_);
}

} // namespace abut
