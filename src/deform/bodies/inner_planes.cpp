#include "deform/bodies/inner_planes.h"

#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace abut {

namespace {

/// A hull of more faces is not listed plane by plane.
constexpr std::size_t kMostFaces = 4096;

/// Planes that are listed: those of a box or of a hull's faces. Planes of similar normals form
/// groups; a group's bounds tell that none of it is the nearest one.
class FacePlanes final : public InnerPlanes {
public:
    /// In: middle, a point inside, less the shape's centre. Seen from there, offsets differ least.
    FacePlanes(const std::vector<SupportingPlane>& planes, const Vec3& middle) : middle_(middle) {
        std::vector<std::pair<std::uint32_t, std::size_t>> order;
        for (std::size_t i = 0; i < planes.size(); ++i)
            order.emplace_back(place_of(planes[i].normal), i);
        std::sort(order.begin(), order.end());
        for (const auto& [place, i] : order)
            planes_.push_back(planes[i]);
        for (std::size_t first = 0; first < planes_.size(); first += kGroup) {
            Group group;
            for (std::size_t i = first; i < end_of(first); ++i) {
                extend(group.normals, planes_[i].normal);
                group.least_offset = std::min(group.least_offset,
                                              planes_[i].offset - dot(planes_[i].normal, middle_));
            }
            groups_.push_back(group);
        }
    }
    [[nodiscard]] SupportingPlane nearest(const Vec3& p) const override {
        // Clearing all of it would cost more than filling in those of a few groups.
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
        std::array<double, kMostFaces / kGroup> bounds;
        const Vec3 from_middle = p - middle_;
        std::size_t likely = 0;
        for (std::size_t i = 0; i < groups_.size(); ++i) {
            bounds[i] = groups_[i].most(from_middle);
            likely = bounds[i] > bounds[likely] ? i : likely;
        }
        Nearest nearest;
        search(likely, p, nearest);
        // Heights are rounded, as the bounds are.
        const double rounding = 0x1p-48 * (sum_of_sizes(p) + sum_of_sizes(middle_));
        for (std::size_t i = 0; i < groups_.size(); ++i)
            if (bounds[i] > nearest.height - rounding && i != likely)
                search(i, p, nearest);
        return planes_[nearest.plane];
    }

private:
    static constexpr std::size_t kGroup = 16;
    struct Group {
        Box3 normals;
        double least_offset = std::numeric_limits<double>::infinity();

        /// No plane of the group has the point higher above it.
        [[nodiscard]] double most(const Vec3& p) const {
            return std::max(normals.lower.x * p.x, normals.upper.x * p.x) +
                   std::max(normals.lower.y * p.y, normals.upper.y * p.y) +
                   std::max(normals.lower.z * p.z, normals.upper.z * p.z) - least_offset;
        }
    };
    struct Nearest {
        double height = -std::numeric_limits<double>::infinity();
        std::size_t plane = 0;
    };

    /// A number that is similar for similar unit vectors: the bits of their coordinates in turn.
    static std::uint32_t place_of(const Vec3& normal) {
        constexpr std::uint32_t kBits = 5;
        const auto cell = [](double x) {
            return static_cast<std::uint32_t>((1 + x) * ((1U << kBits) - 1) / 2);
        };
        std::uint32_t place = 0;
        for (std::uint32_t bit = kBits; bit-- > 0;)
            for (const double x : {normal.x, normal.y, normal.z})
                place = place << 1 | (cell(x) >> bit & 1U);
        return place;
    }
    [[nodiscard]] std::size_t end_of(std::size_t first) const {
        return std::min(first + kGroup, planes_.size());
    }
    void search(std::size_t group, const Vec3& p, Nearest& nearest) const {
        for (std::size_t i = kGroup * group; i < end_of(kGroup * group); ++i) {
            const double height = dot(planes_[i].normal, p) - planes_[i].offset;
            if (height > nearest.height)
                nearest = {height, i};
        }
    }

    std::vector<SupportingPlane> planes_;
    std::vector<Group> groups_;
    Vec3 middle_;
};

/// Solids of revolution about axis[2].
class AxisPlanes : public InnerPlanes {
public:
    explicit AxisPlanes(const SupportShape& solid)
        : axis_(solid.axis[2]), across_(solid.axis[0]), radius_(solid.half[0]),
          half_(solid.half[2]) {}

protected:
    /// A point as height along the axis, distance from it, and the unit vector from it.
    struct Place {
        double height = 0, from_axis = 0;
        Vec3 out;
    };
    [[nodiscard]] Place place(const Vec3& p) const {
        const double height = dot(p, axis_);
        const Vec3 aside = p - height * axis_;
        const double from_axis = length(aside);
        // Beside the axis, rounding may turn the vector anywhere, and the plane across it would not
        // support the solid. Any vector that is perpendicular to the axis will do.
        if (!(from_axis > 0x1p-50 * std::abs(height)))
            return {height, from_axis, across_};
        const Vec3 out = normalized_or_zero(aside);
        return {height, from_axis, normalized_or_zero(out - dot(out, axis_) * axis_)};
    }

    Vec3 axis_, across_;
    double radius_, half_;
};

class CylinderPlanes final : public AxisPlanes {
public:
    using AxisPlanes::AxisPlanes;
    [[nodiscard]] SupportingPlane nearest(const Vec3& p) const override {
        const Place at = place(p);
        if (std::abs(at.height) - half_ > at.from_axis - radius_)
            return {at.height < 0 ? -axis_ : axis_, half_};
        return {at.out, radius_};
    }
};

class ConePlanes final : public AxisPlanes {
public:
    explicit ConePlanes(const SupportShape& solid)
        : AxisPlanes(solid), slant_(std::hypot(radius_, 2 * half_)) {}
    [[nodiscard]] SupportingPlane nearest(const Vec3& p) const override {
        const Place at = place(p);
        // The normal of the side, outwards and up: it holds the apex.
        const double out = 2 * half_ / slant_, up = radius_ / slant_, offset = up * half_;
        if (-at.height - half_ > out * at.from_axis + up * at.height - offset)
            return {-axis_, half_};
        return {normalized_or_zero(out * at.out + up * axis_), offset};
    }

private:
    double slant_;
};

/// The point of the surface nearest to y solves x_k = e_k^2 y_k / (s + e_k^2 - e_min^2), where e_k
/// are the semi-axes and 0 <= s <= e_min^2. Along s, g = sum (x_k / e_k)^2 - 1 decreases and is
/// convex, so that Newton's iteration from below never passes its root.
class EllipsoidPlanes final : public InnerPlanes {
public:
    explicit EllipsoidPlanes(const SupportShape& solid) : axis_(solid.axis), half_(solid.half) {}
    [[nodiscard]] SupportingPlane nearest(const Vec3& p) const override {
        // Semi-axes of the size of 1.
        const double size = *std::max_element(half_.begin(), half_.end());
        const std::size_t shortest =
            static_cast<std::size_t>(std::min_element(half_.begin(), half_.end()) - half_.begin());
        Axes y{}, e{}, beyond{}; // beyond: the squares of e less the least
        for (std::size_t k = 0; k < 3; ++k) {
            y[k] = dot(p, axis_[k]) / size, e[k] = half_[k] / size;
            const double least = half_[shortest] / size;
            beyond[k] = (e[k] - least) * (e[k] + least);
        }
        const double s = root(y, e, beyond);
        Axes n{}; // proportional to the surface's normal
        double rest = 1;
        for (std::size_t k = 0; k < 3; ++k) {
            n[k] = s + beyond[k] > 0 ? y[k] / (s + beyond[k]) : 0;
            rest -= n[k] * n[k] * e[k] * e[k];
        }
        // In the plane of the longer axes s may be 0: the place then is above or below.
        if (!(s > 0) && rest > 0)
            n[shortest] = std::sqrt(rest) / e[shortest];
        const Vec3 normal = normalized_or_zero(n[0] * axis_[0] + n[1] * axis_[1] + n[2] * axis_[2]);
        return {normal, length({half_[0] * dot(normal, axis_[0]), half_[1] * dot(normal, axis_[1]),
                                half_[2] * dot(normal, axis_[2])})};
    }

private:
    using Axes = std::array<double, 3>;

    static double root(const Axes& y, const Axes& e, const Axes& beyond) {
        // At this s, one of the terms is 1 and the others are not negative.
        double s = 0;
        for (std::size_t k = 0; k < 3; ++k)
            s = std::max(s, e[k] * std::abs(y[k]) - beyond[k]);
        constexpr int kMostSteps = 60;
        for (int step = 0; step < kMostSteps; ++step) {
            double g = -1, slope = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const double divisor = s + beyond[k];
                if (!(divisor > 0))
                    continue;
                const double term = e[k] * y[k] / divisor;
                g += term * term, slope -= 2 * term * term / divisor;
            }
            const double next = s - g / slope;
            if (!(g > 0 && next > s))
                break;
            s = next;
        }
        return s;
    }

    std::array<Vec3, 3> axis_;
    std::array<double, 3> half_;
};

std::unique_ptr<const InnerPlanes> planes_of_box(const SupportShape& solid) {
    std::vector<SupportingPlane> planes;
    for (std::size_t k = 0; k < 3; ++k) {
        planes.push_back({solid.axis[k], solid.half[k]});
        planes.push_back({-solid.axis[k], solid.half[k]});
    }
    return std::make_unique<FacePlanes>(planes, Vec3{});
}

/// One plane for each flat face, which holds its farthest vertex. The normal of a needle may be
/// off: its plane is moved out to the farthest vertex of the whole hull.
std::unique_ptr<const InnerPlanes> planes_of_hull(const SupportShape& solid,
                                                  const ConvexData& convex) {
    const std::size_t faces = convex.face_begin.empty() ? 0 : convex.face_begin.size() - 1;
    if (convex.dimension != 3 || faces > kMostFaces)
        return nullptr;
    std::vector<Vec3> seen;
    Vec3 sum;
    for (const Vec3& vertex : convex.vertices) {
        const Vec3 p = vertex - solid.first;
        seen.push_back(p.x * solid.columns[0] + p.y * solid.columns[1] + p.z * solid.columns[2]);
        sum = sum + seen.back();
    }
    std::vector<SupportingPlane> planes;
    for (std::size_t f = 0; f < faces; ++f) {
        Vec3 area; // of the polygon, twice, along its normal
        double longest_sq = 0;
        const std::uint32_t begin = convex.face_begin[f], end = convex.face_begin[f + 1];
        const Vec3& first = seen[convex.face_vertices[begin]];
        for (std::uint32_t i = begin + 1; i < end; ++i) {
            const Vec3 side = seen[convex.face_vertices[i]] - first;
            longest_sq = std::max(longest_sq, length_sq(side));
            area = area + cross(seen[convex.face_vertices[i - 1]] - first, side);
        }
        const Vec3 normal = normalized_or_zero(area);
        if (normal == Vec3{})
            continue;
        constexpr double kNeedle = 0x1p-16;
        double offset = dot(normal, first);
        for (std::uint32_t i = begin + 1; i < end; ++i)
            offset = std::max(offset, dot(normal, seen[convex.face_vertices[i]]));
        if (length(area) < kNeedle * longest_sq)
            offset = dot(normal, farthest(solid, normal));
        planes.push_back({normal, offset});
    }
    if (planes.empty())
        return nullptr;
    return std::make_unique<FacePlanes>(planes, (1.0 / static_cast<double>(seen.size())) * sum);
}

} // namespace

std::unique_ptr<const InnerPlanes> make_inner_planes(const SupportShape& solid,
                                                     const ConvexData* convex) {
    const bool is_flat =
        std::any_of(solid.half.begin(), solid.half.end(), [](double half) { return !(half > 0); });
    if (solid.radius != 0)
        return nullptr;
    if (solid.kind == CoreKind::polytope && convex != nullptr)
        return planes_of_hull(solid, *convex);
    if (is_flat)
        return nullptr;
    switch (solid.kind) {
    case CoreKind::box:
        return planes_of_box(solid);
    case CoreKind::cylinder:
        return std::make_unique<CylinderPlanes>(solid);
    case CoreKind::cone:
        return std::make_unique<ConePlanes>(solid);
    case CoreKind::ellipsoid:
        return std::make_unique<EllipsoidPlanes>(solid);
    case CoreKind::triangle:
    case CoreKind::polytope:
        break;
    }
    return nullptr;
}

} // namespace abut
