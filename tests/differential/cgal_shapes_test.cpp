// Points, rays, segments and boxes against CGAL's AABB tree with exact predicates, where CGAL is
// installed.

#include <abut/shape_queries.h>

#include "math/predicates.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>
#include <numeric>

#ifdef ABUT_HAVE_CGAL
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#endif

namespace abut::test {
namespace {

#ifdef ABUT_HAVE_CGAL

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using CgalTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 cgal(const Vec3& p) {
    return {p.x, p.y, p.z};
}

/// Lattice triangles with an area: nothing is rounded, and most queries are special cases.
Mesh lattice_mesh(Random& random, int count) {
    Mesh mesh;
    while (mesh.triangles.size() < static_cast<std::size_t>(count)) {
        const Vec3 at = random.on_lattice(12);
        const Vec3 a = at + random.on_lattice(4), b = at + random.on_lattice(4),
                   c = at + random.on_lattice(4);
        if (collinear(a, b, c))
            continue;
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {a, b, c});
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

struct Both {
    explicit Both(const Mesh& mesh) : model(mesh) {
        for (const auto& t : mesh.triangles)
            triangles.emplace_back(cgal(mesh.positions[t[0]]), cgal(mesh.positions[t[1]]),
                                   cgal(mesh.positions[t[2]]));
        tree.insert(triangles.begin(), triangles.end());
        tree.build();
    }
    template <typename Shape>
    [[nodiscard]] std::vector<std::uint32_t> met(const Shape& shape) const {
        std::vector<Triangles::const_iterator> found;
        tree.all_intersected_primitives(shape, std::back_inserter(found));
        std::vector<std::uint32_t> numbers;
        numbers.reserve(found.size());
        for (const auto& f : found)
            numbers.push_back(static_cast<std::uint32_t>(f - triangles.begin()));
        std::sort(numbers.begin(), numbers.end());
        return numbers;
    }
    Model model;
    Triangles triangles;
    CgalTree tree;
};

TEST(CgalShapes, AgreesOnALattice) {
    Random random(1501);
    int ray_hits = 0, box_hits = 0, segment_hits = 0, cases = 0;
    for (int k = 0; k < 20; ++k) {
        const Both both(lattice_mesh(random, 150));
        for (int i = 0; i < 60; ++i, ++cases) {
            const Vec3 o = random.on_lattice(18) - Vec3{1, 1, 1};
            Vec3 to = random.on_lattice(18) - Vec3{1, 1, 1};
            if (to == o)
                to = o + Vec3{1, 0, 0};
            std::vector<std::uint32_t> hits;
            for (const RayHit& hit : all_hits(both.model, Pose{}, {o, to - o}))
                hits.push_back(hit.triangle);
            std::sort(hits.begin(), hits.end());
            ASSERT_EQ(hits, both.met(Kernel::Ray_3(cgal(o), cgal(to)))) << k << ' ' << i;
            ASSERT_EQ(first_hit(both.model, Pose{}, {o, to - o}).meet, !hits.empty());
            const auto on_segment = overlapping_triangles(both.model, Pose{}, Segment{o, to});
            ASSERT_EQ(on_segment, both.met(Kernel::Segment_3(cgal(o), cgal(to)))) << k << ' ' << i;
            Box3 box;
            extend(box, o), extend(box, o + random.on_lattice(5) + Vec3{1, 1, 1});
            const auto in_box = overlapping_triangles(both.model, Pose{}, box);
            ASSERT_EQ(in_box, both.met(Kernel::Iso_cuboid_3(cgal(box.lower), cgal(box.upper))))
                << k << ' ' << i;
            ray_hits += hits.empty() ? 0 : 1, box_hits += in_box.empty() ? 0 : 1;
            segment_hits += on_segment.empty() ? 0 : 1;
        }
    }
    for (const int hits : {ray_hits, box_hits, segment_hits}) {
        EXPECT_GT(hits, cases * 2 / 10);
        EXPECT_LT(hits, cases * 98 / 100);
    }
}

TEST(CgalShapes, AgreesOnTheNearestPoint) {
    Random random(1502);
    for (const double scale : {1e-6, 1.0, 1e6}) {
        const Both both(transformed(torus_mesh(1, 0.35, 60, 40), scaling(scale, scale, scale)));
        for (int i = 0; i < 2000; ++i) {
            const Vec3 p = random.in_cube((i % 2 == 0 ? 1.5 : 20) * scale);
            const double theirs = std::sqrt(both.tree.squared_distance(cgal(p)));
            ASSERT_NEAR(nearest(both.model, Pose{}, p).distance, theirs, 1e-12 * (theirs + scale));
        }
    }
}

#else

TEST(CgalShapes, AgreesOnALattice) {
    GTEST_SKIP() << "libcgal-dev was not there when this was built";
}

#endif

} // namespace
} // namespace abut::test
