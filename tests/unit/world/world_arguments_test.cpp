// What a world accepts: ids of its own, motions from where the bodies are, shapes that stay.

#include <abut/error.h>
#include <abut/world.h>

#include "tests/support/shapes.h"

#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace abut::test {
namespace {

/// The message of the Error{bad_argument} that a call throws; empty if it throws none.
template <typename Call>
std::string refusal(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::bad_argument);
        return error.what();
    }
    return {};
}

// A number is no sphere, and three numbers are no temporary surface.
static_assert(!std::is_constructible_v<Vec3, double>);
static_assert(!std::is_aggregate_v<Vec3> && std::is_trivially_copyable_v<Vec3>);
template <typename Surface>
concept CanBeAdded = requires(World& world, Surface&& surface) {
    world.add(std::forward<Surface>(surface));
};
static_assert(CanBeAdded<const Deformable&> && !CanBeAdded<Deformable>);

TEST(WorldArguments, IdsOfAnotherWorldAreErrors) {
    World first, second;
    const BodyId of_first = first.add(Sphere{{}, 1}, {}), of_second = second.add(Sphere{{}, 1}, {});
    EXPECT_EQ(of_first, of_second); // lists of worlds that were made alike are equal
    EXPECT_TRUE(first.is_valid(of_first));
    EXPECT_FALSE(first.is_valid(of_second));
    EXPECT_EQ(refusal([&] { first.move(of_second, {}); }), "body 0: is a body of another world");
    EXPECT_EQ(refusal([&] { first.remove(of_second); }), "body 0: is a body of another world");
    EXPECT_EQ(refusal([&] { (void)first.time_to_collision(of_first, of_second); }),
              "body 0: is a body of another world");
    EXPECT_EQ(refusal([&] {
                  (void)first.time_of_impact({{of_second, Motion::fixed({})}});
              }),
              "body 0: is a body of another world");
    // Numbers that a program keeps by itself belong to any world.
    EXPECT_TRUE(first.is_valid({0, 0}));
    World moved = std::move(first);
    EXPECT_TRUE(moved.is_valid(of_first));
    // The ids in answers are the world's own.
    moved.add(Sphere{{1, 0, 0}, 1}, {});
    const std::vector<BodyPair> meeting = moved.collide();
    ASSERT_EQ(meeting.size(), 1U);
    EXPECT_TRUE(moved.is_valid(meeting[0].a) && moved.is_valid(meeting[0].b));
    EXPECT_FALSE(second.is_valid(meeting[0].a));
}

TEST(WorldArguments, IndicesEndBehindThePiecesOfCompounds) {
    World world;
    EXPECT_EQ(world.index_end(), 0U);
    const std::vector<Compound::Piece> pieces{
        {Sphere{{}, 1}}, {Sphere{{3, 0, 0}, 1}}, {Sphere{{6, 0, 0}, 1}}};
    std::vector<BodyId> ids;
    ids.reserve(4);
    for (int i = 0; i < 3; ++i)
        ids.push_back(world.add(Compound(pieces), {{0, 4.0 * i, 0}}));
    ids.push_back(world.add(Sphere{{}, 1}, {{0, 20, 0}}));
    EXPECT_EQ(ids.back().index, 9U);
    EXPECT_EQ(world.size(), 4U);
    EXPECT_EQ(world.index_end(), 10U);
    world.remove(ids[1]);
    EXPECT_EQ(world.index_end(), 10U);
    world.update(), world.update();
    // A place that is free again is taken before the end moves.
    EXPECT_LT(world.add(Sphere{{}, 1}, {{0, 30, 0}}).index, 10U);
    EXPECT_EQ(world.index_end(), 10U);
}

TEST(WorldArguments, ANumberThatIsNoneIsSaidToBeNone) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    World world;
    const auto ends = Segment{{0, 0, 0}, {0, 0, 1}};
    EXPECT_EQ(refusal([&] {
                  world.add(Sphere{{}, nan}, {});
              }),
              "body 0: radius of the sphere is not a number");
    EXPECT_EQ(refusal([&] {
                  world.add(Capsule{ends, nan}, {});
              }),
              "body 0: radius of the capsule is not a number");
    EXPECT_EQ(refusal([&] {
                  world.add(Cylinder{ends, nan}, {});
              }),
              "body 0: radius is not a number");
    EXPECT_EQ(refusal([&] {
                  world.add(Cone{ends.b, ends.a, nan}, {});
              }),
              "body 0: radius is not a number");
    EXPECT_EQ(refusal([&] {
                  world.add(Ellipsoid{{}, {1, nan, 1}}, {});
              }),
              "body 0: a semi-axis of the ellipsoid is not a number");
    EXPECT_EQ(refusal([&] { (void)world.time_to_collision(nan); }),
              "limit of a time to collision is not a number");
    EXPECT_EQ(refusal([&] { (void)world.time_to_collision(-1); }),
              "limit of a time to collision must not be negative");
}

TEST(WorldArguments, AMotionStartsWhereItsBodyIs) {
    World world;
    const Pose here{{1, 2, 3}, {0.8, 0.6, 0, 0}};
    const BodyId body = world.add(Sphere{{}, 0.5}, here);
    world.add(HalfSpace{{0, 0, 1}, 0}, {});
    const Pose below{{1, 2, -3}, {0.8, 0.6, 0, 0}};
    EXPECT_EQ(world.time_of_impact({{body, Motion::between(here, below)}}).size(), 1U);
    // The same place, written otherwise and rounded.
    const Pose same{{1, 2 + 0x1p-51, 3}, {-1.6, -1.2, 0, 0}};
    EXPECT_EQ(world.time_of_impact({{body, Motion::between(same, below)}}).size(), 1U);
    const Pose beside{{1, 2.001, 3}, {0.8, 0.6, 0, 0}}, turned{{1, 2, 3}, {1, 0, 0, 0}};
    for (const Pose& other : {beside, turned, below})
        EXPECT_EQ(refusal([&] {
                      (void)world.time_of_impact({{body, Motion::between(other, below)}});
                  }),
                  "body 0: its motion does not start where the body is");
    // At the origin, a distance of rounding is none.
    const BodyId small = world.add(Box3{{-1, -1, -1}, {1, 1, 1}}, {});
    const Pose near{{1e-15, 0, 0}};
    EXPECT_FALSE(world.time_of_impact({{small, Motion::between(near, below)}}).empty());
}

TEST(WorldArguments, ADeformableMayMoveToAnotherVariable) {
    const Mesh sheet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    World world;
    const BodyId ball = world.add(Sphere{{0.25, 0.25, 1}, 0.5}, {});
    auto first = std::make_unique<Deformable>(sheet);
    const BodyId cloth = world.add(*first);
    Deformable second = std::move(*first);
    first.reset();
    EXPECT_TRUE(world.collide().empty());
    // The world sees the steps of the surface under its new name.
    const std::vector<Vec3> raised{{0, 0, 0.75}, {1, 0, 0.75}, {0, 1, 0.75}};
    second.advance(raised);
    second.advance(raised);
    world.refresh(cloth);
    const std::vector<BodyPair> touching{{ball, cloth}};
    EXPECT_EQ(world.collide(), touching);
    // Once it is replaced, the body stays as it was.
    second = Deformable(sheet);
    world.refresh(cloth);
    EXPECT_EQ(world.collide(), touching);
}

} // namespace
} // namespace abut::test
