// Contact manifolds of a world of surfaces of which many rest: those of the step before, to the bit, and
// regions and normals of a new world in every step.

#include <abut/deformable.h>
#include <abut/progress.h>
#include <abut/world.h>

#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace abut::test {
namespace {

/// A body of the tested world, and the step since which it has stayed.
struct RestingBody {
    BodyId id;
    std::size_t mesh = 0;
    Pose pose;
    int still_since = 0;
};

class RestingCrowd {
public:
    RestingCrowd(Random& random, const std::vector<Model>& models)
        : random_(random), models_(models) {
        for (int i = 0; i < 12; ++i)
            bodies.push_back(added(0));
    }

    /// Moves some bodies, places some again where they are, and replaces some by others.
    void step(int now) {
        for (RestingBody& body : bodies)
            if (random_.chance(0.15)) {
                const Vec3 by = 0.02 * random_.direction();
                body.pose.translation = body.pose.translation + by;
                world.move(body.id, body.pose);
                body.still_since = now;
            } else if (random_.chance(0.3)) {
                world.move(body.id, body.pose);
            } else if (random_.chance(0.02)) {
                world.remove(body.id);
                body = added(now);
            }
    }

    /// A new world with the same bodies in the order of their indices.
    [[nodiscard]] std::vector<ContactManifold> anew(double margin) const {
        World other;
        std::vector<std::size_t> of_index;
        for (std::uint32_t index = 0; of_index.size() < bodies.size(); ++index)
            for (std::size_t i = 0; i < bodies.size(); ++i)
                if (bodies[i].id.index == index) {
                    other.add(models_[bodies[i].mesh], bodies[i].pose);
                    of_index.push_back(i);
                }
        std::vector<ContactManifold> manifolds = other.contact_manifolds(margin);
        for (ContactManifold& m : manifolds) {
            m.a = bodies[of_index[m.a.index]].id;
            m.b = bodies[of_index[m.b.index]].id;
        }
        return manifolds;
    }

    [[nodiscard]] int still_since(BodyId id) const {
        for (const RestingBody& body : bodies)
            if (body.id == id)
                return body.still_since;
        return -1;
    }

    World world;
    std::vector<RestingBody> bodies;

private:
    RestingBody added(int now) {
        RestingBody body;
        body.mesh = static_cast<std::size_t>(random_.integer(0, int(models_.size()) - 1));
        body.pose = random_.pose(0.8);
        body.id = world.add(models_[body.mesh], body.pose);
        body.still_since = now;
        return body;
    }
    Random& random_;
    const std::vector<Model>& models_;
};

void expect_same(const ContactManifold& m, const ContactManifold& n) {
    EXPECT_EQ(m.normal, n.normal);
    EXPECT_EQ(m.region, n.region);
    EXPECT_EQ(m.status, n.status);
    ASSERT_EQ(m.count, n.count);
    for (std::uint32_t i = 0; i < m.count; ++i) {
        EXPECT_EQ(m.points[i].point_a, n.points[i].point_a);
        EXPECT_EQ(m.points[i].point_b, n.points[i].point_b);
        EXPECT_EQ(m.points[i].depth, n.points[i].depth);
        EXPECT_EQ(m.points[i].feature, n.points[i].feature);
    }
}

using PairOfIndices = std::pair<std::uint32_t, std::uint32_t>;
std::map<PairOfIndices, std::vector<ContactManifold>>
by_pair(const std::vector<ContactManifold>& manifolds) {
    std::map<PairOfIndices, std::vector<ContactManifold>> result;
    for (const ContactManifold& m : manifolds)
        result[{m.a.index, m.b.index}].push_back(m);
    return result;
}

/// The normals of manifolds, sorted. Points and their names may follow the last step; normals do not.
std::vector<std::array<double, 3>> normals_of(const std::vector<ContactManifold>& manifolds) {
    std::vector<std::array<double, 3>> normals;
    normals.reserve(manifolds.size());
    for (const ContactManifold& m : manifolds)
        normals.push_back({m.normal.x, m.normal.y, m.normal.z});
    std::sort(normals.begin(), normals.end());
    return normals;
}

TEST(RestingContacts, AreThoseOfTheStepBefore) {
    Random random(4901);
    const std::vector<Model> models{Model(torus_mesh(0.4, 0.15, 12, 8)),
                                    Model(box_mesh({-0.3, -0.2, -0.1}, {0.3, 0.2, 0.1}))};
    std::size_t all = 0, resting = 0;
    for (int round = 0; round < many(6); ++round) {
        set_threads(random.integer(1, 3));
        RestingCrowd crowd(random, models);
        int since_margin = 0;
        double margin = 0;
        std::map<PairOfIndices, std::vector<ContactManifold>> before;
        for (int step = 1; step <= 24; ++step) {
            if (random.chance(0.1))
                margin = random.chance(0.5) ? 0 : random.uniform(0.01, 0.05), since_margin = step;
            crowd.step(step);
            const auto found = crowd.world.contact_manifolds(margin);
            const auto now = by_pair(found), expected = by_pair(crowd.anew(margin));
            ASSERT_EQ(now.size(), expected.size());
            for (const auto& [pair, manifolds] : now) {
                ASSERT_TRUE(expected.contains(pair));
                EXPECT_EQ(normals_of(manifolds), normals_of(expected.at(pair)));
                all += manifolds.size();
                const int still = std::max({crowd.still_since(manifolds[0].a),
                                            crowd.still_since(manifolds[0].b), since_margin, 1});
                if (still == step)
                    continue;
                resting += manifolds.size();
                ASSERT_EQ(before.at(pair).size(), manifolds.size());
                for (std::size_t i = 0; i < manifolds.size(); ++i)
                    expect_same(manifolds[i], before.at(pair)[i]);
            }
            before = now;
        }
    }
    set_threads(0);
    EXPECT_GT(all, 500U);
    EXPECT_GT(resting, all / 4);
    EXPECT_LT(resting, all - all / 10);
}

TEST(RestingContacts, EndWhenADeformableIsRefreshed) {
    World world;
    const Mesh slab = box_mesh({-1, -1, -1}, {1, 1, 0});
    Mesh cube = box_mesh({-0.3, -0.3, -0.1}, {0.3, 0.3, 0.5});
    Deformable surface(cube);
    world.add(Model(slab), {});
    const BodyId soft = world.add(surface);
    std::optional<double> depth;
    for (int step = 0; step < 4; ++step) {
        const auto manifolds = world.contact_manifolds();
        ASSERT_EQ(manifolds.size(), 1U);
        depth = manifolds[0].points[0].depth;
        EXPECT_NEAR(*depth, 0.1, 1e-6);
    }
    for (Vec3& p : cube.positions)
        p.z += 0.05;
    surface.set_motion(cube.positions, cube.positions);
    world.refresh(soft);
    for (int step = 0; step < 4; ++step)
        EXPECT_NEAR(world.contact_manifolds().at(0).points[0].depth, 0.05, 1e-6);
}

TEST(RestingContacts, ABodyPlacedAgainCountsAsAStep) {
    World world;
    const Model model(box_mesh({0, 0, 0}, {1, 1, 1}));
    world.add(model, {});
    const BodyId b = world.add(model, {{0.5, 0, 0}, {1, 0, 0, 0}});
    world.collide();
    EXPECT_EQ(world.begun().size(), 1U);
    world.move(b, {{0.5, 0, 0}, {1, 0, 0, 0}});
    world.collide();
    EXPECT_TRUE(world.begun().empty());
}

} // namespace
} // namespace abut::test
