// Triangles against CGAL's with exact predicates, where CGAL is installed.

#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

#ifdef ABUT_HAVE_CGAL
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#endif

namespace abut::test {
namespace {

#ifdef ABUT_HAVE_CGAL

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Triangle_3 cgal(const Triangle& t) {
    return {{t[0].x, t[0].y, t[0].z}, {t[1].x, t[1].y, t[1].z}, {t[2].x, t[2].y, t[2].z}};
}

TEST(Cgal, AgreesOnTrianglesWithAnArea) {
    Random random(1401);
    int meet = 0, cases = 0;
    for (int i = 0; i < 300000; ++i) {
        Triangle a, b;
        if (i % 3 == 0) {
            a = random.lattice_triangle(4), b = random.lattice_triangle(4);
        } else {
            a = random.triangle(), b = random.triangle();
            if (i % 3 == 1) // a vertex next to a's face
                b[0] = random.nudge(0.25 * a[0] + 0.25 * a[1] + 0.5 * a[2], 2);
        }
        if (collinear(a[0], a[1], a[2]) || collinear(b[0], b[1], b[2]))
            continue; // CGAL requires an area
        const bool expected = CGAL::do_intersect(cgal(a), cgal(b));
        ASSERT_EQ(triangle_triangle_intersect(a, b) != TriangleContact::none, expected) << i;
        ++cases, meet += expected ? 1 : 0;
    }
    EXPECT_GT(meet, cases * 3 / 10);
    EXPECT_LT(meet, cases * 7 / 10);
}

#else

TEST(Cgal, AgreesOnTrianglesWithAnArea) {
    GTEST_SKIP() << "libcgal-dev was not there when this was built";
}

#endif

} // namespace
} // namespace abut::test
