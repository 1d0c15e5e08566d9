// Lower bounds of the distance of two volumes: never above the distance of their contents, as tight
// as their kind allows, and the same eight at a time as one by one.

#include "geometry/triangle_triangle_distance.h"
#include "geometry/triangle_triangle_intersect.h"
#include "tests/support/simd_targets.h"
#include "tests/support/tree/volumes.h"
#include "volume/lower_bound.h"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

template <typename V>
class VolumeBound : public testing::Test {};

using Volumes = testing::Types<BoundingSphere, Pss, Lss, Rss, Ssv, Obb, Kdop14, Kdop18, Kdop26>;
TYPED_TEST_SUITE(VolumeBound, Volumes);

std::vector<Triangle> moved(std::vector<Triangle> triangles, const Transform& t) {
    for (Triangle& triangle : triangles)
        for (Vec3& p : triangle)
            p = apply(t, p);
    return triangles;
}

double distance_of(const std::vector<Triangle>& a, const std::vector<Triangle>& b) {
    double best_sq = HUGE_VAL;
    for (const Triangle& s : a)
        for (const Triangle& t : b) {
            if (triangle_triangle_intersect(s, t) != TriangleContact::none)
                return 0;
            best_sq = std::min(best_sq, triangle_triangle_distance(s, t).distance_sq);
        }
    return std::sqrt(best_sq);
}
double farthest_of(const std::vector<Triangle>& a, const std::vector<Triangle>& b) {
    double most = 0;
    for (const Triangle& s : a)
        for (const Triangle& t : b)
            for (const Vec3& p : s)
                for (const Vec3& q : t)
                    most = std::max(most, length(p - q));
    return most;
}

/// A few triangles around the origin, in one of the shapes that are hard for volumes.
std::vector<Triangle> part(Random& random, int kind, double size) {
    const Vec3 u = random.direction(), v = random.direction(), w = random.direction();
    std::vector<Triangle> triangles(static_cast<std::size_t>(random.integer(1, 6)));
    for (Triangle& t : triangles)
        for (Vec3& p : t) {
            const Vec3 s = random.in_cube(size);
            switch (kind % 5) {
            case 0:
                p = s;
                break;
            case 1:
                p = s.x * u + 0.3 * s.y * v + 0.02 * s.z * w;
                break;
            case 2:
                p = s.x * u + 0.5 * s.y * v;
                break;
            case 3:
                p = s.x * u;
                break;
            default:
                p = size * random.direction();
                break;
            }
        }
    return triangles;
}

/// Two sets of triangles, the second in its own frame; some pairs are apart and some meet.
struct Pair {
    std::vector<Triangle> a, b;
    Transform a_from_b;

    Pair(Random& random, int i, double scale, bool affine) {
        a = part(random, i, scale);
        b = part(random, i / 5, scale * std::pow(10, random.uniform(-1, 0.5)));
        a_from_b = random.linear_map(affine);
        if (affine && i % 8 == 0) // edges of a box become almost parallel
            a_from_b = compose(
                compose(a_from_b, Transform({1, 0, 0, 0, 1, 0, 0, 0,
                                             std::pow(10, random.uniform(-5, -1)), 0, 0, 0})),
                random.pose(0));
        const Vec3 shift = std::pow(10, random.uniform(-1, 1)) * scale * random.direction();
        a_from_b.m[9] = shift.x, a_from_b.m[10] = shift.y, a_from_b.m[11] = shift.z;
    }
};

TYPED_TEST(VolumeBound, IsBelowTheDistanceOfTheContents) {
    Random random(1201);
    double ratio_sum = 0;
    int apart = 0, open = 0, meeting = 0;
    for (int i = 0; i < 6000; ++i) {
        const double scale = i % 3 == 0 ? std::pow(10.0, random.integer(-6, 6)) : 1;
        const bool affine = i % 4 == 0;
        const Pair pair(random, i, scale, affine);
        const auto a = TypeParam::fit(pair.a), b = TypeParam::fit(pair.b);
        const RelativePose pose = make_relative_pose(pair.a_from_b, a.reach(), b.reach());
        ASSERT_TRUE(pose.valid);
        const typename TypeParam::Map map(pose);
        const double truth = distance_of(pair.a, moved(pair.b, pair.a_from_b));
        const double bound = distance_lower_bound(a, b, map);
        ASSERT_LE(bound, truth) << i;
        meeting += truth == 0 ? 1 : 0;
        if (truth > 0.1 * scale && !affine) {
            ++apart;
            open += bound > 0 ? 1 : 0;
            ratio_sum += bound / truth;
        }
    }
    std::cout << "separated " << double(open) / apart << ", bound / distance " << ratio_sum / apart
              << '\n';
    EXPECT_GT(meeting, 100);
    EXPECT_GT(apart, 2000);
    EXPECT_GT(open, 0.5 * apart);
    EXPECT_GT(ratio_sum, 0.3 * apart);
}

TYPED_TEST(VolumeBound, EightAtATimeEqualsOneByOne) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(1202);
        int open = 0, overlapping = 0, different = 0;
        for (int i = 0; i < 400; ++i) {
            const bool affine = i % 4 == 0;
            const Pair first(random, i, 1, affine);
            const auto one = TypeParam::fit(first.b);
            VolumeBatch<TypeParam> batch;
            std::array<std::vector<Triangle>, 8> contents;
            double reach = 0;
            for (std::size_t lane = 0; lane < 8; ++lane) {
                contents[lane] = part(random, random.integer(0, 4), 1);
                const auto volume = TypeParam::fit(contents[lane]);
                reach = std::max(reach, volume.reach());
                batch.set(lane, volume);
                ASSERT_EQ(batch.get(lane).reach(), volume.reach());
            }
            const RelativePose pose = make_relative_pose(first.a_from_b, reach, one.reach());
            const typename TypeParam::Map map(pose);
            const auto image = image_of(one, map);
            VolumeBounds lanes{}, reference{};
            bound_distances(batch, image, lanes);
            bound_distances_reference(batch, image, reference);
            const auto placed = moved(first.b, first.a_from_b);
            for (std::size_t lane = 0; lane < 8; ++lane) {
                const double truth = distance_of(contents[lane], placed);
                const double lower = std::sqrt(lanes.lower_sq[lane]);
                ASSERT_LE(lower, truth);
                ASSERT_LE(std::sqrt(reference.lower_sq[lane]), truth);
                ASSERT_GE(lanes.upper_sq[lane],
                          std::pow(farthest_of(contents[lane], placed), 2) * (1 - 1e-12));
                // Fused operations round far less than the margin, but they may choose another of
                // two equally good directions.
                ASSERT_NEAR(lower, std::sqrt(reference.lower_sq[lane]), 1e-3);
                different +=
                    std::abs(lanes.gap[lane] - reference.gap[lane]) > 2 * pose.margin ? 1 : 0;
                ASSERT_NEAR(std::sqrt(lanes.upper_sq[lane]), std::sqrt(reference.upper_sq[lane]),
                            2 * pose.margin);
                ASSERT_GE(lower, std::max(0.0F, lanes.gap[lane]) * (1 - 1e-5));
                ++(lower > 0 ? open : overlapping);
            }
        }
        EXPECT_GT(open, 800);
        EXPECT_GT(overlapping, 800);
        EXPECT_LE(different, 8);
    });
}

TYPED_TEST(VolumeBound, FarFromTheOriginAndBesideEachOther) {
    Random random(1203);
    int open = 0;
    for (int i = 0; i < 500; ++i) {
        Pair pair(random, i, 1, false);
        const Vec3 offset = random.in_cube(1e4);
        for (Triangle& t : pair.a)
            for (Vec3& p : t)
                p = p + offset;
        pair.a_from_b.m[9] += offset.x, pair.a_from_b.m[10] += offset.y,
            pair.a_from_b.m[11] += offset.z;
        const auto a = TypeParam::fit(pair.a), b = TypeParam::fit(pair.b);
        const typename TypeParam::Map map(make_relative_pose(pair.a_from_b, a.reach(), b.reach()));
        const double bound = distance_lower_bound(a, b, map);
        ASSERT_LE(bound, distance_of(pair.a, moved(pair.b, pair.a_from_b)));
        open += bound > 0 ? 1 : 0;
    }
    EXPECT_GT(open, 150);
}

// ------------------------------------------------------------------- tightness, volume by volume

/// Corners of the core rectangle, in order around it.
std::array<Vec3, 4> quadrangle(const Rss& rss, const Transform& to) {
    std::array<Vec3, 4> corners;
    constexpr std::array<std::array<int, 2>, 4> kSigns{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    for (std::size_t c = 0; c < 4; ++c) {
        Vec3 p{rss.centre[0], rss.centre[1], rss.centre[2]};
        for (std::size_t i = 0; i < 2; ++i) {
            const auto& d = rss.axes[i].direction;
            p = p + double{rss.axes[i].half} * kSigns[c][i] * Vec3{d[0], d[1], d[2]};
        }
        corners[c] = apply(to, p);
    }
    return corners;
}
std::vector<Triangle> halves(const std::array<Vec3, 4>& q) {
    return {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}};
}

Rss any_rss(Random& random, double thin) {
    std::vector<Triangle> triangles;
    const Vec3 u = random.direction(), v = random.direction();
    for (int k = 0; k < 4; ++k) {
        Triangle t;
        for (Vec3& p : t)
            p = random.uniform(-1, 1) * u + thin * random.uniform(-1, 1) * v;
        triangles.push_back(t);
    }
    Rss rss = Rss::fit(triangles);
    rss.radius = static_cast<float>(random.uniform(0, 0.2));
    return rss;
}

TEST(VolumeBound, EqualsTheDistanceOfRectangles) {
    Random random(1204);
    double worst = 0;
    int apart = 0, near = 0, loose = 0;
    for (int i = 0; i < 20000; ++i) {
        const Rss a = any_rss(random, i % 5 == 0 ? 0 : 1), b = any_rss(random, i % 7 == 0 ? 0 : 1);
        Transform pose = random.pose(0);
        if (i % 3 == 0) // almost parallel
            pose = Pose{{}, {1, random.uniform(0, 1e-4), random.uniform(0, 1e-4), 0.1}};
        const Vec3 shift =
            (i % 2 == 0 ? random.uniform(0, 3) : std::pow(10, random.uniform(-4, 0))) *
            random.direction();
        pose.m[9] = shift.x, pose.m[10] = shift.y, pose.m[11] = shift.z;
        const RelativePose relative = make_relative_pose(pose, a.reach(), b.reach());
        const double cores = distance_of(halves(quadrangle(a, {})), halves(quadrangle(b, pose)));
        const double truth = std::max(0.0, cores - a.radius - b.radius);
        const double bound = distance_lower_bound(a, b, relative);
        ASSERT_LE(bound, truth) << i;
        apart += truth > 0 ? 1 : 0;
        near += truth > 0 && cores < 0.3 ? 1 : 0;
        worst = std::max(worst, truth - bound);
        // The margin is 64 parts in 2^24 of the size.
        loose += truth - bound > 3e-5 ? 1 : 0;
    }
    std::cout << "worst " << worst << " of size 3, loose " << loose << '\n';
    EXPECT_GT(apart, 5000);
    EXPECT_GT(near, 300);
    // Two directions whose lengths agree in single precision may differ by the square root of its
    // precision.
    EXPECT_LT(worst, 3e-3);
    EXPECT_LT(loose, 10);
}

/// A swept sphere whose core has this dimension.
Ssv any_ssv(Random& random, std::size_t dimension) {
    Rss rss = any_rss(random, 1);
    for (std::size_t i = dimension; i < 2; ++i)
        rss.axes[i] = {};
    return Ssv(rss);
}

TEST(VolumeBound, EqualsTheDistanceOfCoresOfAnyDimension) {
    Random random(1211);
    for (std::size_t n = 0; n < 3; ++n)
        for (std::size_t m = 0; m < 3; ++m) {
            SCOPED_TRACE(testing::Message() << n << ' ' << m);
            double worst = 0;
            int apart = 0, loose = 0, open = 0;
            for (int i = 0; i < 3000; ++i) {
                const bool affine = i % 3 == 2;
                const Ssv a = any_ssv(random, n), b = any_ssv(random, m);
                Transform pose = random.linear_map(affine);
                if (i % 4 == 0) // almost parallel
                    pose = Pose{{}, {1, random.uniform(0, 1e-4), random.uniform(0, 1e-4), 0.1}};
                const Vec3 shift =
                    (i % 2 == 0 ? random.uniform(0, 3) : std::pow(10, random.uniform(-4, 0))) *
                    random.direction();
                pose.m[9] = shift.x, pose.m[10] = shift.y, pose.m[11] = shift.z;
                const RelativePose relative = make_relative_pose(pose, a.reach(), b.reach());
                const double cores =
                    distance_of(halves(quadrangle(a, {})), halves(quadrangle(b, pose)));
                // Under a map that is not rigid, b's balls are ellipsoids.
                const double least =
                    std::max(0.0, cores - a.radius - b.radius * stretch_of(pose).most);
                const double bound = distance_lower_bound(a, b, relative);
                const double most =
                    std::max(0.0, cores - a.radius - b.radius * stretch_of(pose).least);
                ASSERT_LE(bound, most * (1 + 1e-12)) << i;
                open += bound > 0 ? 1 : 0;
                if (least > 0 && !affine) {
                    ++apart;
                    worst = std::max(worst, least - bound);
                    loose += least - bound > 4e-5 ? 1 : 0;
                }
            }
            EXPECT_GT(apart, 450);
            EXPECT_GT(open, 650);
            EXPECT_LT(worst, 3e-3);
            EXPECT_LT(loose, 4);
        }
}

TEST(VolumeBound, MixedLanesEqualBatchesOfOneKind) {
    for_each_simd_target([](const std::string& target) {
        SCOPED_TRACE(target);
        Random random(1212);
        int open = 0, mixed = 0;
        for (int i = 0; i < 2000; ++i) {
            const Ssv one = any_ssv(random, static_cast<std::size_t>(i % 3));
            Transform pose = random.linear_map(i % 5 == 0);
            const Vec3 shift = random.uniform(0, 3) * random.direction();
            pose.m[9] = shift.x, pose.m[10] = shift.y, pose.m[11] = shift.z;
            const RelativePose relative = make_relative_pose(pose, 2, 2);
            VolumeBatch<Ssv> batch;
            std::array<std::size_t, 8> dimension{};
            for (std::size_t lane = 0; lane < 8; ++lane) {
                dimension[lane] = static_cast<std::size_t>(random.integer(0, 2));
                batch.set(lane, any_ssv(random, dimension[lane]));
                ASSERT_EQ(batch.get(lane).dimension(), dimension[lane]);
            }
            VolumeBounds together{};
            bound_distances(batch, image_of(one, relative), together);
            for (std::size_t lane = 0; lane < 8; ++lane) {
                VolumeBatch<Ssv> alone;
                VolumeBounds bounds{};
                alone.set(0, batch.get(lane));
                bound_distances(alone, image_of(one, relative), bounds);
                ASSERT_NEAR(std::sqrt(together.lower_sq[lane]), std::sqrt(bounds.lower_sq[0]),
                            3e-3);
                ASSERT_NEAR(together.upper_sq[lane], bounds.upper_sq[0], 1e-5 * bounds.upper_sq[0]);
                open += bounds.lower_sq[0] > 0 ? 1 : 0;
                mixed += dimension[lane] < 2 ? 1 : 0;
            }
        }
        EXPECT_GT(open, 8000);
        EXPECT_LT(open, 15500);
        EXPECT_GT(mixed, 8000);
    });
}

TEST(VolumeBound, ThinRectanglesThatAlmostTouch) {
    Random random(1205);
    int apart = 0, tight = 0;
    for (int i = 0; i < 6000; ++i) {
        Rss a = any_rss(random, 1), b = any_rss(random, i % 3 == 0 ? 0 : 1);
        a.radius = b.radius = 0;
        const Transform turn = random.pose(0);
        // A point of each rectangle is moved onto the other's, then away by very little.
        const auto at = [&](const Rss& r, const Transform& t) {
            const auto q = quadrangle(r, t);
            const int kind = random.integer(0, 2);
            const double s = kind == 0 ? 0 : random.uniform(0, 1),
                         u = kind == 2 ? random.uniform(0, 1) : 0;
            return q[0] + s * (q[1] - q[0]) + u * (q[3] - q[0]);
        };
        const Vec3 shift =
            at(a, {}) - at(b, turn) + std::pow(10, random.uniform(-3.5, -1)) * random.direction();
        Transform pose = turn;
        pose.m[9] = shift.x, pose.m[10] = shift.y, pose.m[11] = shift.z;
        const double truth = distance_of(halves(quadrangle(a, {})), halves(quadrangle(b, pose)));
        const double bound =
            distance_lower_bound(a, b, make_relative_pose(pose, a.reach(), b.reach()));
        ASSERT_LE(bound, truth);
        if (truth > 1e-4) {
            ++apart;
            tight += truth - bound < 3e-5 ? 1 : 0;
        }
    }
    std::cout << apart << " apart, " << tight << " tight\n";
    EXPECT_GT(apart, 1000);
    EXPECT_GT(tight, 0.9 * apart);
}

TEST(VolumeBound, EqualsTheDistanceOfSegmentsAndPoints) {
    Random random(1206);
    int apart = 0;
    for (int i = 0; i < 5000; ++i) {
        const auto line = [&] {
            const Vec3 u = random.uniform(0, 1) * random.direction();
            Lss lss = Lss::fit(std::vector<Triangle>{{u, -u, u}});
            lss.radius = static_cast<float>(random.uniform(0, 0.2));
            return lss;
        };
        const Lss a = line(), b = line();
        Transform pose = random.pose(1.5);
        if (i % 3 == 0)
            pose = Pose{random.in_cube(1), {1, random.uniform(0, 1e-4), 0, 0}};
        const auto ends = [](const Lss& l, const Transform& t) {
            const auto& d = l.axes[0].direction;
            const Vec3 c{l.centre[0], l.centre[1], l.centre[2]},
                h = double{l.axes[0].half} * Vec3{d[0], d[1], d[2]};
            return std::array{apply(t, c - h), apply(t, c + h)};
        };
        const auto p = ends(a, {}), q = ends(b, pose);
        const double truth =
            std::max(0.0, std::sqrt(segment_segment_distance(p[0], p[1], q[0], q[1]).distance_sq) -
                              a.radius - b.radius);
        const RelativePose relative = make_relative_pose(pose, a.reach(), b.reach());
        const double bound = distance_lower_bound(a, b, relative);
        ASSERT_LE(bound, truth);
        ASSERT_NEAR(bound, truth, 4e-5) << i;
        apart += truth > 0 ? 1 : 0;
    }
    EXPECT_GT(apart, 2000);
}

/// The twelve triangles of a placed box.
std::vector<Triangle> surface(const Obb& box, const Transform& to) {
    std::array<Vec3, 8> c;
    for (unsigned i = 0; i < 8; ++i) {
        Vec3 p{box.centre[0], box.centre[1], box.centre[2]};
        for (unsigned k = 0; k < 3; ++k)
            p = p + ((i >> k & 1U) != 0 ? 1.0 : -1.0) * double{box.half[k]} *
                        Vec3{box.axis[k][0], box.axis[k][1], box.axis[k][2]};
        c[i] = apply(to, p);
    }
    std::vector<Triangle> triangles;
    for (const auto& f : {std::array{0, 1, 3, 2}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                          std::array{2, 3, 7, 6}, std::array{0, 2, 6, 4}, std::array{1, 3, 7, 5}}) {
        const auto at = [&](std::size_t i) { return c[static_cast<std::size_t>(f[i])]; };
        triangles.push_back({at(0), at(1), at(2)});
        triangles.push_back({at(0), at(2), at(3)});
    }
    return triangles;
}

TEST(VolumeBound, FifteenAxesTellEveryPairOfBoxesApart) {
    Random random(1207);
    int apart = 0, meeting = 0;
    double ratio_sum = 0;
    for (int i = 0; i < 3000; ++i) {
        const bool affine = i % 3 == 0;
        const auto box = [&] { return Obb::fit(part(random, i, 1)); };
        const Obb a = box(), b = box();
        Transform pose = random.linear_map(affine);
        const Vec3 shift = random.in_cube(1.5);
        pose.m[9] = shift.x, pose.m[10] = shift.y, pose.m[11] = shift.z;
        const RelativePose relative = make_relative_pose(pose, a.reach(), b.reach());
        const double bound = distance_lower_bound(a, b, relative);
        const double truth = distance_of(surface(a, {}), surface(b, pose));
        // The surfaces are apart, but one box is inside the other: their distance says nothing.
        const bool inside = bound == 0 && truth > 0;
        if (!inside) {
            ASSERT_LE(bound, truth) << i;
        }
        if (truth > 1e-3 && !inside) {
            ++apart;
            ratio_sum += bound / truth;
        }
        if (truth == 0) {
            ++meeting;
        }
        if (inside && truth > 1e-4) {
            // The centre of one box must lie in the other.
            const Vec3 ca{a.centre[0], a.centre[1], a.centre[2]};
            const Vec3 cb = apply(pose, {b.centre[0], b.centre[1], b.centre[2]});
            const bool b_in_a = encloses(a, cb), a_in_b = encloses(b, apply(inverse(pose), ca));
            ASSERT_TRUE(b_in_a || a_in_b) << i << " " << truth;
        }
    }
    std::cout << "bound / distance " << ratio_sum / apart << '\n';
    EXPECT_GT(apart, 500);
    EXPECT_GT(meeting, 300);
    EXPECT_GT(ratio_sum, 0.85 * apart);
}

TEST(VolumeBound, SlabsOfTheSameFrameAreExact) {
    // Without a rotation the slabs of both have the same directions.
    Random random(1208);
    for (int i = 0; i < 500; ++i) {
        const Kdop18 kdop = Kdop18::fit(part(random, i, 1));
        const auto image = image_of(kdop, Kdop18::Map(make_relative_pose({}, 2, 2)));
        for (std::size_t slab = 0; slab < Kdop18::kSlabs; ++slab) {
            ASSERT_EQ(image.kdop.lower[slab], kdop.lower[slab]);
            ASSERT_EQ(image.kdop.upper[slab], kdop.upper[slab]);
        }
    }
}

TEST(VolumeBound, MoreSlabsBoundATurnedBallBetter) {
    Random random(1209);
    std::vector<Triangle> ball;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 p = random.direction();
        ball.push_back({p, p, p});
    }
    const auto widest = [&]<std::size_t k>(const Kdop<k>& kdop) {
        double sum = 0;
        Random poses(1210);
        for (int i = 0; i < 200; ++i) {
            const auto image = image_of(kdop, KdopMap<k>(make_relative_pose(poses.pose(0), 2, 2)));
            sum += image.kdop.upper[0] - image.kdop.lower[0];
        }
        return sum / 400;
    };
    const double k14 = widest(Kdop14::fit(ball)), k18 = widest(Kdop18::fit(ball)),
                 k26 = widest(Kdop26::fit(ball));
    std::cout << "half width of a unit ball: " << k14 << ' ' << k18 << ' ' << k26 << '\n';
    EXPECT_LT(k26, 1.12);
    EXPECT_LT(k18, 1.2);
    EXPECT_LT(k14, 1.25);
    EXPECT_LT(k26, k18);
    EXPECT_LT(k18, k14);
    EXPECT_GT(k26, 0.99);
}

TEST(RelativePose, RefusesWhatSinglePrecisionCannotHold) {
    EXPECT_TRUE(make_relative_pose({}, 1, 1).valid);
    EXPECT_TRUE(make_relative_pose({}, 1e-6, 1e-6).valid);
    EXPECT_FALSE(make_relative_pose({}, 1e19, 1).valid);
    const auto scale = [](double x, double y, double z) {
        return Transform({x, 0, 0, 0, y, 0, 0, 0, z, 0, 0, 0});
    };
    EXPECT_FALSE(make_relative_pose(scale(1, 1, 0), 1, 1).valid);
    EXPECT_FALSE(make_relative_pose(scale(1, 1, 1e-14), 1, 1).valid);
    EXPECT_TRUE(make_relative_pose(scale(1, -1, 1e-3), 1, 1).valid);
    EXPECT_FALSE(make_relative_pose(scale(1, 1, NAN), 1, 1).valid);
    EXPECT_FALSE(make_relative_pose({}, 1, NAN).valid);
}

} // namespace
} // namespace abut::test
