// Bodies that rest on each other: faces on faces, edges and corners on faces, in corners, around the
// limit of rounding and far from the origin. Every query tells the same contact and the normal of the
// face, in either order, whatever was asked before.

#include <abut/world.h>

#include "tests/support/kinds_of_bodies.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>
#include <vector>

namespace abut::test {
namespace {

using Turn = std::array<double, 4>;

Turn turn_around(const Vec3& axis, double angle) {
    const Vec3 q = std::sin(0.5 * angle) * normalized_or_zero(axis);
    return {std::cos(0.5 * angle), q.x, q.y, q.z};
}

Turn turn_product(const Turn& q, const Turn& p) {
    return {q[0] * p[0] - q[1] * p[1] - q[2] * p[2] - q[3] * p[3],
            q[0] * p[1] + q[1] * p[0] + q[2] * p[3] - q[3] * p[2],
            q[0] * p[2] - q[1] * p[3] + q[2] * p[0] + q[3] * p[1],
            q[0] * p[3] + q[1] * p[2] - q[2] * p[1] + q[3] * p[0]};
}

/// A pose in the frame of another one.
Pose placed_in(const Pose& outer, const Vec3& place, const Turn& turn) {
    return {apply(Transform(outer), place), turn_product(outer.rotation, turn)};
}

/// A cube of triangles, n on each side of a face.
Mesh fine_cube(int n, double half) {
    Mesh mesh;
    for (int face = 0; face < 6; ++face)
        for (int i = 0; i < n; ++i)
            for (int k = 0; k < n; ++k) {
                const auto corner = [&](int x, int y) {
                    std::array<double, 3> p{};
                    const auto axis = static_cast<std::size_t>(face / 2);
                    p[axis] = face % 2 == 0 ? -half : half;
                    p[(axis + 1) % 3] = half * (2.0 * x / n - 1);
                    p[(axis + 2) % 3] = half * (2.0 * y / n - 1);
                    return Vec3{p[0], p[1], p[2]};
                };
                const auto first = static_cast<std::uint32_t>(mesh.positions.size());
                for (const Vec3& p :
                     {corner(i, k), corner(i + 1, k), corner(i + 1, k + 1), corner(i, k + 1)})
                    mesh.positions.push_back(p);
                if (face % 2 == 0)
                    std::swap(mesh.positions[first + 1], mesh.positions[first + 3]);
                mesh.triangles.push_back({first, first + 1, first + 2});
                mesh.triangles.push_back({first, first + 2, first + 3});
            }
    return mesh;
}

/// A cube as a body of some kind.
struct CubeBody {
    const char* name;
    double half;
    AnyShape shape;
    bool is_model = true;
};

std::vector<CubeBody> cube_bodies() {
    std::vector<CubeBody> all;
    for (const double half : {1.0, 0.2}) {
        const Vec3 corner{half, half, half};
        const Mesh mesh = box_mesh(-corner, corner);
        Mesh twice = mesh;
        twice.triangles.insert(twice.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
        all.push_back({"model", half, Model(mesh)});
        all.push_back({"fine model", half, Model(fine_cube(3, half))});
        all.push_back({"model twice", half, Model(twice)});
        all.push_back({"box", half, Box3{-corner, corner}, false});
        all.push_back({"convex", half, Convex(mesh), false});
    }
    return all;
}

/// How one cube stands on another.
struct WayToStand {
    const char* name;
    Turn turn;
    double height;           ///< of its middle, for a half-width of 1
    double reach_x, reach_y; ///< of what touches
};

std::vector<WayToStand> standings() {
    const Vec3 diagonal = normalized_or_zero({1, 1, 1}), down{0, 0, -1};
    const double angle = std::acos(dot(diagonal, down));
    return {{"face", {1, 0, 0, 0}, 1, 1, 1},
            {"turned face", turn_around({0, 0, 1}, 0.7), 1, 0, 0},
            {"edge", turn_around({1, 0, 0}, std::numbers::pi / 4), std::sqrt(2.0), 1, 0},
            {"corner", turn_around(cross(diagonal, down), angle), std::sqrt(3.0), 0, 0}};
}

/// The extent that two intervals around 0 and x share.
double shared_extent(double half_a, double half_b, double x) {
    return std::min(half_a, x + half_b) - std::max(-half_a, x - half_b);
}

/// Returns whether what stands on a face, seen along one axis, does so clear of the border.
bool stands(double reach, double half_a, double half_b, double x) {
    return reach == 0 ? std::abs(x) < 0.95 * half_a
                      : shared_extent(half_a, reach * half_b, x) > 0.02 * half_a;
}

struct FlushPlacement {
    Pose a, b;
    Vec3 normal; ///< of the face of a
    double gap = 0;
    double rounding = 0; ///< of a position
};

class FlushModels : public ::testing::Test {
protected:
    template <typename List>
    const auto& any(const List& list) {
        return list[static_cast<std::size_t>(random_.integer(0, int(std::size(list)) - 1))];
    }

    /// Places b on the upper face of a, on a grid or anywhere, and both anywhere in the world.
    FlushPlacement placed(const CubeBody& a, const CubeBody& b, const WayToStand& standing) {
        constexpr std::array kGaps{0., 0., 0., 1e-15, -1e-15, 1e-13, 1e-11, 1e-8};
        constexpr std::array kFar{0., 0., 0., 1e3, 1e4, 1e6, 1e7};
        const std::array turns{Turn{1, 0, 0, 0}, turn_around({1, 0, 0}, std::numbers::pi / 6),
                               turn_around({1, 2, 3}, 0.7),
                               turn_around({0, 0, 1}, std::numbers::pi / 4)};
        FlushPlacement result;
        const double far = any(kFar);
        result.a = {{far, -far / 2, 0}, any(turns)};
        result.gap = any(kGaps);
        double x = 0, y = 0;
        do {
            x = a.half * 0.1 * random_.integer(-10, 10),
            y = a.half * 0.1 * random_.integer(-10, 10);
        } while (!stands(standing.reach_x, a.half, b.half, x) ||
                 !stands(standing.reach_y, a.half, b.half, y));
        result.b = placed_in(result.a, {x, y, a.half + standing.height * b.half + result.gap},
                             standing.turn);
        const auto& m = Transform(result.a).m;
        result.normal = {m[6], m[7], m[8]};
        result.rounding = 1e-15 + 0x1p-52 * far;
        return result;
    }

    Random random_{5701};
};

/// Asks something, as an earlier step of a simulation may, and leaves b where it was.
void ask_before(Random& random, World& world, BodyId b, const Pose& at_b) {
    switch (random.integer(0, 3)) {
    case 1:
        static_cast<void>(world.contact_manifolds(0.02));
        static_cast<void>(world.collide());
        break;
    case 2:
        world.move(b, placed_in(at_b, {1e-9, -2e-9, 0}, {1, 0, 0, 0}));
        static_cast<void>(world.contact_manifolds());
        static_cast<void>(world.penetration());
        world.move(b, at_b);
        break;
    case 3:
        world.move(b, placed_in(at_b, {0.1, 3, 0.2}, turn_around({1, 2, 3}, 1)));
        static_cast<void>(world.within(9));
        static_cast<void>(world.contact_manifolds(0.5));
        world.move(b, at_b);
        break;
    default:
        break;
    }
}

TEST_F(FlushModels, TellOneContactAndTheNormalOfTheFace) {
    const std::vector<CubeBody> all = cube_bodies();
    const std::vector<WayToStand> ways = standings();
    int met = 0, apart = 0, off_normal = 0, rounds = 0;
    const int count = many(600);
    for (int i = 0; i < count; ++i) {
        const CubeBody &a = any(all), &b = any(all);
        if (!a.is_model && !b.is_model)
            continue;
        const WayToStand& way = any(ways);
        const FlushPlacement at = placed(a, b, way);
        const bool is_swapped = random_.chance(0.5);
        World world;
        BodyId id_b;
        if (is_swapped)
            id_b = add(world, b.shape, at.b), add(world, a.shape, at.a);
        else
            add(world, a.shape, at.a), id_b = add(world, b.shape, at.b);
        ask_before(random_, world, id_b, at.b);
        SCOPED_TRACE(std::string(b.name) + " on " + a.name + " by a " + way.name + ", round " +
                     std::to_string(i) + ", gap " + std::to_string(1e15 * at.gap) + "e-15");
        const Vec3 normal = is_swapped ? -at.normal : at.normal;
        const double error = 1e-13 + 64 * at.rounding, tilt = 1e-6 + 512 * at.rounding;

        const std::vector<BodyGap> near = world.within(1), deep = world.penetration();
        ASSERT_EQ(near.size(), 1U);
        const bool meets = near[0].distance <= 0;
        ASSERT_EQ(world.collide().size(), meets ? 1U : 0U);
        ASSERT_EQ(deep.size(), meets ? 1U : 0U);
        ASSERT_EQ(world.within(0).size(), meets ? 1U : 0U);
        const std::vector<ContactManifold> contacts = world.contact_manifolds(),
                                           beside = world.contact_manifolds(0.01);
        ASSERT_EQ(contacts.empty(), !meets);
        ASSERT_FALSE(beside.empty());
        ASSERT_NEAR(near[0].distance, at.gap, error);
        ASSERT_LE(length(near[0].normal - normal), tilt) << near[0].distance;
        if (meets) {
            ASSERT_LE(length(deep[0].normal - normal), tilt);
            ASSERT_EQ(deep[0].distance, near[0].distance);
        }
        for (const ContactManifold& each : contacts) {
            ASSERT_LE(length(each.normal - normal), tilt);
            ASSERT_NEAR(each.points[0].depth, -at.gap, 2 * error);
        }
        // The normal of a short gap is a mean of those of all triangles within the margin.
        for (const ContactManifold& each : beside)
            off_normal += length(each.normal - normal) > tilt ? 1 : 0;
        ++(meets ? met : apart), ++rounds;
    }
    EXPECT_LE(off_normal, rounds / 200);
    EXPECT_GT(met, count / 10);
    EXPECT_GT(apart, count / 10);
}

/// Boxes with a common face, both turned in doubles: their triangles cross, touch or miss each other as
/// rounding has it.
TEST_F(FlushModels, PointsOfTurnedBoxesLieOnBoth) {
    constexpr std::array kHalves{0.25, 0.5, 0.75, 1.0, 1.5};
    constexpr double kError = 1e-12;
    int met = 0;
    const int rounds = many(300);
    for (int round = 0; round < rounds; ++round) {
        SCOPED_TRACE(round);
        const Vec3 a{any(kHalves), any(kHalves), any(kHalves)},
            b{any(kHalves), any(kHalves), any(kHalves)};
        const Vec3 reach = a + b;
        Vec3 from_a{random_.uniform(-0.5, 0.5) * reach.x, random_.uniform(-0.5, 0.5) * reach.y,
                    random_.uniform(-0.5, 0.5) * reach.z};
        const int axis = random_.integer(0, 2);
        Vec3 normal{axis == 0 ? 1. : 0., axis == 1 ? 1. : 0., axis == 2 ? 1. : 0.};
        from_a = from_a + (dot(reach, normal) - dot(from_a, normal)) * normal;
        const Pose at_a{{}, turn_around(random_.direction(), random_.uniform(0, 6))};
        const Pose at_b = placed_in(at_a, from_a, {1, 0, 0, 0});
        World world;
        add(world, Model(box_mesh(-a, a)), at_a);
        add(world, Model(box_mesh(-b, b)), at_b);
        const Transform a_from_world = inverse(Transform(at_a));
        normal = apply_linear(Transform(at_a), normal);
        for (const ContactManifold& each : world.contact_manifolds()) {
            ++met;
            ASSERT_LE(length(each.normal - normal), kError);
            for (std::uint32_t i = 0; i < each.count; ++i) {
                const Vec3 on_a = apply(a_from_world, each.points[i].point_a),
                           on_b = apply(a_from_world, each.points[i].point_b) - from_a;
                for (const auto& [p, half] : {std::pair(on_a, a), std::pair(on_b, b)}) {
                    ASSERT_LE(std::abs(p.x), half.x + kError);
                    ASSERT_LE(std::abs(p.y), half.y + kError);
                    ASSERT_LE(std::abs(p.z), half.z + kError);
                }
            }
        }
    }
    EXPECT_GT(met, rounds / 4);
}

/// A prism with an L for its base, whose inner corner is the z axis.
Mesh corner_of_walls() {
    const std::array<Vec3, 6> base{Vec3{-1, -1, -1}, {1, -1, -1}, {1, 0, -1},
                                   {0, 0, -1},       {0, 1, -1},  {-1, 1, -1}};
    Mesh mesh;
    for (const double up : {0., 2.})
        for (const Vec3& p : base)
            mesh.positions.push_back(p + Vec3{0, 0, up});
    for (const std::array<std::uint32_t, 3>& t :
         {std::array{0U, 1U, 2U}, {0U, 2U, 3U}, {0U, 3U, 4U}, {0U, 4U, 5U}}) {
        mesh.triangles.push_back({t[2], t[1], t[0]});
        mesh.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
    }
    for (std::uint32_t i = 0; i < 6; ++i) {
        const std::uint32_t k = (i + 1) % 6;
        mesh.triangles.push_back({i, k, k + 6});
        mesh.triangles.push_back({i, k + 6, i + 6});
    }
    return mesh;
}

TEST_F(FlushModels, ACornerHasAManifoldOfItsNearestWall) {
    constexpr double kHalf = 0.2;
    const Vec3 corner{kHalf, kHalf, kHalf};
    const Model walls(corner_of_walls());
    const std::vector<AnyShape> inside{Model(box_mesh(-corner, corner)), Box3{-corner, corner},
                                       Convex(box_mesh(-corner, corner))};
    constexpr std::array kGaps{0., 1e-3, 1e-2, 2e-2};
    constexpr std::array kMargins{0.02, 0.05, 0.1};
    constexpr std::array kHeights{0., 0.5, 0.3};
    int rounds = 0, off = 0;
    for (const AnyShape& shape : inside)
        for (const double gap_x : kGaps)
            for (const double gap_y : kGaps)
                for (const double margin : kMargins)
                    for (const double z : kHeights) {
                        World world;
                        world.add(walls, {});
                        add(world, shape, Pose{{kHalf + gap_x, kHalf + gap_y, z}, {1, 0, 0, 0}});
                        const double gap = std::min(gap_x, gap_y);
                        const std::vector<ContactManifold> contacts =
                            world.contact_manifolds(margin);
                        ASSERT_FALSE(contacts.empty());
                        double deepest = -HUGE_VAL;
                        bool is_of_walls = true;
                        for (const ContactManifold& each : contacts) {
                            for (std::uint32_t i = 0; i < each.count; ++i)
                                deepest = std::max(deepest, each.points[i].depth);
                            is_of_walls =
                                is_of_walls && std::max(each.normal.x, each.normal.y) > 1 - 1e-9;
                        }
                        // Never a depth that is not there.
                        ASSERT_LE(deepest, gap > 0 ? 0 : 1e-12)
                            << gap_x << ' ' << gap_y << ' ' << z << ' ' << margin;
                        off += std::abs(deepest + gap) > 1e-12 || !is_of_walls ? 1 : 0;
                        ++rounds;
                    }
    EXPECT_EQ(rounds, 3 * 4 * 4 * 3 * 3);
    // A wide margin may still mix the gaps of both walls.
    EXPECT_LE(off, rounds / 20);
}

TEST_F(FlushModels, AWideMarginKeepsTheNearestContactOfASolidInside) {
    const Model outer(box_mesh({-1, -1, -1}, {1, 1, 1})),
        inner(box_mesh({-.2, -.2, -.2}, {.2, .2, .2}));
    constexpr std::array kPlaces{0., .25, .5, .6, .7, .79, -.79};
    for (int i = 0; i < 200; ++i) {
        const Vec3 place{any(kPlaces), any(kPlaces), any(kPlaces)};
        World world;
        world.add(outer, {});
        world.add(inner, Pose{place, {1, 0, 0, 0}});
        const double gap = 0.8 - max_abs(place);
        for (const double margin : {0.02, 0.05, 0.1, 0.2, 1.0}) {
            if (std::abs(gap - margin) < 1e-9)
                continue;
            const std::vector<ContactManifold> contacts = world.contact_manifolds(margin);
            double deepest = -HUGE_VAL;
            for (const ContactManifold& each : contacts)
                for (std::uint32_t k = 0; k < each.count; ++k)
                    deepest = std::max(deepest, each.points[k].depth);
            ASSERT_EQ(contacts.empty(), gap > margin) << i << ' ' << margin;
            if (!contacts.empty()) {
                ASSERT_NEAR(deepest, -gap, 1e-9) << "round " << i << " margin " << margin;
            }
        }
    }
}

/// Balls and capsules flush with a face, an edge or a corner of a convex body, far from the origin.
TEST_F(FlushModels, AConvexBodyAndABallHaveOneAnswerFarFromTheOrigin) {
    const Convex cube(box_mesh({-1, -1, -1}, {1, 1, 1}));
    int met = 0, apart = 0;
    const int count = many(2000);
    for (int i = 0; i < count; ++i) {
        const double radius = random_.chance(0.5) ? 1 : 0.25;
        const Vec3 far = any(std::array{0., 1e3, 1e5, 1e6, 1e7}) * Vec3{1, 0.3, -0.7};
        const Pose at_cube{far, turn_around(random_.direction(), random_.uniform(0, 3))};
        const Vec3 edge = normalized_or_zero({1, 1, 0});
        const Vec3 along{0, 0, random_.uniform(-1, 1)};
        const Vec3 place =
            any(std::array{Vec3{1 + radius, random_.uniform(-1, 1), 0} + along,
                           Vec3{1, 1, 0} + radius * edge + along, Vec3{1 + radius, 1, 0} + along});
        const AnyShape round = random_.chance(0.5) ? AnyShape(Sphere{{}, radius})
                                                   : AnyShape(Capsule{{{}, {0, 0, 1}}, radius});
        World world;
        const bool is_first = random_.chance(0.5);
        const Pose at_round = placed_in(at_cube, place, {1, 0, 0, 0});
        if (is_first)
            add(world, round, at_round);
        add(world, cube, at_cube);
        if (!is_first)
            add(world, round, at_round);
        World fresh;
        add(fresh, cube, at_cube), add(fresh, round, at_round);
        const bool meets = fresh.within(9).at(0).distance <= 0;
        std::array<int, 5> order{0, 1, 2, 3, 4};
        for (std::size_t k = order.size(); k > 1; --k)
            std::swap(order[k - 1], order[std::size_t(random_.integer(0, int(k) - 1))]);
        for (int repeat = 0; repeat < 2; ++repeat)
            for (const int query : order) {
                const bool found = query == 0   ? !world.collide().empty()
                                   : query == 1 ? !world.penetration().empty()
                                   : query == 2 ? !world.within(0).empty()
                                   : query == 3 ? !world.contact_manifolds().empty()
                                                : world.within(9).at(0).distance <= 0;
                ASSERT_EQ(found, meets) << "round " << i << " query " << query;
            }
        ++(meets ? met : apart);
    }
    EXPECT_GT(met, count / 10);
    EXPECT_GT(apart, count / 10);
}

/// The points and normals of one pair in one world do not depend on which query tells them.
TEST_F(FlushModels, ACapsuleAlongAFaceOrAnEdgeHasOneNormalAndPlace) {
    const Vec3 corner{1, 1, 1};
    const std::array<AnyShape, 2> solids{Box3{-corner, corner}, Convex(box_mesh(-corner, corner))};
    constexpr std::array kGrid{-1., -.5, 0., .5, 1.};
    int met = 0;
    for (int i = 0; i < 1500; ++i) {
        const AnyShape& solid = any(solids);
        const Vec3 start{any(kGrid), any(kGrid), any(kGrid)};
        const Vec3 way = any(
            std::array{Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 0, -2}});
        World world;
        if (random_.chance(0.5))
            add(world, solid, {}), world.add(Capsule{{start, start + way}, 0.3}, {});
        else
            world.add(Capsule{{start, start + way}, 0.3}, {}), add(world, solid, {});
        if (random_.chance(0.5))
            static_cast<void>(world.contact_manifolds(1));
        const std::vector<BodyGap> deep = world.penetration(), near = world.within(0);
        const std::vector<ContactManifold> contacts = world.contact_manifolds();
        ASSERT_EQ(deep.size(), near.size());
        ASSERT_EQ(contacts.size(), near.size());
        if (near.empty())
            continue;
        ASSERT_EQ(deep[0].distance, near[0].distance);
        ASSERT_LE(length(deep[0].normal - near[0].normal), 1e-9) << i;
        ASSERT_LE(length(deep[0].point_a - near[0].point_a), 1e-9) << i;
        ASSERT_LE(length(deep[0].point_b - near[0].point_b), 1e-9) << i;
        ASSERT_LE(length(contacts[0].normal - near[0].normal), 1e-9) << i;
        ++met;
    }
    EXPECT_GT(met, 500);
}

/// A small open surface in a face of a solid, over or under it by rounding.
TEST(FlushPlates, AreInContact) {
    Random random(5541);
    int met = 0;
    for (int i = 0; i < many(900); ++i) {
        const double x = random.uniform(0.05, 0.4), y = random.uniform(0.05, 0.4);
        const Model plate(grid_mesh(2, 2, false, false, [&](double u, double v) {
            return Vec3{x * (2 * u - 1), y * (2 * v - 1), 0};
        }));
        const Pose frame = random.pose(1);
        const double height =
            std::array{0.0, 1e-16, -1e-16, 1e-15, -1e-15}.at(std::size_t(random.integer(0, 4)));
        World world;
        world.add(plate, placed_in(frame, {random.uniform(-0.05, 0.05), 0, height}, {1, 0, 0, 0}));
        if (random.chance(0.5))
            world.add(Box3{{-0.5, -0.5, -1}, {0.5, 0.5, 0}}, frame);
        else
            world.add(Convex(box_mesh({-0.5, -0.5, -1}, {0.5, 0.5, 0}).positions), frame);
        const std::vector<BodyGap> near = world.within(0.1);
        ASSERT_EQ(near.size(), 1U) << i;
        EXPECT_NEAR(near[0].distance, 0, 1e-13);
        const std::vector<BodyGap> deep = world.penetration();
        EXPECT_EQ(deep.size(), world.collide().size());
        met += deep.empty() ? 0 : 1;
        EXPECT_EQ(world.contact_manifolds().empty(), deep.empty()) << i;
    }
    EXPECT_GT(met, many(900) / 20);
}

} // namespace
} // namespace abut::test
