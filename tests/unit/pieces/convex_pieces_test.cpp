#include <abut/convex_pieces.h>
#include <abut/error.h>

#include "tests/support/shapes.h"
#include "tests/support/solids.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace abut::test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

ConvexPieces pieces(const Mesh& mesh) {
    return ConvexPieces(Model(mesh));
}
ConvexPieces box(const Vec3& lower, const Vec3& upper) {
    return pieces(box_mesh(lower, upper));
}
double distance_of(const ConvexPieces& a, const ConvexPieces& b) {
    return distance(a, {}, b, {}).distance;
}

/// A U along y with walls x in [0, 1] and [3, 4] and floor z in [0, 1]; its height is 4.
Mesh u_mesh() {
    Mesh m = cells_mesh(4, [](int x, int /*y*/, int z) { return x == 0 || x == 3 || z == 0; });
    return m;
}

std::string error_of(const Mesh& mesh) {
    try {
        pieces(mesh);
        return "none";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_mesh);
        return error.what();
    }
}
void expect_error(const Mesh& mesh, const std::string& part) {
    EXPECT_NE(error_of(mesh).find(part), std::string::npos) << error_of(mesh);
}

TEST(ConvexPieces, AConvexSolidIsOnePiece) {
    EXPECT_EQ(box({0, 0, 0}, {1, 2, 3}).size(), 1U);
    const Convex ball(sphere_mesh(1, 20, 10).positions);
    EXPECT_EQ(pieces(ball.mesh()).size(), 1U);
    EXPECT_EQ(pieces(joined(box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({2, 0, 0}, {3, 1, 1}))).size(),
              2U);
}

TEST(ConvexPieces, HullsDoNotFillGaps) {
    // The outer walls of a U lie on one convex hull, which would fill the gap.
    const ConvexPieces u = pieces(u_mesh());
    EXPECT_LE(u.size(), 5U);
    const ConvexPieces inside = box({1.5, 1, 1.75}, {2.5, 2, 3});
    const PiecesGap gap = distance(u, {}, inside, {});
    EXPECT_DOUBLE_EQ(gap.distance, 0.5);
    EXPECT_LE(gap.at_least, gap.distance);
    EXPECT_GE(gap.at_least, gap.distance - 1e-10);
    EXPECT_EQ(gap.status, Status::exact);
    EXPECT_DOUBLE_EQ(std::abs(gap.point_a.x - gap.point_b.x), 0.5);
    // A flat patch around a hole.
    const ConvexPieces plate =
        pieces(cells_mesh(3, [](int x, int y, int z) { return z == 0 && !(x == 1 && y == 1); }));
    EXPECT_DOUBLE_EQ(distance_of(plate, box({1.25, 1.25, -1}, {1.75, 1.75, 2})), 0.25);
    EXPECT_EQ(distance_of(plate, box({0.75, 1.25, -1}, {1.75, 1.75, 2})), 0);
    // A notch in a thin plate, seen from above.
    const ConvexPieces notched =
        pieces(cells_mesh(3, [](int x, int y, int z) { return z == 0 && !(x == 1 && y > 0); }));
    EXPECT_DOUBLE_EQ(distance_of(notched, box({1.25, 1.5, -1}, {1.75, 5, 2})), 0.25);
}

TEST(ConvexPieces, SolidsInsideEachOtherAreAtDistanceZero) {
    const ConvexPieces large = box({-5, -5, -5}, {5, 5, 5}), small = box({0, 0, 0}, {1, 1, 1});
    EXPECT_EQ(distance_of(large, small), 0);
    EXPECT_EQ(distance_of(small, large), 0);
    // The pits in a cube's sides keep its convex pieces away from its centre.
    const ConvexPieces pitted = pieces(pitted_cube_mesh());
    const ConvexPieces seed = box({3.4, 3.4, 3.4}, {3.5, 3.5, 3.5});
    const PiecesGap gap = distance(pitted, {}, seed, {});
    EXPECT_EQ(gap.distance, 0);
    EXPECT_EQ(gap.status, Status::exact);
    EXPECT_NEAR(gap.point_a.x, 3.45, 0.05 + 1e-12);
    EXPECT_EQ(gap.point_a, gap.point_b);
    const PiecesContacts contacts = collide(seed, {}, pitted, {});
    EXPECT_TRUE(contacts.meet);
    EXPECT_TRUE(contacts.contained);
    EXPECT_TRUE(contacts.pairs.empty());
    EXPECT_TRUE(within(pitted, {}, seed, {}, 0));
    PiecesWarmStart warm_start;
    for (int i = 0; i < 3; ++i) // nothing has moved
        EXPECT_EQ(distance(pitted, {}, seed, {}, {.warm_start = &warm_start}).distance, 0);
    const Transform away = translation(0, 0, 40);
    EXPECT_GT(distance(pitted, {}, seed, away, {.warm_start = &warm_start}).distance, 30);
    const ConvexPieces ring = pieces(torus_mesh(10, 4, 60, 40));
    // There is no solid in the ring's hole.
    const ConvexPieces ball = pieces(sphere_mesh(2, 12, 8));
    EXPECT_GT(distance_of(ring, ball), 3.9);
    EXPECT_FALSE(collide(ring, {}, ball, {}).meet);
}

TEST(ConvexPieces, PointsWithWindingNumberTwoAreInside) {
    const Mesh cube = pitted_cube_mesh();
    const ConvexPieces twice =
        pieces(joined(cube, transformed(cube, translation(0.0625, 0.125, -0.0625))));
    const ConvexPieces seed = box({3.4, 3.4, 3.4}, {3.5, 3.5, 3.5});
    const PiecesContacts contacts = collide(twice, {}, seed, {});
    EXPECT_TRUE(contacts.contained);
    EXPECT_TRUE(contacts.pairs.empty());
}

TEST(ConvexPieces, CavitiesAreOutside) {
    const ConvexPieces hollow = pieces(
        joined(box_mesh({-4, -4, -4}, {4, 4, 4}), reversed(box_mesh({-2, -2, -2}, {2, 2, 2}))));
    EXPECT_DOUBLE_EQ(distance_of(hollow, box({-1, -1, -1}, {1, 1, 1.5})), 0.5);
    EXPECT_EQ(distance_of(hollow, box({-1, -1, -1}, {1, 1, 2.5})), 0);
    EXPECT_EQ(distance_of(hollow, box({2.5, -1, -1}, {3.5, 1, 1})), 0); // in the wall
    EXPECT_DOUBLE_EQ(distance_of(hollow, box({5, -1, -1}, {6, 1, 1})), 1);
}

TEST(ConvexPieces, NamesTheFeaturesOfTheSurface) {
    const Mesh mesh = u_mesh();
    const ConvexPieces u = pieces(mesh);
    const auto on = [&](std::uint32_t triangle, const Vec3& p) {
        const auto& t = mesh.triangles[triangle];
        const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        const Vec3 n = cross(b - a, c - a);
        return dot(n, p - a) == 0 && dot(cross(b - a, p - a), n) >= 0 &&
               dot(cross(c - b, p - b), n) >= 0 && dot(cross(a - c, p - c), n) >= 0;
    };
    const auto tip = [](const Vec3& at, const Vec3& towards) {
        // A thin pyramid with its tip at the point.
        Mesh m;
        const Vec3 n = at + 4.0 * towards;
        m.positions = {at, n + Vec3{0.25, 0, 0}, n + Vec3{0, 0.25, 0.25},
                       n + Vec3{0, -0.25, -0.25}};
        m.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
        const Vec3 d = m.positions[1] - m.positions[0];
        if (dot(d, cross(m.positions[2] - m.positions[0], m.positions[3] - m.positions[0])) > 0)
            m = reversed(m);
        return m;
    };
    struct Case {
        Vec3 at, towards;
        Feature feature = Feature::face;
    };
    for (const Case& c : {Case{{-0.5, 1.375, 2.25}, {-1, 0, 0}, Feature::face},
                          Case{{-0.5, -0.5, 2.25}, {-1, -1, 0}, Feature::edge},
                          Case{{-0.5, -0.5, -0.5}, {-1, -1, -1}, Feature::vertex}}) {
        const PiecesGap gap = distance(u, {}, pieces(tip(c.at, c.towards)), {});
        EXPECT_EQ(gap.point_b, c.at);
        EXPECT_EQ(gap.feature_b, Feature::vertex);
        EXPECT_EQ(gap.feature_a, c.feature);
        EXPECT_TRUE(on(gap.triangle_a, gap.point_a)) << gap.triangle_a;
        if (c.feature == Feature::vertex) {
            EXPECT_EQ(mesh.positions[mesh.triangles[gap.triangle_a].at(gap.index_a)], (Vec3{}));
        }
        const auto of_piece = u.triangles(gap.piece_a);
        if (c.feature == Feature::face) {
            EXPECT_NE(std::find(of_piece.begin(), of_piece.end(), gap.triangle_a), of_piece.end());
        }
    }
}

TEST(ConvexPieces, MeshesThatAreNoSolidsAreRefused) {
    const Mesh cube = box_mesh({0, 0, 0}, {1, 1, 1});
    expect_error(open_box_mesh({0, 0, 0}, {1, 1, 1}), "is open");
    expect_error(reversed(cube), "turned inside out");
    expect_error(joined(cube, reversed(box_mesh({3, 0, 0}, {4, 1, 1}))), "turned inside out");
    Mesh flipped = cube;
    std::swap(flipped.triangles[4][0], flipped.triangles[4][1]);
    expect_error(flipped, "flipped");
    expect_error({}, "no triangle");
    expect_error({cube.positions, {{0, 0, 1}, {2, 2, 2}}}, "no triangle");
    // A wall between two rooms: which of the three surfaces at its edges is none too many?
    Mesh rooms = joined(cube, box_mesh({1, 0, 0}, {2, 1, 1}));
    rooms.triangles.erase(rooms.triangles.begin() + 10, rooms.triangles.begin() + 12);
    expect_error(rooms, "more than two triangles");
    Mesh bad = cube;
    bad.positions[3].y = kNaN;
    expect_error(bad, "finite");
}

TEST(ConvexPieces, ShellsMayShareEdges) {
    const ConvexPieces diagonal =
        pieces(cells_mesh(2, [](int x, int y, int /*z*/) { return x == y; }));
    EXPECT_EQ(distance_of(diagonal, box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75})), 0);
    EXPECT_DOUBLE_EQ(distance_of(diagonal, box({1.25, 0.25, 0.25}, {1.75, 0.75, 0.75})), 0.25);
}

TEST(ConvexPieces, BadArgumentsAreRefused) {
    const ConvexPieces cube = box({0, 0, 0}, {1, 1, 1});
    Transform bad;
    bad.m[4] = kInfinity;
    EXPECT_THROW((void)distance(cube, bad, cube, {}), Error);
    EXPECT_THROW((void)distance(cube, {}, cube, bad), Error);
    EXPECT_THROW((void)distance(cube, {}, cube, {}, {.upper_bound = -1}), Error);
    EXPECT_THROW((void)distance(cube, {}, cube, {}, {.absolute_error = kNaN}), Error);
    EXPECT_THROW((void)within(cube, {}, cube, {}, kNaN), Error);
    EXPECT_THROW((void)collide(cube, bad, cube, {}), Error);
    EXPECT_THROW((void)collide(cube, bad, cube, {}, {.mode = ContactMode::all}), Error);
}

TEST(ConvexPieces, TrianglesWithoutAreaBelongToTheSurface) {
    Mesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
    mesh.positions.push_back({0.5, 0.5, 3});
    mesh.triangles.push_back({7, 8, 7}); // a hair that sticks out
    mesh.triangles.push_back({8, 8, 8});
    const ConvexPieces hairy = pieces(mesh);
    EXPECT_EQ(hairy.size(), 3U);
    EXPECT_DOUBLE_EQ(distance_of(hairy, box({0, 0, 4}, {1, 1, 5})), 1);
    EXPECT_EQ(distance_of(hairy, box({0, 0, 2}, {1, 1, 5})), 0);
}

TEST(ConvexPieces, BoundsAndErrorsAllowed) {
    const ConvexPieces u = pieces(u_mesh()), cube = box({10, 0, 0}, {11, 1, 1});
    const PiecesGap beyond = distance(u, {}, cube, {}, {.upper_bound = 5});
    EXPECT_EQ(beyond.distance, 5);
    EXPECT_LE(beyond.at_least, 5);
    EXPECT_GE(beyond.at_least, 5 - 1e-12);
    EXPECT_EQ(beyond.status, Status::bound_only);
    EXPECT_DOUBLE_EQ(distance(u, {}, cube, {}, {.upper_bound = 7}).distance, 6);
    EXPECT_TRUE(within(u, {}, cube, {}, 6));
    EXPECT_FALSE(within(u, {}, cube, {}, 5.999));
    EXPECT_TRUE(within(u, {}, cube, {}, kInfinity));
    const PiecesGap rough = distance(u, {}, cube, {}, {.absolute_error = 100});
    EXPECT_GE(rough.distance, 6);
    EXPECT_LE(rough.at_least, 6);
    EXPECT_GE(rough.distance, rough.at_least);
}

TEST(ConvexPieces, ContactsByPiecesAndTriangles) {
    const ConvexPieces u = pieces(u_mesh());
    const ConvexPieces bar = box({0.5, 1.25, 2.25}, {3.5, 1.75, 2.75}); // passes through both walls
    const PiecesContacts all =
        collide(u, {}, bar, {}, {.mode = ContactMode::all, .triangles = true});
    EXPECT_TRUE(all.meet);
    EXPECT_GE(all.pairs.size(), 2U);
    const Contacts surfaces = collide(u.model(), {}, bar.model(), {}, {.mode = ContactMode::all});
    EXPECT_EQ(all.triangles, surfaces.pairs);
    const PiecesContacts first = collide(u, {}, bar, {});
    ASSERT_EQ(first.pairs.size(), 1U);
    EXPECT_NE(std::find(all.pairs.begin(), all.pairs.end(), first.pairs[0]), all.pairs.end());
    // Touching counts as contact.
    EXPECT_TRUE(collide(u, {}, box({4, 1, 1}, {5, 2, 2}), {}).meet);
    EXPECT_FALSE(collide(u, {}, box({4.0001, 1, 1}, {5, 2, 2}), {}).meet);
}

TEST(ConvexPieces, WarmStartsOfOtherSolidsDoNoHarm) {
    const ConvexPieces u = pieces(u_mesh()), ring = pieces(torus_mesh(10, 4, 30, 20)),
                       cube = box({10, 0, 0}, {11, 1, 1});
    PiecesWarmStart warm_start;
    const auto ask = [&](const ConvexPieces& a, const ConvexPieces& b) {
        return distance(a, {}, b, {}, {.warm_start = &warm_start}).distance;
    };
    const double expected = distance_of(u, ring);
    EXPECT_DOUBLE_EQ(ask(u, cube), 6);
    EXPECT_EQ(ask(u, ring), expected);
    EXPECT_DOUBLE_EQ(ask(u, cube), 6);
    EXPECT_DOUBLE_EQ(ask(cube, u), 6);
    PiecesWarmStart other = std::move(warm_start);
    EXPECT_DOUBLE_EQ(distance(cube, {}, u, {}, {.warm_start = &other}).distance, 6);
    warm_start = PiecesWarmStart();
    EXPECT_DOUBLE_EQ(ask(u, cube), 6);
}

} // namespace
} // namespace abut::test
