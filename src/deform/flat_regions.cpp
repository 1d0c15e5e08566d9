#include "deform/flat_regions.h"

#include "core/parallel.h"
#include "math/vector.h"
#include "mesh/disc_boundary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace abut {

namespace {

/// Nodes with more leaves than this are not examined: they have long borders and are rarely flat.
constexpr std::uint32_t kMostLeaves = 64;

/// A value below this fraction of its terms' size counts as zero. Rounding is a millionth of that.
constexpr double kLeastPart = 0x1p-32;

/// A projection: the plane's two directions, and the direction towards the viewer.
struct View {
    Vec3 u, v, towards;
};

/// The direction from which the most triangle area faces the viewer, over the whole step.
View best_view(std::span<const std::uint32_t> faces, std::span<const IndexTriangle> triangles,
               std::span<const MovingVertex> vertices) {
    Vec3 sum;
    for (const std::uint32_t face : faces) {
        const auto& [i, j, k] = triangles[face];
        const MovingVertex &a = vertices[i], &b = vertices[j], &c = vertices[k];
        sum =
            sum + cross(b.start - a.start, c.start - a.start) + cross(b.end - a.end, c.end - a.end);
    }
    const Vec3 n = normalized_or_zero(sum);
    const Vec3 axis = std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 u = normalized_or_zero(cross(axis, n)), v = cross(n, u);
    return {u, v, cross(u, v)};
}

/// Whether all triangles face the viewer throughout the step. The normal, (b - a) x (c - a), is
/// quadratic in time; its Bernstein coefficients are tested.
bool shows_all(const View& view, std::span<const std::uint32_t> faces,
               std::span<const IndexTriangle> triangles, std::span<const MovingVertex> vertices) {
    return std::all_of(faces.begin(), faces.end(), [&](std::uint32_t face) {
        const auto& [i, j, k] = triangles[face];
        const MovingVertex &a = vertices[i], &b = vertices[j], &c = vertices[k];
        const Vec3 p0 = b.start - a.start, p1 = b.end - a.end, q0 = c.start - a.start,
                   q1 = c.end - a.end;
        const double least = kLeastPart * (length(p0) + length(p1)) * (length(q0) + length(q1));
        return dot(cross(p0, q0), view.towards) > least &&
               dot(cross(p1, q1), view.towards) > least &&
               dot(cross(p0, q1) + cross(p1, q0), view.towards) > least;
    });
}

struct Vec2 {
    double x = 0, y = 0;
};
double cross(const Vec2& a, const Vec2& b) {
    return a.x * b.y - a.y * b.x;
}
double dot(const Vec2& a, const Vec2& b) {
    return a.x * b.x + a.y * b.y;
}
Vec2 operator-(const Vec2& a, const Vec2& b) {
    return {a.x - b.x, a.y - b.y};
}

/// A border as projected by a view.
class Border {
public:
    Border(const View& view, std::span<const std::uint32_t> loop,
           std::span<const MovingVertex> vertices)
        : points_(loop.size()) {
        double size = 0;
        for (std::size_t i = 0; i < loop.size(); ++i)
            for (std::size_t end = 0; end < 2; ++end) {
                const MovingVertex& vertex = vertices[loop[i]];
                const Vec3& p = end == 0 ? vertex.start : vertex.end;
                points_[i][end] = {dot(p, view.u), dot(p, view.v)};
                size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
            }
        least_gap_ = kLeastPart * size;
    }

    /// Whether the border does not touch itself at any time.
    [[nodiscard]] bool is_simple() const {
        const std::size_t n = points_.size();
        for (std::size_t i = 0; i < n; ++i) {
            if (folds_at((i + 1) % n))
                return false;
            for (std::size_t k = i + 2; k < n; ++k)
                if (!(i == 0 && k + 1 == n) && !are_apart(i, k))
                    return false;
        }
        return true;
    }

private:
    using Moving = std::array<Vec2, 2>; ///< position at the start and at the end

    [[nodiscard]] const Moving& point(std::size_t i) const { return points_[i % points_.size()]; }

    /// Whether the sides before and after a point may lie on each other at some time: there their
    /// cross product is zero and their dot product positive. Both are quadratic in time.
    [[nodiscard]] bool folds_at(std::size_t i) const {
        const Moving &here = point(i), &before = point(i + points_.size() - 1),
                     &after = point(i + 1);
        const Vec2 p0 = before[0] - here[0], p1 = before[1] - here[1], q0 = after[0] - here[0],
                   q1 = after[1] - here[1];
        const auto size = [](const Vec2& a) { return std::abs(a.x) + std::abs(a.y); };
        const double least = kLeastPart * (size(p0) + size(p1)) * (size(q0) + size(q1)) +
                             least_gap_ * (size(p0) + size(p1) + size(q0) + size(q1));
        const double c0 = cross(p0, q0), c1 = cross(p0, q1) + cross(p1, q0), c2 = cross(p1, q1);
        if (std::min({c0, c1, c2}) > least || std::max({c0, c1, c2}) < -least)
            return false;
        return !(std::max({dot(p0, q0), dot(p0, q1) + dot(p1, q0), dot(p1, q1)}) < -least);
    }

    /// Whether a line separates two sides, in the same order, at both ends of the step. It then
    /// does so throughout the step, because the motion is linear.
    [[nodiscard]] bool are_apart(std::size_t i, std::size_t k) const {
        const auto parts = [&](const Vec2& n) {
            bool below = true, above = true;
            const double least = least_gap_ * (std::abs(n.x) + std::abs(n.y));
            for (std::size_t end = 0; end < 2; ++end) {
                const double a = dot(n, point(i)[end]), b = dot(n, point(i + 1)[end]),
                             c = dot(n, point(k)[end]), d = dot(n, point(k + 1)[end]);
                below = below && std::max(a, b) < std::min(c, d) - least;
                above = above && std::max(c, d) < std::min(a, b) - least;
            }
            return below || above;
        };
        const auto across = [&](std::size_t side) {
            const Vec2 p = point(side + 1)[0] - point(side)[0],
                       q = point(side + 1)[1] - point(side)[1];
            return Vec2{-p.y - q.y, p.x + q.x};
        };
        return parts({1, 0}) || parts({0, 1}) || parts({1, 1}) || parts({1, -1}) ||
               parts(across(i)) || parts(across(k));
    }

    std::vector<Moving> points_;
    double least_gap_ = 0;
};

} // namespace

FlatRegions::FlatRegions(const MovingTree& tree, const FeatureRuns& faces,
                         const SurfaceView& surface)
    : flat_(tree.nodes.size()) {
    // The range of leaves below each node. A node comes after its parent, and leaves are numbered
    // in the order of the nodes.
    struct Leaves {
        std::uint32_t first = ~0U, last = 0;
    };
    std::vector<Leaves> below(tree.nodes.size());
    for (std::size_t i = tree.nodes.size(); i-- > 0;)
        for (const NodeRef child : tree.nodes[i].child) {
            if (child.is_none())
                continue;
            const Leaves leaves = child.is_leaf()
                                      ? Leaves{leaf_number(child), leaf_number(child) + 1}
                                      : below[child.index()];
            below[i].first = std::min(below[i].first, leaves.first);
            below[i].last = std::max(below[i].last, leaves.last);
        }
    std::vector<std::vector<std::uint32_t>> borders(tree.nodes.size());
    parallel_for(tree.nodes.size(), 64, [&](std::size_t i) {
        if (below[i].last - below[i].first <= kMostLeaves)
            borders[i] = disc_boundary(surface, faces.ids(below[i].first, below[i].last));
    });
    for (std::uint32_t i = 0; i < borders.size(); ++i) {
        if (borders[i].empty())
            continue;
        if (outer_.empty() || below[i].first >= regions_[outer_.back()].last_leaf)
            outer_.push_back(static_cast<std::uint32_t>(regions_.size()));
        const auto first = static_cast<std::uint32_t>(border_.size());
        border_.insert(border_.end(), borders[i].begin(), borders[i].end());
        regions_.push_back(
            {i, below[i].first, below[i].last, first, static_cast<std::uint32_t>(border_.size())});
    }
}

void FlatRegions::fit(const FeatureRuns& faces, std::span<const IndexTriangle> triangles,
                      std::span<const MovingVertex> vertices) {
    const auto is_flat = [&](const Region& region) {
        const auto ids = faces.ids(region.first_leaf, region.last_leaf);
        const View view = best_view(ids, triangles, vertices);
        const auto loop = std::span(border_).subspan(region.first_border,
                                                     region.last_border - region.first_border);
        return shows_all(view, ids, triangles, vertices) &&
               Border(view, loop, vertices).is_simple();
    };
    parallel_for(outer_.size(), 8, [&](std::size_t k) {
        const std::size_t end = k + 1 < outer_.size() ? outer_[k + 1] : regions_.size();
        std::uint32_t flat_until = 0; // regions within a flat one are skipped
        for (std::size_t i = outer_[k]; i < end; ++i) {
            const Region& region = regions_[i];
            const bool flat = region.first_leaf >= flat_until && is_flat(region);
            flat_[region.node] = flat ? 1 : 0;
            if (flat)
                flat_until = region.last_leaf;
        }
    });
}

std::size_t FlatRegions::bytes() const {
    return regions_.size() * sizeof(Region) + border_.size() * sizeof(border_[0]) + flat_.size();
}

} // namespace abut
