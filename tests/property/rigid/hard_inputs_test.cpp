// collide, distance and within where rounding matters: cracks, copies, needles and zero-area
// triangles; far from the origin, tiny, huge, and tiny beside huge. Checked against all pairs of
// triangles; distances of the nearest pairs with 100 digits.

#include <abut/rigid.h>

#include "scenes/bodies.h"
#include "tests/support/oracle/brute_force.h"
#include "tests/support/oracle/precise_distance.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace abut::test {
namespace {

enum class Shape { cracked, copied, flat, needles, uneven, body };
constexpr std::array kShapes{Shape::cracked, Shape::copied, Shape::flat,
                             Shape::needles, Shape::uneven, Shape::body};

void add_triangle(Mesh& m, const Triangle& t) {
    const auto first = static_cast<std::uint32_t>(m.positions.size());
    m.positions.insert(m.positions.end(), t.begin(), t.end());
    m.triangles.push_back({first, first + 1, first + 2});
}

/// Triangles with vertices of their own, each moved by some units in the last place, so that
/// nothing is joined.
Mesh cracked(Random& random, const Mesh& mesh) {
    Mesh m;
    for (const auto& t : mesh.triangles)
        add_triangle(m,
                     {random.nudge(mesh.positions[t[0]], 3), random.nudge(mesh.positions[t[1]], 3),
                      random.nudge(mesh.positions[t[2]], 3)});
    return m;
}
/// Every triangle two or three times, with its vertices rotated or reversed.
Mesh copied(Random& random, Mesh m) {
    for (std::size_t i = m.triangles.size(); i-- > 0;) {
        const auto [a, b, c] = m.triangles[i];
        m.triangles.push_back({b, c, a});
        if (random.chance(0.5))
            m.triangles.push_back({b, a, c});
    }
    return m;
}
/// Adds points, segments, and triangles whose vertices are collinear, exactly or up to rounding.
Mesh flat(Random& random, Mesh m, int count) {
    m = with_degenerates(random, std::move(m), count);
    for (int i = 0; i < count; ++i) {
        const Vec3 p = random.in_cube(0.7), d = 0.25 * random.on_lattice(2);
        if (i % 2 == 0)
            add_triangle(m, {p, p + random.in_cube(0.3), p + 1e-17 * d});
        else
            add_triangle(m, {d, d + Vec3{0.5, 0.25, -0.5}, d + Vec3{1, 0.5, -1}});
    }
    return m;
}
/// Triangles a million times as long as wide, in bundles of four.
Mesh needles(Random& random, int count) {
    Mesh m;
    Vec3 base, along;
    for (int i = 0; i < count; ++i) {
        if (i % 4 == 0)
            base = random.in_cube(0.6), along = random.uniform(0.2, 1) * random.direction();
        const Vec3 p = base + random.in_cube(1e-4);
        add_triangle(m, {p, p + along + random.in_cube(1e-3), p + random.in_cube(5e-7)});
    }
    return m;
}
/// One triangle as large as the model, others down to a hundred-thousandth of it.
Mesh uneven(Random& random, int count) {
    Mesh m;
    add_triangle(m, random.triangle(0.8));
    for (int i = 1; i < count; ++i) {
        const Vec3 p = random.in_cube(0.7);
        const double size = std::pow(10, random.uniform(-5, -0.5));
        add_triangle(m, {p, p + random.in_cube(size), p + random.in_cube(size)});
    }
    return m;
}

/// A mesh of this shape, about 1 across.
Mesh make_mesh(Random& random, Shape shape) {
    switch (shape) {
    case Shape::cracked:
        return cracked(random, scenes::boulder(60, 3));
    case Shape::copied:
        return copied(random, random.chance(0.5) ? scenes::boulder(30, 5)
                                                 : box_mesh({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}));
    case Shape::flat:
        return flat(random, soup_mesh(random, 30, 0.6, 0.3), 20);
    case Shape::needles:
        return needles(random, 60);
    case Shape::uneven:
        return uneven(random, 70);
    default:
        return scenes::knot(90);
    }
}

struct HardCase {
    Mesh mesh_a, mesh_b;
    Transform world_a, world_b;
    Volume volume = Volume::automatic;
};

/// The placed triangles of both models, and their true pairs and distance.
struct Truth {
    std::vector<PlacedTriangle> a, b;
    std::vector<TrianglePair> pairs;
    double distance = 0;
    double largest = 0; ///< coordinate, absolute

    explicit Truth(const HardCase& c)
        : a(placed_triangles(c.mesh_a, c.world_a)), b(placed_triangles(c.mesh_b, c.world_b)),
          pairs(brute_pairs(a, b)) {
        for (const auto* triangles : {&a, &b})
            for (const PlacedTriangle& t : *triangles)
                for (const Vec3& p : t.corners)
                    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        if (pairs.empty())
            distance = nearest_of_all();
    }

private:
    /// Every pair that may be nearest despite rounding is measured with 100 digits.
    [[nodiscard]] double nearest_of_all() const {
        const double rounded = brute_distance(a, b);
        Precise least = 1e300;
        for (const PlacedTriangle& s : a)
            for (const PlacedTriangle& t : b) {
                const double limit =
                    rounded * (1 + 1e-10) + 64 * 0x1p-53 * size_of(s.corners, t.corners);
                if (box_distance_sq(s.box, t.box) > limit * limit ||
                    triangle_triangle_distance(s.corners, t.corners).distance_sq > limit * limit)
                    continue;
                keep_least(least, precise_boundary_distance(s.corners, t.corners));
            }
        return double(least);
    }
};

/// Bound on the rounding of differences between the coordinates of two triangles.
double rounding(const Triangle& a, const Triangle& b) {
    return 16 * 0x1p-53 * size_of(a, b);
}

void expect_gap(const Gap& gap, const std::vector<PlacedTriangle>& a,
                const std::vector<PlacedTriangle>& b, const Truth& truth) {
    ASSERT_LT(gap.triangle_a, a.size());
    ASSERT_LT(gap.triangle_b, b.size());
    const Triangle &s = a[gap.triangle_a].corners, &t = b[gap.triangle_b].corners;
    const double error = std::max(1e-12 * truth.distance, rounding(s, t));
    EXPECT_NEAR(gap.distance, truth.distance, error);
    EXPECT_EQ(gap.distance == 0, !truth.pairs.empty());
    EXPECT_EQ(gap.status, Status::exact);
    EXPECT_LE(gap.at_least, truth.distance);
    // The witness points are rounded to the grid of the coordinates. Where needles cross, their
    // common point is less certain.
    const double grid = gap.distance > 0 ? 32 * 0x1p-53 * truth.largest
                                         : 1e-8 * size_of(s, t) + truth.largest * 1e-15;
    EXPECT_LE(double(precise_distance(gap.point_a, s)), grid);
    EXPECT_LE(double(precise_distance(gap.point_b, t)), grid);
    EXPECT_NEAR(length(gap.point_a - gap.point_b), gap.distance, grid);
}

/// Checks all queries against the truth. Returns the distance.
double check(const HardCase& c) {
    const Truth truth(c);
    const Model a(c.mesh_a, {c.volume}), b(c.mesh_b, {c.volume});
    EXPECT_EQ(collide(a, c.world_a, b, c.world_b, {.mode = ContactMode::all}).pairs, truth.pairs);
    std::vector<TrianglePair> swapped;
    for (const TrianglePair& p :
         collide(b, c.world_b, a, c.world_a, {.mode = ContactMode::all}).pairs)
        swapped.push_back({p.b, p.a});
    std::sort(swapped.begin(), swapped.end());
    EXPECT_EQ(swapped, truth.pairs);
    for (const TrianglePair& p : collide(a, c.world_a, b, c.world_b).pairs)
        EXPECT_TRUE(std::binary_search(truth.pairs.begin(), truth.pairs.end(), p));
    EXPECT_EQ(collide(b, c.world_b, a, c.world_a).meet(), !truth.pairs.empty());

    const Gap gap = distance(a, c.world_a, b, c.world_b),
              back = distance(b, c.world_b, a, c.world_a);
    expect_gap(gap, truth.a, truth.b, truth);
    expect_gap(back, truth.b, truth.a, truth);

    const double size = 2 * std::max({truth.largest, truth.distance});
    const double error = 1e-12 * truth.distance + 32 * 0x1p-53 * size;
    const auto near = [&](double tolerance) {
        const bool result = within(a, c.world_a, b, c.world_b, tolerance);
        EXPECT_EQ(within(b, c.world_b, a, c.world_a, tolerance), result);
        return result;
    };
    EXPECT_EQ(near(0), !truth.pairs.empty());
    EXPECT_TRUE(near(truth.distance + error));
    EXPECT_TRUE(near(3 * truth.distance + size));
    if (truth.distance > 4 * error) {
        EXPECT_FALSE(near(truth.distance - error));
        EXPECT_FALSE(near(truth.distance / 2));
    }
    return gap.distance;
}

/// Moving the whole case keeps the distance, up to the rounding of positions.
void expect_same_when_moved(const HardCase& c, double before, const Transform& motion,
                            double reach) {
    const Model a(c.mesh_a, {c.volume}), b(c.mesh_b, {c.volume});
    const double after =
        distance(a, compose(motion, c.world_a), b, compose(motion, c.world_b)).distance;
    EXPECT_NEAR(before, after, 64 * 0x1p-53 * reach);
}

enum class Place {
    near,         ///< near the origin
    far_in_world, ///< 1e5 away
    far_in_mesh,  ///< the mesh is 1e5 from its own origin
    tiny,         ///< 1e-6 across
    huge,         ///< 1e6 across
    tiny_by_transform,
    huge_by_transform,
    minute, ///< 1e-30 across: squares underflow in single precision
    minute_by_transform,
    unlike, ///< b is a millionth of a
};

/// A random rotation with a scale, and a translation that takes `from` to `to`.
Transform put(Random& random, double scale, const Vec3& from, const Vec3& to) {
    Transform t = compose(random.pose(0), scaling(scale, scale, scale));
    const Vec3 shift = to - apply_linear(t, from);
    t.m[9] = shift.x, t.m[10] = shift.y, t.m[11] = shift.z;
    return t;
}

/// A random point on the surface.
Vec3 point_of(Random& random, const Mesh& mesh, const Transform& world) {
    const auto& t = mesh.triangles[static_cast<std::size_t>(
        random.integer(0, static_cast<int>(mesh.triangles.size()) - 1))];
    const double u = random.uniform(0, 1), v = random.uniform(0, 1 - u);
    const auto& p = mesh.positions;
    return apply(world, p[t[0]] + u * (p[t[1]] - p[t[0]]) + v * (p[t[2]] - p[t[0]]));
}

/// reach: receives a bound on the numbers from which positions are computed.
HardCase make_case(Random& random, Place place, Shape shape_a, Shape shape_b, double& reach) {
    HardCase c{make_mesh(random, shape_a), make_mesh(random, shape_b), {}, {}};
    double size = 1, by_transform = 1;
    Vec3 at = random.in_cube(1), middle_a, middle_b;
    reach = 4;
    const auto scale_mesh = [](Mesh& mesh, double s) {
        mesh = transformed(std::move(mesh), scaling(s, s, s));
    };
    switch (place) {
    case Place::near:
        break;
    case Place::far_in_world:
        at = 1e5 * random.direction(), reach = 2e5;
        break;
    case Place::far_in_mesh:
        middle_a = 1e5 * random.direction(), middle_b = 1e5 * random.direction(), reach = 4e5;
        c.mesh_a = transformed(c.mesh_a, translation(middle_a.x, middle_a.y, middle_a.z));
        c.mesh_b = transformed(c.mesh_b, translation(middle_b.x, middle_b.y, middle_b.z));
        break;
    case Place::tiny:
    case Place::huge:
    case Place::minute:
        size = place == Place::tiny ? 1e-6 : place == Place::huge ? 1e6 : 1e-30;
        scale_mesh(c.mesh_a, size), scale_mesh(c.mesh_b, size);
        break;
    case Place::tiny_by_transform:
    case Place::huge_by_transform:
    case Place::minute_by_transform:
        size = by_transform = place == Place::tiny_by_transform   ? 1e-6
                              : place == Place::huge_by_transform ? 1e6
                                                                  : 1e-30;
        break;
    case Place::unlike:
        scale_mesh(c.mesh_b, 1e-6);
        break;
    }
    at = size * at;
    reach *= size;
    c.world_a = put(random, by_transform, middle_a, at);
    c.world_b =
        put(random, by_transform, middle_b,
            place == Place::unlike ? point_of(random, c.mesh_a, c.world_a) +
                                         std::pow(10, random.uniform(-7.5, -5)) * random.direction()
                                   : at + random.uniform(0.2, 2.5) * size * random.direction());
    return c;
}

class HardInputs : public testing::TestWithParam<Place> {};

TEST_P(HardInputs, EqualBruteForce) {
    const Place place = GetParam();
    Random random(4300 + static_cast<std::uint64_t>(place));
    int meet = 0, rounds = 0;
    for (const Shape shape_a : kShapes)
        for (const Shape shape_b : kShapes)
            for (int i = 0; i < 3; ++i, ++rounds) {
                double reach = 0;
                HardCase c = make_case(random, place, shape_a, shape_b, reach);
                c.volume = static_cast<Volume>(rounds % (static_cast<int>(Volume::ssv) + 1));
                const double d = check(c);
                const Transform motion = put(random, 1, {}, random.in_cube(reach));
                expect_same_when_moved(c, d, motion, 4 * reach);
                meet += d == 0 ? 1 : 0;
                ASSERT_FALSE(HasFailure()) << "shapes " << int(shape_a) << ' ' << int(shape_b)
                                           << ", volume " << int(c.volume) << ", round " << i;
            }
    std::cout << meet << " of " << rounds << " meet\n";
    EXPECT_GT(meet, rounds / 8);
    EXPECT_LT(meet, rounds * 7 / 8);
}
INSTANTIATE_TEST_SUITE_P(Places, HardInputs,
                         testing::Values(Place::near, Place::far_in_world, Place::far_in_mesh,
                                         Place::tiny, Place::huge, Place::tiny_by_transform,
                                         Place::huge_by_transform, Place::minute,
                                         Place::minute_by_transform, Place::unlike));

/// A model against itself, at the same pose or moved by a few units in the last place.
TEST(HardInputs, CoincidentModels) {
    Random random(4310);
    int rounds = 0, whole = 0;
    for (const Shape shape : kShapes)
        for (const double far : {1.0, 1e5})
            for (const bool nudged : {false, true}) {
                const Mesh mesh = make_mesh(random, shape);
                const Transform world = put(random, 1, {}, random.in_cube(far));
                HardCase c{mesh, mesh, world, world};
                c.volume = static_cast<Volume>(rounds++ % (static_cast<int>(Volume::ssv) + 1));
                if (nudged)
                    for (std::size_t i = 9; i < 12; ++i)
                        c.world_b.m[i] = random.nudge(c.world_b.m[i], 4);
                const double d = check(c);
                ASSERT_TRUE(nudged || d == 0);
                // They either meet or are apart by no more than the nudge.
                ASSERT_LE(d, 16 * 0x1p-52 * far);
                if (!nudged) {
                    const Model m(mesh);
                    const auto pairs =
                        collide(m, world, m, world, {.mode = ContactMode::all}).pairs;
                    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
                        ASSERT_TRUE(
                            std::binary_search(pairs.begin(), pairs.end(), TrianglePair{i, i}));
                    whole += int(mesh.triangles.size());
                }
                ASSERT_FALSE(HasFailure()) << "shape " << int(shape) << " far " << far;
            }
    EXPECT_GT(whole, 500);
}

/// Parallel faces of boxes, with gaps and overlaps from a whole size down to rounding. The true
/// distance is known without other code.
TEST(HardInputs, ParallelFacesAtAnyGap) {
    const Model box(box_mesh({0, 0, 0}, {1, 1, 1}));
    for (const double far : {0.0, 0x1p17})
        for (double gap = 1; 1 + far + gap > 1 + far; gap /= 2) {
            const Transform world_a = translation(far, far, far),
                            world_b = translation(1 + far + gap, far + 0.25, far - 0.25);
            EXPECT_EQ(distance(box, world_a, box, world_b).distance, gap);
            EXPECT_FALSE(collide(box, world_a, box, world_b).meet());
            EXPECT_TRUE(within(box, world_a, box, world_b, gap));
            EXPECT_FALSE(within(box, world_a, box, world_b, std::nextafter(gap, 0)));
            const Transform overlapping = translation(1 + far - gap, far + 0.25, far - 0.25);
            EXPECT_EQ(distance(box, world_a, box, overlapping).distance, 0);
        }
    EXPECT_TRUE(collide(box, translation(0x1p17, 0, 0), box, translation(0x1p17 + 1, 0, 0)).meet());
}

} // namespace
} // namespace abut::test
