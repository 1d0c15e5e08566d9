// Contacts of a deformable surface with rigid bodies, against closed forms of the bodies' signed
// distances. Each test prints its seed and what it has seen.

#include <abut/error.h>
#include <abut/surface_contacts.h>

#include "math/transform.h"
#include "tests/support/moving_meshes.h"
#include "tests/support/random.h"
#include "tests/support/rounds.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace abut::test {
namespace {

/// A body, and its signed distance in closed form.
struct KnownBody {
    const char* name;
    RigidShape shape;
    Pose pose;
    std::function<double(const Vec3&)> distance; ///< of a point of the world
};

double ball_distance(const Vec3& p, const Vec3& centre, double radius) {
    return length(p - centre) - radius;
}
double capsule_distance(const Vec3& p, const Capsule& capsule) {
    const Vec3 along = capsule.axis.b - capsule.axis.a;
    const double t = std::clamp(dot(p - capsule.axis.a, along) / length_sq(along), 0.0, 1.0);
    return ball_distance(p, capsule.axis.a + t * along, capsule.radius);
}
double box_distance(const Vec3& p, const Box3& box) {
    const Vec3 q = max(box.lower - p, p - box.upper);
    return length(max(q, {})) + std::min(0.0, std::max({q.x, q.y, q.z}));
}

double cylinder_distance(const Vec3& p, const Cylinder& cylinder) {
    const Vec3 along = cylinder.axis.b - cylinder.axis.a;
    const Vec3 axis = (1 / length(along)) * along;
    const double t = dot(p - cylinder.axis.a, axis);
    const double out = length(p - cylinder.axis.a - t * axis) - cylinder.radius;
    const double beyond = std::max(-t, t - length(along));
    return std::hypot(std::max(out, 0.0), std::max(beyond, 0.0)) +
           std::min(0.0, std::max(out, beyond));
}

/// A body of each kind, of about the size of a sheet's triangles or larger, at one of these places.
std::vector<KnownBody> bodies(Random& random, const std::vector<Vec3>& places) {
    Pose pose = random.pose(0.3);
    const int place = random.integer(0, static_cast<int>(places.size()) - 1);
    pose.translation = pose.translation + places[static_cast<std::size_t>(place)];
    const Transform body_from_world = inverse(Transform(pose));
    const auto in_body = [body_from_world](const Vec3& p) { return apply(body_from_world, p); };
    const Sphere ball{random.in_cube(0.1), random.uniform(0.001, 0.3)};
    const Capsule capsule{{random.in_cube(0.4), random.in_cube(0.4)}, random.uniform(0.001, 0.2)};
    const Cylinder cylinder{{random.in_cube(0.3), random.in_cube(0.3) + Vec3{0, 0, 0.7}},
                            random.uniform(0.01, 0.2)};
    const Vec3 half{random.uniform(0.02, 0.4), random.uniform(0.02, 0.4),
                    random.uniform(0.02, 0.4)};
    const Box3 box{-half, half};
    const Vec3 normal = random.direction();
    const double offset = random.uniform(-0.2, 0.2);
    return {
        {"ball", ball, pose,
         [=](const Vec3& p) { return ball_distance(in_body(p), ball.centre, ball.radius); }},
        {"capsule", capsule, pose,
         [=](const Vec3& p) { return capsule_distance(in_body(p), capsule); }},
        {"cylinder", cylinder, pose,
         [=](const Vec3& p) { return cylinder_distance(in_body(p), cylinder); }},
        {"box", box, pose, [=](const Vec3& p) { return box_distance(in_body(p), box); }},
        {"hull", Convex(box_mesh(-half, half).positions), pose,
         [=](const Vec3& p) { return box_distance(in_body(p), box); }},
        {"half-space", HalfSpace{3 * normal, 3 * offset}, pose,
         [=](const Vec3& p) { return dot(normal, in_body(p)) - offset; }},
        {"model", Model(box_mesh(-half, half)), pose,
         [=](const Vec3& p) { return box_distance(in_body(p), box); }},
    };
}

constexpr double kOff = 1e-11;

struct ContactCounts {
    std::size_t vertices = 0, edges = 0, faces = 0, inside = 0, samples = 0;
};

using ContactKey = std::tuple<Feature, std::uint32_t>;

/// Each contact's members agree with each other and with the body.
void check_contact(const SurfaceContact& c, const KnownBody& body, const Deformable& surface,
                   const std::vector<Vec3>& positions) {
    ASSERT_NEAR(length(c.normal), 1, 1e-12) << body.name;
    ASSERT_LE(c.distance, c.limit);
    Vec3 point;
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        ASSERT_GE(c.weights[i], 0);
        point = point + c.weights[i] * positions[c.vertices[i]];
        sum += c.weights[i];
    }
    ASSERT_NEAR(sum, 1, 1e-12);
    // A place within 1e-9 of the triangle beside an edge counts as on it.
    ASSERT_LT(length(point - c.point), 1e-8) << body.name;
    ASSERT_LT(length(c.point_on_body + c.distance * c.normal - c.point), kOff) << body.name;
    ASSERT_NEAR(body.distance(c.point_on_body), 0, kOff) << body.name;
    if (c.feature == Feature::vertex) {
        ASSERT_EQ(c.id, c.vertices[0]);
        ASSERT_NEAR(body.distance(c.point), c.distance, kOff) << body.name;
    } else if (c.feature == Feature::edge) {
        ASSERT_EQ((std::array{c.vertices[0], c.vertices[1]}), surface.edges()[c.id]);
    } else {
        ASSERT_EQ(c.vertices, surface.triangles()[c.id]);
    }
    if (c.distance > 0) {
        ASSERT_NEAR(body.distance(c.point), c.distance, kOff) << body.name;
    }
}

/// Every vertex within the limit is listed, and no sampled point of a triangle is nearer than the
/// contacts of its parts.
void check_complete(const std::vector<SurfaceContact>& found, const KnownBody& body,
                    const Deformable& surface, const std::vector<Vec3>& positions, double limit,
                    Random& random, ContactCounts& counts) {
    std::map<ContactKey, double> listed;
    for (const SurfaceContact& c : found)
        ASSERT_TRUE(listed.emplace(ContactKey(c.feature, c.id), c.distance).second);
    std::set<std::uint32_t> used;
    for (const auto& t : surface.triangles())
        used.insert(t.begin(), t.end());
    for (const std::uint32_t v : used) {
        const double distance = body.distance(positions[v]);
        if (std::abs(distance - limit) > kOff) {
            ASSERT_EQ(listed.contains({Feature::vertex, v}), distance < limit) << body.name;
        }
    }
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> edge_ids;
    for (std::uint32_t e = 0; e < surface.edges().size(); ++e)
        edge_ids[surface.edges()[e]] = e;
    for (std::uint32_t id = 0; id < surface.triangles().size(); ++id) {
        const auto& t = surface.triangles()[id];
        std::vector<ContactKey> parts{{Feature::face, id}};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t u = t[i], v = t[(i + 1) % 3];
            parts.emplace_back(Feature::vertex, u);
            if (u != v)
                parts.emplace_back(Feature::edge, edge_ids.at({std::min(u, v), std::max(u, v)}));
        }
        double nearest = HUGE_VAL;
        for (const ContactKey& part : parts)
            if (const auto at = listed.find(part); at != listed.end())
                nearest = std::min(nearest, at->second);
        for (int i = 0; i < 12; ++i) {
            double s = random.uniform(0, 1), r = random.uniform(0, 1);
            if (s + r > 1)
                s = 1 - s, r = 1 - r;
            const Vec3 p =
                (1 - s - r) * positions[t[0]] + s * positions[t[1]] + r * positions[t[2]];
            const double distance = body.distance(p);
            ++counts.samples;
            if (distance < limit - kOff) {
                // Where a triangle passes through a model, its contact has distance 0.
                const bool is_model = std::string_view(body.name) == "model";
                ASSERT_LE(nearest, (is_model ? std::max(0.0, distance) : distance) + kOff)
                    << body.name;
            }
        }
    }
}

TEST(SurfaceContacts, BodiesOfAllKindsAgainstClosedForms) {
    Random random(1234);
    std::map<std::string, ContactCounts> seen;
    for (int round = 0; round < many(140); ++round) {
        // Soups have triangles without area and with a repeated vertex.
        const MovingMesh moving = random.chance(0.7) ? crumpled_sheet(random, random.integer(1, 6))
                                  : random.chance(0.5)
                                      ? random_soup(random, 12, random.integer(1, 14))
                                      : needle_soup(random, random.integer(1, 20));
        const bool at_end = random.chance(0.5);
        const std::vector<Vec3>& positions = at_end ? moving.end : moving.mesh.positions;
        const Deformable surface = moving.deformable();
        const double limit = random.chance(0.2) ? 0 : random.uniform(0, 0.1);
        for (const KnownBody& body : bodies(random, positions)) {
            const auto found = within(surface, body.shape, body.pose, limit, {.at_end = at_end});
            ContactCounts& counts = seen[body.name];
            for (const SurfaceContact& c : found) {
                ASSERT_NO_FATAL_FAILURE(check_contact(c, body, surface, positions));
                (c.feature == Feature::vertex ? counts.vertices
                 : c.feature == Feature::edge ? counts.edges
                                              : counts.faces) += 1;
                counts.inside += c.distance < 0 ? 1 : 0;
            }
            ASSERT_NO_FATAL_FAILURE(
                check_complete(found, body, surface, positions, limit, random, counts));
        }
    }
    for (const auto& [name, counts] : seen) {
        std::cout << name << ": " << counts.vertices << " vertices, " << counts.edges << " edges, "
                  << counts.faces << " faces, " << counts.inside << " inside, " << counts.samples
                  << " samples\n";
        EXPECT_GT(counts.vertices, 40U) << name;
        EXPECT_GT(counts.inside, 20U) << name;
        if (name != "half-space") {
            EXPECT_GT(counts.faces, 5U) << name;
            EXPECT_GT(counts.edges, 10U) << name;
        }
    }
}

/// A small ball or model that only the middle of a large triangle is near.
TEST(SurfaceContacts, SmallBodiesInTheMiddleOfATriangle) {
    Random random(77);
    std::size_t faces = 0;
    for (int round = 0; round < many(60); ++round) {
        const Triangle t{Vec3{-3, -2, 0} + random.in_cube(0.5),
                         Vec3{3, -2, 0} + random.in_cube(0.5), Vec3{0, 3, 0} + random.in_cube(0.5)};
        const Deformable surface(Mesh{{t[0], t[1], t[2]}, {{0, 1, 2}}});
        const Vec3 across = normalized_or_zero(cross(t[1] - t[0], t[2] - t[0]));
        const Vec3 middle = (1.0 / 3) * (t[0] + t[1] + t[2]) + random.in_cube(0.2);
        const double above = dot(middle - t[0], across), gap = random.uniform(1e-4, 0.01);
        const double radius = random.uniform(0.001, 0.05);
        const Vec3 centre = middle + (gap + radius - above) * across;
        const RigidShape ball = Sphere{{}, radius};
        ASSERT_TRUE(within(surface, ball, Pose{centre}, 0.9 * gap).empty());
        const auto found = within(surface, ball, Pose{centre}, 1.1 * gap);
        ASSERT_EQ(found.size(), 1U);
        EXPECT_EQ(found[0].feature, Feature::face);
        EXPECT_NEAR(found[0].distance, gap, 1e-13);
        EXPECT_LT(length(found[0].normal + across), 1e-12); // out of the ball, which is above
        faces += found[0].feature == Feature::face ? 1 : 0;

        // A needle's tip points at the triangle, or passes through it.
        const bool pierces = random.chance(0.5);
        const Vec3 tip = middle + ((pierces ? -gap : gap) - above) * across, far = tip + across;
        const Model needle(Mesh{{tip, far, far + Vec3{0.01, 0, 0.003}, far + Vec3{0, 0.01, -0.002}},
                                {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}});
        const auto near = within(surface, needle, Pose{}, 1.1 * gap);
        ASSERT_EQ(near.size(), 1U);
        EXPECT_EQ(near[0].feature, Feature::face);
        EXPECT_NEAR(near[0].distance, pierces ? 0 : gap, 1e-13);
    }
    EXPECT_EQ(faces, std::size_t(many(60)));
}

/// Thickness, groups and marks select contacts as they select pairs.
TEST(SurfaceContacts, RulesSelectContacts) {
    Random random(8);
    std::size_t all = 0, listed = 0, alone = 0;
    for (int round = 0; round < many(20); ++round) {
        const MovingMesh moving = crumpled_sheet(random, 5);
        const Deformable surface = moving.deformable();
        const std::size_t n = moving.mesh.positions.size();
        std::vector<double> thickness(n);
        std::vector<std::uint32_t> groups(n), masks(n);
        std::vector<std::uint8_t> moved(n);
        for (std::size_t v = 0; v < n; ++v) {
            thickness[v] = random.uniform(0, 0.1);
            groups[v] = random.chance(0.8) ? 3 : 2;
            masks[v] = random.chance(0.8) ? 1 : 2;
            moved[v] = random.chance(0.5) ? 1 : 0;
        }
        const auto known = bodies(random, moving.mesh.positions);
        const KnownBody& body = known[std::size_t(random.integer(0, 6))];
        const auto found =
            within(surface, body.shape, body.pose, 0.01,
                   {.vertices = {.thickness = thickness, .masks = masks, .moved = moved}});
        // All parts that are near enough with the largest thickness.
        std::vector<SurfaceContact> expected;
        for (SurfaceContact c : within(surface, body.shape, body.pose, 0.01 + 0.1)) {
            ++all;
            double thick = 0;
            std::uint32_t mask = ~0U;
            bool has_moved = false;
            for (const std::uint32_t v : c.vertices) {
                thick = std::max(thick, thickness[v]);
                mask &= masks[v];
                has_moved = has_moved || moved[v] == 1;
            }
            c.limit = 0.01 + thick;
            if (c.distance <= c.limit && (mask & 1) != 0 && has_moved)
                expected.push_back(c);
        }
        const auto key = [](const SurfaceContact& c) {
            return std::tuple(static_cast<int>(c.feature), c.id);
        };
        std::map<std::tuple<int, std::uint32_t>, SurfaceContact> by_part;
        for (const SurfaceContact& c : found)
            by_part[key(c)] = c;
        ASSERT_EQ(by_part.size(), found.size());
        for (const SurfaceContact& c : expected) {
            ASSERT_TRUE(by_part.contains(key(c))) << body.name;
            const SurfaceContact& here = by_part[key(c)];
            EXPECT_EQ(here.limit, c.limit);
            EXPECT_NEAR(here.distance, c.distance, kOff);
            by_part.erase(key(c));
        }
        for (const auto& [part, c] : by_part) { // edges of triangles that are left out
            EXPECT_EQ(c.feature, Feature::edge);
            EXPECT_LE(c.distance, c.limit);
            EXPECT_EQ(masks[c.vertices[0]] & masks[c.vertices[1]] & 1U, 1U);
            EXPECT_TRUE(moved[c.vertices[0]] == 1 || moved[c.vertices[1]] == 1);
            ++alone;
        }
        listed += found.size();
    }
    std::cout << listed << " of " << all << " contacts\n";
    EXPECT_GT(listed, all / 20);
    EXPECT_LT(listed, all);
    EXPECT_GT(alone, 0U);
}

TEST(SurfaceContacts, ATriangleThatTouchesAModelIsNear) {
    Random random(9);
    const Model cube(box_mesh({-1, -1, -1}, {1, 1, 1}));
    int listed = 0;
    for (int round = 0; round < many(300); ++round) {
        // A plane through a corner, an edge or a face of the cube, with the triangle's inside there.
        const int kind = random.integer(0, 2);
        const Vec3 normal = normalized_or_zero(
            kind == 0   ? Vec3{random.uniform(.2, 1), random.uniform(.2, 1), random.uniform(.2, 1)}
            : kind == 1 ? Vec3{random.uniform(.2, 1), random.uniform(.2, 1), 0}
                        : Vec3{0, 0, 1});
        const double gap = random.chance(0.4) ? 0 : std::pow(10, -random.uniform(13, 17));
        const Vec3 at = kind == 2 ? Vec3{0, 0, 1} : Vec3{1, 1, kind == 0 ? 1.0 : 0.0},
                   u = perpendicular(normal), w = cross(normal, u);
        const Pose pose = random.pose(0);
        const Transform world = pose;
        Mesh triangle;
        const double turn = random.uniform(0, 6);
        for (int k = 0; k < 3; ++k) {
            const double angle = turn + 2 * k;
            triangle.positions.push_back(apply(world, at + gap * normal + 8 * std::cos(angle) * u +
                                                          8 * std::sin(angle) * w));
        }
        triangle.triangles = {{0, 1, 2}};
        const auto found = within(Deformable(triangle), cube, pose, 0.1);
        ASSERT_EQ(found.size(), 1U) << kind << " at " << gap;
        EXPECT_NEAR(found[0].distance, 0, 2e-13); // the gap is up to 1e-13, of 8
        ++listed;
    }
    EXPECT_EQ(listed, many(300));
}

TEST(SurfaceContacts, EdgesOfATriangleThatMasksLeaveOutStandForThemselves) {
    // The ball is nearest to the triangle's inside, and farther from the edge of the other two vertices.
    const Deformable surface(Mesh{{{0, -8, 1.5}, {-4, .2, 1.5}, {4, .2, 1.5}}, {{0, 1, 2}}});
    const std::vector<std::uint32_t> masks{0, 1, 1};
    const auto found = within(surface, Sphere{{}, 1}, {}, 0.6, {.vertices = {.masks = masks}});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].feature, Feature::edge);
    EXPECT_EQ(found[0].vertices[0], 1U);
    EXPECT_EQ(found[0].vertices[1], 2U);
    EXPECT_NEAR(found[0].weights[0], 0.5, 1e-12);
    EXPECT_NEAR(found[0].distance, std::hypot(.2, 1.5) - 1, 1e-12);
    const auto all = within(surface, Sphere{{}, 1}, {}, 0.6);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].feature, Feature::face);
}

TEST(SurfaceContacts, Errors) {
    const Deformable surface(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    const RigidShape ball = Sphere{{}, 1};
    const std::vector<double> four(4, 0.0), three(3, 0.0);
    const auto fails = [&](double distance, const Pose& pose, const NearOptions& options) {
        try {
            within(surface, ball, pose, distance, options);
        } catch (const Error& error) {
            return error.code() == ErrorCode::bad_argument;
        }
        return false;
    };
    EXPECT_FALSE(fails(1, {}, {.vertices = {.thickness = three}}));
    EXPECT_TRUE(fails(-1, {}, {}));
    EXPECT_TRUE(fails(1, {{}, {0, 0, 0, 0}}, {}));
    EXPECT_TRUE(fails(1, {{HUGE_VAL, 0, 0}}, {}));
    EXPECT_TRUE(fails(1, {}, {.vertices = {.thickness = four}}));
    EXPECT_TRUE(fails(1, {}, {.vertices_b = {.thickness = three}}));
}

} // namespace
} // namespace abut::test
