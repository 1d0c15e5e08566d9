// The thickness of a solid is the diameter of the largest ball in it.

#include "rigid/tolerance/overlap_within.h"
#include "tests/support/body.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>
#include <vector>

namespace abut::test {
namespace {

/// The prism over a star-shaped outline around the origin, from z = -2 to 2. In: radii of the
/// corners, at equal angles, counterclockwise.
Mesh star_prism(const std::vector<double>& radii) {
    Mesh m;
    const auto n = static_cast<std::uint32_t>(radii.size());
    for (const double z : {-2.0, 2.0}) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const double angle = 2 * std::numbers::pi * i / n;
            m.positions.push_back({radii[i] * std::cos(angle), radii[i] * std::sin(angle), z});
        }
        m.positions.push_back({0, 0, z});
    }
    const std::uint32_t top = n + 1;
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        m.triangles.push_back({i, j, top + j});
        m.triangles.push_back({i, top + j, top + i});
        m.triangles.push_back({n, j, i});
        m.triangles.push_back({top + n, top + i, top + j});
    }
    return m;
}

/// The cube from -1 to 1 with a pyramid cut out of each face. Its tip is `height` from the centre.
Mesh dented_cube(double height) {
    const Mesh cube = box_mesh({-1, -1, -1}, {1, 1, 1});
    Mesh m;
    m.positions = cube.positions;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            std::vector<std::uint32_t> corners;
            for (std::uint32_t i = 0; i < 8; ++i)
                if (component(cube.positions[i], axis) == sign)
                    corners.push_back(i);
            const Vec3 out =
                sign * Vec3{axis == 0 ? 1.0 : 0, axis == 1 ? 1.0 : 0, axis == 2 ? 1.0 : 0};
            const auto tip = static_cast<std::uint32_t>(m.positions.size());
            m.positions.push_back(height * out);
            for (std::size_t i = 0; i < 4; ++i)
                for (std::size_t j = 0; j < 4; ++j) {
                    const Vec3 &p = m.positions[corners[i]], &q = m.positions[corners[j]];
                    // Neighbours on the face, in the order that turns left as seen from outside.
                    if (length(q - p) < 2.5 && dot(cross(p, q), out) > 0)
                        m.triangles.push_back({corners[i], corners[j], tip});
                }
        }
    return m;
}

struct KnownThickness {
    const char* name;
    Mesh mesh;
    double thickness;
};

std::vector<KnownThickness> known_thicknesses() {
    const double spike = 1.5, notch = 0.4;
    return {
        {"box", box_mesh({-1, -0.2, -0.5}, {1, 0.2, 0.5}), 0.4},
        {"prism", prism_mesh(-1, 1, 0.3, 12), 0.6 * std::cos(std::numbers::pi / 12)},
        {"sphere", sphere_mesh(0.5, 48, 24), 0.5 * 2 * 0.9936},
        {"ring", ring_mesh(-1, 1, 0.5, 0.7, 36), 0.2 * std::cos(std::numbers::pi / 36)},
        // The ball touches edges at which the solid's angle exceeds 180 degrees, and nothing else.
        {"star", star_prism({spike, notch, spike, notch, spike, notch, spike, notch, spike, notch}),
         2 * notch},
        // The ball touches six vertices and nothing else.
        {"dented cube", dented_cube(0.35), 0.7},
    };
}

TEST(Thickness, LargestBallsOfKnownSolids) {
    const Body around(box_mesh({-5, -5, -5}, {5, 5, 5}));
    for (const KnownThickness& known : known_thicknesses())
        for (const Transform& world :
             {Transform{}, Transform(Pose{{0.1, 0.2, -0.3}, {0.5, 0.2, -0.6, 0.4}})}) {
            SCOPED_TRACE(known.name);
            const Body body(known.mesh, world);
            ASSERT_TRUE(body.placed.bounds_solid());
            EXPECT_EQ(nowhere_thicker(body.placed, around.placed, {0.98 * known.thickness}),
                      Proof::fails);
            EXPECT_EQ(nowhere_thicker(around.placed, body.placed, {0.98 * known.thickness}),
                      Proof::fails);
            EXPECT_EQ(nowhere_thicker(body.placed, around.placed, {1.03 * known.thickness}),
                      Proof::holds);
            EXPECT_EQ(nowhere_thicker(around.placed, body.placed, {1.03 * known.thickness}),
                      Proof::holds);
        }
}

TEST(Thickness, TolerancesNearTheThicknessAreDecided) {
    // Some solids have one shell inside out, so that outward() is 0.
    const Mesh floor = box_mesh({-0.5, -3, -3}, {0.5, 3, 3});
    std::vector<KnownThickness> all = known_thicknesses();
    for (const int sides : {12, 36}) {
        const double inradius = std::cos(std::numbers::pi / sides);
        const Mesh leg = prism_mesh(-1, 1, 0.3, sides), tube = ring_mesh(-1, 1, 0.5, 0.7, sides);
        const Mesh inside_out = reversed(box_mesh({-1, 2, 2}, {1, 2.1, 2.1}));
        all.push_back({"leg", joined(leg, inside_out), 0.6 * inradius});
        all.push_back(
            {"tube", joined(reversed(tube), box_mesh({-1, 2, 2}, {1, 2.1, 2.1})), 0.2 * inradius});
    }
    for (const KnownThickness& known : all)
        for (const Mesh& other : {floor, box_mesh({-5, -5, -5}, {5, 5, 5})})
            for (const double factor :
                 {0.9, 0.98, 0.99, 0.999, 1 - 1e-9, 1.0, 1 + 1e-9, 1.001, 1.1}) {
                SCOPED_TRACE(std::string(known.name) + " " + std::to_string(factor));
                const Body body(known.mesh), around(other);
                const double most = 1; // of the floor
                if (known.thickness > most)
                    continue;
                const Proof proof =
                    nowhere_thicker(body.placed, around.placed, {factor * known.thickness});
                EXPECT_NE(proof, Proof::open);
                if (factor < 1 / (1 + 0x1p-6)) {
                    EXPECT_EQ(proof, Proof::fails);
                }
                if (factor > 1.001) {
                    EXPECT_EQ(proof, Proof::holds);
                }
            }
}

TEST(Thickness, NormalsMayPointInwardOrBothWays) {
    const Body around(box_mesh({-5, -5, -5}, {5, 5, 5}));
    Mesh mixed = box_mesh({-1, -0.2, -0.5}, {1, 0.2, 0.5});
    for (std::size_t i = 0; i < mixed.triangles.size(); i += 3)
        std::swap(mixed.triangles[i][1], mixed.triangles[i][2]);
    for (const Mesh& mesh : {reversed(box_mesh({-1, -0.2, -0.5}, {1, 0.2, 0.5})), mixed}) {
        const Body body(mesh);
        EXPECT_EQ(nowhere_thicker(body.placed, around.placed, {0.39}), Proof::fails);
        EXPECT_EQ(nowhere_thicker(body.placed, around.placed, {0.41}), Proof::holds);
    }
}

TEST(Thickness, BudgetsThatAreUsedUpLeaveTheQuestionOpen) {
    const Body a(sphere_mesh(1, 32, 16)), b(sphere_mesh(1.001, 30, 18));
    EXPECT_EQ(everywhere_near(a.placed, b.placed, {0.02, 10}), Proof::open);
    EXPECT_EQ(everywhere_near(a.placed, b.placed, {0.02}), Proof::holds);
    EXPECT_EQ(everywhere_near(a.placed, b.placed, {1e-4}), Proof::fails);
}

} // namespace
} // namespace abut::test
