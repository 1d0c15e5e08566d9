// The kinds of docs/clash.md at a touch tolerance t, just within it and just beyond it.

#include "tests/support/classified_pair.h"
#include "tests/support/sanitizer.h"

#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace abut::test {
namespace {

using enum ClashKind;

/// Two meshes that differ from exact contact by `by`.
struct TouchCase {
    const char* name;
    Mesh (*first)(double by);
    Mesh (*second)(double by);
    double just_within, just_beyond; ///< `by` over t
    std::optional<ClashKind> within, beyond;
};

/// A body that fills a groove: x in [-1, 1], z >= 0, with a groove of depth 1.
Mesh groove_mesh() {
    // The outline in the xz plane, counterclockwise, extruded along y from 0 to 2.
    const std::vector<std::array<double, 2>> outline{{-2, -1}, {2, -1}, {2, 1},  {1, 1},
                                                     {1, 0},   {-1, 0}, {-1, 1}, {-2, 1}};
    Mesh m;
    const auto n = static_cast<std::uint32_t>(outline.size());
    for (const double y : {0.0, 2.0})
        for (const auto& [x, z] : outline)
            m.positions.push_back({x, y, z});
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        m.triangles.push_back({i, n + j, j});
        m.triangles.push_back({i, n + i, n + j});
    }
    for (const auto& t : std::vector<std::array<std::uint32_t, 3>>{
             {0, 1, 4}, {1, 2, 3}, {1, 3, 4}, {0, 4, 5}, {0, 5, 7}, {5, 6, 7}}) {
        m.triangles.push_back(t);
        m.triangles.push_back({n + t[0], n + t[2], n + t[1]});
    }
    return m;
}

const std::vector<TouchCase> kTouchCases{
    {"wall in slab",
     [](double by) {
         return box_mesh({0, 0, -by}, {4, 0.3, 3});
     },
     [](double) {
         return box_mesh({-2, -2, -0.5}, {6, 2, 0});
     },
     0.9, 1.1, touch, hard},
    {"wall over slab",
     [](double by) {
         return box_mesh({0, 0, by}, {4, 0.3, 3});
     },
     [](double) {
         return box_mesh({-2, -2, -0.5}, {6, 2, 0});
     },
     0.9, 1.1, touch, std::nullopt},
    {"wall at the end of a slab",
     [](double by) {
         return box_mesh({-by, -2, -1}, {0.3, 2, 0});
     },
     [](double) {
         return box_mesh({-4, -2, -0.5}, {0, 2, 0});
     },
     0.9, 1.1, touch, hard},
    {"copy beside itself",
     [](double by) {
         return box_mesh({by, 0, 0}, {4 + by, 0.3, 3});
     },
     [](double) {
         return box_mesh({0, 0, 0}, {4, 0.3, 3});
     },
     0.9, 1.1, duplicate, hard},
    {"copy that is larger all round",
     [](double by) {
         return box_mesh({-by, -by, -by}, {4 + by, 2 + by, 3 + by});
     },
     [](double) {
         return box_mesh({0, 0, 0}, {4, 2, 3});
     },
     0.5, 1.1, duplicate, contained},
    {"bar in a sleeve", [](double by) { return prism_mesh(-2, 2, 0.5 + by, 24); },
     [](double) { return ring_mesh(-1, 1, 0.5, 1, 24); }, 0.9, 1.1, touch, hard},
    {"body in a groove",
     [](double by) {
         return box_mesh({-1 - by, 0.5, -by}, {1 + by, 1.5, 1});
     },
     [](double) { return groove_mesh(); }, 0.9 * 0.70710678, 1.1 * 0.70710678, touch, hard},
    {"bar through a thin plate",
     [](double by) {
         return box_mesh({-3, -3, -0.5 * by}, {3, 3, 0.5 * by});
     },
     [](double) {
         return box_mesh({-0.5, -0.5, -2}, {0.5, 0.5, 2});
     },
     0.1, 0.4, hard, hard},
    {"sheet through a beam",
     [](double by) {
         return box_mesh({-1, -1, -by}, {1, 1, by});
     },
     [](double) {
         return box_mesh({-0.4, -3, -0.4}, {0.4, 3, 0.4});
     },
     0.1, 0.4, hard, hard},
    {"bars end to end, with equal sides",
     [](double by) {
         return box_mesh({0, 0, 0}, {2 + by, 1, 1});
     },
     [](double) {
         return box_mesh({2, 0, 0}, {4, 1, 1});
     },
     0.9, 1.1, touch, hard},
};

struct TouchPlacement {
    const char* name;
    Transform world;
    double least_t; ///< below it, the placement rounds too much
};

const std::vector<TouchPlacement> kTouchPlacements{
    {"here", {}, 1e-9},
    {"turned", Pose{{0.3, -0.7, 1.1}, {0.8, 0.1, -0.5, 0.3}}, 1e-9},
    {"1000 km away", Pose{{1e6, -1e6, 5e5}, {1, 0, 0, 0}}, 1e-6},
    {"turned, 1000 km away", Pose{{-1e6, 2e5, 1e6}, {0.6, 0.2, 0.4, -0.7}}, 1e-6},
};

std::string word_of(const std::optional<ClashKind>& kind) {
    return kind ? to_string(*kind) : "none";
}

std::optional<ClashKind> kind_of(const std::optional<Clash>& clash) {
    return clash ? std::optional(clash->kind) : std::nullopt;
}

TEST(TouchTolerance, KindsJustWithinAndJustBeyond) {
    const auto tolerances = reduced_for_threads(
        std::vector<double>{1e-9, 1e-6, 1e-4, 1e-3, 0.01, 0.1}, std::vector<double>{1e-6, 0.01});
    for (const TouchPlacement& place : kTouchPlacements)
        for (const TouchCase& c : kTouchCases)
            for (const double t : tolerances) {
                if (t < place.least_t)
                    continue;
                SCOPED_TRACE(std::string(c.name) + ", " + place.name + ", t " + std::to_string(t));
                for (const bool within : {true, false}) {
                    const double by = t * (within ? c.just_within : c.just_beyond);
                    const Mesh a = c.first(by), b = c.second(by);
                    const auto expected = within ? c.within : c.beyond;
                    const auto clash = classified(a, b, t, place.world, place.world);
                    EXPECT_EQ(word_of(kind_of(clash)), word_of(expected)) << by / t;
                    if (clash && clash->kind == hard) {
                        EXPECT_LT(clash->distance, -t) << by / t;
                    }
                    EXPECT_EQ(word_of(kind_of(classified(b, a, t, place.world, place.world))),
                              word_of(expected))
                        << "exchanged, " << by / t;
                }
            }
}

TEST(TouchTolerance, ExactContactIsTouchAtEveryTolerance) {
    for (const double t : {0.0, 1e-9, 1e-3, 0.1}) {
        const auto clash =
            classified(box_mesh({0, 0, 0}, {4, 0.3, 3}), box_mesh({-2, -2, -0.5}, {6, 2, 0}), t);
        ASSERT_TRUE(clash);
        EXPECT_EQ(clash->kind, touch);
        EXPECT_EQ(clash->distance, 0);
    }
}

TEST(TouchTolerance, ToleranceZeroReportsWhatIsLeastDeep) {
    const auto clash =
        classified(box_mesh({0, 0, -1e-7}, {4, 0.3, 3}), box_mesh({-2, -2, -0.5}, {6, 2, 0}), 0);
    ASSERT_TRUE(clash);
    EXPECT_EQ(clash->kind, hard);
    EXPECT_NEAR(clash->distance, -1e-7, 1e-9);
}

/// A sheet from (0, y, 0) to (0, y, height), y from -1 to 1, in n columns and rows.
Mesh sheet_mesh(double from, double to, int n) {
    return grid_mesh(n, n, false, false, [&](double u, double v) {
        return Vec3{0, 2 * u - 1, from + v * (to - from)};
    });
}
Mesh floor_mesh(int n) {
    return grid_mesh(n, n, false, false, [](double u, double v) {
        return Vec3{4 * u - 2, 4 * v - 2, 0};
    });
}

TEST(TouchTolerance, SheetsTouchIfOneEndsWithinTheTolerance) {
    const double t = 1e-3;
    // Neither the fineness of the triangles nor vertices on the other sheet matter.
    for (const int n : {1, 2, 7, 40})
        for (const int m : {1, 4, 30}) {
            SCOPED_TRACE(std::to_string(n) + " " + std::to_string(m));
            EXPECT_EQ(word_of(kind_of(classified(sheet_mesh(-0.9 * t, 1, n), floor_mesh(m), t))),
                      "touch");
            EXPECT_EQ(word_of(kind_of(classified(floor_mesh(m), sheet_mesh(-0.9 * t, 1, n), t))),
                      "touch");
            EXPECT_EQ(word_of(kind_of(classified(sheet_mesh(-1.1 * t, 1, n), floor_mesh(m), t))),
                      "hard");
            EXPECT_EQ(word_of(kind_of(classified(sheet_mesh(-1, 1, n), floor_mesh(m), t))), "hard");
            EXPECT_EQ(word_of(kind_of(classified(floor_mesh(m), sheet_mesh(-1, 1, n), t))), "hard");
            EXPECT_EQ(word_of(kind_of(classified(sheet_mesh(0.9 * t, 1, n), floor_mesh(m), t))),
                      "touch");
        }
}

/// A flat sheet with a corner at p, in n columns along u and m rows along v.
Mesh flat_sheet(const Vec3& p, const Vec3& u, const Vec3& v, int n, int m) {
    return grid_mesh(n, m, false, false, [&](double s, double t) { return p + s * u + t * v; });
}

TEST(TouchTolerance, SheetsThatReachBeyondABorder) {
    const double d = 0.01;
    struct Case {
        const char* name;
        Vec3 p, u, v; ///< of a sheet that crosses the square from (-1, -1, 0) to (1, 1, 0)
        double t;
        ClashKind kind;
    };
    const std::vector<Case> cases{
        {"pokes through, over both borders", {-2, 0, -d}, {4, 0, 0}, {0, 0, 1}, 2 * d, touch},
        {"pokes through, over one border", {-0.5, 0.3, -d}, {4, 0, 0}, {0, 0, 1}, 2 * d, touch},
        {"pokes through aslant", {-2, 0.1, -d}, {4, 0.7, 0}, {0, 0, 1}, 2 * d, touch},
        {"pokes through farther than t", {-2, 0, -d}, {4, 0, 0}, {0, 0, 1}, 0.5 * d, hard},
        {"passes through", {-2, 0, -0.5}, {4, 0, 0}, {0, 0, 1}, 0.1, hard},
        {"passes through inside", {-0.5, 0, -0.5}, {1, 0, 0}, {0, 0, 1}, 2 * d, hard},
        {"cuts off less than t", {1 - d, -2, -1}, {0, 4, 0}, {0, 0, 2}, 2 * d, touch},
        {"cuts off more than t", {1 - 10 * d, -2, -1}, {0, 4, 0}, {0, 0, 2}, 2 * d, hard},
    };
    const std::vector<Transform> places{
        {}, Pose{{3, -2, 5}, {0.8, 0.1, -0.5, 0.3}}, Pose{{1e4, 2e4, 30}, {1, 0, 0, 0}}};
    for (const Case& c : cases)
        for (const auto& [n, m] : {std::pair{1, 1}, {2, 3}, {5, 4}})
            for (const auto& [k, l] : {std::pair{1, 1}, {5, 7}, {2, 1}}) {
                SCOPED_TRACE(std::string(c.name) + " " + std::to_string(n) + " " +
                             std::to_string(k));
                const Mesh square = flat_sheet({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, n, m),
                           other = flat_sheet(c.p, c.u, c.v, k, l);
                for (const Transform& world : places)
                    for (const auto& clash : {classified(square, other, c.t, world, world),
                                              classified(other, square, c.t, world, world)}) {
                        ASSERT_EQ(word_of(kind_of(clash)), to_string(c.kind));
                        if (c.kind == hard) {
                            EXPECT_LT(clash->distance, -c.t);
                        }
                    }
            }
}

TEST(TouchTolerance, SheetsThatMeetAtPoints) {
    // A wall between two strips meets them at one point each.
    const Mesh strips = joined(flat_sheet({0, -0.5, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1),
                               flat_sheet({2, -0.5, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1)),
               between = flat_sheet({1, 0, -0.25}, {1, 0, 0}, {0, 0, 1}, 1, 1);
    for (const Transform& world : {Transform{}, Transform(Pose{{1000, 0, 0}, {1, 0, 0, 0}}),
                                   Transform(Pose{{3, -2, 5}, {0.8, 0.1, -0.5, 0.3}})})
        for (const auto& clash : {classified(strips, between, 0.01, world, world),
                                  classified(between, strips, 0.01, world, world)}) {
            ASSERT_TRUE(clash);
            EXPECT_EQ(clash->kind, touch);
            EXPECT_NEAR(clash->distance, 0, 1e-9);
        }
}

TEST(TouchTolerance, LinesOfAMeshAreNoBorder) {
    // The lower corner goes 0.05 below the floor, whose mesh has a line close to the curve.
    const Mesh aslant = flat_sheet({0.3, -0.05, -0.05}, {0.5, 0, 0}, {0, 0.75, 0.75}, 1, 1);
    for (const double line : {0.05, 0.0625, 0.2}) {
        Mesh floor = joined(flat_sheet({-1, -1, 0}, {2, 0, 0}, {0, 1 + line, 0}, 1, 1),
                            flat_sheet({-1, line, 0}, {2, 0, 0}, {0, 1 - line, 0}, 1, 1));
        for (const double t : {0.0445, 0.045, 0.0499}) {
            EXPECT_EQ(word_of(kind_of(classified(floor, aslant, t))), "hard") << line << " " << t;
            EXPECT_EQ(word_of(kind_of(classified(aslant, floor, t))), "hard") << line << " " << t;
        }
        EXPECT_EQ(word_of(kind_of(classified(floor, aslant, 0.06))), "touch") << line;
    }
}

TEST(TouchTolerance, ANarrowStripThroughASheetIsHard) {
    const double t = 0.02;
    const Mesh strip = flat_sheet({-1, -0.005, 0}, {2, 0, 0}, {0, 0.01, 0}, 3, 1),
               across = flat_sheet({0, -1, -1}, {0, 2, 0}, {0, 0, 2}, 2, 2),
               along = flat_sheet({-1.5, 0, -1}, {3, 0, 0}, {0, 0, 2}, 2, 2);
    EXPECT_EQ(word_of(kind_of(classified(strip, across, t))), "hard");
    EXPECT_EQ(word_of(kind_of(classified(across, strip, t))), "hard");
    EXPECT_EQ(word_of(kind_of(classified(strip, along, t))), "touch");
    EXPECT_EQ(word_of(kind_of(classified(along, strip, t))), "touch");
}

TEST(TouchTolerance, SheetsOfPartsThatAlsoHoldSolids) {
    // The solids are elsewhere. Each face of the second part is there twice, once for each side.
    const double t = 1e-3;
    for (const double reach : {0.5 * t, 2 * t}) {
        const Mesh sheet = sheet_mesh(-reach, 1, 3), floor = floor_mesh(4);
        const Mesh first = joined(sheet, box_mesh({8, 0, 0}, {9, 1, 1})),
                   second =
                       joined(joined(floor, reversed(floor)), box_mesh({-9, 0, 0}, {-8, 1, 1}));
        const std::string expected = reach < t ? "touch" : "hard";
        EXPECT_EQ(word_of(kind_of(classified(first, second, t))), expected);
        EXPECT_EQ(word_of(kind_of(classified(second, first, t))), expected);
        EXPECT_EQ(word_of(kind_of(classified(first, floor, t))), expected);
        EXPECT_EQ(word_of(kind_of(classified(sheet, second, t))), expected);
    }
}

TEST(TouchTolerance, TheDepthOfSolidsAndSheetsDoesNotDependOnTheTolerance) {
    // The boxes have 0.5 mm in common, the sheets go 0.3 m beyond each other.
    const Mesh first = joined(sheet_mesh(-0.3, 1, 3), box_mesh({8, 0, 0}, {9, 1, 1})),
               second = joined(floor_mesh(4), box_mesh({8.9995, 0.25, 0.25}, {10, 0.75, 0.75}));
    for (const double t : {1e-5, 1e-4, 1e-3, 0.01, 0.1})
        for (const auto& clash : {classified(first, second, t), classified(second, first, t)}) {
            EXPECT_EQ(word_of(kind_of(clash)), "hard") << t;
            EXPECT_NEAR(clash->distance, -0.3, 1e-9) << t;
        }
}

TEST(TouchTolerance, FinsWithoutAThicknessAreSheets) {
    // Each fin has two sides, whose triangles are the same or not, and shares corners with a box.
    const double t = 1e-3;
    for (const bool same : {true, false})
        for (const double reach : {0.5 * t, 2 * t, 0.5}) {
            const auto fin = [&](const Vec3& p, const Vec3& u, const Vec3& v) {
                Mesh m{{p, p + u, p + u + v, p + v}, {{0, 1, 2}, {0, 2, 3}}};
                m.triangles.push_back(same ? std::array<std::uint32_t, 3>{0, 2, 1}
                                           : std::array<std::uint32_t, 3>{0, 3, 1});
                m.triangles.push_back(same ? std::array<std::uint32_t, 3>{0, 3, 2}
                                           : std::array<std::uint32_t, 3>{1, 3, 2});
                return m;
            };
            const Mesh wall = joined(box_mesh({-2, 0, -2}, {2, 1, -1}),
                                     fin({-2, 0, -1}, {4, 0, 0}, {0, 0, 1 + reach})),
                       floor = joined(box_mesh({-9, -3, -0.5}, {-8, 3, 0}),
                                      fin({-8, -3, 0}, {16, 0, 0}, {0, 6, 0}));
            const ClashKind expected = reach < t ? touch : hard;
            EXPECT_EQ(word_of(kind_of(classified(wall, floor, t))), to_string(expected));
            EXPECT_EQ(word_of(kind_of(classified(floor, wall, t))), to_string(expected));
        }
    // Plates thinner than the tolerance are solids: they cross, but no point is deep.
    const Mesh upright = box_mesh({-5, -0.002, -5}, {5, 0.002, 5}),
               level = box_mesh({-5, -5, -0.002}, {5, 5, 0.002});
    EXPECT_EQ(word_of(kind_of(classified(upright, level, 0.01))), "touch");
    EXPECT_EQ(word_of(kind_of(classified(level, upright, 0.01))), "touch");
}

TEST(TouchTolerance, PartsOfWhichOneShellIsInside) {
    const Mesh block = box_mesh({0, 0, 0}, {2, 2, 2});
    const Mesh two = joined(box_mesh({0.5, 0.5, 0.5}, {1, 1, 1}), box_mesh({3, 0, 0}, {4, 1, 1}));
    for (const double t : {0.0, 1e-3}) {
        const auto clash = classified(block, two, t);
        ASSERT_TRUE(clash);
        EXPECT_EQ(clash->kind, hard);
        EXPECT_LE(clash->distance, -0.5);
        EXPECT_NEAR(clash->volume, 0.125, 1e-6);
        EXPECT_EQ(word_of(kind_of(classified(two, block, t))), "hard");
    }
    // Both shells inside: contained.
    EXPECT_EQ(word_of(kind_of(classified(
                  box_mesh({0, 0, 0}, {5, 2, 2}),
                  joined(box_mesh({0.5, 0.5, 0.5}, {1, 1, 1}), box_mesh({3, 0.5, 0.5}, {4, 1, 1})),
                  1e-3))),
              "contained");
}

TEST(TouchTolerance, GapsAreTouchesUpToTheToleranceAndClearancesBeyond) {
    const Mesh slab = box_mesh({-2, -2, -0.5}, {6, 2, 0});
    const auto over = [](double gap) { return box_mesh({0, 0, gap}, {4, 0.3, 3}); };
    const auto near = classified(over(0.004), slab, 0.005, {}, {}, 0.01);
    ASSERT_TRUE(near);
    EXPECT_EQ(near->kind, touch);
    EXPECT_NEAR(near->distance, 0.004, 1e-12);
    const auto far = classified(over(0.006), slab, 0.005, {}, {}, 0.01);
    ASSERT_TRUE(far);
    EXPECT_EQ(far->kind, clearance);
}

} // namespace
} // namespace abut::test
