#pragma once

#include "math/scaled_integers.h"
#include "math/vector.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

/// Decides by brute force in integers whether the convex hulls of two small point sets meet, and
/// how deep.
///
/// The difference of two hulls is bounded by planes that contain an edge vector of each hull, or
/// two of one. All such planes are tried, whether or not the points are vertices. Only the final
/// depth is rounded.
namespace abut::test {

class DifferenceOracle {
public:
    DifferenceOracle(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
        least_ = std::numeric_limits<int>::max();
        int most = std::numeric_limits<int>::min();
        for (const auto* side : {&a, &b})
            for (const Vec3& p : *side)
                for (const double v : {p.x, p.y, p.z})
                    if (v != 0) {
                        least_ = std::min(least_, decompose(v).exponent);
                        most = std::max(most, std::ilogb(v));
                    }
        if (most - least_ > kMostBits)
            throw std::out_of_range("coordinates too wide for the oracle");
        for (const Vec3& p : a)
            a_.push_back(whole(p));
        for (const Vec3& p : b)
            b_.push_back(whole(p));
        std::vector<Whole> edges_a = edges(a_), edges_b = edges(b_);
        across(edges_a, edges_a);
        across(edges_b, edges_b);
        across(edges_a, edges_b);
    }

    /// Whether the difference has a volume. If not, the other answers are meaningless.
    [[nodiscard]] bool is_solid() const { return spans_ && thick_; }
    [[nodiscard]] bool meet() const { return !separated_; }
    /// Whether they touch without overlapping.
    [[nodiscard]] bool touch() const { return !separated_ && touches_; }
    /// The length of the shortest translation that ends the overlap.
    [[nodiscard]] double depth() const { return depth_; }

private:
    using Int = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
        768, 768, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked, void>>;
    static constexpr int kMostBits = 180; ///< so that a product of four fits in an Int
    struct Whole {
        Int x, y, z;
    };

    [[nodiscard]] Int whole(double v) const {
        const Binary binary = decompose(v);
        if (binary.mantissa == 0)
            return Int(0);
        return Int(binary.mantissa) * (Int(1) << (binary.exponent - least_));
    }
    [[nodiscard]] Whole whole(const Vec3& p) const { return {whole(p.x), whole(p.y), whole(p.z)}; }
    static Int dot(const Whole& a, const Whole& b) {
        return Int(a.x * b.x + a.y * b.y + a.z * b.z);
    }

    static std::vector<Whole> edges(const std::vector<Whole>& points) {
        std::vector<Whole> edges;
        for (std::size_t i = 0; i < points.size(); ++i)
            for (std::size_t j = i + 1; j < points.size(); ++j)
                edges.push_back({Int(points[j].x - points[i].x), Int(points[j].y - points[i].y),
                                 Int(points[j].z - points[i].z)});
        return edges;
    }

    void across(const std::vector<Whole>& us, const std::vector<Whole>& vs) {
        for (const Whole& u : us)
            for (const Whole& v : vs)
                if (&us != &vs || &u < &v)
                    try_plane({Int(u.y * v.z - u.z * v.y), Int(u.z * v.x - u.x * v.z),
                               Int(u.x * v.y - u.y * v.x)});
    }

    void try_plane(const Whole& n) {
        if (n.x == 0 && n.y == 0 && n.z == 0)
            return;
        spans_ = true;
        const auto range = [&](const std::vector<Whole>& points, Int& low, Int& high) {
            low = high = dot(n, points[0]);
            for (const Whole& p : points) {
                const Int h = dot(n, p);
                if (h < low)
                    low = h;
                if (h > high)
                    high = h;
            }
        };
        Int low_a, high_a, low_b, high_b;
        range(a_, low_a, high_a), range(b_, low_b, high_b);
        const Int one = high_b - low_a, other = high_a - low_b;
        separated_ = separated_ || one < 0 || other < 0;
        touches_ = touches_ || one == 0 || other == 0;
        thick_ = thick_ && one + other != 0;
        const Int& less = one < other ? one : other;
        if (less > 0) {
            const long double size = std::sqrt(as_double(dot(n, n)));
            depth_ =
                std::min(depth_, static_cast<double>(std::ldexp(as_double(less) / size, least_)));
        } else {
            depth_ = 0;
        }
    }

    static long double as_double(const Int& v) { return v.convert_to<long double>(); }

    int least_ = 0;
    std::vector<Whole> a_, b_;
    bool separated_ = false, touches_ = false, spans_ = false, thick_ = true;
    double depth_ = std::numeric_limits<double>::infinity();
};

} // namespace abut::test
