#include "suites/long_motion_rows.h"

#include <abut/motion.h>

#include "measure.h"

#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <numbers>
#include <string>
#include <utility>

namespace abut::bench {

namespace {

using std::numbers::pi;

/// A grid of nu x nv squares of two triangles each. In: point(u, v), with u and v in [0, 1].
template <typename Point>
Mesh surface(std::uint32_t nu, std::uint32_t nv, const Point& point) {
    Mesh mesh;
    for (std::uint32_t j = 0; j <= nv; ++j)
        for (std::uint32_t i = 0; i <= nu; ++i)
            mesh.positions.push_back(point(double(i) / nu, double(j) / nv));
    for (std::uint32_t j = 0; j < nv; ++j)
        for (std::uint32_t i = 0; i < nu; ++i) {
            const std::uint32_t k = j * (nu + 1) + i;
            mesh.triangles.push_back({k, k + 1, k + nu + 2});
            mesh.triangles.push_back({k, k + nu + 2, k + nu + 1});
        }
    return mesh;
}
Mesh ball(std::uint32_t around, std::uint32_t rings) {
    return surface(around, rings, [](double u, double v) {
        return Vec3{std::sin(pi * v) * std::cos(2 * pi * u),
                    std::sin(pi * v) * std::sin(2 * pi * u), std::cos(pi * v)};
    });
}
Mesh cylinder(double radius, std::uint32_t sides) {
    return surface(sides, 1, [&](double u, double v) {
        return Vec3{radius * std::cos(2 * pi * u), radius * std::sin(2 * pi * u), 4 * v - 2};
    });
}
Mesh floor_at(double height, double half, std::uint32_t squares) {
    return surface(squares, squares, [&](double u, double v) {
        return Vec3{half * (2 * u - 1), half * (2 * v - 1), height};
    });
}
Mesh box(double half, double thickness) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.push_back({(i & 1) != 0 ? half : -half, (i & 2) != 0 ? half : -half,
                                  (i & 4) != 0 ? thickness : -thickness});
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}
Mesh needle(double half, double height) {
    return {{{-half, 0, height}, {half, 0, height}, {half, 1e-3, height}}, {{0, 1, 2}}};
}
Motion spin(const Vec3& w, const Vec3& velocity = {}) {
    return {{}, {}, velocity, w};
}

struct LongMotionCase {
    std::string name;
    Mesh mesh_a;
    Motion motion_a;
    Mesh mesh_b;
    Motion motion_b;
    double tolerance;
};

Row measure(const LongMotionCase& c, int rounds) {
    const Model a(c.mesh_a), b(c.mesh_b);
    std::vector<double> seconds;
    Impact impact;
    for (int round = 0; round < rounds; ++round) {
        const double start = thread_seconds();
        impact = time_of_impact(a, c.motion_a, b, c.motion_b, {.absolute_error = c.tolerance});
        seconds.push_back(thread_seconds() - start);
    }
    Row row{c.name, 1e3 * median(seconds), {}, {}, "ms", 1, {}};
    row.counters["steps"] = static_cast<double>(impact.steps);
    row.counters["hit"] = impact.meet ? 1 : 0;
    row.counters["undecided"] = impact.status == Status::bound_only ? 1 : 0;
    return row;
}

} // namespace

std::vector<Row> long_motion_rows(int rounds) {
    std::vector<Row> rows;
    const auto add = [&](const LongMotionCase& c) { rows.push_back(measure(c, rounds)); };
    const Pose beside{{0.3, 4, 2}, {1, 0, 0, 0}};
    const Motion still = Motion::fixed({}), at_side = Motion::fixed(beside);
    const Motion towards{beside, beside.translation, {0.1, -1, 0.2}, {1, 2, 3}};
    for (const double size : {1e2, 1e3, 1e4, 1e5, 3e5, 1e6}) {
        const Mesh plate = box(size, 1e-9 * size);
        add({fmt::format("plate of half-width {:g} turns, ball of 120 triangles", size), plate,
             spin({0.6, 0.1, 0.2}), ball(10, 6), at_side, 8e-5});
        add({fmt::format("plate of half-width {:g}, ball of 120 triangles, both turn", size), plate,
             spin({0.6, 0.1, 0.2}), ball(10, 6), towards, 8e-5});
        add({fmt::format("plate of half-width {:g} turns, ball of 19,200 triangles", size), plate,
             spin({0.6, 0.1, 0.2}), ball(120, 80), at_side, 8e-5});
    }
    for (const double size : {1e1, 1e3, 1e5})
        add({fmt::format("needles of half-length {:g} turn past each other", size), needle(size, 0),
             spin({1, 1, 2}), needle(size, 1e-3), still, 1e-4});
    for (const double tolerance : {1e-4, 1e-3})
        add({fmt::format("floors of 800 triangles slide 1.1e-4 apart, tolerance {:g}", tolerance),
             floor_at(0, 100, 20), spin({0, 0, 1}, {0.1, 0.2, 0}), floor_at(1.1e-4, 100, 20), still,
             tolerance});
    for (const double gap : {1e-2, 1e-4, 1e-6, 1e-8})
        for (const double tolerance : {1e-9, 2 * gap})
            add({fmt::format("cylinders of 32 sides turn {:g} apart, tolerance {:g}", gap,
                             tolerance),
                 cylinder(1, 32), spin({0, 0, -2}), cylinder(std::cos(pi / 32) - gap, 32),
                 spin({0, 0, 3}, {0, 0, 0.1}), tolerance});
    return rows;
}

} // namespace abut::bench
