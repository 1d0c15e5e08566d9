#include "volume/kdop.h"

#include "math/rounding.h"
#include "volume/aabb.h"
#include "volume/float_vector.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace abut {

namespace {

using Normal = std::array<int, 3>;

double along(const Normal& n, const Vec3& p) {
    return n[0] * p.x + n[1] * p.y + n[2] * p.z;
}
int sum_of_magnitudes(const Normal& n) {
    return std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);
}

/// A direction as a sum of three normals with non-negative weights.
struct Cone {
    std::array<Normal, 3> normals;
    std::array<double, 3> weights;
};

/// The cone of a direction (a, b, c) with a >= b >= c >= 0.
template <std::size_t k>
Cone sorted_cone(double a, double b, double c) {
    if constexpr (k == 26)
        return {{{{1, 0, 0}, {1, 1, 0}, {1, 1, 1}}}, {a - b, b - c, c}};
    if constexpr (k == 14)
        return {{{{1, 0, 0}, {1, 1, 1}, {1, 1, -1}}}, {a - b, 0.5 * (b + c), 0.5 * (b - c)}};
    if (a >= b + c)
        return {{{{1, 0, 0}, {1, 1, 0}, {1, 0, 1}}}, {a - b - c, b, c}};
    return {{{{1, 1, 0}, {1, 0, 1}, {0, 1, 1}}},
            {0.5 * (a + b - c), 0.5 * (a + c - b), 0.5 * (b + c - a)}};
}

/// The cone of any direction. Sorts its magnitudes, and undoes order and signs in the normals.
template <std::size_t k>
Cone cone_of(const std::array<double, 3>& direction) {
    std::array<std::size_t, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
        return std::abs(direction[i]) > std::abs(direction[j]);
    });
    Cone cone = sorted_cone<k>(std::abs(direction[order[0]]), std::abs(direction[order[1]]),
                               std::abs(direction[order[2]]));
    for (Normal& n : cone.normals) {
        const Normal sorted = n;
        for (std::size_t i = 0; i < 3; ++i)
            n[order[i]] = direction[order[i]] < 0 ? -sorted[i] : sorted[i];
    }
    return cone;
}

} // namespace

template <std::size_t k>
Kdop<k> Kdop<k>::fit(std::span<const Triangle> triangles, double margin) {
    Kdop kdop;
    for (std::size_t i = 0; i < kSlabs; ++i) {
        double low = std::numeric_limits<double>::infinity(), high = -low, size = 0;
        for (const Triangle& t : triangles)
            for (const Vec3& p : t) {
                const double x = along(kNormals[i], p);
                low = std::min(low, x);
                high = std::max(high, x);
                size = std::max(size, std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
            }
        // Nothing is rounded along a coordinate axis. Along other normals, two sums are.
        const int terms = sum_of_magnitudes(kNormals[i]);
        const double off = terms * margin + (terms > 1 ? 2 * 0x1p-53 * size : 0);
        kdop.lower[i] = round_down(low - off);
        kdop.upper[i] = round_up(high + off);
    }
    return kdop;
}

template <std::size_t k>
Kdop<k> Kdop<k>::merge(const Kdop& a, const Kdop& b) {
    Kdop kdop;
    for (std::size_t i = 0; i < kSlabs; ++i) {
        kdop.lower[i] = std::min(a.lower[i], b.lower[i]);
        kdop.upper[i] = std::max(a.upper[i], b.upper[i]);
    }
    return kdop;
}

template <std::size_t k>
double Kdop<k>::reach() const {
    const auto farthest = [&](std::size_t i) {
        return std::max(std::abs(double{lower[i]}), std::abs(double{upper[i]}));
    };
    return length(Vec3{farthest(0), farthest(1), farthest(2)}) * (1 + 0x1p-20);
}

template <std::size_t k>
float Kdop<k>::circumradius() const {
    const Vec3 half{0.5 * (double{upper[0]} - lower[0]), 0.5 * (double{upper[1]} - lower[1]),
                    0.5 * (double{upper[2]} - lower[2])};
    return round_up(length(half) * (1 + 8 * 0x1p-24));
}

template <std::size_t k>
KdopMap<k>::KdopMap(const RelativePose& pose) : margin(pose.margin) {
    const auto& m = pose.linear;
    const auto& normals = Kdop<k>::kNormals;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const Normal& n = normals[i];
        offset[i] =
            to_float(along(n, {pose.translation[0], pose.translation[1], pose.translation[2]}));
        std::array<double, 3> direction{};
        for (std::size_t column = 0; column < 3; ++column)
            direction[column] = along(n, {m[0][column], m[1][column], m[2][column]});
        const Cone cone = cone_of<k>(direction);
        for (std::size_t j = 0; j < 3; ++j) {
            const Normal opposite{-cone.normals[j][0], -cone.normals[j][1], -cone.normals[j][2]};
            for (std::uint32_t slab = 0; slab < normals.size(); ++slab)
                if (normals[slab] == cone.normals[j] || normals[slab] == opposite)
                    terms[i][j] = {slab, to_float(normals[slab] == opposite ? -cone.weights[j]
                                                                            : cone.weights[j])};
        }
    }
}

template <std::size_t k>
KdopImage<k> image_of(const Kdop<k>& volume, const KdopMap<k>& map) {
    KdopImage<k> image;
    image.margin = map.margin;
    for (std::size_t i = 0; i < Kdop<k>::kSlabs; ++i) {
        float low = map.offset[i], high = low;
        for (const auto& [slab, weight] : map.terms[i]) {
            const float at_lower = weight * volume.lower[slab],
                        at_upper = weight * volume.upper[slab];
            low += std::min(at_lower, at_upper);
            high += std::max(at_lower, at_upper);
        }
        image.kdop.lower[i] = low;
        image.kdop.upper[i] = high;
    }
    return image;
}

template struct Kdop<14>;
template struct Kdop<18>;
template struct Kdop<26>;
template struct KdopMap<14>;
template struct KdopMap<18>;
template struct KdopMap<26>;
template KdopImage<14> image_of(const Kdop<14>&, const KdopMap<14>&);
template KdopImage<18> image_of(const Kdop<18>&, const KdopMap<18>&);
template KdopImage<26> image_of(const Kdop<26>&, const KdopMap<26>&);

} // namespace abut
