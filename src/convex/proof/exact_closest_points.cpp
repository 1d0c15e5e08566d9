#include "convex/proof/exact_closest_points.h"

#include <bit>

namespace abut {

namespace {

template <class Int>
class ExactSimplexSearch {
public:
    using Vector = IntVec3<Int>;

    ExactSimplexSearch(const PlacedPoints& points, const IntegerGrid& grid)
        : points_(points), difference_(points, grid) {}

    ExactClosestPoints run(const DifferenceSimplex& start) {
        for (std::uint32_t i = 0; i < start.count; ++i)
            add(start.corners[i]);
        ExactClosestPoints result;
        for (;;) {
            ++result.steps;
            reduce();
            if (is_zero(gap_))
                break;
            const VertexPair next = difference_.farthest(-gap_);
            if (dot(gap_, difference_.at(next) - at_[0]) >= 0)
                break;
            add(next);
        }
        finish(result);
        return result;
    }

private:
    void add(const VertexPair& corner) {
        corners_[count_] = corner;
        at_[count_++] = difference_.at(corner);
    }

    /// Keeps the corners whose hull has the point nearest to the origin in its inside. They are
    /// recognised by positive weights and by no other corner being nearer along the gap; only other
    /// sets for the same point share these properties.
    void reduce() {
        const std::uint32_t all = (1U << count_) - 1;
        for (int size = static_cast<int>(count_); size >= 1; --size)
            for (std::uint32_t subset = 1; subset <= all; ++subset)
                if (std::popcount(subset) == size && is_nearest(subset)) {
                    keep(subset);
                    return;
                }
    }

    void keep(std::uint32_t subset) {
        std::uint32_t kept = 0;
        for (std::uint32_t i = 0; i < count_; ++i)
            if (subset >> i & 1U) {
                corners_[kept] = corners_[i];
                at_[kept++] = at_[i];
            }
        count_ = kept;
    }

    /// Returns whether the subset holds the nearest point. Sets the gap and the weights, in the
    /// subset's order.
    bool is_nearest(std::uint32_t subset) {
        std::array<const Vector*, 4> p{};
        std::size_t n = 0;
        for (std::uint32_t i = 0; i < count_; ++i)
            if (subset >> i & 1U)
                p[n++] = &at_[i];
        switch (n) {
        case 1:
            weights_[0] = 1, gap_ = *p[0];
            break;
        case 2:
            if (!measure_segment(*p[0], *p[1]))
                return false;
            break;
        case 3:
            if (!measure_triangle(*p[0], *p[1], *p[2]))
                return false;
            break;
        default:
            return measure_tetrahedron(*p[0], *p[1], *p[2], *p[3]);
        }
        for (std::uint32_t i = 0; i < count_; ++i)
            if ((subset >> i & 1U) == 0 && dot(gap_, at_[i] - *p[0]) < 0)
                return false;
        return true;
    }

    bool measure_segment(const Vector& p, const Vector& q) {
        const Vector e = q - p;
        weights_[0] = dot(q, e), weights_[1] = Int(-dot(p, e));
        if (!(weights_[0] > 0 && weights_[1] > 0))
            return false;
        const Vector from_p = scaled(weights_[0], p), from_q = scaled(weights_[1], q);
        gap_ = {Int(from_p.x + from_q.x), Int(from_p.y + from_q.y), Int(from_p.z + from_q.z)};
        return true;
    }

    bool measure_triangle(const Vector& p, const Vector& q, const Vector& r) {
        const Vector n = cross(q - p, r - p);
        if (is_zero(n))
            return false;
        weights_[0] = dot(cross(q, r), n), weights_[1] = dot(cross(r, p), n);
        weights_[2] = dot(cross(p, q), n);
        if (!(weights_[0] > 0 && weights_[1] > 0 && weights_[2] > 0))
            return false;
        const int side = sign_of(dot(n, p));
        gap_ = side > 0 ? n : side < 0 ? -n : Vector{};
        return true;
    }

    bool measure_tetrahedron(const Vector& p, const Vector& q, const Vector& r, const Vector& s) {
        const Vector pq = cross(p, q), rs = cross(r, s);
        weights_[0] = dot(q, rs), weights_[1] = Int(-dot(p, rs));
        weights_[2] = dot(s, pq), weights_[3] = Int(-dot(r, pq));
        const int side = sign_of(weights_[0]);
        for (Int& w : weights_) {
            if (sign_of(w) == 0 || sign_of(w) != side)
                return false;
            w = side < 0 ? Int(-w) : w;
        }
        gap_ = {};
        return true;
    }

    void finish(ExactClosestPoints& result) const {
        result.meeting = is_zero(gap_);
        result.simplex.count = count_;
        std::array<ScaledDouble, 4> weights{};
        int most = std::numeric_limits<int>::min();
        for (std::uint32_t i = 0; i < count_; ++i) {
            weights[i] = scaled_double(weights_[i]);
            most = std::max(most, weights[i].exponent);
        }
        double sum = 0;
        for (std::uint32_t i = 0; i < count_; ++i) {
            result.simplex.corners[i] = corners_[i];
            result.simplex.weights[i] =
                std::ldexp(weights[i].mantissa, std::max(weights[i].exponent - most, -1000));
            sum += result.simplex.weights[i];
        }
        const Vec3& first = points_.a[corners_[0].a];
        for (std::uint32_t i = 0; i < count_; ++i) {
            result.simplex.weights[i] /= sum;
            result.point_a =
                result.point_a + result.simplex.weights[i] * (points_.a[corners_[i].a] - first);
        }
        result.point_a = first + result.point_a;
        if (result.meeting)
            return;
        result.distance = measure();
        // A distance below the range of doubles must not become 0.
        if (!(result.distance > 0))
            result.distance = std::numeric_limits<double>::denorm_min();
        result.at_least = std::max(0.0, result.distance * (1 - 0x1p-48) -
                                            std::numeric_limits<double>::denorm_min());
        result.gap = result.distance * normalized_or_zero(direction_of(gap_));
    }

    /// The length of the gap, to 2^-49 of itself.
    [[nodiscard]] double measure() const {
        const int unit = difference_.exponent();
        const auto ratio = [&](const Int& squared, const Int& by_squared) {
            const ScaledDouble a = scaled_double(squared), b = scaled_double(by_squared);
            int exponent = a.exponent - b.exponent;
            const double odd = exponent % 2 != 0 ? 2 : 1;
            exponent -= exponent % 2 == 0 ? 0 : 1;
            return std::ldexp(std::sqrt(odd * a.mantissa / b.mantissa), exponent / 2 + unit);
        };
        const Vector& p = at_[0];
        if (count_ == 1)
            return ratio(dot(p, p), Int(1));
        if (count_ == 2) {
            const Vector e = at_[1] - p, across = cross(p, e);
            return ratio(dot(across, across), dot(e, e));
        }
        const Vector n = cross(at_[1] - p, at_[2] - p);
        const ScaledDouble height = scaled_double(dot(n, p)), nn = scaled_double(dot(n, n));
        const double odd = nn.exponent % 2 != 0 ? 2 : 1;
        const int exponent = nn.exponent - (nn.exponent % 2 == 0 ? 0 : 1);
        return std::ldexp(std::abs(height.mantissa) / std::sqrt(odd * nn.mantissa),
                          height.exponent - exponent / 2 + unit);
    }

    const PlacedPoints& points_;
    IntegerDifference<Int> difference_;
    std::array<VertexPair, 4> corners_{};
    std::array<Vector, 4> at_{};
    std::uint32_t count_ = 0;
    std::array<Int, 4> weights_{}; ///< of the nearest point, not normalised
    Vector gap_;                   ///< from the origin to that point, times some positive factor
};

} // namespace

ExactClosestPoints exact_closest_points(const PlacedPoints& points, const IntegerGrid& grid,
                                        const DifferenceSimplex& start) {
    return with_integers(
        grid, [&]<class Int>() { return ExactSimplexSearch<Int>(points, grid).run(start); });
}

} // namespace abut
