// What is prepared once gives the bits of what is computed anew.

#include "geometry/prepared_triangle.h"
#include "rigid/solid/prepared_faces.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

Triangle some_triangle(Random& random) {
    const double scale = random.chance(0.1) ? std::pow(2, random.uniform(-340, 340)) : 1;
    Triangle t = random.chance(0.3) ? random.lattice_triangle(2) : random.triangle();
    if (random.chance(0.2))
        t[2] = t[0] + random.uniform(-0.5, 1.5) * (t[1] - t[0]);
    if (random.chance(0.05))
        t[2] = t[0];
    for (Vec3& p : t)
        p = scale * p;
    return t;
}

Vec3 some_point(Random& random, const Triangle& t) {
    const double reach = 0x1p-340 + max_abs(t[0]) + max_abs(t[1]) + max_abs(t[2]);
    if (random.chance(0.3)) { // near the plane or in it
        const double g = random.uniform(-0.5, 1.5), h = random.uniform(-0.5, 1.5);
        return t[0] + g * (t[1] - t[0]) + h * (t[2] - t[0]);
    }
    if (random.chance(0.1))
        return t[static_cast<std::size_t>(random.integer(0, 2))];
    return random.chance(0.2) ? random.on_lattice(2) : reach * random.in_cube();
}

TEST(PreparedTriangle, same_bits) {
    Random random(20261123);
    std::array<int, 3> dimensions{}, sides{};
    for (int i = 0; i < many(200'000); ++i) {
        const Triangle t = some_triangle(random);
        const Vec3 p = some_point(random, t);
        const PreparedTriangle prepared(t);
        const NearestOnTriangle nearest = nearest_on_triangle(p, t);
        const ClosestPoints found = prepared.nearest(p);
        ASSERT_EQ(found.distance_sq, nearest.distance_sq) << i;
        ASSERT_EQ(prepared.distance_sq(p), nearest.distance_sq) << i;
        ASSERT_EQ(found.a, p) << i;
        ASSERT_EQ(found.b, nearest.point) << i;
        const int side = orient3d(t[0], t[1], t[2], p);
        ASSERT_EQ(prepared.side(p), side) << i;
        ++dimensions.at(nearest.dimension);
        ++sides.at(side < 0 ? 0U : side == 0 ? 1U : 2U);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_GT(dimensions.at(k), many(5'000)) << k;
        EXPECT_GT(sides.at(k), many(5'000)) << k;
    }
}

TEST(PreparedFaces, keeps_each_slot_apart) {
    const auto triangle = [](std::uint32_t slot) {
        const double x = slot;
        return Triangle{Vec3{x, 0, 0}, Vec3{x, 1, 0}, Vec3{x, 0, 1}};
    };
    Random random(7);
    PreparedFaces faces;
    int made = 0, asked = 0;
    for (int i = 0; i < 200'000; ++i) {
        // Few slots, then more than are kept.
        const auto slot = static_cast<std::uint32_t>(random.integer(0, i < 50'000 ? 500 : 50'000));
        const PreparedTriangle& face = faces.get(slot, [&] {
            ++made;
            return triangle(slot);
        });
        ++asked;
        ASSERT_EQ(face.corners(), triangle(slot)) << i;
    }
    EXPECT_GT(made, 50'000);
    EXPECT_LT(made, asked - 49'000);
}

} // namespace
} // namespace abut::test
