#include "math/unit_root.h"

#include <cmath>
#include <gtest/gtest.h>

namespace abut {
namespace {

IntegerPolynomial polynomial(int c0, int c1, int c2 = 0, int c3 = 0) {
    return {{BigInt(c0), BigInt(c1), BigInt(c2), BigInt(c3)}};
}

std::vector<double> roots_of(const IntegerPolynomial& p) {
    std::vector<double> result;
    for (UnitRoot& root : unit_roots(p)) {
        root.refine(60);
        result.push_back(root.lower_bound());
    }
    return result;
}

void expect_roots(const IntegerPolynomial& p, const std::vector<double>& roots) {
    const auto found = roots_of(p);
    ASSERT_EQ(found.size(), roots.size());
    for (std::size_t i = 0; i < roots.size(); ++i) {
        EXPECT_LE(found[i], roots[i]);
        EXPECT_NEAR(found[i], roots[i], 1e-15);
    }
}

TEST(UnitRoots, AllInOrderEachOnce) {
    expect_roots(polynomial(-1, 2), {0.5});
    expect_roots(polynomial(-1, 3), {1.0 / 3});
    expect_roots(polynomial(-1, 0, 2), {std::sqrt(0.5)});
    // (3 t - 1) (2 t - 1) (4 t - 3), (2 t - 1)^2 (3 t - 2) and (2 t - 1)^3.
    expect_roots(polynomial(-3, 19, -38, 24), {1.0 / 3, 0.5, 0.75});
    expect_roots(polynomial(-2, 11, -20, 12), {0.5, 2.0 / 3});
    expect_roots(polynomial(-1, 6, -12, 8), {0.5});
    // (3 t - 1)^2 has no change of sign.
    expect_roots(polynomial(1, -6, 9), {1.0 / 3});
}

TEST(UnitRoots, EndsBelongToTheInterval) {
    expect_roots(polynomial(0, 1), {0});
    expect_roots(polynomial(-1, 1), {1});
    expect_roots(polynomial(0, 0, -1, 1), {0, 1}); // t^2 (t - 1)
    expect_roots(polynomial(0, 1, -3, 2), {0, 0.5, 1});
    expect_roots(polynomial(1, 1), {});
    expect_roots(polynomial(-3, 2), {});
    expect_roots(polynomial(7, 0), {});
}

TEST(UnitRoots, SignsThere) {
    // The root is sqrt(1/2), of 2 t^2 - 1. The convergents 408/577 and 577/816 of its continued
    // fraction lie on opposite sides.
    auto roots = unit_roots(polynomial(-1, 0, 2));
    ASSERT_EQ(roots.size(), 1U);
    EXPECT_EQ(roots[0].sign_of(polynomial(-1, 0, 2)), 0);
    EXPECT_EQ(roots[0].sign_of(polynomial(0, -1, 0, 2)), 0); // t (2 t^2 - 1)
    EXPECT_EQ(roots[0].sign_of(polynomial(-408, 577)), 1);
    EXPECT_EQ(roots[0].sign_of(polynomial(-577, 816)), -1);
    EXPECT_EQ(roots[0].sign_of(polynomial(0, 0)), 0);
    EXPECT_EQ(roots[0].sign_of(polynomial(-5, 0)), -1);
    auto half = unit_roots(polynomial(-1, 2));
    EXPECT_EQ(half[0].sign_of(polynomial(-2, 4)), 0);
    EXPECT_EQ(half[0].sign_of(polynomial(-1, 1, 1)), -1);
}

} // namespace
} // namespace abut
