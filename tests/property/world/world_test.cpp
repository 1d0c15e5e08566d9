// Random scripts of operations on a world, against queries of all pairs of bodies.

#include <abut/deformable.h>
#include <abut/error.h>
#include <abut/progress.h>
#include <abut/shape_queries.h>
#include <abut/world.h>

#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/world_script.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <optional>
#include <variant>

namespace abut::test {
namespace {

using Script = WorldScript<Random>;

TEST(World, ScriptsAgreeWithAllPairs) {
    Random random(5201);
    std::size_t checked = 0, pairs = 0, changed = 0, removed = 0;
    for (int round = 0; round < many(24); ++round) {
        set_threads(random.integer(1, 4));
        const auto method = static_cast<BroadPhaseMethod>(random.integer(0, 3));
        World world({method, {}});
        Script script(random, world, {round % 4 == 0 ? 1e7 : 0, true});
        BodyPairs last;
        for (int step = 0; step < 40; ++step) {
            script.step();
            world.update();
            const BodyPairs now = pairs_of_boxes(script, world);
            ASSERT_EQ(world.pairs(), now);
            ASSERT_EQ(world.begun(), without(now, last));
            ASSERT_EQ(world.ended(), without(last, now));
            ASSERT_EQ(world.size(), script.bodies().size());
            checked += script.bodies().size(), pairs += now.size();
            changed += world.begun().size() + world.ended().size();
            last = now;
        }
        for (const BodyId id : script.removed())
            EXPECT_FALSE(world.is_valid(id));
        removed += script.removed().size();
    }
    set_threads(0);
    EXPECT_GT(pairs, checked / 4);
    EXPECT_GT(changed, checked / 8);
    EXPECT_GT(removed, 200U);
}

/// Whether a vertex of a model lies in a solid.
bool any_inside(const Model& model, const Pose& pose, const Model& solid, const Pose& solid_pose) {
    return std::any_of(model.mesh().positions.begin(), model.mesh().positions.end(),
                       [&](const Vec3& p) {
                           return contains(solid, solid_pose, apply(pose, p)).side != Side::outside;
                       });
}

/// Whether a convex body touches b, by its surface and by points inside. Nothing for flat bodies,
/// and where rounding decides.
std::optional<bool> touch_convex_by_hand(const Convex& convex, const Pose& pose, const Known& b) {
    if (convex.dimension() < 3)
        return std::nullopt;
    const Model solid(convex.mesh());
    if (const auto* model = std::get_if<Model>(&b.shape))
        return collide(solid, pose, *model, b.pose).meet() ||
               any_inside(*model, b.pose, solid, pose);
    if (const auto* other = std::get_if<Convex>(&b.shape)) {
        if (other->dimension() < 3)
            return std::nullopt;
        const Model other_solid(other->mesh());
        return collide(solid, pose, other_solid, b.pose).meet() ||
               any_inside(solid, pose, other_solid, b.pose) ||
               any_inside(other_solid, b.pose, solid, pose);
    }
    if (const auto* box = std::get_if<Box3>(&b.shape))
        return overlaps(solid, pose, OrientedBox{*box, b.pose}) ||
               contains(solid, pose, apply(b.pose, box->lower)).side != Side::outside;
    double gap = 0;
    Vec3 inner;
    if (const auto* sphere = std::get_if<Sphere>(&b.shape)) {
        inner = apply(b.pose, sphere->centre);
        gap = nearest(solid, pose, inner).distance - sphere->radius;
    } else {
        const auto& capsule = std::get<Capsule>(b.shape);
        inner = apply(b.pose, capsule.axis.a);
        const Segment axis{inner, apply(b.pose, capsule.axis.b)};
        gap = distance(solid, pose, axis).distance - capsule.radius;
    }
    const bool inside = contains(solid, pose, inner).side != Side::outside;
    return std::abs(gap) < 1e-12 ? std::nullopt : std::optional(inside || gap <= 0);
}

/// A deformable as a model at the start of its step.
Known at_start(const Known& body) {
    const auto* moving = std::get_if<std::shared_ptr<MovingSurface>>(&body.shape);
    return moving != nullptr ? Known{Model((*moving)->mesh), {}, body.options} : body;
}

/// Whether two bodies touch, by queries of two models or of a model and a shape; nothing for other
/// pairs and where rounding decides.
std::optional<bool> touch_by_hand(const Known& a, const Known& b) {
    if (const auto* convex = std::get_if<Convex>(&a.shape))
        return touch_convex_by_hand(*convex, a.pose, b);
    if (const auto* convex = std::get_if<Convex>(&b.shape))
        return touch_convex_by_hand(*convex, b.pose, a);
    const auto* model_a = std::get_if<Model>(&a.shape);
    const auto* model_b = std::get_if<Model>(&b.shape);
    if (model_b != nullptr && model_a == nullptr)
        return touch_by_hand(b, a);
    if (model_a == nullptr) {
        const auto *x = std::get_if<Sphere>(&a.shape), *y = std::get_if<Sphere>(&b.shape);
        if (x == nullptr || y == nullptr)
            return std::nullopt;
        const Vec3 way = apply(a.pose, x->centre) - apply(b.pose, y->centre);
        return length(way) <= x->radius + y->radius;
    }
    if (model_b != nullptr)
        return collide(*model_a, a.pose, *model_b, b.pose).meet();
    if (const auto* sphere = std::get_if<Sphere>(&b.shape))
        return overlaps(*model_a, a.pose, Sphere{apply(b.pose, sphere->centre), sphere->radius});
    if (const auto* box = std::get_if<Box3>(&b.shape))
        return overlaps(*model_a, a.pose, OrientedBox{*box, b.pose});
    const auto& capsule = std::get<Capsule>(b.shape);
    const Segment axis{apply(b.pose, capsule.axis.a), apply(b.pose, capsule.axis.b)};
    const double gap = distance(*model_a, a.pose, axis).distance - capsule.radius;
    return std::abs(gap) < 1e-12 ? std::nullopt : std::optional(gap <= 0);
}

TEST(World, CollideEqualsAllPairs) {
    Random random(5202);
    std::size_t met = 0, apart = 0;
    for (int round = 0; round < many(10); ++round) {
        set_threads(random.integer(1, 4));
        World world;
        Script script(random, world, {0, true});
        for (int step = 0; step < 12; ++step) {
            script.step();
            const BodyPairs touching = world.collide();
            const BodyPairs known = pairs_where(script, [&](BodyId a, BodyId b) {
                const auto by_hand =
                    touch_by_hand(at_start(script.bodies().at(a)), at_start(script.bodies().at(b)));
                return by_hand ? *by_hand : holds(touching, {a, b});
            });
            ASSERT_EQ(touching, known);
            met += touching.size();
            apart += world.pairs().size() - touching.size();
            const auto contacts = world.penetration();
            ASSERT_EQ(contacts.size(), touching.size());
            for (std::size_t i = 0; i < contacts.size(); ++i) {
                EXPECT_EQ(contacts[i].a, touching[i].a);
                EXPECT_EQ(contacts[i].b, touching[i].b);
                EXPECT_LE(contacts[i].distance, 1e-12);
            }
        }
    }
    set_threads(0);
    EXPECT_GT(met, 200U);
    EXPECT_GT(apart, 200U);
}

TEST(World, WithinEqualsAllPairs) {
    Random random(5203);
    std::size_t near = 0, far = 0;
    for (int round = 0; round < many(10); ++round) {
        World world;
        Script script(random, world);
        for (int step = 0; step < 12; ++step)
            script.step();
        const double limit = random.uniform(0, 0.3);
        const auto all = world.within(10);
        BodyPairs expected;
        for (const BodyGap& gap : all)
            if (gap.distance <= limit)
                expected.push_back({gap.a, gap.b});
        EXPECT_EQ(pairs_where(script, [](BodyId, BodyId) { return true; }).size(), all.size());
        BodyPairs found;
        for (const BodyGap& gap : world.within(limit)) {
            found.push_back({gap.a, gap.b});
            EXPECT_LE(gap.distance, limit);
        }
        EXPECT_EQ(found, expected);
        near += found.size(), far += all.size() - found.size();
        for (const BodyPair& pair : world.collide())
            EXPECT_TRUE(holds(found, pair));
    }
    EXPECT_GT(near, 50U);
    EXPECT_GT(far, 100U);
}

TEST(World, RefusesBadBodiesByTheirIdAndStaysUnchanged) {
    World world;
    const BodyId first = world.add(Sphere{{}, 1}, {});
    const auto message = [&](const auto& work) -> std::string {
        try {
            work();
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_argument);
            return error.what();
        }
        return "no error";
    };
    const Pose bad{{0, NAN, 0}, {1, 0, 0, 0}}, unturned{{}, {0, 0, 0, 0}};
    EXPECT_EQ(message([&] { world.move(first, bad); }).substr(0, 8), "body 0: ");
    EXPECT_EQ(message([&] { world.move(first, unturned); }).substr(0, 8), "body 0: ");
    EXPECT_EQ(message([&] { world.add(Sphere{{}, 1}, bad); }).substr(0, 8), "body 1: ");
    EXPECT_EQ(message([&] { world.add(Sphere{{}, -1}, {}); }).substr(0, 8), "body 1: ");
    EXPECT_EQ(message([&] { world.add(Box3{}, {}); }).substr(0, 8), "body 1: ");
    EXPECT_EQ(world.world_from_body(first), Transform());
    EXPECT_EQ(world.size(), 1U);
    world.remove(first);
    EXPECT_EQ(message([&] { world.move(first, {}); }).substr(0, 8), "body 0: ");
    EXPECT_EQ(message([&] { world.remove(first); }).substr(0, 8), "body 0: ");
    EXPECT_EQ(message([&] { world.within(-1); }), "distance must be a length, not negative");
}

TEST(World, IdsAreNeverReusedAndBodiesMayBeRemovedWhileIterating) {
    World world;
    std::vector<BodyId> ids;
    ids.reserve(12);
    for (int i = 0; i < 6; ++i)
        ids.push_back(world.add(Sphere{{double(i), 0, 0}, 0.6}, {}));
    world.update();
    EXPECT_EQ(world.pairs().size(), 5U);
    std::size_t gone = 0;
    for (const BodyPair& pair : world.pairs())
        if (world.is_valid(pair.a) && world.is_valid(pair.b)) {
            world.remove(pair.b);
            ++gone;
        }
    EXPECT_EQ(gone, 3U);
    EXPECT_TRUE(world.collide().empty());
    EXPECT_EQ(world.ended().size(), 5U);
    const BodyPairs ended = world.ended();
    for (int i = 0; i < 6; ++i) {
        const BodyId id = world.add(Sphere{{double(i), 0, 0}, 0.6}, {});
        EXPECT_EQ(std::count(ids.begin(), ids.end(), id), 0);
        ids.push_back(id);
        EXPECT_EQ(world.ended(), ended);
    }
    world.update();
    EXPECT_TRUE(world.is_valid(ids[0]));
    EXPECT_FALSE(world.is_valid(ids[1]));
}

TEST(World, AFilterDecidesAndMayChange) {
    bool none = true;
    World world({BroadPhaseMethod::automatic, [&](BodyId, BodyId) { return !none; }});
    for (int i = 0; i < 3; ++i)
        world.add(Sphere{{}, 1}, {});
    EXPECT_TRUE(world.collide().empty());
    none = false;
    world.refilter();
    EXPECT_EQ(world.collide().size(), 3U);
}

TEST(World, DeformablesMeetModelsAsTheyAreAtTheStart) {
    Mesh sheet{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    Deformable cloth(sheet);
    World world;
    const BodyId cloth_id = world.add(cloth);
    world.add(Sphere{{0, 0, 0.5}, 0.4}, {});
    world.add(Model(tetrahedron(1)), Pose{{0, 0, -0.5}, {1, 0, 0, 0}});
    EXPECT_EQ(world.collide().size(), 2U); // model with cloth, model with ball
    for (Vec3& p : sheet.positions)
        p.z += 0.3;
    cloth.set_motion(sheet.positions, sheet.positions);
    world.refresh(cloth_id);
    EXPECT_EQ(world.collide().size(), 3U);
    const auto near = world.within(1);
    EXPECT_EQ(near.size(), 3U);
    EXPECT_NEAR(near[0].distance, -0.2, 1e-12);
}

} // namespace
} // namespace abut::test
