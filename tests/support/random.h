#pragma once

#include "math/transform.h"
#include "math/vector.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <random>

namespace abut::test {

/// Random numbers for a test. Prints the seed, which ABUT_TEST_SEED in the environment replaces.
class Random {
public:
    explicit Random(std::uint64_t seed) {
        // NOLINTNEXTLINE(concurrency-mt-unsafe): tests set no environment
        if (const char* text = std::getenv("ABUT_TEST_SEED"))
            seed = std::strtoull(text, nullptr, 10);
        std::cout << "seed " << seed << '\n';
        engine_.seed(seed);
    }

    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    /// Both bounds are included.
    int integer(int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(engine_);
    }
    bool chance(double p) { return uniform(0, 1) < p; }
    std::uint64_t bits() { return engine_(); }

    Vec3 in_cube(double half = 1) {
        const double x = uniform(-half, half), y = uniform(-half, half), z = uniform(-half, half);
        return {x, y, z};
    }
    Vec3 on_lattice(int n) {
        const int x = integer(0, n), y = integer(0, n), z = integer(0, n);
        return {double(x), double(y), double(z)};
    }
    Vec3 direction() {
        const double z = uniform(-1, 1), angle = uniform(0, 2 * std::numbers::pi);
        const double r = std::sqrt(1 - z * z);
        return {r * std::cos(angle), r * std::sin(angle), z};
    }
    Triangle triangle(double half = 1) {
        const Vec3 a = in_cube(half), b = in_cube(half), c = in_cube(half);
        return {a, b, c};
    }
    Triangle lattice_triangle(int n) {
        const Vec3 a = on_lattice(n), b = on_lattice(n), c = on_lattice(n);
        return {a, b, c};
    }
    Pose pose(double reach) {
        const Vec3 d = direction();
        const double angle = uniform(0, std::numbers::pi);
        const Vec3 q = std::sin(angle) * d;
        return {in_cube(reach), {std::cos(angle), q.x, q.y, q.z}};
    }
    /// A rotation. If `affine`, it also scales and shears, and in half of the cases mirrors.
    Transform linear_map(bool affine) {
        const Transform rotation = pose(0);
        if (!affine)
            return rotation;
        const double mirror = chance(0.5) ? -1 : 1;
        return compose(
            rotation, Transform({mirror * uniform(0.2, 3), uniform(-1, 1), 0, uniform(-1, 1),
                                 uniform(0.2, 3), 0, 0, uniform(-1, 1), uniform(0.2, 3), 0, 0, 0}));
    }
    /// A double at most `ulps` units in the last place away.
    double nudge(double v, int ulps) {
        for (int i = integer(-ulps, ulps); i != 0; i += i > 0 ? -1 : 1)
            v = std::nextafter(v, i > 0 ? HUGE_VAL : -HUGE_VAL);
        return v;
    }
    Vec3 nudge(const Vec3& p, int ulps) {
        const double x = nudge(p.x, ulps), y = nudge(p.y, ulps), z = nudge(p.z, ulps);
        return {x, y, z};
    }

private:
    std::mt19937_64 engine_;
};

inline double size_of(const Triangle& a, const Triangle& b) {
    Box3 box;
    for (std::size_t i = 0; i < 3; ++i)
        extend(box, a[i]), extend(box, b[i]);
    const Vec3 d = box.upper - box.lower;
    return std::max({d.x, d.y, d.z});
}

} // namespace abut::test
