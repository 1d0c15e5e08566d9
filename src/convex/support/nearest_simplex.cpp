#include "convex/support/nearest_simplex.h"

#include <array>
#include <cmath>
#include <limits>

namespace abut {

namespace {

/// The nearest point of a hull to the origin: which corners span it, and their weights.
struct NearestPart {
    std::array<std::uint32_t, 3> corner{};
    std::array<double, 3> weight{};
    std::uint32_t count = 0;
    double distance_sq = std::numeric_limits<double>::infinity();
};

class SimplexSearch {
public:
    explicit SimplexSearch(const SupportSimplex& simplex) : simplex_(simplex) {}

    static bool reduce(SupportSimplex& simplex) {
        SimplexSearch search(simplex);
        switch (simplex.count) {
        case 1:
            search.try_corner(0);
            break;
        case 2:
            search.try_segment(0, 1);
            break;
        case 3:
            search.try_triangle(0, 1, 2);
            break;
        default:
            if (search.tetrahedron_holds_origin()) {
                weigh_by_volumes(simplex);
                return false;
            }
        }
        SupportSimplex kept;
        kept.count = search.best_.count;
        for (std::uint32_t i = 0; i < kept.count; ++i) {
            kept.corners[i] = simplex.corners[search.best_.corner[i]];
            kept.weights[i] = search.best_.weight[i];
        }
        simplex = kept;
        return true;
    }

private:
    /// The weights with which the corners of a tetrahedron have the origin as their mean.
    static void weigh_by_volumes(SupportSimplex& simplex) {
        const auto at = [&](std::size_t i) { return simplex.corners[i].at; };
        const auto volume = [](const Vec3& p, const Vec3& q, const Vec3& r) {
            return std::abs(dot(p, cross(q, r)));
        };
        simplex.weights = {volume(at(1), at(2), at(3)), volume(at(0), at(2), at(3)),
                           volume(at(0), at(1), at(3)), volume(at(0), at(1), at(2))};
        double sum = 0;
        for (const double weight : simplex.weights)
            sum += weight;
        for (double& weight : simplex.weights)
            weight = sum > 0 ? weight / sum : 0.25;
    }
    [[nodiscard]] const Vec3& at(std::uint32_t i) const { return simplex_.corners[i].at; }

    void offer(const NearestPart& part) {
        if (part.distance_sq < best_.distance_sq)
            best_ = part;
    }
    void try_corner(std::uint32_t i) { offer({{i}, {1}, 1, length_sq(at(i))}); }
    void try_segment(std::uint32_t i, std::uint32_t j) {
        const Vec3 way = at(j) - at(i);
        const double along = -dot(at(i), way), all = length_sq(way);
        if (!(along > 0))
            return try_corner(i);
        if (!(along < all))
            return try_corner(j);
        const double s = along / all;
        offer({{i, j}, {1 - s, s}, 2, length_sq(at(i) + s * way)});
    }
    /// The inside of a triangle minimises |p + s u + t v|^2, whose gradient is zero there. The edges u
    /// and v are the shorter two, between which the angle is largest, so that little cancels.
    void try_triangle(std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        const double ij = length_sq(at(j) - at(i)), jk = length_sq(at(k) - at(j)),
                     ki = length_sq(at(i) - at(k));
        if (ij >= jk && ij >= ki)
            return try_inside(k, i, j);
        if (ki >= jk)
            return try_inside(j, k, i);
        try_inside(i, j, k);
    }
    void try_inside(std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        const Vec3 &p = at(i), u = at(j) - p, v = at(k) - p;
        const double uu = length_sq(u), uv = dot(u, v), vv = length_sq(v);
        const double pu = -dot(p, u), pv = -dot(p, v), area_sq = uu * vv - uv * uv;
        const double s = vv * pu - uv * pv, t = uu * pv - uv * pu;
        if (area_sq > 0 && s > 0 && t > 0 && s + t < area_sq) {
            const double x = s / area_sq, y = t / area_sq;
            offer({{i, j, k}, {1 - x - y, x, y}, 3, length_sq(p + x * u + y * v)});
            return;
        }
        try_segment(i, j), try_segment(j, k), try_segment(k, i);
    }
    /// Tries the faces that have the origin on their outer side. Of a flat tetrahedron, all.
    bool tetrahedron_holds_origin() {
        bool holds = true;
        for (const std::array<std::uint32_t, 4>& face :
             {std::array{0U, 1U, 2U, 3U}, {0U, 1U, 3U, 2U}, {0U, 2U, 3U, 1U}, {1U, 2U, 3U, 0U}}) {
            const Vec3& p = at(face[0]);
            const Vec3 u = at(face[1]) - p, v = at(face[2]) - p, w = at(face[3]) - p;
            const Vec3 n = cross(u, v);
            const double inner = dot(n, w), origin = -dot(n, p);
            constexpr double kFlat = 0x1p-50;
            const bool flat = std::abs(inner) <= kFlat * length(u) * length(v) * length(w);
            if (!flat && origin * inner >= 0)
                continue;
            holds = false;
            try_triangle(face[0], face[1], face[2]);
        }
        return holds;
    }

    const SupportSimplex& simplex_;
    NearestPart best_;
};

/// As NearestPart, of twice the digits.
struct WidePart {
    std::array<std::uint32_t, 3> corner{};
    std::array<DoubleDouble, 3> weight{};
    std::uint32_t count = 0;
    WideVec3 at;
    DoubleDouble distance_sq = std::numeric_limits<double>::infinity();
};

/// The nearest point by comparison of all faces of the simplex, each solved with 106 bits. A face
/// that holds the point in its inside gives it; the others give farther points or none.
class WideSimplexSearch {
public:
    explicit WideSimplexSearch(const SupportSimplex& simplex) : count_(simplex.count) {
        for (std::uint32_t i = 0; i < count_; ++i)
            corner_[i] = WideVec3(simplex.corners[i].at);
    }

    /// Whether the simplex is a tetrahedron with the origin strictly inside: the four volumes have
    /// one sign, also after their rounding.
    [[nodiscard]] bool holds_origin(std::array<double, 4>& weights) const {
        if (count_ < 4)
            return false;
        double positive = 0;
        for (std::uint32_t i = 0; i < 4; ++i) {
            const std::uint32_t j = (i + 1) % 4, k = (i + 2) % 4, l = (i + 3) % 4;
            const DoubleDouble volume =
                dot(corner_[j], cross(corner_[k], corner_[l])) * DoubleDouble(i % 2 == 0 ? 1 : -1);
            if (!(std::abs(volume.high) > kVolumeRounding * size(j) * size(k) * size(l)))
                return false;
            positive += volume.high > 0 ? 1 : -1;
            weights[i] = std::abs(volume.high);
        }
        if (std::abs(positive) != 4)
            return false;
        const double sum = weights[0] + weights[1] + weights[2] + weights[3];
        for (double& weight : weights)
            weight /= sum;
        return true;
    }

    WidePart nearest() {
        for (std::uint32_t i = 0; i < count_; ++i) {
            offer({{i}, {DoubleDouble(1)}, 1, corner_[i]});
            for (std::uint32_t j = i + 1; j < count_; ++j) {
                try_segment(i, j);
                for (std::uint32_t k = j + 1; k < count_; ++k)
                    try_triangle(i, j, k);
            }
        }
        return best_;
    }

private:
    /// Bound of the error of a product of three coordinates' sums, with a margin of 2^8.
    static constexpr double kVolumeRounding = 0x1p-90;

    [[nodiscard]] double size(std::uint32_t i) const { return length(corner_[i].rounded()); }

    void offer(WidePart part) {
        part.distance_sq = dot(part.at, part.at);
        if (part.distance_sq < best_.distance_sq)
            best_ = part;
    }
    void try_segment(std::uint32_t i, std::uint32_t j) {
        const WideVec3 way = corner_[j] - corner_[i];
        const DoubleDouble all = dot(way, way), along = -dot(corner_[i], way), rest = all - along;
        if (!(along.high > 0 && rest.high > 0))
            return;
        const DoubleDouble s = along / all;
        offer({{i, j}, {rest / all, s}, 2, corner_[i] + s * way});
    }
    /// The foot of the origin in the triangle's plane is (p . n) n / n^2. It is weighted by the areas
    /// that it cuts off, along the normal n.
    void try_triangle(std::uint32_t i, std::uint32_t j, std::uint32_t k) {
        const WideVec3 &p = corner_[i], &q = corner_[j], &r = corner_[k];
        const WideVec3 n = cross(q - p, r - p);
        const DoubleDouble all = dot(n, n);
        if (!(all.high > 0))
            return;
        const DoubleDouble of_p = dot(n, cross(q, r)), of_q = dot(n, cross(r, p)),
                           of_r = dot(n, cross(p, q));
        if (!(of_p.high > 0 && of_q.high > 0 && of_r.high > 0))
            return;
        offer({{i, j, k}, {of_p / all, of_q / all, of_r / all}, 3, (dot(n, p) / all) * n});
    }

    std::array<WideVec3, 4> corner_;
    std::uint32_t count_;
    WidePart best_;
};

} // namespace

std::optional<Vec3> reduce_to_nearest(SupportSimplex& simplex) {
    if (!SimplexSearch::reduce(simplex))
        return std::nullopt;
    return simplex.nearest().at;
}

std::optional<PrecisePoint> reduce_to_nearest_precisely(SupportSimplex& simplex) {
    WideSimplexSearch search(simplex);
    if (search.holds_origin(simplex.weights))
        return std::nullopt;
    const WidePart best = search.nearest();
    SupportSimplex kept;
    kept.count = best.count;
    for (std::uint32_t i = 0; i < kept.count; ++i) {
        kept.corners[i] = simplex.corners[best.corner[i]];
        kept.weights[i] = best.weight[i].high;
    }
    simplex = kept;
    return PrecisePoint{best.at.rounded(), best.distance_sq};
}

} // namespace abut
