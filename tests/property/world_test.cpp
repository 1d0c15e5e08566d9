// Random scripts of operations on a world against brute force: all pairs of bodies, asked one by one.

#include <abut/deformable.h>
#include <abut/error.h>
#include <abut/progress.h>
#include <abut/shape_queries.h>
#include <abut/world.h>

#include "tests/support/random.h"
#include "tests/support/rounds.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <optional>
#include <variant>

namespace abut::test {
namespace {

Mesh tetrahedron(double size) {
    return {{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}},
            {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

/// A body as the test knows it.
struct Known {
    std::variant<Model, Convex, Sphere, Capsule, Box3> shape;
    Pose pose;
    BodyOptions options;
};

bool is_apart(const Box3& a, const Box3& b) {
    return a.upper.x < b.lower.x || b.upper.x < a.lower.x || a.upper.y < b.lower.y ||
           b.upper.y < a.lower.y || a.upper.z < b.lower.z || b.upper.z < a.lower.z;
}

class WorldScript {
public:
    WorldScript(Random& random, World& world, double offset)
        : random_(random), world_(world), offset_(offset), model_(tetrahedron(0.3)) {}

    [[nodiscard]] const std::map<BodyId, Known>& bodies() const { return bodies_; }
    [[nodiscard]] const std::vector<BodyId>& removed() const { return removed_; }

    void step() {
        for (int count = random_.integer(0, 12); count > 0; --count) {
            const double choice = random_.uniform(0, 1);
            if (bodies_.size() < 10 || choice < 0.35)
                add();
            else if (choice < 0.8)
                move(choice < 0.5 ? 2 : 0.05);
            else if (choice < 0.95)
                remove();
            else
                change_options();
        }
    }
    void add() {
        Known body{sphere(), pose(), options()};
        switch (random_.integer(0, 4)) {
        case 0:
            body.shape = model_;
            break;
        case 3: {
            std::vector<Vec3> points(static_cast<std::size_t>(random_.integer(1, 20)));
            for (Vec3& p : points)
                p = random_.in_cube(0.25);
            body.shape = Convex(points);
            break;
        }
        case 1:
            body.shape = Capsule{{random_.in_cube(0.2), random_.in_cube(0.2)}, radius()};
            break;
        case 2: {
            const Vec3 half = 0.2 * (random_.in_cube() + Vec3{1.1, 1.1, 1.1});
            body.shape = random_.chance(0.1) ? Box3{{}, {}} : Box3{-half, half};
            break;
        }
        default:
            break;
        }
        if (!bodies_.empty() && random_.chance(0.1)) // coincident bodies
            body = any()->second;
        const BodyId id = std::visit(
            [&](const auto& shape) { return world_.add(shape, body.pose, body.options); },
            body.shape);
        EXPECT_TRUE(bodies_.emplace(id, body).second);
    }

private:
    double radius() { return random_.chance(0.2) ? 0 : random_.uniform(0, 0.2); }
    Sphere sphere() {
        if (random_.chance(0.02))
            return {{}, 1e3}; // spans the world
        return {random_.in_cube(0.1), radius()};
    }
    Pose pose() {
        Pose pose = random_.pose(1);
        pose.translation = pose.translation + Vec3{offset_, -offset_, offset_};
        return pose;
    }
    BodyOptions options() {
        BodyOptions options;
        options.is_static = random_.chance(0.2);
        options.groups = std::uint32_t(random_.integer(1, 3));
        options.mask = random_.chance(0.8) ? ~0U : std::uint32_t(random_.integer(0, 3));
        return options;
    }
    std::map<BodyId, Known>::iterator any() {
        return std::next(bodies_.begin(), random_.integer(0, int(bodies_.size()) - 1));
    }
    void move(double by) {
        auto& [id, body] = *any();
        Pose next = pose();
        if (by < 1) {
            next = body.pose;
            next.translation = next.translation + by * random_.in_cube();
        }
        world_.move(id, next);
        body.pose = next;
    }
    void remove() {
        const auto body = any();
        world_.remove(body->first);
        removed_.push_back(body->first);
        bodies_.erase(body);
    }
    void change_options() {
        auto& [id, body] = *any();
        body.options = options();
        world_.set_options(id, body.options);
    }

    Random& random_;
    World& world_;
    double offset_;
    Model model_;
    std::map<BodyId, Known> bodies_;
    std::vector<BodyId> removed_;
};

bool may_meet(const BodyOptions& a, const BodyOptions& b) {
    return !(a.is_static && b.is_static) && (a.groups & b.mask) != 0 && (b.groups & a.mask) != 0;
}

using Pairs = std::vector<BodyPair>;

template <typename Holds>
Pairs pairs_where(const WorldScript& script, const Holds& holds) {
    Pairs pairs;
    for (const auto& [a, body_a] : script.bodies())
        for (const auto& [b, body_b] : script.bodies())
            if (a.index < b.index && may_meet(body_a.options, body_b.options) && holds(a, b))
                pairs.push_back({a, b});
    return pairs;
}

Pairs without(const Pairs& a, const Pairs& b) {
    Pairs rest;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(rest));
    return rest;
}

TEST(World, ScriptsAgreeWithAllPairs) {
    Random random(5201);
    std::size_t checked = 0, pairs = 0, changed = 0, removed = 0;
    for (int round = 0; round < many(24); ++round) {
        set_threads(random.integer(1, 4));
        const auto method = static_cast<BroadPhaseMethod>(random.integer(0, 3));
        World world({method, {}});
        WorldScript script(random, world, round % 4 == 0 ? 1e7 : 0);
        Pairs last;
        for (int step = 0; step < 40; ++step) {
            script.step();
            world.update();
            const Pairs now = pairs_where(
                script, [&](BodyId a, BodyId b) { return !is_apart(world.box(a), world.box(b)); });
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

/// Of a convex body: by its surface, and by what lies inside of it. Nothing of flat ones.
std::optional<bool> touch_convex_by_hand(const Convex& convex, const Pose& pose, const Known& b) {
    if (convex.dimension() < 3)
        return std::nullopt;
    const Model solid(convex.mesh());
    if (const auto* model = std::get_if<Model>(&b.shape))
        return collide(solid, pose, *model, b.pose).any() ||
               any_inside(*model, b.pose, solid, pose);
    if (const auto* other = std::get_if<Convex>(&b.shape)) {
        if (other->dimension() < 3)
            return std::nullopt;
        const Model other_solid(other->mesh());
        return collide(solid, pose, other_solid, b.pose).any() ||
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

/// By the queries of two models, or of a model and a shape; nothing where the test has no other way.
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
        return collide(*model_a, a.pose, *model_b, b.pose).any();
    if (const auto* sphere = std::get_if<Sphere>(&b.shape))
        return overlaps(*model_a, a.pose, Sphere{apply(b.pose, sphere->centre), sphere->radius});
    if (const auto* box = std::get_if<Box3>(&b.shape))
        return overlaps(*model_a, a.pose, OrientedBox{*box, b.pose});
    const auto& capsule = std::get<Capsule>(b.shape);
    const Segment axis{apply(b.pose, capsule.axis.a), apply(b.pose, capsule.axis.b)};
    const double gap = distance(*model_a, a.pose, axis).distance - capsule.radius;
    return std::abs(gap) < 1e-12 ? std::nullopt : std::optional(gap <= 0);
}

bool holds(const Pairs& pairs, BodyPair pair) {
    return std::binary_search(pairs.begin(), pairs.end(), pair);
}

TEST(World, TouchingPairsAreThoseOfAllPairs) {
    Random random(5202);
    std::size_t met = 0, apart = 0;
    for (int round = 0; round < many(10); ++round) {
        set_threads(random.integer(1, 4));
        World world;
        WorldScript script(random, world, 0);
        for (int step = 0; step < 12; ++step) {
            script.step();
            const Pairs touching = world.touching();
            const Pairs known = pairs_where(script, [&](BodyId a, BodyId b) {
                const auto by_hand = touch_by_hand(script.bodies().at(a), script.bodies().at(b));
                return by_hand ? *by_hand : holds(touching, {a, b});
            });
            ASSERT_EQ(touching, known);
            met += touching.size();
            apart += world.pairs().size() - touching.size();
            const auto contacts = world.contacts();
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

TEST(World, ClosePairsAreThoseOfAllPairs) {
    Random random(5203);
    std::size_t near = 0, far = 0;
    for (int round = 0; round < many(10); ++round) {
        World world;
        WorldScript script(random, world, 0);
        for (int step = 0; step < 12; ++step)
            script.step();
        const double limit = random.uniform(0, 0.3);
        const auto all = world.closer_than(10);
        Pairs expected;
        for (const BodyGap& gap : all)
            if (gap.distance <= limit)
                expected.push_back({gap.a, gap.b});
        EXPECT_EQ(pairs_where(script, [](BodyId, BodyId) { return true; }).size(), all.size());
        Pairs found;
        for (const BodyGap& gap : world.closer_than(limit)) {
            found.push_back({gap.a, gap.b});
            EXPECT_LE(gap.distance, limit);
        }
        EXPECT_EQ(found, expected);
        near += found.size(), far += all.size() - found.size();
        for (const BodyPair& pair : world.touching())
            EXPECT_TRUE(holds(found, pair));
    }
    EXPECT_GT(near, 50U);
    EXPECT_GT(far, 100U);
}

TEST(World, RefusesBadBodiesByTheirIdAndStaysAsItWas) {
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
    EXPECT_EQ(message([&] { world.closer_than(-1); }), "distance must be a length, not negative");
}

TEST(World, IdsAreNeverGivenAgainAndBodiesMayGoWhilePairsAreLookedAt) {
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
    EXPECT_TRUE(world.touching().empty());
    EXPECT_EQ(world.ended().size(), 5U);
    const Pairs ended = world.ended();
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
    EXPECT_TRUE(world.touching().empty());
    none = false;
    world.refilter();
    EXPECT_EQ(world.touching().size(), 3U);
}

TEST(World, DeformablesMeetModelsAsTheyAreAtTheStart) {
    Mesh sheet{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    Deformable cloth(sheet);
    World world;
    const BodyId cloth_id = world.add(cloth);
    world.add(Sphere{{0, 0, 0.5}, 0.4}, {});
    world.add(Model(tetrahedron(1)), Pose{{0, 0, -0.5}, {1, 0, 0, 0}});
    EXPECT_EQ(world.touching().size(), 2U); // model and cloth, model and ball
    for (Vec3& p : sheet.positions)
        p.z += 0.3;
    cloth.set_motion(sheet.positions, sheet.positions);
    world.refresh(cloth_id);
    EXPECT_EQ(world.touching().size(), 3U);
    const auto near = world.closer_than(1);
    EXPECT_EQ(near.size(), 3U);
    EXPECT_NEAR(near[0].distance, -0.2, 1e-12);
}

/// The first of many small steps at which two bodies share a point; nothing if none does.
std::optional<double> first_contact(World& world, const std::vector<BodyMotion>& motions,
                                    BodyPair pair, int steps) {
    for (int step = 0; step <= steps; ++step) {
        const double t = double(step) / steps;
        for (const BodyMotion& each : motions) {
            const Transform now = at(each.motion, t);
            // The motion's rotation about its centre, after the start's.
            const Vec3 w = t * each.motion.angular_velocity;
            const double angle = length(w), s = angle > 0 ? std::sin(angle / 2) / angle : 0.5;
            const std::array<double, 4> turn{std::cos(angle / 2), s * w.x, s * w.y, s * w.z};
            const auto& q = each.motion.start.rotation;
            world.move(each.body,
                       {{now.m[9], now.m[10], now.m[11]},
                        {turn[0] * q[0] - turn[1] * q[1] - turn[2] * q[2] - turn[3] * q[3],
                         turn[0] * q[1] + turn[1] * q[0] + turn[2] * q[3] - turn[3] * q[2],
                         turn[0] * q[2] - turn[1] * q[3] + turn[2] * q[0] + turn[3] * q[1],
                         turn[0] * q[3] + turn[1] * q[2] - turn[2] * q[1] + turn[3] * q[0]}});
        }
        const auto touching = world.touching();
        if (std::binary_search(touching.begin(), touching.end(), pair))
            return t;
    }
    return std::nullopt;
}

TEST(World, ImpactsComeNoLaterThanAnyContactOfFineSteps) {
    Random random(5204);
    int hits = 0, misses = 0, tight = 0, proven = 0;
    for (int round = 0; round < many(900); ++round) {
        World world;
        WorldScript script(random, world, 0);
        script.add(), script.add();
        std::vector<BodyMotion> motions;
        for (const auto& [id, body] : script.bodies()) {
            world.set_options(id, {});
            if (random.chance(0.8))
                motions.push_back({id,
                                   {body.pose, body.pose.translation + random.in_cube(0.1),
                                    2 * random.in_cube(), 3 * random.in_cube()}});
        }
        const BodyPair pair{script.bodies().begin()->first, script.bodies().rbegin()->first};
        const auto impacts = world.impacts(motions);
        const auto contact = first_contact(world, motions, pair, 60);
        if (motions.empty())
            continue;
        SCOPED_TRACE(round);
        if (contact) {
            ++hits;
            ASSERT_EQ(impacts.size(), 1U);
            EXPECT_EQ(impacts[0].a, pair.a);
            EXPECT_EQ(impacts[0].b, pair.b);
            EXPECT_LE(impacts[0].impact.time, *contact + 1e-9);
            tight += impacts[0].impact.time > *contact - 1.5 / 60 ? 1 : 0;
            proven += impacts[0].impact.status == Status::exact ? 1 : 0;
        } else if (impacts.empty()) {
            ++misses;
        }
    }
    EXPECT_GT(hits, 60);
    EXPECT_GT(misses, 60);
    EXPECT_GT(tight, hits * 8 / 10);
    EXPECT_GT(proven, hits * 8 / 10);
}

TEST(World, AFastBallDoesNotPassAThinWall) {
    World world;
    const BodyId wall = world.add(Box3{{-0.001, -5, -5}, {0.001, 5, 5}}, {});
    const BodyId ball = world.add(Sphere{{}, 0.1}, Pose{{-50, 0, 0}, {1, 0, 0, 0}});
    const BodyMotion motion{ball, {{{-50, 0, 0}, {1, 0, 0, 0}}, {-50, 0, 0}, {100, 0, 0}, {}}};
    const auto impacts = world.impacts({motion});
    ASSERT_EQ(impacts.size(), 1U);
    EXPECT_EQ(impacts[0].a, wall);
    EXPECT_NEAR(impacts[0].impact.time, (50 - 0.101) / 100, 1e-5);
    EXPECT_THROW(world.impacts({motion, motion}), Error);
}

} // namespace
} // namespace abut::test
