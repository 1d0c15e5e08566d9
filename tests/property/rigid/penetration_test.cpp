// The public penetration query on random poses: separations, bounds and invariance.

#include <abut/penetration.h>

#include "geometry/triangle_triangle_distance.h"
#include "rigid/penetration/contact_regions.h"
#include "tests/support/body.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <numeric>
#include <tuple>

namespace abut::test {
namespace {

constexpr int kBodies = 6;

/// Solids, convex or not, with one or two components.
Mesh solid_mesh(int kind) {
    switch (kind) {
    case 0:
        return torus_mesh(1, 0.4, 24, 12);
    case 1:
        return sphere_mesh(0.8, 18, 10);
    case 2:
        return box_mesh({-0.8, -0.5, -0.3}, {0.7, 0.6, 0.4});
    case 3:
        return ring_mesh(-0.2, 0.3, 0.5, 0.9, 14);
    case 4:
        return joined(box_mesh({-1, -0.2, -0.2}, {-0.3, 0.2, 0.2}), sphere_mesh(0.4, 12, 7));
    default: // wavy, star-shaped
        return transformed(
            grid_mesh(30, 16, true, true,
                      [](double u, double v) {
                          const double a = 2 * std::numbers::pi * u, b = 2 * std::numbers::pi * v;
                          const double r = 0.7 + 0.1 * std::sin(5 * a) + 0.3 * std::cos(b);
                          return Vec3{r * std::cos(a), r * std::sin(a), 0.3 * std::sin(b)};
                      }),
            Transform());
    }
}

Transform moved(Transform t, const Vec3& shift) {
    t.m[9] += shift.x, t.m[10] += shift.y, t.m[11] += shift.z;
    return t;
}

/// Whether `outer` contains a vertex of `inner`.
bool contains_any(const Body& outer, const Transform& world, const Body& inner,
                  const Transform& inner_world) {
    const PlacedSolid placed(outer.model, outer.solid, world);
    const Mesh& mesh = inner.model.mesh();
    return std::any_of(mesh.positions.begin(), mesh.positions.end(),
                       [&](const Vec3& p) { return placed.contains(apply(inner_world, p)); });
}

bool separated(const Body& a, const Transform& world_a, const Body& b, const Transform& world_b) {
    return !collide(a.model, world_a, b.model, world_b).meet() &&
           !contains_any(a, world_a, b, world_b) && !contains_any(b, world_b, a, world_a);
}

struct Pair {
    const Body& a;
    const Body& b;
    Transform world_a, world_b;
};

template <typename Check>
void for_each_pair(std::uint64_t seed, int pairs, const Check& check) {
    Random random(seed);
    std::vector<std::unique_ptr<Body>> bodies;
    for (int k = 0; k < kBodies; ++k) {
        bodies.push_back(std::make_unique<Body>(solid_mesh(k)));
        ASSERT_TRUE(bodies.back()->solid.closed);
    }
    for (int i = 0; i < pairs && !testing::Test::HasFatalFailure(); ++i) {
        const Body &a = *bodies[std::size_t(random.integer(0, kBodies - 1))],
                   &b = *bodies[std::size_t(random.integer(0, kBodies - 1))];
        const Transform world_a = random.pose(0.6), world_b = random.pose(0.6);
        SCOPED_TRACE(i);
        check(random, Pair{a, b, world_a, world_b});
    }
}

TEST(Penetration, TheSeparationSeparates) {
    int deep = 0, apart = 0;
    double slack = 0;
    for_each_pair(3201, 250, [&](Random& random, const Pair& p) {
        const Depth d = penetration(p.a.model, p.world_a, p.b.model, p.world_b);
        ASSERT_EQ(d.interpenetrate, !separated(p.a, p.world_a, p.b, p.world_b));
        ASSERT_TRUE(separated(p.a, p.world_a, p.b, moved(p.world_b, d.separation)));
        ASSERT_LE(d.depth, length(d.separation) * (1 + 1e-12));
        if (!d.interpenetrate) {
            ASSERT_EQ(d.separation, Vec3{});
            ++apart;
            return;
        }
        ++deep;
        slack += length(d.separation) / d.depth;
        // A translation shorter than the depth separates in no direction.
        for (int i = 0; i < 5; ++i)
            ASSERT_FALSE(separated(p.a, p.world_a, p.b,
                                   moved(p.world_b, (0.999 * d.depth) * random.direction())));
    });
    EXPECT_GT(deep, 120);
    EXPECT_GT(apart, 10);
    std::cout << "separation over depth: " << slack / deep << " in the mean\n";
}

TEST(Penetration, SymmetricAndInvariant) {
    int deep = 0;
    for_each_pair(3202, 80, [&](Random& random, const Pair& p) {
        const PenetrationOptions options{.separation = false};
        const Depth d = penetration(p.a.model, p.world_a, p.b.model, p.world_b, options);
        const Depth swapped = penetration(p.b.model, p.world_b, p.a.model, p.world_a, options);
        const Transform common = random.pose(3);
        const Depth turned = penetration(p.a.model, compose(common, p.world_a), p.b.model,
                                         compose(common, p.world_b), options);
        deep += d.interpenetrate ? 1 : 0;
        for (const Depth* other : {&swapped, &turned}) {
            ASSERT_EQ(d.interpenetrate, other->interpenetrate);
            // The true depth lies in both intervals.
            ASSERT_LE(std::max(d.depth, other->depth),
                      std::min(d.depth_at_most, other->depth_at_most) * (1 + 1e-12));
            ASSERT_EQ(d.regions.size(), other->regions.size());
            double area = 0, other_area = 0;
            for (const ContactRegion& r : d.regions)
                area += r.area;
            for (const ContactRegion& r : other->regions)
                other_area += r.area;
            ASSERT_NEAR(area, other_area, 1e-9);
        }
        for (std::size_t i = 0; i < d.regions.size(); ++i) {
            const Vec3 n = d.regions[i].normal;
            const Vec3 turned_n = turned.regions[i].normal;
            ASSERT_NEAR(length(apply_linear(common, n) - turned_n), 0,
                        1e-9 / std::max(d.regions[i].area, 1e-6));
        }
    });
    EXPECT_GT(deep, 40);
}

/// The depth against dense samples of each surface that lie inside the other solid.
TEST(Penetration, DepthAgainstSampling) {
    int deep = 0, narrow = 0;
    for_each_pair(3203, 60, [&](Random& random, const Pair& p) {
        const Depth d =
            penetration(p.a.model, p.world_a, p.b.model, p.world_b, {.separation = false});
        const PlacedSolid a(p.a.model, p.a.solid, p.world_a), b(p.b.model, p.b.solid, p.world_b);
        double deepest = 0;
        const auto sample = [&](const PlacedSolid& surface, const PlacedSolid& solid) {
            for (std::uint32_t t = 0; t < surface.model().data().mesh().triangles.size(); ++t) {
                const Triangle c = surface.world_triangle(t);
                for (int i = 0; i < 12; ++i) {
                    double u = random.uniform(0, 1), v = random.uniform(0, 1);
                    if (u + v > 1)
                        u = 1 - u, v = 1 - v;
                    const Vec3 point = c[0] + u * (c[1] - c[0]) + v * (c[2] - c[0]);
                    if (solid.contains(point))
                        deepest = std::max(deepest, solid.nearest(point, HUGE_VAL).distance);
                }
            }
        };
        sample(a, b), sample(b, a);
        ASSERT_LE(deepest, d.depth_at_most * (1 + 1e-12));
        if (!d.interpenetrate)
            return;
        ++deep;
        narrow += d.depth_at_most <= 1.011 * d.depth ? 1 : 0;
        // The witness points lie on the surfaces, at the reported distance; one of them is inside
        // the other solid.
        ASSERT_NEAR(a.nearest(d.point_a, HUGE_VAL).distance, 0, 1e-12);
        ASSERT_NEAR(b.nearest(d.point_b, HUGE_VAL).distance, 0, 1e-12);
        ASSERT_NEAR(length(d.point_a - d.point_b), d.depth, 1e-12);
        ASSERT_TRUE(b.contains(d.point_a) || a.contains(d.point_b));
        ASSERT_NEAR(length(d.point_b + d.depth * d.direction - d.point_a), 0, 1e-9);
    });
    EXPECT_GT(deep, 30);
    EXPECT_GT(narrow, deep * 9 / 10);
}

/// Regions against the intersection curve: segments that end in the same point, bit for bit, belong
/// to one region.
TEST(Penetration, RegionsAgainstTheCurve) {
    int several = 0, pairs = 0;
    for_each_pair(3204, 100, [&](Random&, const Pair& p) {
        const Contacts c = collide(p.a.model, p.world_a, p.b.model, p.world_b,
                                   {.mode = ContactMode::all, .segments = true});
        std::vector<std::size_t> label(c.pairs.size());
        std::iota(label.begin(), label.end(), 0U);
        std::map<std::tuple<double, double, double>, std::size_t> first;
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t i = 0; i < c.pairs.size(); ++i)
                for (std::uint32_t k = 0; k < c.segments[i].count; ++k) {
                    const Vec3& end = c.segments[i].corners.at(k);
                    auto [at, added] = first.try_emplace({end.x, end.y, end.z}, label[i]);
                    const std::size_t least = std::min(at->second, label[i]);
                    changed |= at->second != least || label[i] != least;
                    at->second = label[i] = least;
                }
        }
        const Depth d =
            penetration(p.a.model, p.world_a, p.b.model, p.world_b, {.separation = false});
        std::map<std::size_t, std::vector<TrianglePair>> expected;
        for (std::size_t i = 0; i < c.pairs.size(); ++i)
            expected[label[i]].push_back(c.pairs[i]);
        std::vector<std::vector<TrianglePair>> got;
        for (const ContactRegion& r : d.regions)
            if (!r.pairs.empty())
                got.push_back(r.pairs);
        ASSERT_EQ(got.size(), expected.size());
        std::size_t i = 0;
        for (const auto& [least, region] : expected)
            ASSERT_EQ(got[i++], region);
        pairs += c.meet() ? 1 : 0, several += expected.size() > 1 ? 1 : 0;
    });
    EXPECT_GT(pairs, 50);
    EXPECT_GT(several, 20);
}

/// Each region's depth against samples, where each sample counts for the region with the nearest
/// curve.
TEST(Penetration, RegionDepthsAgainstSampling) {
    int several = 0;
    for_each_pair(3205, 80, [&](Random& random, const Pair& p) {
        const Contacts c = collide(p.a.model, p.world_a, p.b.model, p.world_b,
                                   {.mode = ContactMode::all, .segments = true});
        const Depth d =
            penetration(p.a.model, p.world_a, p.b.model, p.world_b, {.separation = false});
        if (d.regions.size() < 2 || d.regions.back().pairs.empty())
            return;
        ++several;
        std::map<TrianglePair, std::size_t> region_of;
        for (std::size_t r = 0; r < d.regions.size(); ++r)
            for (const TrianglePair& pair : d.regions[r].pairs)
                region_of[pair] = r;
        const auto nearest_region = [&](const Vec3& x) {
            double best = HUGE_VAL;
            std::size_t region = 0;
            for (std::size_t i = 0; i < c.pairs.size(); ++i) {
                const auto& s = c.segments[i].corners;
                const double to =
                    segment_segment_distance(x, x, s[0], s[c.segments[i].count - 1]).distance_sq;
                if (to < best)
                    best = to, region = region_of.at(c.pairs[i]);
            }
            return region;
        };
        const PlacedSolid a(p.a.model, p.a.solid, p.world_a), b(p.b.model, p.b.solid, p.world_b);
        std::vector<double> deepest(d.regions.size());
        const auto sample = [&](const PlacedSolid& surface, const PlacedSolid& solid) {
            for (std::uint32_t v = 0; v < surface.model().data().mesh().positions.size(); ++v) {
                const Vec3 x = surface.model().world_vertex(v);
                if (random.chance(0.5) && solid.contains(x)) {
                    double& region = deepest[nearest_region(x)];
                    region = std::max(region, solid.nearest(x, HUGE_VAL).distance);
                }
            }
        };
        sample(a, b), sample(b, a);
        for (std::size_t r = 0; r < d.regions.size(); ++r)
            ASSERT_LE(deepest[r], d.regions[r].depth_at_most * (1 + 1e-9)) << r;
    });
    EXPECT_GT(several, 15);
}

/// Sheets, soups, cracks, needles, zero-area and doubled triangles; mirrored, stretched, far away.
TEST(Penetration, DirtyMeshes) {
    Random random(3207);
    const auto make = [&](int kind) {
        Mesh torus = torus_mesh(1, 0.35, 14, 8);
        switch (kind) {
        case 0: // a crack
            torus.triangles.pop_back();
            return torus;
        case 1:
            return grid_mesh(8, 8, false, false, [](double u, double v) {
                return Vec3{2 * u - 1, 2 * v - 1, 0.3 * std::sin(6 * u)};
            });
        case 2:
            return soup_mesh(random, 60, 0.7, 0.3);
        case 3:
            return with_degenerates(random, torus, 10);
        case 4: // every triangle twice
            return joined(torus, torus);
        default: // needles
            return transformed(torus, scaling(1, 1, 1e-6));
        }
    };
    int deep = 0, no_solid = 0;
    for (int i = 0; i < 90; ++i) {
        const Model a(make(i % 6)), b(make(random.integer(0, 5)));
        const Vec3 far = random.chance(0.3) ? Vec3{1e5, -1e5, 1e5} : Vec3{};
        const double stretch = random.chance(0.3) ? -1.5 : 1;
        const Transform world_a = moved(random.pose(0.5), far),
                        world_b = compose(moved(random.pose(0.5), far), scaling(stretch, 1, 1));
        const Depth d = penetration(a, world_a, b, world_b);
        const bool meet = collide(a, world_a, b, world_b).meet();
        ASSERT_TRUE(d.interpenetrate || !meet || d.regions.front().touching) << i;
        ASSERT_FALSE(collide(a, world_a, b, moved(world_b, d.separation)).meet()) << i;
        ASSERT_TRUE(meet || d.interpenetrate || d.regions.empty());
        ASSERT_LE(d.depth, length(d.separation) * (1 + 1e-9)) << i;
        std::size_t pairs = 0;
        for (const ContactRegion& r : d.regions)
            pairs += r.pairs.size();
        ASSERT_EQ(pairs, collide(a, world_a, b, world_b, {.mode = ContactMode::all}).pairs.size());
        deep += d.interpenetrate ? 1 : 0;
        no_solid += d.interpenetrate && !examine_solid(a.mesh()).solid ? 1 : 0;
    }
    EXPECT_GT(deep, 60);
    EXPECT_GT(no_solid, 20);
}

/// Coarse solids on a grid, whose faces, edges and corners coincide in every way.
TEST(Penetration, BoxesOnAGrid) {
    Random random(3206);
    int deep = 0, touch = 0;
    for (int i = 0; i < 400; ++i) {
        const Vec3 a_low = random.on_lattice(2), b_low = random.on_lattice(2);
        const Vec3 a_high = a_low + random.on_lattice(2) + Vec3{1, 1, 1},
                   b_high = b_low + random.on_lattice(2) + Vec3{1, 1, 1};
        const Vec3 low = max(a_low, b_low), high = min(a_high, b_high);
        const bool overlap = low.x < high.x && low.y < high.y && low.z < high.z;
        const Body a(box_mesh(a_low, a_high)), b(box_mesh(b_low, b_high));
        const Depth d = penetration(a.model, {}, b.model, {});
        ASSERT_EQ(d.interpenetrate, overlap);
        ASSERT_TRUE(
            separated(a, {}, b, translation(d.separation.x, d.separation.y, d.separation.z)));
        ASSERT_TRUE(overlap || std::all_of(d.regions.begin(), d.regions.end(),
                                           [](const ContactRegion& r) { return r.touching; }));
        touch += !overlap && !d.regions.empty() ? 1 : 0;
        if (!overlap)
            continue;
        ++deep;
        // The shortest separating motion is along an axis.
        const double shortest =
            std::min({a_high.x - b_low.x, b_high.x - a_low.x, a_high.y - b_low.y,
                      b_high.y - a_low.y, a_high.z - b_low.z, b_high.z - a_low.z});
        ASSERT_LE(d.depth, shortest);
        ASSERT_GT(length(d.separation), shortest);
        ASSERT_LE(length(d.separation), shortest * (1 + 1.0 / 128));
    }
    EXPECT_GT(deep, 100);
    EXPECT_GT(touch, 40);
}

} // namespace
} // namespace abut::test
