#include "rigid/model/tree_frame.h"

#include "math/vector.h"
#include "volume/fit/principal_axes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

namespace {

constexpr std::size_t kSamples = 256;

constexpr Axes kModelAxes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

/// Completes two axes that are perpendicular to rounding by a third. Returns the model's axes if
/// the two are no directions.
Axes complete(const Vec3& first, const Vec3& second) {
    const Vec3 x = normalized_or_zero(first);
    const Vec3 y = normalized_or_zero(second - dot(second, x) * x);
    const Vec3 z = cross(x, y);
    return std::abs(length_sq(z) - 1) < 0x1p-40 ? Axes{x, y, z} : kModelAxes;
}

/// Axes along the second-longest edge of the largest triangle, and along its normal.
Axes largest_face(const std::vector<Triangle>& triangles) {
    const auto doubled_area_sq = [](const Triangle& t) {
        return length_sq(cross(t[1] - t[0], t[2] - t[0]));
    };
    const Triangle& t = *std::max_element(triangles.begin(), triangles.end(),
                                          [&](const Triangle& s, const Triangle& u) {
                                              return doubled_area_sq(s) < doubled_area_sq(u);
                                          });
    std::array edges{t[1] - t[0], t[2] - t[1], t[0] - t[2]};
    // The longest edge may be the diagonal of a rectangle, which is no axis of it: take the longer
    // of the other two.
    std::sort(edges.begin(), edges.end(),
              [](const Vec3& p, const Vec3& q) { return length_sq(p) < length_sq(q); });
    return complete(edges[1], cross(edges[0], edges[1]));
}

double summed_box_area(const std::vector<Triangle>& triangles, const Axes& axes) {
    double sum = 0;
    for (const Triangle& t : triangles) {
        Vec3 size;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] =
                std::minmax({dot(axes[i], t[0]), dot(axes[i], t[1]), dot(axes[i], t[2])});
            (i == 0 ? size.x : i == 1 ? size.y : size.z) = high - low;
        }
        sum += size.x * size.y + size.y * size.z + size.z * size.x;
    }
    return sum;
}

/// An even sample of triangles, relative to the centre of the bounds.
std::vector<Triangle> some_triangles(const Mesh& mesh, const Box3& bounds) {
    std::vector<Triangle> sample;
    const std::size_t count = std::min(kSamples, mesh.triangles.size());
    sample.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto& t = mesh.triangles[i * mesh.triangles.size() / count];
        sample.push_back({from_middle(bounds, mesh.positions[t[0]]),
                          from_middle(bounds, mesh.positions[t[1]]),
                          from_middle(bounds, mesh.positions[t[2]])});
    }
    return sample;
}

Axes axes_of(const std::vector<Triangle>& sample, TreeAxes axes) {
    switch (axes) {
    case TreeAxes::principal:
        return principal_axes(std::span<const Triangle>(sample));
    case TreeAxes::of_largest_face:
        return largest_face(sample);
    default:
        return kModelAxes;
    }
}

Vec3 middle_of(const Box3& box) {
    return 0.5 * box.lower + 0.5 * box.upper;
}

Transform transform_of(const Axes& axes, const Vec3& origin) {
    return Transform({axes[0].x, axes[0].y, axes[0].z, axes[1].x, axes[1].y, axes[1].z, axes[2].x,
                      axes[2].y, axes[2].z, origin.x, origin.y, origin.z});
}

} // namespace

TreeFrame choose_tree_frame(const Mesh& mesh, const Box3& bounds) {
    if (is_empty(bounds))
        return {};
    const std::vector<Triangle> sample = some_triangles(mesh, bounds);
    TreeAxes chosen = TreeAxes::of_model;
    Axes best = kModelAxes;
    double least = summed_box_area(sample, best);
    for (const TreeAxes candidate : {TreeAxes::principal, TreeAxes::of_largest_face}) {
        const Axes axes = axes_of(sample, candidate);
        const double sum = summed_box_area(sample, axes);
        if (sum < least)
            chosen = candidate, best = axes, least = sum;
    }
    return {chosen, transform_of(best, middle_of(bounds))};
}

TreeFrame tree_frame(const Mesh& mesh, const Box3& bounds, TreeAxes axes) {
    if (is_empty(bounds))
        return {};
    const Vec3 origin = middle_of(bounds);
    if (axes == TreeAxes::of_model)
        return {axes, transform_of(kModelAxes, origin)};
    return {axes, transform_of(axes_of(some_triangles(mesh, bounds), axes), origin)};
}

} // namespace abut
