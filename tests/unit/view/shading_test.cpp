// The error of a simplified surface because of its shade, in scenes worked by hand.
#include "math/vector.h"
#include "tests/support/shapes.h"
#include "view/levels/shaded_mesh.h"
#include "view/simplify/shading.h"
#include "view/simplify/simplify_surface.h"

#include <cmath>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

constexpr double kLength = 8, kPitch = 0.25, kDepth = 0.0625;
constexpr int kWaves = 64;

/// A sheet in the plane z = 0 with waves along x. Its normals are those of the faces.
///
/// In          depth: of the waves; 0: a flat sheet.
ShadedTriangles sheet(double depth) {
    ShadedTriangles result;
    const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        const Vec3 normal = normalized_or_zero(cross(b - a, c - a));
        result.triangles.push_back({a, b, c});
        result.normals.push_back({normal, normal, normal});
    };
    for (int i = 0; i < 2 * kWaves; ++i) {
        const double x = i * kPitch / 2, low = i % 2 == 0 ? 0 : depth, high = depth - low;
        const Vec3 a{x, 0, low}, b{x + kPitch / 2, 0, high}, c{x + kPitch / 2, kLength, high},
            d{x, kLength, low};
        add(a, b, c), add(a, c, d);
    }
    return result;
}

ShadedTriangles flat(double height, const Vec3& normal) {
    const double width = kWaves * kPitch;
    const Vec3 a{0, 0, height}, b{width, 0, height}, c{width, kLength, height},
        d{0, kLength, height};
    return {{{a, b, c}, {a, c, d}}, {{normal, normal, normal}, {normal, normal, normal}}};
}

double error_of(const ShadedTriangles& surface, const ShadedTriangles& shown, double least = 0) {
    return shading_error(surface, shown, TriangleSearch(shown.triangles), least);
}

TEST(Shading, OfOneShadeIsNoError) {
    const ShadedTriangles waves = sheet(kDepth);
    EXPECT_EQ(error_of(waves, waves), 0);
    EXPECT_EQ(error_of(sheet(0), flat(0, {0, 0, 1})), 0);
    EXPECT_EQ(error_of(sheet(0), flat(0, {0, 0, -1})), 0) << "shaded from both sides";
    EXPECT_EQ(error_of(sheet(0.02), flat(0.01, {0, 0, 1})), 0) << "9 degrees show nothing";
}

TEST(Shading, OfWavesThatBecomeFlatIsAnError) {
    // All faces are turned by atan(0.5), 27 degrees: the error is a quarter of the side of a square
    // of their area.
    const double slope = std::hypot(kPitch / 2, kDepth) / (kPitch / 2);
    const double area = kWaves * kPitch * kLength * slope;
    EXPECT_NEAR(error_of(sheet(kDepth), flat(kDepth / 2, {0, 0, 1})), 0.25 * std::sqrt(area), 1e-9);
    // A normal across the waves agrees with none of them either.
    EXPECT_NEAR(error_of(sheet(kDepth), flat(kDepth / 2, {0, 1, 0})), 0.25 * std::sqrt(area), 1e-9);
    // With the normal of one side of each wave, the other side is wrong.
    const Vec3 side = sheet(kDepth).normals[0][0];
    EXPECT_NEAR(error_of(sheet(kDepth), flat(kDepth / 2, side)), 0.25 * std::sqrt(area / 2), 1e-9);
}

TEST(Shading, BelowTheLeastIsNoError) {
    const double whole = error_of(sheet(kDepth), flat(kDepth / 2, {0, 0, 1}));
    EXPECT_EQ(error_of(sheet(kDepth), flat(kDepth / 2, {0, 0, 1}), 1.001 * whole), 0);
    EXPECT_EQ(error_of(sheet(kDepth), flat(kDepth / 2, {0, 0, 1}), 0.999 * whole), whole);
}

TEST(Shading, OfDegenerateTrianglesIsFinite) {
    const Vec3 p{1, 2, 3};
    const ShadedTriangles point{{{p, p, p}}, {{Vec3{}, Vec3{}, Vec3{}}}};
    const ShadedTriangles waves = sheet(kDepth);
    EXPECT_EQ(error_of(point, waves), 0);
    EXPECT_EQ(error_of(point, point), 0);
    EXPECT_TRUE(std::isfinite(error_of(waves, point)));
}

/// The surface of a mesh, as levels are made from it.
LevelSurface surface_of(const Mesh& mesh) {
    LevelSurface surface;
    surface.parts = {1};
    surface.errors = {0};
    add_shaded(mesh, Transform(), 0, surface);
    return surface;
}

TEST(Shading, CountsInTheErrorOfALevel) {
    // Waves of 6 cm over 16 x 8 metres: what is farther than 6 cm from nothing still looks different.
    Mesh waves;
    for (const Triangle& t : sheet(kDepth).triangles) {
        const auto base = static_cast<std::uint32_t>(waves.positions.size());
        waves.positions.insert(waves.positions.end(), t.begin(), t.end());
        waves.triangles.push_back({base, base + 1, base + 2});
    }
    const SimplifiedSurface fewer = simplify(surface_of(waves), 64);
    EXPECT_LE(fewer.surface.triangles.size(), 64U);
    EXPECT_GT(fewer.error, 0.5);
    // A ball keeps its normals: its error is one of places, a small part of its size.
    const LevelSurface ball = surface_of(sphere_mesh(1, 64, 48));
    const SimplifiedSurface round =
        simplify(ball, static_cast<std::uint32_t>(ball.triangles.size() / 4));
    EXPECT_LE(round.surface.triangles.size(), ball.triangles.size() / 4);
    EXPECT_GT(round.error, 0);
    EXPECT_LT(round.error, 0.02);
}

} // namespace
} // namespace abut::test
