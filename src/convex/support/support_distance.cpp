#include "convex/support/support_distance.h"

#include <algorithm>
#include <cmath>

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

    /// Keeps only the corners that span the point nearest to the origin. Returns false if the
    /// simplex is a tetrahedron that holds the origin; it keeps its corners then.
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

bool has_corner(const SupportSimplex& simplex, const Vec3& at) {
    return std::any_of(simplex.corners.begin(), simplex.corners.begin() + simplex.count,
                       [&](const DifferencePoint& corner) { return corner.at == at; });
}

} // namespace

SupportDistance support_distance(const SupportPair& pair, const SupportSearch& search) {
    constexpr int kMostSteps = 256;
    SupportDistance result;
    const Vec3 first = search.first != Vec3{} ? search.first : pair.offset();
    SupportSimplex& simplex = result.simplex;
    simplex.corners[0] = pair.farthest(-first), simplex.weights[0] = 1, simplex.count = 1;
    result.direction = simplex.corners[0].at;
    result.distance = length(result.direction);
    for (int step = 0; step < kMostSteps; ++step) {
        if (result.distance <= pair.rounding()) {
            result.meet = true, result.at_least = 0;
            return result;
        }
        if (result.distance <= search.near)
            return result;
        const DifferencePoint next = pair.farthest(-result.direction);
        const double low = dot(next.at, result.direction) / result.distance;
        result.at_least = std::max(result.at_least, low);
        if (result.at_least > search.apart ||
            result.distance - result.at_least <= pair.rounding() || has_corner(simplex, next.at))
            return result;
        SupportSimplex larger = simplex;
        larger.corners[larger.count++] = next;
        if (!SimplexSearch::reduce(larger)) {
            simplex = larger;
            result.meet = true, result.distance = result.at_least = 0;
            return result;
        }
        const Vec3 direction = larger.nearest().at;
        const double distance = length(direction);
        if (!(distance < result.distance)) // rounding hides further progress
            return result;
        simplex = larger, result.direction = direction, result.distance = distance;
    }
    return result;
}

} // namespace abut
