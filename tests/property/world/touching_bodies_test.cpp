// Bodies that touch at a point, or nearly: every query of a world says the same about them, whatever
// was asked before and in whichever order they were added.

#include <abut/make_mesh.h>
#include <abut/world.h>

#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/sanitizer.h"

#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace abut::test {
namespace {

/// A body that touches the plane x = 0 at the origin, from where x is positive.
struct TouchingBody {
    const char* name;
    std::function<BodyId(World&, const Pose&)> add;
    bool curved = false; ///< a cylinder, cone or ellipsoid
};

Mesh mesh_of_box(const Box3& box) {
    Mesh mesh;
    for (unsigned i = 0; i < 8; ++i)
        mesh.positions.push_back({(i & 1U) != 0 ? box.upper.x : box.lower.x,
                                  (i & 2U) != 0 ? box.upper.y : box.lower.y,
                                  (i & 4U) != 0 ? box.upper.z : box.lower.z});
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

/// An octahedron whose corner 1 is the origin.
Mesh octahedron_at_corner(double r) {
    return {
        {{r + r, 0, 0}, {0, 0, 0}, {r, r, 0}, {r, -r, 0}, {r, 0, r}, {r, 0, -r}},
        {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

std::vector<TouchingBody> bodies_of_size(double s) {
    const Box3 face{{0, -s, -s}, {2 * s, s, s}}, corner{{0, 0, 0}, {2 * s, s, s}};
    return {
        {"ball",
         [s](World& w, const Pose& p) {
             return w.add(Sphere{{s, 0, 0}, s}, p);
         }},
        {"capsule's end",
         [s](World& w, const Pose& p) {
             return w.add(Capsule{{{s, 0, 0}, {3 * s, 0, 0}}, s}, p);
         }},
        {"capsule's side",
         [s](World& w, const Pose& p) {
             return w.add(Capsule{{{s, 0, -s}, {s, 0, s}}, s}, p);
         }},
        {"box's face", [face](World& w, const Pose& p) { return w.add(face, p); }},
        {"box's corner", [corner](World& w, const Pose& p) { return w.add(corner, p); }},
        {"cylinder's end",
         [s](World& w, const Pose& p) {
             return w.add(Cylinder{{{0, 0, 0}, {2 * s, 0, 0}}, s}, p);
         },
         true},
        {"cylinder's side",
         [s](World& w, const Pose& p) {
             return w.add(Cylinder{{{s, 0, -s}, {s, 0, s}}, s}, p);
         },
         true},
        {"cone's apex",
         [s](World& w, const Pose& p) {
             return w.add(Cone{{0, 0, 0}, {2 * s, 0, 0}, s}, p);
         },
         true},
        {"cone's base",
         [s](World& w, const Pose& p) {
             return w.add(Cone{{2 * s, 0, 0}, {0, 0, 0}, s}, p);
         },
         true},
        {"ellipsoid",
         [s](World& w, const Pose& p) {
             return w.add(Ellipsoid{{s, 0, 0}, {s, s / 2, 2 * s}}, p);
         },
         true},
        {"flat ellipsoid",
         [s](World& w, const Pose& p) {
             return w.add(Ellipsoid{{s / 4, 0, 0}, {s / 4, s, 2 * s}}, p);
         },
         true},
        {"half-space",
         [](World& w, const Pose& p) {
             return w.add(HalfSpace{{-1, 0, 0}, 0}, p);
         }},
        {"convex corner",
         [s](World& w, const Pose& p) {
             return w.add(Convex(octahedron_at_corner(s).positions), p);
         }},
        {"convex face",
         [face](World& w, const Pose& p) { return w.add(Convex(mesh_of_box(face).positions), p); }},
        {"model's corner",
         [s](World& w, const Pose& p) { return w.add(Model(octahedron_at_corner(s)), p); }},
        {"model's face",
         [face](World& w, const Pose& p) { return w.add(Model(mesh_of_box(face)), p); }}};
}

/// Whether a query finds the two bodies of a world in contact.
struct ContactQuery {
    const char* name;
    bool (*finds)(World&);
};
constexpr std::array kContactQueries{
    ContactQuery{"collide", [](World& w) { return !w.collide().empty(); }},
    ContactQuery{"penetration", [](World& w) { return !w.penetration().empty(); }},
    ContactQuery{"contacts", [](World& w) { return !w.contact_manifolds().empty(); }},
    ContactQuery{"within 0", [](World& w) { return !w.within(0).empty(); }},
    ContactQuery{"within",
                 [](World& w) {
                     const auto near = w.within(0.5);
                     return !near.empty() && near[0].distance <= 0;
                 }},
    ContactQuery{"advance", [](World& w) { return !w.advance(0).empty(); }}};

using QueryNumber = std::size_t;

struct TwoBodies {
    TouchingBody a, b;
    Pose at_a, at_b;
    [[nodiscard]] std::unique_ptr<World> world(bool swapped) const {
        auto made = std::make_unique<World>();
        if (swapped)
            b.add(*made, at_b), a.add(*made, at_a);
        else
            a.add(*made, at_a), b.add(*made, at_b);
        return made;
    }
    [[nodiscard]] BodyId id_of_b(bool swapped) const { return {swapped ? 0U : 1U, 0}; }
};

std::array<double, 4> quaternion_product(const std::array<double, 4>& q,
                                         const std::array<double, 4>& p) {
    return {q[0] * p[0] - q[1] * p[1] - q[2] * p[2] - q[3] * p[3],
            q[0] * p[1] + q[1] * p[0] + q[2] * p[3] - q[3] * p[2],
            q[0] * p[2] - q[1] * p[3] + q[2] * p[0] + q[3] * p[1],
            q[0] * p[3] + q[1] * p[2] - q[2] * p[1] + q[3] * p[0]};
}

enum class Placement : std::uint8_t { grid, anywhere, turned, far_away, with_a_gap };

/// Two bodies; with curved ones, the first is curved.
TwoBodies touching_bodies(Random& random, Placement placement, bool curved) {
    constexpr std::array<double, 8> kSizes{1, 0.5, 0.25, 2, 8, 0.3, 0.1, 1.7};
    const int sizes = placement == Placement::grid ? 5 : 8;
    const auto any = [&](bool may_be_flat, bool may_be_curved) {
        const auto all = bodies_of_size(kSizes[std::size_t(random.integer(0, sizes - 1))]);
        for (;;)
            if (const TouchingBody& body = all[std::size_t(random.integer(0, int(all.size()) - 1))];
                body.curved ? may_be_curved : may_be_flat)
                return body;
    };
    const TouchingBody first = any(!curved, curved), second = any(true, curved);
    TwoBodies two{first, second, {}, {}};
    if (random.chance(0.5))
        std::swap(two.a, two.b);
    // Half a turn about y or z puts a on the other side of the plane.
    two.at_a.rotation =
        random.chance(0.5) ? std::array<double, 4>{0, 0, 0, 1} : std::array<double, 4>{0, 0, 1, 0};
    Vec3 place = random.in_cube(3);
    if (placement == Placement::grid)
        place = {std::round(8 * place.x) / 8, std::round(8 * place.y) / 8,
                 std::round(8 * place.z) / 8};
    if (placement == Placement::far_away)
        place = random.in_cube(1e6);
    two.at_a.translation = two.at_b.translation = place;
    if (placement == Placement::turned || placement == Placement::far_away) {
        const std::array<double, 4> turn = random.pose(1).rotation;
        two.at_a.rotation = quaternion_product(turn, two.at_a.rotation);
        two.at_b.rotation = quaternion_product(turn, two.at_b.rotation);
    }
    if (placement == Placement::with_a_gap)
        two.at_b.translation.x +=
            (random.chance(0.5) ? 1 : -1) * std::pow(10, random.uniform(-17, -9));
    return two;
}

struct TouchingCase {
    Placement placement;
    bool curved;
};
class TouchingBodies : public testing::TestWithParam<TouchingCase> {};

TEST_P(TouchingBodies, AreTheSameForEveryQueryAndOrder) {
    const auto [placement, curved] = GetParam();
    Random random(5401);
    std::size_t met = 0, apart = 0;
    std::map<std::string, int> faults;
    const int rounds = many(reduced_for_threads(400, 100));
    for (int round = 0; round < rounds; ++round) {
        const TwoBodies two = touching_bodies(random, placement, curved);
        const std::string names = std::string(two.a.name) + ", " + two.b.name + ": ";
        const bool truth = !two.world(false)->collide().empty();
        (truth ? met : apart) += 1;
        const auto expect = [&](World& world, const ContactQuery& query, const char* when) {
            if (query.finds(world) != truth)
                ++faults[names + query.name + when];
        };
        for (const ContactQuery& query : kContactQueries) {
            expect(*two.world(false), query, ", alone");
            expect(*two.world(true), query, ", alone, added in the other order");
        }
        const auto some = [&] {
            return kContactQueries[std::size_t(random.integer(0, int(kContactQueries.size()) - 1))];
        };
        const bool swapped = random.chance(0.5);
        const auto world = two.world(swapped);
        for (int i = 0; i < 4; ++i)
            expect(*world, some(), ", after others");
        // After another placement.
        Pose elsewhere = two.at_b;
        elsewhere.translation = elsewhere.translation + random.in_cube(0.5);
        world->move(two.id_of_b(swapped), elsewhere);
        for (int i = 0; i < 3; ++i)
            some().finds(*world);
        world->move(two.id_of_b(swapped), two.at_b);
        for (int i = 0; i < 3; ++i)
            expect(*world, some(), ", after another placement");
    }
    std::cout << met << " met, " << apart << " apart\n";
    for (const auto& [what, count] : faults)
        ADD_FAILURE() << what << " (" << count << " times)";
    EXPECT_GT(met, std::size_t(rounds) / 4);
    if (placement == Placement::grid) { // touching counts
        EXPECT_EQ(apart, 0U);
    }
    if (placement == Placement::with_a_gap) {
        EXPECT_GT(apart, std::size_t(rounds) / 8);
    }
}

std::string name_of_touching(const testing::TestParamInfo<TouchingCase>& tested) {
    constexpr std::array kNames{"grid", "anywhere", "turned", "far_away", "with_a_gap"};
    return std::string(tested.param.curved ? "curved_" : "plain_") +
           kNames.at(std::size_t(tested.param.placement));
}

std::vector<TouchingCase> all_touching_cases() {
    std::vector<TouchingCase> cases;
    for (const bool curved : {false, true})
        for (const Placement placement : {Placement::grid, Placement::anywhere, Placement::turned,
                                          Placement::far_away, Placement::with_a_gap})
            cases.push_back({placement, curved});
    return cases;
}

INSTANTIATE_TEST_SUITE_P(Placements, TouchingBodies, testing::ValuesIn(all_touching_cases()),
                         name_of_touching);

} // namespace
} // namespace abut::test
