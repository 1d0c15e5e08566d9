// Contacts at re-entrant edges and vertices of models: which way their normals lead. Each test
// prints its seed and what it has seen.

#include <abut/surface_contacts.h>

#include "math/transform.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/solids.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <numbers>
#include <vector>

namespace abut::test {
namespace {

constexpr double kReentrantX = 0.25;
/// Where points coincide to rounding, their direction is not that of the normal.
constexpr double kCoincide = 1e-14;

/// A prism of height 1 with a notch, whose walls meet in a re-entrant edge along z.
class NotchedPrism {
public:
    explicit NotchedPrism(double angle)
        : wall_{std::cos(angle / 2), std::sin(angle / 2), 0}, out_{std::sin(angle / 2),
                                                                   std::cos(angle / 2), 0} {
        const double width = (1 - kReentrantX) * std::tan(angle / 2);
        mesh_ = star_prism({{kReentrantX, 0, 0},
                            {1, width, 0},
                            {1, 2, 0},
                            {-1, 2, 0},
                            {-1, -2, 0},
                            {1, -2, 0},
                            {1, -width, 0}},
                           1);
    }
    [[nodiscard]] const Mesh& mesh() const { return mesh_; }
    /// Upwards along the upper wall, away from the re-entrant edge.
    [[nodiscard]] const Vec3& wall() const { return wall_; }
    /// Signed distance of a point near the re-entrant edge, and far from the prism's other edges.
    [[nodiscard]] double distance(const Vec3& p) const {
        const double x = p.x - kReentrantX, y = std::abs(p.y);
        // The notch is symmetric: the wall that is nearer is on the point's side.
        const double above_wall = y * out_.y - x * out_.x, along_wall = x * wall_.x + y * wall_.y;
        const double from_wall = along_wall > 0 ? std::abs(above_wall) : std::hypot(x, y);
        return above_wall < 0 ? from_wall : -from_wall;
    }
    /// How fast a point that leaves the re-entrant edge along the bisector leaves both walls.
    [[nodiscard]] double slope() const { return out_.x; }

private:
    Vec3 wall_, out_;
    Mesh mesh_;
};

double from_reentrant_edge(const Vec3& p) {
    return std::hypot(p.x - kReentrantX, p.y);
}

struct ReentrantSeen {
    std::size_t coincide = 0, gaps = 0, depths = 0;
};

/// The contact's normal leads out of the prism at the contact's point, by its contract.
void check_leads_out(const NotchedPrism& prism, const SurfaceContact& c, const Transform& world,
                     ReentrantSeen& seen) {
    const Transform prism_from_world = inverse(world);
    const Vec3 p = apply(prism_from_world, c.point), n = apply_linear(prism_from_world, c.normal);
    ASSERT_NEAR(length(c.normal), 1, 1e-12);
    const double distance = prism.distance(p);
    ASSERT_NEAR(c.distance, distance, 1e-13);
    ASSERT_LT(length(c.point_on_body + c.distance * c.normal - c.point), 2e-13);
    // A way out by the depth ends on the surface, but for the rounding within which points
    // coincide.
    const double depth = std::max(-c.distance, 0.0);
    ASSERT_GE(prism.distance(p + depth * n), depth > 1e-12 ? -2e-15 : -2e-13);
    const double apart = std::abs(distance);
    (apart < kCoincide ? seen.coincide : distance > 0 ? seen.gaps : seen.depths) += 1;
    // So the normal is the direction of the nearest points, whose distance is known.
    ASSERT_LT(std::abs(prism.distance(p - distance * n)), 2e-13);
    if (apart >= kCoincide)
        return;
    // A touching point leaves both walls where they meet, and else the wall that it touches.
    const double from_edge = from_reentrant_edge(p);
    if (from_edge < kCoincide) {
        ASSERT_GT(prism.distance(p + 1e-6 * n), 0.9e-6 * prism.slope() - 1e-15);
    } else if (from_edge > 1e-12) {
        ASSERT_GT(prism.distance(p + 0.1 * from_edge * n), 0.05 * from_edge - 1e-15);
    }
}

/// 0, or a length from 1e-17 to 1e-3 of either sign.
double small_offset(Random& random) {
    return random.chance(0.3)
               ? 0
               : std::pow(10, -random.uniform(3, 17)) * (random.chance(0.5) ? 1 : -1);
}

double any_notch(Random& random) {
    constexpr double kRightAngle = std::numbers::pi / 2; // an L
    return random.chance(0.3) ? kRightAngle : random.uniform(0.3, 1.15) * kRightAngle;
}

TEST(ReentrantContacts, VerticesBesideTheEdge) {
    Random random(1618);
    ReentrantSeen seen;
    for (int round = 0; round < many(600); ++round) {
        const NotchedPrism prism(any_notch(random));
        const Model model(prism.mesh());
        Pose pose = random.chance(0.3) ? Pose{} : random.pose(0);
        const Transform world = pose;
        // At the edge, or on a wall beside it, and a little off.
        const double side = random.chance(0.5) ? 1 : -1,
                     along = random.chance(0.6) ? 0 : std::pow(10, -random.uniform(1, 9));
        const Vec3 wall{prism.wall().x, side * prism.wall().y, 0};
        const double turn = random.uniform(0, 6.28), off = small_offset(random);
        const Vec3 p = Vec3{kReentrantX, 0, random.uniform(0.3, 0.7)} + along * wall +
                       off * Vec3{std::cos(turn), std::sin(turn), 0};
        Mesh triangle{{apply(world, p), apply(world, p + Vec3{1, 0.1, 0.05}),
                       apply(world, p + Vec3{1, -0.1, 0.05})},
                      {{0, 1, 2}}};
        const auto found = within(Deformable(triangle), model, pose, 0.01);
        ASSERT_FALSE(found.empty());
        ASSERT_EQ(found[0].feature, Feature::vertex);
        ASSERT_EQ(found[0].id, 0U);
        ASSERT_NO_FATAL_FAILURE(check_leads_out(prism, found[0], world, seen)) << round;
    }
    std::cout << seen.coincide << " touch, " << seen.gaps << " gaps, " << seen.depths
              << " depths\n";
    EXPECT_GT(seen.coincide, std::size_t(many(600)) / 8);
    EXPECT_GT(seen.gaps, std::size_t(many(600)) / 8);
    EXPECT_GT(seen.depths, std::size_t(many(600)) / 8);
}

/// The edge of a triangle along the re-entrant edge, and triangles flush with a wall.
TEST(ReentrantContacts, EdgesAndFacesInTheNotch) {
    Random random(1619);
    ReentrantSeen seen;
    std::size_t edges = 0, faces = 0;
    for (int round = 0; round < many(600); ++round) {
        const NotchedPrism prism(any_notch(random));
        const Model model(prism.mesh());
        const Pose pose = random.chance(0.3) ? Pose{} : random.pose(0);
        const Transform world = pose;
        const double side = random.chance(0.5) ? 1 : -1;
        const Vec3 wall{prism.wall().x, side * prism.wall().y, 0};
        const double off = std::abs(small_offset(random));
        Triangle t;
        const double turn = random.uniform(-0.9, 0.9) * std::asin(prism.slope());
        const Vec3 first{kReentrantX + off * std::cos(turn), off * std::sin(turn), -0.5};
        if (random.chance(0.5)) { // an edge that is longer than the prism
            t = {first, first + Vec3{0, 0, 2}, {1.5, 0, random.uniform(0, 1)}};
        } else { // flush with the wall, or turned about a line beside it and parallel to the edge
            const double beside = random.chance(0.5) ? 0 : random.uniform(0, 0.01);
            const Vec3 at = first + beside * wall;
            t = {at, at + Vec3{0, 0, 2}, at + 0.2 * wall + Vec3{0, 0, 1}};
        }
        Mesh mesh{{apply(world, t[0]), apply(world, t[1]), apply(world, t[2])}, {{0, 1, 2}}};
        for (const SurfaceContact& c : within(Deformable(mesh), model, pose, 0.005)) {
            const Vec3 p = apply(inverse(world), c.point);
            // Vertices are beside the prism, where its distance is another. So are the ends of the
            // walls.
            if (c.feature == Feature::vertex || !(p.z > 0.01 && p.z < 0.99) || p.x > 0.9)
                continue;
            // A triangle that passes through a wall by rounding may touch it anywhere.
            if (prism.distance(p) < -kCoincide)
                continue;
            (c.feature == Feature::edge ? edges : faces) += 1;
            ASSERT_NO_FATAL_FAILURE(check_leads_out(prism, c, world, seen)) << round;
        }
    }
    std::cout << seen.coincide << " touch, " << seen.gaps << " gaps, " << edges << " edges, "
              << faces << " faces\n";
    EXPECT_GT(seen.coincide, std::size_t(many(600)) / 60);
    EXPECT_GT(edges, std::size_t(many(600)) / 60);
}

/// A vertex in the innermost corner of a cube that lacks a cell, on the corner's edges, and at the
/// end of a re-entrant edge: it leaves all faces there.
TEST(ReentrantContacts, VerticesInCorners) {
    Random random(1620);
    const Mesh mesh = cells_mesh(2, [](int x, int y, int z) { return x + y + z < 3; });
    const Model model(mesh), inside_out(reversed(mesh));
    for (int round = 0; round < many(200); ++round) {
        const Pose pose = random.chance(0.3) ? Pose{} : random.pose(0);
        const Transform world = pose;
        const Vec3 p{random.chance(0.7) ? 1 : 2.0, random.chance(0.7) ? 1 : 2.0, 1};
        Mesh triangle{
            {apply(world, p), apply(world, p + Vec3{3, 2.9, 3}), apply(world, p + Vec3{2.9, 3, 3})},
            {{0, 1, 2}}};
        for (const Model* m : {&model, &inside_out}) {
            const auto found = within(Deformable(triangle), *m, pose, 1e-3);
            ASSERT_FALSE(found.empty());
            ASSERT_EQ(found[0].feature, Feature::vertex);
            ASSERT_LT(std::abs(found[0].distance), kCoincide);
            const Vec3 n = apply_linear(inverse(world), found[0].normal);
            EXPECT_GT(n.x, 0.3);
            EXPECT_GT(n.y, 0.3);
            EXPECT_GT(n.z, 0.3);
        }
    }
}

} // namespace
} // namespace abut::test
