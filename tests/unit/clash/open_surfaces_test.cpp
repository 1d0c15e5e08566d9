// Kinds and depths of two open surfaces that cross, for many triangulations of the same surfaces.

#include "tests/support/classified_pair.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace abut::test {
namespace {

using enum ClashKind;
using Polygon2 = std::vector<std::array<double, 2>>;

/// The ways in which convex_floor() divides a polygon into triangles.
constexpr int kDivisions = 5;

/// A convex polygon in the plane z = 0.
Mesh convex_floor(const Polygon2& corners, int division) {
    Mesh m;
    const auto n = static_cast<std::uint32_t>(corners.size());
    for (const auto& [x, y] : corners)
        m.positions.push_back({x, y, 0});
    if (division < 3) { // a fan around a corner
        const auto first = static_cast<std::uint32_t>(division);
        for (std::uint32_t i = 1; i + 1 < n; ++i)
            m.triangles.push_back({first, (first + i) % n, (first + i + 1) % n});
        return m;
    }
    m.positions.push_back({0, 0, 0}); // a fan around the middle
    for (std::uint32_t i = 0; i < n; ++i)
        m.triangles.push_back({n, i, (i + 1) % n});
    if (division == 3)
        return m;
    Mesh fine{m.positions, {}}; // each triangle in three, at an uneven point
    for (const auto& [p, q, r] : m.triangles) {
        const auto inner = static_cast<std::uint32_t>(fine.positions.size());
        fine.positions.push_back(0.3 * m.positions[p] + 0.6 * m.positions[q] +
                                 0.1 * m.positions[r]);
        for (const auto& [s, t] : {std::pair{p, q}, {q, r}, {r, p}})
            fine.triangles.push_back({s, t, inner});
    }
    return fine;
}

/// Walls on some sides of a polygon, from z = -1 to 1, each in n columns and m rows.
Mesh walls_around(const Polygon2& corners, unsigned sides, int n, int m) {
    Mesh walls;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if ((sides >> i & 1) == 0)
            continue;
        const auto [x, y] = corners[i];
        const auto [end_x, end_y] = corners[(i + 1) % corners.size()];
        const Vec3 p{x, y, -1}, along{end_x - x, end_y - y, 0};
        walls = joined(walls, grid_mesh(n, m, false, false, [&](double u, double v) {
                           return p + u * along + Vec3{0, 0, 2 * v};
                       }));
    }
    return walls;
}

Polygon2 ring(int n, double radius, double turned) {
    Polygon2 corners;
    for (int i = 0; i < n; ++i) {
        const double angle = turned + 2 * std::numbers::pi * i / n;
        corners.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return corners;
}

/// A line of points (y, z), extruded along x.
Mesh profile(const Polygon2& points, double from, double to, int columns) {
    Mesh m;
    for (std::size_t k = 0; k + 1 < points.size(); ++k)
        m = joined(
            m, grid_mesh(columns, 1, false, false, [&](double u, double v) {
                const auto [y, z] = points[k];
                const auto [end_y, end_z] = points[k + 1];
                return Vec3{from + u * (to - from), y + v * (end_y - y), z + v * (end_z - z)};
            }));
    return m;
}

const std::vector<Transform> kPlaces{{},
                                     Pose{{3, -2, 5}, {0.8, 0.1, -0.5, 0.3}},
                                     Pose{{2e4, -1e4, 30}, {0.9, 0.3, 0.2, 0.1}},
                                     Pose{{0x1p20, -0x1p17, 0x1p13}, {1, 0, 0, 0}}};

std::string kind_word(const std::optional<Clash>& clash) {
    return clash ? std::string(to_string(clash->kind)) : "none";
}

/// Expects a kind and a depth for either order, in all places.
void expect_overlap(const Mesh& a, const Mesh& b, double t, ClashKind kind, double depth) {
    for (const Transform& world : kPlaces) {
        const auto clash = classified(a, b, t, world, world),
                   swapped = classified(b, a, t, world, world);
        ASSERT_EQ(kind_word(clash), to_string(kind));
        ASSERT_EQ(kind_word(swapped), to_string(kind));
        ASSERT_EQ(clash->distance, swapped->distance);
        // Positions are rounded by 2^-33 at the farthest place.
        ASSERT_NEAR(-clash->distance, depth, 1e-8);
    }
}

TEST(OpenSurfaces, FloorsWhoseBordersRestInWalls) {
    for (const int n : {3, 4, 8, 24})
        for (const double turned : {std::numbers::pi / n, 0.1})
            for (const double beyond : {0.0, 1e-3}) {
                // The corners of the floor are as far from those of the walls.
                const Polygon2 inner = ring(n, 1, turned), outer = ring(n, 1 + beyond, turned);
                for (int division = 0; division < kDivisions; ++division)
                    for (const auto& [columns, rows] : {std::pair{1, 1}, {3, 2}}) {
                        SCOPED_TRACE(std::to_string(n) + " " + std::to_string(division) + " " +
                                     std::to_string(columns));
                        const Mesh floor = convex_floor(outer, division),
                                   walls = walls_around(inner, ~0U, columns, rows);
                        expect_overlap(floor, walls, 1.02e-3, touch, beyond);
                        if (beyond > 0)
                            expect_overlap(floor, walls, 0.98e-3, hard, beyond);
                    }
            }
}

TEST(OpenSurfaces, WallsOnSomeSidesOfAFloor) {
    const Polygon2 square{{{1, 1}}, {{-1, 1}}, {{-1, -1}}, {{1, -1}}};
    for (unsigned sides = 1; sides < 16; ++sides)
        for (int division = 0; division < kDivisions; ++division) {
            SCOPED_TRACE(std::to_string(sides) + " " + std::to_string(division));
            expect_overlap(convex_floor(square, division), walls_around(square, sides, 1, 1), 1e-6,
                           touch, 0);
        }
}

/// A mesh with its positions turned and rounded to single precision, as many files have them.
Mesh rounded(Mesh mesh, const Pose& turn) {
    const Transform world = turn;
    for (Vec3& p : mesh.positions) {
        p = apply(world, p);
        p = {double{static_cast<float>(p.x)}, double{static_cast<float>(p.y)},
             double{static_cast<float>(p.z)}};
    }
    return mesh;
}

TEST(OpenSurfaces, TwoWallsWhoseBordersAreInOneLineButForRounding) {
    // A plate lies between the walls, passes through one of them, and leaves both over their ends. Half-way
    // between the walls it is farthest; beyond the ends it goes 2 on.
    const auto wall = [](double x) {
        return grid_mesh(1, 1, false, false, [&](double u, double v) {
            return Vec3{x, u, -0.75 + 1.5 * v};
        });
    };
    const Mesh walls = joined(wall(0), wall(1)),
               plate = grid_mesh(1, 1, false, false, [](double u, double v) {
                   return Vec3{-1 + 1.875 * u, 0.5 + 2.5 * v, 0};
               });
    constexpr double kRounding = 0x1p-22; // of points no farther than 4
    for (int i = 0; i < 20; ++i) {
        SCOPED_TRACE(i);
        const double angle = 0.1 + 0.3 * i;
        const Pose turn{{}, {std::cos(angle), 0.3 * std::sin(angle), std::sin(angle), 0.1 * i}};
        const Mesh a = rounded(walls, turn), b = rounded(plate, turn);
        const auto above = classified(a, b, 0.55, {}, {}, 0, kRounding),
                   below = classified(b, a, 0.45, {}, {}, 0, kRounding);
        ASSERT_EQ(kind_word(above), "touch");
        ASSERT_EQ(kind_word(below), "hard");
        ASSERT_NEAR(below->distance, -0.5, 1e-5);
    }
}

TEST(OpenSurfaces, APlateBesideAFlange) {
    // The plate passes through the leg of an L, 0.125 over its flange, and ends over the flange's end,
    // or goes on beyond it. Over either end of the L, or at its own, it leaves the L sideways.
    const double d = 0.125;
    for (const Polygon2& l : {Polygon2{{{1, 0}}, {{2, 0}}, {{2, 1}}},
                              Polygon2{{{1, 0}}, {{1.5, 0}}, {{2, 0}}, {{2, 0.5}}, {{2, 1}}}})
        for (const Polygon2& plate :
             {Polygon2{{{3, d}}, {{1, d}}}, Polygon2{{{3, d}}, {{2, d}}, {{1, d}}},
              Polygon2{{{3, d}}, {{0, d}}}})
            for (const auto& [from, to] :
                 {std::pair{2.0, 5.0}, {0.0, 4.0}, {-1.0, 5.0}, {1.0, 3.0}})
                for (const int columns : {1, 2}) {
                    const Mesh a = profile(l, 0, 4, columns), b = profile(plate, from, to, 1);
                    expect_overlap(a, b, 0.99 * d, hard, d);
                    expect_overlap(a, b, 1.01 * d, touch, d);
                }
}

TEST(OpenSurfaces, AChannelSunkIntoAPlate) {
    const double d = 1.0 / 64;
    const Polygon2 channel{{{-1, 1}}, {{-0.2, -d}}, {{0.2, -d}}, {{1, 1}}};
    for (const double seam : {0.0, 0.1, 0.2, 1.0})
        for (const auto& [from, to] : {std::pair{-1.0, 9.0}, {4.0, 9.0}, {0.0, 8.0}})
            for (const double begin : {-3.0, 0.0}) { // over the channel, or from its middle
                const Mesh a = profile(channel, 0, 8, 1),
                           b = profile({{{begin, 0}}, {{begin + 0.5 * seam, 0}}, {{3, 0}}}, from,
                                       to, 1);
                expect_overlap(a, b, 0.99 * d, hard, d);
                expect_overlap(a, b, 1.01 * d, touch, d);
            }
}

TEST(OpenSurfaces, TheDepthIsOneNumber) {
    // A wall that goes 0.5 below the floor and 0.25 over it; the floor goes on on both sides.
    for (const int n : {1, 2, 5})
        for (const int m : {1, 3}) {
            const Mesh floor = grid_mesh(n, m, false, false,
                                         [](double u, double v) {
                                             return Vec3{6 * u - 3, 4 * v - 2, 0};
                                         }),
                       wall = grid_mesh(m, n, false, false, [](double u, double v) {
                           return Vec3{2 * u - 1, 0.5, 0.75 * v - 0.5};
                       });
            for (const double t : {1e-9, 1e-4, 0.24})
                expect_overlap(floor, wall, t, hard, 0.25);
            expect_overlap(floor, wall, 0.3, touch, 0.25);
        }
}

TEST(OpenSurfaces, EndAtTheSolidsOfTheOtherPart) {
    // A plate goes 1/32 beyond a fin, and 1/16 more into a box that the fin goes through, ends at, or lies
    // on. What of the plate is inside the box is no way around the fin.
    const double reach = 1.0 / 32;
    for (const double in_box : {1.0 / 16, 0.0})
        for (const double from : {-1.0, 0.5}) {
            SCOPED_TRACE(std::to_string(in_box) + ' ' + std::to_string(from));
            const Mesh plate = grid_mesh(1, 1, false, false, [&](double u, double v) {
                return Vec3{u * (1 + reach) - 1, 1.5 * v - 0.75, 0};
            });
            const Mesh fin = grid_mesh(1, 1, false, false, [&](double u, double v) {
                return Vec3{0, from + u * (1 - from), 2 * v - 1};
            });
            const Mesh both = joined(fin, box_mesh({-in_box, -0.5, -0.5}, {1, 0.5, 0.25}));
            for (const Transform& world : kPlaces)
                for (const bool swap : {false, true})
                    for (const auto& [tolerance, kind] : {std::pair(0.1, touch), {0.015, hard}}) {
                        const auto clash = classified(swap ? both : plate, swap ? plate : both,
                                                      tolerance, world, world);
                        EXPECT_EQ(kind_word(clash), to_string(kind));
                        EXPECT_NEAR(-clash->distance, reach + in_box, 1e-6 * (reach + in_box));
                    }
        }
}

/// A polygon as a fan around each of its corners.
std::vector<Mesh> fans(const std::vector<Vec3>& corners) {
    std::vector<Mesh> fans;
    const auto n = static_cast<std::uint32_t>(corners.size());
    for (std::uint32_t first = 0; first < n; ++first) {
        fans.push_back({corners, {}});
        for (std::uint32_t i = 1; i + 1 < n; ++i)
            fans.back().triangles.push_back({first, (first + i) % n, (first + i + 1) % n});
    }
    return fans;
}

TEST(OpenSurfaces, TheBordersOfANarrowStripAreNotJoinedBeyondItsEnd) {
    // Beyond a strip's end, its corner is as near as both borders that meet there. The planes over these
    // borders end where the other surface's triangle does; no line leads from one to the other.
    struct Case {
        std::vector<Vec3> a, b;
        double depth; ///< of the planar polygons, by exact arithmetic
    };
    const std::vector<Case> cases{
        {{{1.03125, -0.453125, -0.34375},
          {0.0625, -0.609375, 1.5},
          {0.046875, -0.59375, 1.484375},
          {1.015625, -0.4375, -0.359375}},
         {{1.8984375, -1.4140625, -0.828125},
          {1.8984375, -1.4140625, 0.9375},
          {-0.0703125, 0.5859375, 0.3125},
          {-0.0703125, 0.5859375, -1.453125}},
         0.056110941916137996},
        {{{-0.0048828125, -0.25, 0},
          {0.5, -0.25, 0},
          {0.5, 0.2578125, 0},
          {-0.0048828125, 0.2578125, 0}},
         {{0.0029296875, -0.23354721069335938, -0.10919189453125},
          {-0.0078125, 1.132354736328125, 0.5294113159179688},
          {0.0029296875, 1.132354736328125, 0.5294113159179688}},
         0.10588325611415383},
        {{{-1.25, -0.001220703125, 0},
          {0.25, -0.001220703125, 0},
          {1.75, -0.000244140625, 0},
          {1.75, 0.000732421875, 0},
          {-1.25, 0.000732421875, 0}},
         {{-0.001953125, 0.0018024444580078125, -0.000751495361328125},
          {0.0029296875, 0.0018024444580078125, -0.000751495361328125},
          {0.0029296875, -0.00045013427734375, 0.00018787384033203125},
          {-0.001953125, -0.00045013427734375, 0.00018787384033203125}},
         0.00018787384033203125},
    };
    for (const auto& [a, b, depth] : cases)
        for (const Mesh& of_a : fans(a))
            for (const Mesh& of_b : fans(b))
                for (const double rounding : {0.0, 1e-7}) {
                    const auto clash = classified(of_a, of_b, 0.9 * depth, {}, {}, 0, rounding);
                    EXPECT_EQ(kind_word(clash), "hard") << depth;
                    EXPECT_NEAR(-clash->distance, depth, 4e-5 * depth) << depth;
                    EXPECT_EQ(kind_word(classified(of_a, of_b, 1.1 * depth, {}, {}, 0, rounding)),
                              "touch");
                }
}

TEST(OpenSurfaces, ThinFacesAndVerticesOnEdgesAreNoGaps) {
    // The floor has a vertex of one half on the edge of the other one, or a thin face between them.
    const double t = 1e-3;
    for (const bool filled : {false, true})
        for (const double reach : {0.9 * t, 1.1 * t}) {
            Mesh floor{{{-1, -1, 0},
                        {1, -1, 0},
                        {1, 0, 0},
                        {-1, 0, 0},
                        {0.3, 0, 0},
                        {1, 1, 0},
                        {-1, 1, 0}},
                       {{0, 1, 2}, {0, 2, 3}, {4, 2, 5}, {3, 4, 6}, {4, 5, 6}}};
            if (filled)
                floor.triangles.push_back({3, 2, 4});
            const Mesh wall = grid_mesh(1, 1, false, false, [&](double u, double v) {
                return Vec3{u - 0.4, 2 * v - 1.5, u * 0.5 - reach};
            });
            const Mesh upright = grid_mesh(1, 1, false, false, [&](double u, double v) {
                return Vec3{u - 0.4, 0, v - reach};
            });
            expect_overlap(floor, upright, t, reach < t ? touch : hard, reach);
            EXPECT_EQ(kind_word(classified(floor, wall, t)), reach < t ? "touch" : "hard");
        }
}

} // namespace
} // namespace abut::test
