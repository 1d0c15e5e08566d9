// Edges and faces of surfaces at rest that share a point: all pairs against integers; every number
// of threads and SIMD target against each other. Each test prints its seed and what it has seen.

#include <abut/deformable.h>
#include <abut/penetration.h>
#include <abut/progress.h>
#include <abut/rigid.h>

#include "geometry/segment_triangle_contact.h"
#include "tests/support/moving_meshes.h"
#include "tests/support/oracle/edge_face_truth.h"
#include "tests/support/rounds.h"
#include "tests/support/simd_targets.h"

#include <gtest/gtest.h>
#include <iostream>
#include <map>

namespace abut::test {
namespace {

using Found = std::vector<EdgeFaceIntersection>;

/// Calls visit(edge, face, face_first, p, q, triangle) for every edge and face that are a pair.
template <typename Visit>
void for_each_edge_and_face(const Deformable& edges_of, const Mesh& edge_mesh,
                            const Deformable& faces_of, const Mesh& face_mesh, bool face_first,
                            const Visit& visit) {
    const bool self = &edges_of == &faces_of;
    for (std::uint32_t edge = 0; edge < edges_of.edges().size(); ++edge)
        for (std::uint32_t face = 0; face < face_mesh.triangles.size(); ++face) {
            const auto& e = edges_of.edges()[edge];
            const auto& f = face_mesh.triangles[face];
            if (self &&
                std::any_of(f.begin(), f.end(), [&](auto v) { return v == e[0] || v == e[1]; }))
                continue;
            const auto& at = face_mesh.positions;
            visit(edge, face, face_first, edge_mesh.positions[e[0]], edge_mesh.positions[e[1]],
                  Triangle{at[f[0]], at[f[1]], at[f[2]]});
        }
}

struct Tally {
    std::size_t pairs = 0;
    std::map<EdgeFaceContact, std::size_t> hits;

    [[nodiscard]] std::size_t all() const {
        std::size_t sum = 0;
        for (const auto& [contact, count] : hits)
            sum += count;
        return sum;
    }
    void print() {
        std::cout << pairs << " pairs, " << hits[EdgeFaceContact::crossing] << " crossing, "
                  << hits[EdgeFaceContact::touching] << " touching, "
                  << hits[EdgeFaceContact::coplanar] << " coplanar\n";
    }
};

Vec3 weighted(const Triangle& t, const std::array<double, 3>& w) {
    return w[0] * t[0] + w[1] * t[1] + w[2] * t[2];
}

double size_of(const Vec3& p, const Vec3& q, const Triangle& t) {
    double size = 0;
    for (const Vec3& v : {p, q, t[0], t[1], t[2]})
        size = std::max({size, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return size;
}

/// Compares a list with the truth of every pair. In: b is null for one surface.
void expect_truth(const Found& found, const Deformable& a, const Mesh& mesh_a, const Deformable& b,
                  const Mesh& mesh_b, Tally& tally) {
    auto next = found.begin();
    const auto check = [&](std::uint32_t edge, std::uint32_t face, bool face_first, const Vec3& p,
                           const Vec3& q, const Triangle& t) {
        ++tally.pairs;
        const auto truth = true_contact(p, q, t);
        const bool listed = next != found.end() && next->edge == edge && next->face == face &&
                            next->face_first == face_first;
        ASSERT_EQ(listed, truth.has_value()) << edge << ' ' << face;
        if (!listed)
            return;
        ASSERT_EQ(next->contact, *truth) << edge << ' ' << face;
        ++tally.hits[*truth];
        // The point lies on both, where the numbers say.
        const double error = 1e-9 * size_of(p, q, t);
        EXPECT_LE(length(p + next->along * (q - p) - next->point), error);
        EXPECT_LE(length(weighted(t, next->barycentric) - next->point), error);
        ++next;
    };
    for_each_edge_and_face(a, mesh_a, b, mesh_b, false, check);
    if (&a != &b)
        for_each_edge_and_face(b, mesh_b, a, mesh_a, true, check);
    ASSERT_EQ(next, found.end());
}

MovingMesh any_surface(Random& random) {
    const int vertices = random.integer(4, 14), triangles = random.integer(1, 14);
    return random.chance(0.6) ? lattice_soup(random, vertices, triangles, random.integer(1, 4))
                              : random_soup(random, vertices, triangles);
}

/// Moves a mesh far away, so that its coordinates are rounded, or scales it by a power of two.
Mesh displaced(Random& random, Mesh mesh) {
    const bool far = random.chance(0.3);
    const double scale = random.chance(0.3) ? std::ldexp(1, random.integer(-300, 15)) : 1;
    const Vec3 by = far ? random.in_cube(std::pow(10, random.integer(2, 12))) : Vec3{};
    for (Vec3& p : mesh.positions)
        p = scale * (p + by);
    return mesh;
}

TEST(Intersections, EveryPairOfASurfaceAgainstIntegers) {
    Random random(1997);
    Tally tally;
    while (tally.pairs < std::size_t(many(300'000))) {
        const Mesh mesh = displaced(random, any_surface(random).mesh);
        const Deformable surface(mesh);
        expect_truth(self_intersections(surface), surface, mesh, surface, mesh, tally);
        if (HasFatalFailure())
            return;
    }
    tally.print();
    EXPECT_GT(tally.all(), tally.pairs / 20);
    EXPECT_LT(tally.all(), tally.pairs / 2);
    for (const auto& [contact, count] : tally.hits)
        EXPECT_GT(count, tally.pairs / 100) << int(contact);
    EXPECT_EQ(tally.hits.size(), 3U);
}

TEST(Intersections, EveryPairOfTwoSurfacesAgainstIntegers) {
    Random random(402);
    Tally tally;
    std::size_t face_first = 0;
    while (tally.pairs < std::size_t(many(200'000))) {
        const Mesh mesh_a = any_surface(random).mesh, mesh_b = any_surface(random).mesh;
        const Deformable a(mesh_a), b(mesh_b, {.scheme = Scheme::features});
        const Found found = intersections(a, b);
        expect_truth(found, a, mesh_a, b, mesh_b, tally);
        if (HasFatalFailure())
            return;
        for (const EdgeFaceIntersection& each : found)
            face_first += each.face_first ? 1 : 0;
        // Two surfaces share a point if and only if an edge of one shares one with a face of the
        // other.
        ASSERT_EQ(found.empty(), !collide(a.model(), {}, b.model(), {}).meet());
    }
    tally.print();
    EXPECT_GT(tally.all(), tally.pairs / 40);
    EXPECT_GT(face_first, tally.all() / 4);
}

/// All pairs of a crumpled sheet by the kernel alone.
Found by_single_tests(const Deformable& surface, const Mesh& mesh) {
    Found all;
    for_each_edge_and_face(surface, mesh, surface, mesh, false,
                           [&](std::uint32_t edge, std::uint32_t face, bool, const Vec3& p,
                               const Vec3& q, const Triangle& t) {
                               if (segment_triangle_contact(p, q, t) != SegmentContact::none)
                                   all.push_back({false, edge, face, {}, {}, {}, {}});
                           });
    return all;
}

void expect_same_pairs(const Found& found, const Found& truth) {
    ASSERT_EQ(found.size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i)
        ASSERT_TRUE(found[i].edge == truth[i].edge && found[i].face == truth[i].face) << i;
}

/// A surface in motion, at both ends of its steps, on hierarchies that are refitted and rebuilt.
TEST(Intersections, BothEndsOfEveryStepOfACrumpledSheet) {
    Random random(55);
    std::size_t hits = 0;
    for (int round = 0; round < many(3); ++round) {
        MovingMesh moving = crumpled_sheet(random, 12);
        Deformable surface(moving.mesh);
        surface.set_motion(moving.mesh.positions, moving.end);
        for (int step = 0; step < 4; ++step) {
            Mesh at_end = moving.mesh;
            at_end.positions = moving.end;
            const Found start = self_intersections(surface),
                        end = self_intersections(surface, {.at_end = true});
            expect_same_pairs(start, by_single_tests(surface, moving.mesh));
            expect_same_pairs(end, by_single_tests(surface, at_end));
            if (HasFatalFailure())
                return;
            hits += start.size() + end.size();
            moving.mesh.positions = moving.end;
            for (Vec3& p : moving.end)
                p = p + random.in_cube(step == 2 ? 0.5 : 0.05);
            surface.advance(moving.end);
        }
    }
    std::cout << hits << " hits\n";
    EXPECT_GT(hits, 1000U);
}

/// Regions that are proven flat are skipped.
TEST(Intersections, ASmoothSheetHasNone) {
    Random random(8);
    const auto wave = [](double bend) {
        return grid_mesh(60, 60, false, false, [&](double u, double v) {
            return Vec3{u, 0.1 * std::sin(bend * u) * std::cos(bend * v), v};
        });
    };
    Deformable surface(wave(3));
    EXPECT_TRUE(self_intersections(surface).empty());
    surface.advance(wave(5).positions);
    EXPECT_TRUE(self_intersections(surface, {.at_end = true}).empty());
}

TEST(Intersections, ThreadsAndTargetsChangeNothing) {
    Random random(71);
    const MovingMesh moving = crumpled_sheet(random, 60);
    const Found truth = self_intersections(moving.deformable(), {.at_end = true});
    EXPECT_GT(truth.size(), 50U);
    for (const int threads : {1, 2, 5}) {
        set_threads(threads);
        EXPECT_EQ(self_intersections(moving.deformable(), {.at_end = true}), truth) << threads;
    }
    set_threads(0);
    for_each_simd_target([&](const std::string& name) {
        EXPECT_EQ(self_intersections(moving.deformable(), {.at_end = true}), truth) << name;
    });
    for (const Assignment assignment : {Assignment::maximal, Assignment::uniform_edge_edge})
        EXPECT_EQ(
            self_intersections(moving.deformable({.assignment = assignment}), {.at_end = true}),
            truth);
}

/// The model of a surface in motion answers as one that is built anew for each step.
TEST(DeformableModel, StepsEqualNewModels) {
    Random random(31);
    int met = 0, apart = 0;
    for (int round = 0; round < many(20); ++round) {
        MovingMesh moving = crumpled_sheet(random, 12);
        Deformable surface(moving.mesh);
        const Model probe(grid_mesh(4, 4, false, false, [](double u, double v) {
            return Vec3{0.3 * u, 0.3 * v, 0.1 * u * v};
        }));
        std::vector<Vec3> at = moving.mesh.positions;
        for (int step = 0; step < 6; ++step) {
            for (Vec3& p : at)
                p = p + random.in_cube(step == 4 ? 1 : 0.05);
            surface.set_motion(at, at);
            Mesh mesh = moving.mesh;
            mesh.positions = at;
            const Model anew(mesh), refitted = surface.model();
            ASSERT_EQ(refitted.mesh().positions, at);
            const Transform place = random.pose(1.2);
            const Contacts contacts =
                               collide(refitted, {}, probe, place, {.mode = ContactMode::all}),
                           truth = collide(anew, {}, probe, place, {.mode = ContactMode::all});
            ASSERT_EQ(contacts.pairs, truth.pairs);
            ASSERT_DOUBLE_EQ(distance(refitted, {}, probe, place).distance,
                             distance(anew, {}, probe, place).distance);
            (truth.meet() ? met : apart) += 1;
        }
    }
    std::cout << met << " met, " << apart << " apart\n";
    EXPECT_GT(met, 10);
    EXPECT_GT(apart, 10);
}

/// Penetration of a closed surface that deforms, and of two.
TEST(DeformableModel, ClosedSurfacesPenetrate) {
    Random random(77);
    int deep = 0, apart = 0;
    const Mesh rest = torus_mesh(1, 0.4, 24, 12);
    const Model probe(sphere_mesh(0.4, 16, 12));
    Deformable surface(rest), other(rest);
    for (int step = 0; step < many(40); ++step) {
        Mesh mesh = rest, second = rest;
        const Vec3 by = random.in_cube(1.2);
        const double wave = random.uniform(0, 6);
        for (Vec3& p : mesh.positions)
            p = p + 0.1 * Vec3{std::sin(3 * p.y + wave), std::sin(2 * p.z), std::cos(3 * p.x)};
        for (Vec3& p : second.positions)
            p = p + 2 * by;
        surface.set_motion(mesh.positions, mesh.positions);
        other.set_motion(second.positions, second.positions);
        const auto check = [&](const Model& a, const Model& b, const Model& anew,
                               const Transform& place) {
            const Depth found = penetration(a, {}, b, place),
                        truth = penetration(anew, {}, b, place);
            ASSERT_EQ(found.meet, truth.meet);
            ASSERT_EQ(found.interpenetrate, truth.interpenetrate);
            ASSERT_EQ(found.regions.size(), truth.regions.size());
            // Both intervals hold the depth.
            ASSERT_LE(found.depth, truth.depth_at_most * (1 + 1e-9));
            ASSERT_LE(truth.depth, found.depth_at_most * (1 + 1e-9));
            (found.depth > 0 ? deep : apart) += 1;
        };
        check(surface.model(), probe, Model(mesh), Pose{by});
        check(surface.model(), other.model(), Model(mesh), {});
        const Gap gap = distance(surface.model(), {}, other.model(), {});
        ASSERT_EQ(gap.distance == 0, !intersections(surface, other).empty());
    }
    std::cout << deep << " deep, " << apart << " apart\n";
    EXPECT_GT(deep, many(40) / 4);
    EXPECT_GT(apart, many(40) / 4);
}

} // namespace
} // namespace abut::test
