#include "geometry/prepared_triangle.h"

namespace abut {

PreparedTriangle::PreparedTriangle(const Triangle& t) : corners_(t) {
    for (std::size_t i = 0; i < 3; ++i) {
        edges_[i] = t[(i + 1) % 3] - t[i];
        lengths_sq_[i] = length_sq(edges_[i]);
    }
    if (lengths_sq_[1] > lengths_sq_[0])
        first_ = 1;
    if (lengths_sq_[2] > lengths_sq_[first_])
        first_ = 2;
    const Vec3& u = edges_[first_];
    other_ = -edges_[(first_ + 2) % 3];
    normal_ = cross(u, other_);
    normal_sq_ = length_sq(normal_);
    rounding_ = 0x1p-48 * sum_of_sizes(u) * sum_of_sizes(other_) + kTiny;
}

ClosestPoints PreparedTriangle::nearest(const Vec3& p) const {
    const Found found = nearest_feature(p);
    if (found.dimension == 0)
        return {found.distance_sq, p, corners_[found.index]};
    if (found.dimension == 1)
        return {found.distance_sq, p, corners_[found.index] + found.s * edges_[found.index]};
    return {found.distance_sq, p, corners_[first_] + (found.s * edges_[first_] + found.t * other_)};
}

} // namespace abut
