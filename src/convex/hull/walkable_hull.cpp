#include "convex/hull/walkable_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace abut {

namespace {

/// A few roundings of a coordinate of size 1.
constexpr double kRounding = 0x1p-46;

/// Finds vertices that lie within rounding of the hull of the others, where the surface is flat, or
/// bends along an edge, by too little for a walk to tell the direction.
class SuperfluousVertices {
public:
    SuperfluousVertices(std::span<const Vec3> points, const HullSurface& hull, double rounding)
        : points_(points), hull_(hull), rounding_(rounding), dropped_(points.size()),
          kept_(points.size()) {}

    /// Marks such vertices, except those that hold another marked one. Empty if there are none.
    std::vector<bool> find() && {
        for (const IndexTriangle& t : hull_.triangles)
            drop_from_segment(t);
        if (!any_ && hull_.dimension == 3)
            drop_from_faces();
        if (!any_)
            dropped_.clear();
        return std::move(dropped_);
    }

private:
    /// Drops a corner that lies on the segment between the other two.
    void drop_from_segment(const IndexTriangle& t) {
        std::size_t k = 0; // the longest side runs from corner k
        const auto side = [&](std::size_t i) { return points_[t[(i + 1) % 3]] - points_[t[i]]; };
        for (std::size_t i = 1; i < 3; ++i)
            if (length_sq(side(i)) > length_sq(side(k)))
                k = i;
        const std::uint32_t middle = t[(k + 2) % 3];
        const double area = length(cross(side(k), points_[middle] - points_[t[k]]));
        if (area <= rounding_ * length(side(k)))
            drop(middle, std::array{t[k], t[(k + 1) % 3]});
    }

    /// Drops vertices that are surrounded by triangles in one plane which face the same way.
    void drop_from_faces() {
        std::vector<std::vector<std::uint32_t>> triangles_at(points_.size());
        for (std::uint32_t i = 0; i < hull_.triangles.size(); ++i)
            for (const std::uint32_t v : hull_.triangles[i])
                triangles_at[v].push_back(i);
        for (std::uint32_t v = 0; v < points_.size(); ++v)
            if (!triangles_at[v].empty() && is_in_face(v, triangles_at[v])) {
                std::vector<std::uint32_t> ring;
                for (const std::uint32_t i : triangles_at[v])
                    for (const std::uint32_t w : hull_.triangles[i])
                        if (w != v)
                            ring.push_back(w);
                drop(v, ring);
            }
    }

    [[nodiscard]] Vec3 area_of(std::uint32_t triangle) const {
        const IndexTriangle& t = hull_.triangles[triangle];
        return cross(points_[t[1]] - points_[t[0]], points_[t[2]] - points_[t[0]]);
    }

    [[nodiscard]] bool is_in_face(std::uint32_t v, std::span<const std::uint32_t> around) const {
        Vec3 largest;
        for (const std::uint32_t i : around)
            if (const Vec3 area = area_of(i); length_sq(area) > length_sq(largest))
                largest = area;
        const Vec3 normal = normalized_or_zero(largest);
        return std::all_of(around.begin(), around.end(), [&](std::uint32_t i) {
            const IndexTriangle& t = hull_.triangles[i];
            return dot(area_of(i), normal) > 0 &&
                   std::all_of(t.begin(), t.end(), [&](std::uint32_t w) {
                       return std::abs(dot(points_[w] - points_[v], normal)) <= rounding_;
                   });
        });
    }

    void drop(std::uint32_t v, std::span<const std::uint32_t> needed) {
        const auto is_gone = [&](std::uint32_t w) { return dropped_[w]; };
        if (kept_[v] || dropped_[v] || std::any_of(needed.begin(), needed.end(), is_gone))
            return;
        any_ = dropped_[v] = true;
        for (const std::uint32_t w : needed)
            kept_[w] = true;
    }

    std::span<const Vec3> points_;
    const HullSurface& hull_;
    double rounding_;
    std::vector<bool> dropped_, kept_;
    bool any_ = false;
};

} // namespace

HullSurface walkable_hull(std::span<const Vec3> all, LeftOutVertices* left_out) {
    double largest = 0;
    for (const Vec3& p : all)
        largest = std::max(largest, max_abs(p));
    std::vector<std::uint32_t> numbers(all.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    std::vector<Vec3> points(all.begin(), all.end());
    HullSurface hull;
    std::vector<std::uint32_t> all_vertices;
    for (int round = 0;; ++round) {
        hull = exact_hull(points);
        if (left_out != nullptr && round == 0)
            all_vertices = hull.vertices;
        // In each round, vertices that stay hold what is dropped. Doubled for the rounding of the
        // test itself.
        if (left_out != nullptr)
            left_out->outside = 2 * round * kRounding * largest;
        const std::vector<bool> dropped =
            SuperfluousVertices(points, hull, kRounding * largest).find();
        if (dropped.empty())
            break;
        std::size_t n = 0;
        for (std::size_t i = 0; i < numbers.size(); ++i)
            if (!dropped[i]) {
                points[n] = points[i];
                numbers[n++] = numbers[i];
            }
        numbers.resize(n);
        points.resize(n);
    }
    for (std::uint32_t& v : hull.vertices)
        v = numbers[v];
    for (IndexTriangle& t : hull.triangles)
        for (std::uint32_t& v : t)
            v = numbers[v];
    if (left_out != nullptr) {
        std::vector<bool> stays(all.size());
        for (const std::uint32_t v : hull.vertices)
            stays[v] = true;
        for (const std::uint32_t v : all_vertices)
            if (!stays[v])
                left_out->vertices.push_back(v);
    }
    return hull;
}

} // namespace abut
