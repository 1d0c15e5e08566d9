// Polygons of all kinds are cut into n - 2 triangles with the polygon's orientation and area. The
// work grows little faster than the number of corners.

#include "io/polygon/triangulate.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <string>

namespace abut::test {
namespace {

/// Integer grid points, so that areas are exact.
struct GridPoint {
    double x = 0, y = 0, z = 0;
};
using Outline = std::vector<GridPoint>;

double doubled_area(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double doubled_area(const Outline& outline) {
    double sum = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const GridPoint& p = outline[i];
        const GridPoint& q = outline[(i + 1) % outline.size()];
        sum += p.x * q.y - p.y * q.x;
    }
    return sum;
}

struct Cut {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    TriangulationWork work;
};

Cut cut(const Outline& outline) {
    std::vector<std::uint32_t> corners;
    for (std::uint32_t i = 0; i < outline.size(); ++i)
        corners.push_back(i);
    Cut result;
    triangulate_in_plane(project_polygon(std::span<const std::uint32_t>(corners), outline.data()),
                         result.triangles, &result.work);
    return result;
}

/// Expects no triangle to be oriented against the polygon, and the areas to add up to the
/// polygon's. The polygon covers no point twice, so neither do the triangles.
Cut expect_tiled(const Outline& outline, const std::string& what) {
    SCOPED_TRACE(what);
    Cut result = cut(outline);
    EXPECT_EQ(result.triangles.size(), outline.size() - 2);
    const double whole = doubled_area(outline);
    double sum = 0;
    std::size_t turned = 0;
    std::set<std::uint32_t> used;
    for (const auto& [a, b, c] : result.triangles) {
        const double area = doubled_area(outline.at(a), outline.at(b), outline.at(c));
        turned += area * whole < 0 ? 1 : 0;
        sum += area;
        used.insert({a, b, c});
    }
    EXPECT_EQ(turned, 0U);
    EXPECT_EQ(sum, whole);
    EXPECT_EQ(used.size(), outline.size());
    return result;
}

/// Expects O(n log n) visits; n^2 would be 30 times as many.
void expect_little_work(const Outline& outline, const std::string& what) {
    const Cut result = expect_tiled(outline, what);
    const double n = static_cast<double>(outline.size());
    EXPECT_LT(static_cast<double>(result.work.visits), 200 * n * std::log2(n)) << what;
    EXPECT_LT(static_cast<double>(result.work.tests), 20 * n) << what;
}

Outline reversed(Outline outline) {
    std::reverse(outline.begin(), outline.end());
    return outline;
}

/// Grid points around the origin, sorted by angle, at varying distances. No two neighbours are half
/// a turn apart, so that no edge passes the origin on the wrong side.
Outline star(Random& random, std::size_t corners, int near, int far) {
    Outline outline{{double(far), 0}, {0, double(far)}, {-double(far), 0}, {0, -double(far)}};
    while (outline.size() < corners) {
        const double angle = random.uniform(0, 6.283185307179586);
        const double radius = random.integer(near, far);
        const GridPoint p{std::round(radius * std::cos(angle)),
                          std::round(radius * std::sin(angle)), 0};
        if (p.x != 0 || p.y != 0)
            outline.push_back(p);
    }
    const auto is_lower = [](const GridPoint& p) { return p.y < 0 || (p.y == 0 && p.x < 0); };
    std::stable_sort(outline.begin(), outline.end(), [&](const GridPoint& p, const GridPoint& q) {
        if (is_lower(p) != is_lower(q))
            return is_lower(q);
        return p.x * q.y - p.y * q.x > 0;
    });
    return outline;
}

Outline comb(std::size_t teeth, int slant) {
    Outline outline;
    for (std::size_t i = 0; i < teeth; ++i) {
        const auto x = static_cast<double>(4 * i);
        outline.push_back({x, 0, 0});
        outline.push_back({x + 1 + slant, 1000000, 0});
        outline.push_back({x + 2, 0, 0});
    }
    outline.push_back({static_cast<double>(4 * teeth), 0, 0});
    outline.push_back({static_cast<double>(4 * teeth), -10, 0});
    outline.push_back({0, -10, 0});
    return reversed(outline);
}

/// A corridor of width 1 that spirals inwards.
Outline spiral(int turns) {
    Outline outward, inward;
    for (int i = 0; i < turns; ++i) {
        const double r = 4.0 * (i + 1);
        for (const auto& [x, y] : {std::pair{r, -r}, {r, r}, {-r, r}, {-r, -r - 4}}) {
            outward.push_back({x, y, 0});
            inward.push_back({x + (x > 0 ? 1 : -1), y + (y > 0 ? 1 : -1), 0});
        }
    }
    Outline outline = outward;
    outline.insert(outline.end(), inward.rbegin(), inward.rend());
    return reversed(outline);
}

/// A square with holes, each joined to its left side by a slit.
Outline keyholes(int rows) {
    Outline outline{{0, 0, 0}, {100, 0, 0}, {100, 10.0 * rows, 0}, {0, 10.0 * rows, 0}};
    for (int i = rows; i-- > 0;) {
        const double y = 10.0 * i + 5;
        for (const GridPoint& p : {GridPoint{0, y, 0},
                                   {20, y, 0},
                                   {50, y + 3, 0},
                                   {80, y, 0},
                                   {50, y - 3, 0},
                                   {20, y, 0},
                                   {0, y, 0}})
            outline.push_back(p);
    }
    return outline;
}

Outline square_with_points_on_its_sides(int points) {
    Outline outline;
    for (int i = 0; i < points; ++i)
        outline.push_back({double(i), 0, 0});
    for (int i = 0; i < points; ++i)
        outline.push_back({double(points), double(i), 0});
    for (int i = points; i > 0; --i)
        outline.push_back({double(i), double(points), 0});
    for (int i = points; i > 0; --i)
        outline.push_back({0, double(i), 0});
    return outline;
}

Outline repeated(const Outline& outline, std::size_t times) {
    Outline result;
    for (const GridPoint& p : outline)
        result.insert(result.end(), times, p);
    return result;
}

TEST(Triangulate, SmallPolygons) {
    expect_tiled({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, "square");
    expect_tiled({{0, 0}, {4, 0}, {1, 1}, {0, 4}}, "dart");
    expect_tiled({{1, 1}, {0, 4}, {0, 0}, {4, 0}}, "dart from its notch");
    expect_tiled({{0, 0}, {2, 0}, {4, 0}, {4, 4}}, "a corner on a side");
    expect_tiled({{0, 0}, {6, 0}, {6, 6}, {3, 2}, {0, 6}}, "notch");
    expect_tiled({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}, "a corner touches a side");
    expect_tiled({{0, 0}, {2, 2}, {4, 0}, {4, 4}, {2, 2}, {0, 4}}, "two triangles at a point");
    expect_tiled({{0, 0}, {4, 0}, {8, 0}, {4, 0}, {4, 4}}, "spike");
    expect_tiled({{0, 0}, {1, 0}, {2, 0}, {1, 0}}, "line");
    expect_tiled({{0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}}, "point");
    expect_tiled(reversed({{0, 0}, {6, 0}, {6, 6}, {3, 2}, {0, 6}}), "clockwise");
}

TEST(Triangulate, AreaIsKeptInEveryPlane) {
    // A notched polygon seen from all sides. One that is not quite planar keeps its projected area.
    for (unsigned axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0}) {
            const Outline flat{{0, 0}, {6, 0}, {6, 6}, {3, 2}, {0, 6}};
            Outline outline;
            for (const GridPoint& p : flat) {
                std::array<double, 3> q{};
                q.at((axis + 1) % 3) = sign * p.x + 1e6;
                q.at((axis + 2) % 3) = p.y;
                q.at(axis) = p.x == 3 ? 0.25 : 0;
                outline.push_back({q[0], q[1], q[2]});
            }
            double sum = 0;
            for (const auto& t : cut(outline).triangles)
                sum += doubled_area(flat[t[0]], flat[t[1]], flat[t[2]]);
            EXPECT_EQ(sum, doubled_area(flat));
        }
}

TEST(Triangulate, ManyCornersTakeLittleWork) {
    constexpr std::size_t kMany = 100'000;
    Random random(17);
    expect_little_work(star(random, kMany, 10'000'000, 10'000'000), "circle");
    expect_little_work(star(random, kMany, 5'000'000, 10'000'000), "star");
    expect_little_work(comb(kMany / 3, 0), "comb");
    expect_little_work(comb(kMany / 3, 4), "slanted comb");
    expect_little_work(spiral(kMany / 8), "spiral");
    expect_little_work(square_with_points_on_its_sides(kMany / 4), "points on sides");
}

TEST(Triangulate, RepeatedCornersAndKeyholesTakeLittleWork) {
    Random random(18);
    expect_little_work(keyholes(14'000), "keyholes");
    expect_little_work(repeated(star(random, 1000, 500'000, 1'000'000), 100), "repeated");
    expect_little_work(repeated({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 25'000), "four points");
    expect_little_work(repeated(keyholes(100), 20), "repeated keyholes");
    expect_little_work(Outline(100'000, GridPoint{1, 2, 3}), "one point");
}

TEST(Triangulate, RandomPolygonsAreTiled) {
    const unsigned seed = 20261123;
    SCOPED_TRACE(seed);
    Random random(seed);
    std::size_t with_touching = 0;
    for (int round = 0; round < many(2000); ++round) {
        // Few grid points make corners repeat, lie on lines and touch.
        Outline outline = star(random, static_cast<std::size_t>(random.integer(5, 40)), 2, 12);
        std::set<std::pair<double, double>> distinct;
        for (const GridPoint& p : outline)
            distinct.emplace(p.x, p.y);
        with_touching += distinct.size() < outline.size() ? 1 : 0;
        expect_tiled(outline, "round " + std::to_string(round));
        if (testing::Test::HasFailure()) {
            for (const GridPoint& p : outline)
                std::cout << '{' << p.x << ", " << p.y << "}, ";
            std::cout << '\n';
            return;
        }
    }
    EXPECT_GT(with_touching, 500U);
}

TEST(Triangulate, APolygonThatCrossesItselfKeepsItsSignedArea) {
    Random random(5);
    for (int round = 0; round < many(500); ++round) {
        Outline outline;
        for (int i = random.integer(4, 30); i > 0; --i)
            outline.push_back({double(random.integer(-9, 9)), double(random.integer(-9, 9)), 0});
        const Cut result = cut(outline);
        EXPECT_EQ(result.triangles.size(), outline.size() - 2);
        double sum = 0;
        for (const auto& [a, b, c] : result.triangles)
            sum += doubled_area(outline[a], outline[b], outline[c]);
        EXPECT_EQ(sum, doubled_area(outline));
    }
}

} // namespace
} // namespace abut::test
