#include "volume/obb.h"

#include "math/rounding.h"
#include "volume/aabb.h"
#include "volume/float_vector.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace abut {

namespace {

/// Fits boxes with given axes to points.
class BoxFit {
public:
    BoxFit(const Axes& axes, const Vec3& origin) : origin_(origin) {
        Eigen::Matrix3d a;
        for (std::size_t i = 0; i < 3; ++i) {
            box_.axis[i] = to_float(axes[i]);
            for (std::size_t k = 0; k < 3; ++k)
                a(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) = box_.axis[i][k];
        }
        // The stored axes are orthogonal only up to rounding. Coordinates therefore come from the
        // inverse, not from dot products.
        inverse_ = a.inverse();
    }

    void add(const Vec3& p) {
        const Eigen::Vector3d x = coordinates(p - origin_);
        low_ = low_.cwiseMin(x);
        high_ = high_.cwiseMax(x);
    }

    [[nodiscard]] Obb box(double margin) const {
        Obb box = box_;
        const Eigen::Vector3d middle = 0.5 * low_ + 0.5 * high_;
        Vec3 centre = origin_;
        for (std::size_t i = 0; i < 3; ++i)
            centre = centre + middle[static_cast<Eigen::Index>(i)] * to_double(box.axis[i]);
        box.centre = to_float(centre);
        const Eigen::Vector3d shift = coordinates(to_double(box.centre) - origin_);
        // Differences, a rounded inverse, three products and sums: fewer than 64 roundings,
        // relative to the distance to the origin. The sum of the coordinates is at least 1 / 2 of
        // that distance.
        const double size = low_.cwiseAbs().cwiseMax(high_.cwiseAbs()).sum() + shift.lpNorm<1>();
        for (std::size_t i = 0; i < 3; ++i) {
            const auto k = static_cast<Eigen::Index>(i);
            box.half[i] = round_up(std::max(high_[k] - shift[k], shift[k] - low_[k]) +
                                   128 * 0x1p-53 * size + 2 * margin + kUnderflow);
        }
        return box;
    }

private:
    [[nodiscard]] Eigen::Vector3d coordinates(const Vec3& d) const {
        return inverse_ * Eigen::Vector3d(d.x, d.y, d.z);
    }

    Vec3 origin_;
    Obb box_;
    Eigen::Matrix3d inverse_;
    Eigen::Vector3d low_ = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()),
                    high_ = -low_;
};

std::array<Vec3, 8> corners_of(const Obb& box) {
    std::array<Vec3, 8> corners;
    for (unsigned corner = 0; corner < 8; ++corner) {
        corners[corner] = to_double(box.centre);
        for (unsigned i = 0; i < 3; ++i) {
            const double half = box.half[i];
            corners[corner] =
                corners[corner] + ((corner >> i & 1U) != 0 ? half : -half) * to_double(box.axis[i]);
        }
    }
    return corners;
}

double volume_of(const Obb& box) {
    return double{box.half[0]} * box.half[1] * box.half[2];
}

} // namespace

Obb Obb::fit(std::span<const Triangle> triangles, double margin) {
    BoxFit fit(hull_axes(triangles), triangles[0][0]);
    for (const Triangle& t : triangles)
        for (const Vec3& p : t)
            fit.add(p);
    return fit.box(margin);
}

Obb Obb::merge(const Obb& a, const Obb& b) {
    std::vector<Vec3> corners;
    double size = 0;
    for (const Obb* box : {&a, &b}) {
        const auto own = corners_of(*box);
        corners.insert(corners.end(), own.begin(), own.end());
        size = std::max(size, box->reach());
    }
    const auto axes_of = [](const Obb& box) {
        return Axes{to_double(box.axis[0]), to_double(box.axis[1]), to_double(box.axis[2])};
    };
    Obb best;
    double least = std::numeric_limits<double>::infinity();
    for (const Axes& axes : {principal_axes(corners), axes_of(a), axes_of(b)}) {
        BoxFit fit(axes, corners[0]);
        for (const Vec3& p : corners)
            fit.add(p);
        const Obb box = fit.box(8 * 0x1p-53 * size); // the margin bounds the rounding of the
                                                     // corners
        if (!(volume_of(box) >= least))
            best = box, least = volume_of(box);
    }
    return best;
}

double Obb::reach() const {
    return (length(to_double(centre)) + double{circumradius()}) * (1 + 0x1p-20);
}

float Obb::circumradius() const {
    return round_up(length(to_double(half)) * (1 + 8 * 0x1p-24));
}

ObbImage image_of(const Obb& volume, const RelativePose& pose) {
    ObbImage image{};
    image.centre = apply(pose, volume.centre);
    image.circumradius = volume.circumradius() * pose.most_stretch;
    image.margin = pose.margin;
    auto& e = image.direction;
    for (std::size_t i = 0; i < 3; ++i) {
        e[i] = apply_linear(pose, volume.axis[i]);
        const float stretch = std::sqrt(dot(e[i], e[i]));
        e[i] = scaled(1 / stretch, e[i]);
        image.half[i] = volume.half[i] * stretch;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t k = (i + 1) % 3, l = (i + 2) % 3;
        const Float3 across = cross(e[k], e[l]);
        const float sine = std::sqrt(dot(across, across));
        image.normal[i] = scaled(sine > 0 ? 1 / sine : 0, across);
        // Sums over all three edges: the normal of two almost parallel edges is not orthogonal to
        // them.
        for (std::size_t j = 0; j < 3; ++j)
            image.normal_half[i] += image.half[j] * std::abs(dot(image.normal[i], e[j]));
        image.half_across[k][l] = image.half[l] * sine;
        image.half_across[l][k] = image.half[k] * sine;
    }
    // Gershgorin's bound of the largest eigenvalue of the matrix of the normals' dot products.
    const auto& n = image.normal;
    const float xy = std::abs(dot(n[0], n[1])), yz = std::abs(dot(n[1], n[2])),
                zx = std::abs(dot(n[2], n[0]));
    image.normals_spread = 1 + std::max({xy + zx, xy + yz, yz + zx});
    return image;
}

} // namespace abut
