#include "simulator/container.h"

#include <cmath>
#include <random>

namespace simulation {

namespace {

constexpr double kSpacing = 0.35; ///< of the lattice
constexpr double kDensity = 500;  ///< kg/m^3

int bodies_of_row(int bodies) {
    return std::max(2, static_cast<int>(std::cbrt(static_cast<double>(bodies))));
}

} // namespace

double half_width(int bodies) {
    return 0.5 * kSpacing * (bodies_of_row(bodies) + 1);
}

void fill_container(Stage& stage, int bodies) {
    const auto add = [&](const auto& shape, const Pose& pose, double density) {
        stage.add(shape, pose, {.density = density});
    };
    const double w = half_width(bodies), thick = 0.5, high = 4 * w;
    const double wide = w + 2 * thick;
    add(abut::Box3{{-wide, -wide, -thick}, {wide, wide, thick}}, {{0, 0, -thick}}, 0);
    for (const double side : {-1.0, 1.0}) {
        add(abut::Box3{{-thick, -wide, 0}, {thick, wide, high}}, {{side * (w + thick), 0, 0}}, 0);
        add(abut::Box3{{-wide, -thick, 0}, {wide, thick, high}}, {{0, side * (w + thick), 0}}, 0);
    }
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const int row = bodies_of_row(bodies);
    for (int i = 0; i < bodies; ++i) {
        const auto along = [&](int k) { return kSpacing * (k - 0.5 * (row - 1)); };
        const double q[4] = {uniform(random), uniform(random), uniform(random), uniform(random)};
        const Pose pose{{along(i % row) + 0.02 * uniform(random),
                         along(i / row % row) + 0.02 * uniform(random),
                         0.3 + kSpacing * std::floor(static_cast<double>(i) / (row * row))},
                        {q[0], q[1], q[2], q[3]}};
        if (i % 3 == 0)
            add(abut::Sphere{{}, 0.1}, pose, kDensity);
        else if (i % 3 == 1)
            add(abut::Capsule{{{0, 0, -0.07}, {0, 0, 0.07}}, 0.06}, pose, kDensity);
        else
            add(abut::Box3{{-0.1, -0.07, -0.06}, {0.1, 0.07, 0.06}}, pose, kDensity);
    }
}

} // namespace simulation
