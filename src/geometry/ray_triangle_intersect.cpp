#include "geometry/ray_triangle_intersect.h"

#include "geometry/point_triangle_distance.h"
#include "math/dyadic.h"
#include "math/predicates.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {

namespace {

/// Relative precision of t. If rounding leaves t less precise, it is computed exactly.
constexpr double kPrecision = 0x1p-40;
/// Relative error bound of sums of three products of three factors, each a rounded difference, sum
/// or product. It is relative to the sum of the products' magnitudes.
constexpr double kRayRounding = 16 * 0x1p-53;
/// Far above what products lose to underflow; a normal number, since arithmetic with subnormal ones
/// is slow.
constexpr double kUnderflow = 0x1p-1000;

Vec3 magnitudes(const Vec3& v) {
    return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

/// A value and a bound on its rounding error.
struct Rounded {
    double value = 0, bound = 0;
    [[nodiscard]] int certain_sign() const { // overflow makes both comparisons false
        return value > bound ? 1 : value < -bound ? -1 : 0;
    }
};

/// The normal of a triangle, and the sums of the magnitudes of its components' terms.
struct Normal {
    Vec3 value, terms;

    explicit Normal(const Triangle& t) {
        const Vec3 u = t[1] - t[0], v = t[2] - t[0];
        const Vec3 a = magnitudes(u), b = magnitudes(v);
        value = cross(u, v);
        terms = {a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x};
    }
    /// n . w, where w was rounded from terms whose magnitudes sum to `w_terms`.
    [[nodiscard]] Rounded dot(const Vec3& w, const Vec3& w_terms) const {
        return {abut::dot(value, w), kRayRounding * abut::dot(terms, w_terms) +
                                         kUnderflow * (1 + w_terms.x + w_terms.y + w_terms.z)};
    }
};

struct ExactTriangle {
    std::array<DyadicVec3, 3> v;
    explicit ExactTriangle(const Triangle& t)
        : v{DyadicVec3(t[0]), DyadicVec3(t[1]), DyadicVec3(t[2])} {}
    [[nodiscard]] DyadicVec3 normal() const { return cross(v[1] - v[0], v[2] - v[0]); }
};

/// numerator / denominator; the denominator is positive.
struct Fraction {
    Dyadic numerator, denominator{1.0};
};
int compare(const Fraction& a, const Fraction& b) {
    return (a.numerator * b.denominator - b.numerator * a.denominator).sign();
}

/// The line's parameter where it crosses the plane of a triangle. In: the line is not parallel to
/// the plane.
Fraction exact_crossing(const Ray& ray, const Triangle& triangle) {
    const ExactTriangle t(triangle);
    const DyadicVec3 n = t.normal();
    // t = n . (v_0 - o) / n . d
    const Dyadic numerator = dot(n, t.v[0] - DyadicVec3(ray.origin)),
                 denominator = dot(n, DyadicVec3(ray.direction));
    return denominator.sign() > 0 ? Fraction{numerator, denominator}
                                  : Fraction{-numerator, -denominator};
}

/// Sign of t - s, where t is the parameter of exact_crossing. In: s is finite.
int compare_crossing(const Ray& ray, const Triangle& triangle, const Normal& n, int facing,
                     double s) {
    // n . (v_0 - o - s d) has the sign of t - s if n . d is positive.
    const Vec3 w = triangle[0] - ray.origin, step = s * ray.direction;
    const int sign = n.dot(w - step, magnitudes(w) + magnitudes(step)).certain_sign();
    return sign != 0 ? sign * facing : compare(exact_crossing(ray, triangle), {Dyadic(s)});
}

/// The parameters at which a line enters and leaves a triangle (or segment) whose plane holds the
/// line.
struct Interval {
    Fraction enter, leave;
};

/// In: the line is coplanar with each edge.
std::optional<Interval> interval_along(const Ray& ray, const Triangle& triangle) {
    const ExactTriangle t(triangle);
    const DyadicVec3 o(ray.origin), d(ray.direction);
    const Dyadic d_sq = dot(d, d);
    std::array<DyadicVec3, 3> off; // (v - o) x d: multiples of one normal
    std::array<Dyadic, 3> along;   // (v - o) . d
    for (std::size_t i = 0; i < 3; ++i)
        off[i] = cross(t.v[i] - o, d), along[i] = dot(t.v[i] - o, d);
    // Any component that is nonzero for some vertex tells the multiples apart.
    const auto nonzero = [&](const Dyadic DyadicVec3::*c) {
        return std::any_of(off.begin(), off.end(),
                           [&](const DyadicVec3& v) { return (v.*c).sign() != 0; });
    };
    const Dyadic DyadicVec3::*c = nonzero(&DyadicVec3::x)   ? &DyadicVec3::x
                                  : nonzero(&DyadicVec3::y) ? &DyadicVec3::y
                                                            : &DyadicVec3::z;
    std::optional<Interval> found;
    const auto add = [&](const Fraction& f) {
        if (!found) {
            found = {f, f};
            return;
        }
        if (compare(f, found->enter) < 0)
            found->enter = f;
        if (compare(f, found->leave) > 0)
            found->leave = f;
    };
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const Dyadic &ci = off[i].*c, &cj = off[j].*c;
        if (ci.sign() == 0)
            add({along[i], d_sq});
        else if (ci.sign() * cj.sign() < 0) {
            // The crossing is at v_i + (v_j - v_i) c_i / (c_i - c_j).
            const Dyadic numerator = ci * along[j] - cj * along[i], difference = ci - cj;
            add(difference.sign() > 0 ? Fraction{numerator, difference * d_sq}
                                      : Fraction{-numerator, -difference * d_sq});
        }
    }
    return found;
}

/// The parameter at which a ray in the plane of a triangle first is within the triangle.
std::optional<Fraction> exact_entry(const Ray& ray, const Triangle& triangle) {
    std::optional<Interval> range = interval_along(ray, triangle);
    if (!range || ray.t_min > ray.t_max)
        return std::nullopt;
    if (std::isfinite(ray.t_max) && compare(range->enter, {Dyadic(ray.t_max)}) > 0)
        return std::nullopt;
    if (!std::isfinite(ray.t_min))
        return range->enter;
    const Fraction begin{Dyadic(ray.t_min)};
    if (compare(range->leave, begin) < 0)
        return std::nullopt;
    return compare(range->enter, begin) < 0 ? begin : range->enter;
}

double rounded(const Fraction& f) {
    return quotient(f.numerator, f.denominator);
}

std::optional<RayTriangleHit> hit_along(const Ray& ray, const Triangle& triangle) {
    const std::optional<Fraction> entry = exact_entry(ray, triangle);
    if (!entry)
        return std::nullopt;
    return RayTriangleHit{rounded(*entry), 0};
}

double crossing(const Ray& ray, const Triangle& triangle, const Normal& n) {
    const Vec3 w = triangle[0] - ray.origin;
    const Rounded numerator = n.dot(w, magnitudes(w)),
                  denominator = n.dot(ray.direction, magnitudes(ray.direction));
    const auto precise = [](const Rounded& r) {
        return r.bound < kPrecision / 4 * std::abs(r.value);
    };
    const double t = numerator.value / denominator.value;
    // Quotients near the smallest double are less precise than their terms.
    return precise(numerator) && precise(denominator) && std::abs(t) > 1e-300
               ? t
               : rounded(exact_crossing(ray, triangle));
}

/// The parameter, on the edge from q to r, of the point nearest to p.
double fraction_along(const Vec3& p, const Vec3& q, const Vec3& r) {
    const double s = dot(p - q, r - q) / length_sq(r - q);
    return s > 0 ? std::min(s, 1.0) : 0; // also if the edge's squared length is out of range
}

/// For each vertex, on which side of the opposite edge the ray passes.
std::array<int, 3> edge_sides(const Ray& ray, const Triangle& t) {
    const Vec3 &o = ray.origin, &d = ray.direction;
    return {turn_around_line(o, d, t[1], t[2]), turn_around_line(o, d, t[2], t[0]),
            turn_around_line(o, d, t[0], t[1])};
}

} // namespace

std::optional<RayTriangleHit> ray_triangle_intersect(const Ray& ray, const Triangle& t) {
    const std::array<int, 3> sides = edge_sides(ray, t);
    const auto [least, greatest] = std::minmax({sides[0], sides[1], sides[2]});
    if (least < 0 && greatest > 0)
        return std::nullopt;
    // The three determinants sum to n . d.
    const int facing = least + greatest; // +-1, or +-2 as the sum of two signs
    if (facing == 0)
        return hit_along(ray, t);
    const Normal n(t);
    const bool begins_before =
        ray.t_min == -std::numeric_limits<double>::infinity() ||
        (std::isfinite(ray.t_min) && compare_crossing(ray, t, n, facing, ray.t_min) >= 0);
    const bool ends_after =
        ray.t_max == std::numeric_limits<double>::infinity() ||
        (std::isfinite(ray.t_max) && compare_crossing(ray, t, n, facing, ray.t_max) <= 0);
    if (!begins_before || !ends_after)
        return std::nullopt;
    return RayTriangleHit{std::clamp(crossing(ray, t, n), ray.t_min, ray.t_max),
                          facing > 0 ? -1 : 1};
}

std::array<double, 3> hit_weights(const Ray& ray, const Triangle& t, const RayTriangleHit& hit) {
    const Vec3 p = ray.origin + hit.t * ray.direction;
    if (hit.side != 0) {
        const std::array<int, 3> sides = edge_sides(ray, t);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
            if (sides[i] != 0)
                continue;
            std::array<double, 3> weights{};
            weights[k] = sides[j] == 0   ? 1 // on two edges: at their common vertex
                         : sides[k] == 0 ? 0
                                         : fraction_along(p, t[j], t[k]);
            weights[j] = 1 - weights[k];
            return weights;
        }
    }
    return nearest_on_triangle(p, t).weights;
}

int compare_hits(const Ray& ray, const Triangle& a, const RayTriangleHit& hit_a, const Triangle& b,
                 const RayTriangleHit& hit_b) {
    const double difference = hit_a.t - hit_b.t;
    if (std::abs(difference) > 2 * kPrecision * (std::abs(hit_a.t) + std::abs(hit_b.t)))
        return difference > 0 ? 1 : -1;
    const auto exact = [&](const Triangle& t, const RayTriangleHit& hit) {
        return hit.side == 0 ? *exact_entry(ray, t) : exact_crossing(ray, t);
    };
    return compare(exact(a, hit_a), exact(b, hit_b));
}

} // namespace abut
