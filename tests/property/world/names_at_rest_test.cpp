// Bodies that lie on others and hardly move keep the names of their contact points, and have the four
// corners of the face on which they lie.

#include <abut/vector.h>
#include <abut/world.h>

#include "tests/support/kinds_of_bodies.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <iostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace abut::test {
namespace {

/// A prism of twelve sides between two heights.
Mesh twelve_sided(double low, double high) {
    Mesh mesh = prism_mesh(low, high, 0.5, 12);
    for (Vec3& p : mesh.positions) // its axis is x
        p = {p.y, p.z, p.x};
    return mesh;
}

struct NamedShape {
    const char* name;
    AnyShape shape;
};

std::vector<NamedShape> lying_bodies() {
    const Mesh box = box_mesh({-0.5, -0.4, 0}, {0.5, 0.4, 0.6}), prism = twelve_sided(0, 0.8);
    return {{"box", Box3{{-0.5, -0.4, 0}, {0.5, 0.4, 0.6}}},
            {"mesh box", Model(box)},
            {"convex box", Convex(box)},
            {"prism", Convex(prism)},
            {"mesh prism", Model(prism)}};
}

std::vector<NamedShape> flat_grounds() {
    const auto floor = [](int n) {
        return Model(grid_mesh(n, n, false, false, [](double u, double v) {
            return Vec3{4 * u - 2, 4 * v - 2, 0};
        }));
    };
    const Mesh same = box_mesh({-0.5, -0.4, -0.6}, {0.5, 0.4, 0}), prism = twelve_sided(-0.8, 0);
    return {{"half-space", HalfSpace{{0, 0, 1}, 0}},
            {"floor of 0.25 m cells", floor(16)},
            {"floor of 1 m cells", floor(4)},
            {"large box", Box3{{-2, -2, -1}, {2, 2, 0}}},
            {"large mesh box", Model(box_mesh({-2, -2, -1}, {2, 2, 0}))},
            {"equal box", Box3{{-0.5, -0.4, -0.6}, {0.5, 0.4, 0}}},
            {"equal mesh box", Model(same)},
            {"equal convex box", Convex(same)},
            {"prism", Convex(prism)},
            {"mesh prism", Model(prism)}};
}

/// The steps of a body that lies still but for a small motion.
class LyingBody {
public:
    LyingBody(Random& random, const AnyShape& body, const AnyShape& ground, bool is_aligned)
        : random_(random) {
        add(world_, ground, {});
        at_.translation.z = -1e-4;
        if (!is_aligned) {
            const double turn = random.uniform(0, 3);
            at_.translation = {random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), -1e-4};
            at_.rotation = {std::cos(turn), 0, 0, std::sin(turn)};
        }
        body_ = add(world_, body, at_);
    }
    /// Moves a little, and counts names and new ones.
    void step(double motion, double margin) {
        const auto some = [&] { return random_.uniform(-motion, motion); };
        Pose pose = at_;
        pose.translation = pose.translation + Vec3{some(), some(), some()};
        for (double& q : pose.rotation)
            q += some();
        world_.move(body_, pose);
        const std::vector<ContactManifold> manifolds = world_.contact_manifolds(margin);
        ASSERT_EQ(manifolds.size(), 1U);
        ASSERT_EQ(manifolds[0].count, 4U);
        std::set<std::uint64_t> now;
        for (const ContactPoint& point : manifolds[0].points) {
            now.insert(point.feature);
            EXPECT_NEAR(point.depth, 1e-4, 10 * motion + 1e-12);
            EXPECT_LE(point.depth, manifolds[0].points[0].depth);
        }
        EXPECT_EQ(now.size(), 4U);
        EXPECT_LE(std::abs(1 - manifolds[0].normal.z), 100 * motion * motion + 1e-15);
        for (const std::uint64_t name : now)
            fresh += last_.empty() || last_.contains(name) ? 0 : 1;
        all += last_.empty() ? 0 : now.size();
        last_ = now;
    }
    std::size_t fresh = 0, all = 0;

private:
    Random& random_;
    World world_;
    Pose at_;
    BodyId body_;
    std::set<std::uint64_t> last_;
};

TEST(NamesAtRest, StayOnEveryGround) {
    Random random(331);
    std::size_t fresh = 0, all = 0;
    for (const NamedShape& body : lying_bodies())
        for (const NamedShape& ground : flat_grounds())
            for (const double margin : {0.0, 0.01})
                for (int round = 0; round < many(6); ++round) {
                    SCOPED_TRACE(std::string(body.name) + " on " + ground.name + ", margin " +
                                 std::to_string(margin) + ", round " + std::to_string(round));
                    LyingBody lies(random, body.shape, ground.shape, round % 3 == 0);
                    for (int step = 0; step < 12; ++step)
                        ASSERT_NO_FATAL_FAILURE(lies.step(step < 8 ? 1e-6 : 1e-15, margin));
                    const bool is_large = std::string(ground.name).find("equal") != 0 &&
                                          std::string(ground.name).find("prism") > 20;
                    if (is_large) {
                        EXPECT_EQ(lies.fresh, 0U);
                    }
                    fresh += lies.fresh, all += lies.all;
                }
    std::cout << fresh << " of " << all << " names are new\n";
    EXPECT_LE(fresh, all / 200);
}

} // namespace
} // namespace abut::test
