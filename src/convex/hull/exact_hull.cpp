#include "convex/hull/exact_hull.h"

#include "convex/hull/coplanar_faces.h"
#include "math/predicates.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace abut {

namespace {

constexpr std::uint32_t kNone = 0xffffffffU;

/// Four points that span a volume. Fewer, if all points lie in a plane, on a line or at one place.
std::vector<std::uint32_t> spanning_points(std::span<const Vec3> points) {
    const auto n = static_cast<std::uint32_t>(points.size());
    // The point that is farthest by a floating-point measure, if the exact test accepts it;
    // otherwise the first point that the test accepts.
    const auto pick = [&](const auto& measure, const auto& test) {
        std::uint32_t best = 0;
        double most = -1;
        for (std::uint32_t i = 0; i < n; ++i)
            if (const double m = measure(points[i]); m > most)
                most = m, best = i;
        if (test(points[best]))
            return best;
        for (std::uint32_t i = 0; i < n; ++i)
            if (test(points[i]))
                return i;
        return kNone;
    };
    std::uint32_t first = 0;
    for (std::uint32_t i = 1; i < n; ++i)
        if (points[i].x < points[first].x)
            first = i;
    const Vec3& a = points[first];
    const std::uint32_t second = pick([&](const Vec3& p) { return length_sq(p - a); },
                                      [&](const Vec3& p) { return p != a; });
    if (second == kNone)
        return {first};
    const Vec3& b = points[second];
    const Vec3 along = normalized_or_zero(b - a);
    const std::uint32_t third = pick([&](const Vec3& p) { return length_sq(cross(along, p - a)); },
                                     [&](const Vec3& p) { return !collinear(a, b, p); });
    if (third == kNone)
        return {first, second};
    const Vec3& c = points[third];
    const Vec3 normal = normalized_or_zero(cross(b - a, c - a));
    const std::uint32_t fourth = pick([&](const Vec3& p) { return std::abs(dot(normal, p - a)); },
                                      [&](const Vec3& p) { return orient3d(a, b, c, p) != 0; });
    if (fourth == kNone)
        return {first, second, third};
    if (orient3d(a, b, c, points[fourth]) > 0)
        return {first, third, second, fourth};
    return {first, second, third, fourth};
}

/// Grows a tetrahedron by one point at a time. The faces that see the point are replaced by a cone
/// from their border.
class QuickHull {
public:
    /// In          four points; the last lies on the inner side of the plane of the first three.
    QuickHull(std::span<const Vec3> points, const std::vector<std::uint32_t>& start)
        : points_(points), cone_from_(points.size(), kNone) {
        const std::uint32_t a = start[0], b = start[1], c = start[2], d = start[3];
        faces_ = {{{a, b, c}, {3, 2, 1}, {}, true},
                  {{a, c, d}, {0, 2, 3}, {}, true},
                  {{c, b, d}, {0, 3, 1}, {}, true},
                  {{b, a, d}, {0, 1, 2}, {}, true}};
        std::vector<std::uint32_t> all(points.size());
        std::iota(all.begin(), all.end(), 0);
        assign(all, 0);
        for (std::uint32_t f = 0; f < 4; ++f)
            pending_.push_back(f);
    }

    std::vector<IndexTriangle> run() && {
        while (!pending_.empty()) {
            const std::uint32_t face = pending_.back();
            pending_.pop_back();
            if (faces_[face].alive && !faces_[face].outside.empty())
                add_point(farthest(faces_[face]), face);
        }
        std::vector<IndexTriangle> triangles;
        for (const Face& f : faces_)
            if (f.alive)
                triangles.push_back(f.corners);
        return triangles;
    }

private:
    struct Face {
        IndexTriangle corners;
        IndexTriangle across;               ///< across[k]: the face beyond the edge from corner k
        std::vector<std::uint32_t> outside; ///< points that this face sees and no earlier face does
        bool alive;
    };
    /// An edge between a face that stays (`beyond`) and one that goes, directed as in the latter.
    struct HorizonEdge {
        std::uint32_t from, to, beyond;
    };

    [[nodiscard]] bool sees(const Face& f, std::uint32_t p) const {
        return orient3d(points_[f.corners[0]], points_[f.corners[1]], points_[f.corners[2]],
                        points_[p]) > 0;
    }

    [[nodiscard]] std::uint32_t farthest(const Face& f) const {
        const Vec3& a = points_[f.corners[0]];
        const Vec3 normal = cross(points_[f.corners[1]] - a, points_[f.corners[2]] - a);
        return *std::max_element(
            f.outside.begin(), f.outside.end(), [&](std::uint32_t p, std::uint32_t q) {
                return dot(normal, points_[p] - a) < dot(normal, points_[q] - a);
            });
    }

    /// Gives each point to the first face, from `first_face` on, that sees it.
    void assign(std::span<const std::uint32_t> points, std::size_t first_face) {
        for (const std::uint32_t p : points)
            for (std::size_t f = first_face; f < faces_.size(); ++f)
                if (sees(faces_[f], p)) {
                    faces_[f].outside.push_back(p);
                    break;
                }
    }

    /// Removes the faces that see the point; the points that they saw become orphans.
    void remove_visible(std::uint32_t point, std::uint32_t seen_by) {
        horizon_.clear();
        orphans_.clear();
        std::vector<std::uint32_t> visible{seen_by};
        faces_[seen_by].alive = false;
        for (std::size_t i = 0; i < visible.size(); ++i) {
            Face& face = faces_[visible[i]];
            orphans_.insert(orphans_.end(), face.outside.begin(), face.outside.end());
            face.outside = {};
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t beyond = face.across[k];
                if (!faces_[beyond].alive)
                    continue;
                if (sees(faces_[beyond], point)) {
                    faces_[beyond].alive = false;
                    visible.push_back(beyond);
                }
            }
        }
        for (const std::uint32_t f : visible)
            for (std::size_t k = 0; k < 3; ++k)
                if (faces_[faces_[f].across[k]].alive)
                    horizon_.push_back({faces_[f].corners[k], faces_[f].corners[(k + 1) % 3],
                                        faces_[f].across[k]});
    }

    void add_point(std::uint32_t point, std::uint32_t seen_by) {
        remove_visible(point, seen_by);
        const auto first = static_cast<std::uint32_t>(faces_.size());
        for (const HorizonEdge& edge : horizon_) {
            const auto face = static_cast<std::uint32_t>(faces_.size());
            cone_from_[edge.from] = face;
            faces_.push_back({{edge.from, edge.to, point}, {edge.beyond, kNone, kNone}, {}, true});
            Face& beyond = faces_[edge.beyond];
            for (std::size_t k = 0; k < 3; ++k)
                if (beyond.corners[k] == edge.to && beyond.corners[(k + 1) % 3] == edge.from)
                    beyond.across[k] = face;
        }
        for (std::uint32_t f = first; f < faces_.size(); ++f) {
            const std::uint32_t next = cone_from_[faces_[f].corners[1]];
            faces_[f].across[1] = next;
            faces_[next].across[2] = f;
        }
        assign(orphans_, first);
        for (std::uint32_t f = first; f < faces_.size(); ++f)
            pending_.push_back(f);
    }

    std::span<const Vec3> points_;
    std::vector<Face> faces_;
    std::vector<std::uint32_t> pending_, cone_from_, orphans_;
    std::vector<HorizonEdge> horizon_;
};

/// Corners of the hull of points in a plane, counter-clockwise as seen from the positive end of
/// `axis`.
///
/// Source      monotone chain [Andrew 1979].
std::vector<std::uint32_t> polygon_hull(std::span<const Vec3> points, int axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](std::uint32_t i) {
        return std::pair(component(points[i], u), component(points[i], v));
    };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t i, std::uint32_t j) { return key(i) < key(j); });
    std::vector<std::uint32_t> hull;
    const auto add_chain = [&](const auto& chain) {
        const std::size_t base = hull.size();
        for (const std::uint32_t i : chain) {
            while (hull.size() >= base + 2 && orient2d(points[hull[hull.size() - 2]],
                                                       points[hull.back()], points[i], axis) <= 0)
                hull.pop_back();
            hull.push_back(i);
        }
        hull.pop_back(); // the first point of the other chain
    };
    add_chain(order);
    std::reverse(order.begin(), order.end());
    add_chain(order);
    return hull;
}

/// A fan over the top from the first corner, and one over the bottom from the second, so that no
/// two triangles share both ends of a diagonal.
std::vector<IndexTriangle> cover_both_sides(const std::vector<std::uint32_t>& polygon) {
    const std::size_t n = polygon.size();
    std::vector<IndexTriangle> triangles;
    for (std::size_t i = 1; i + 1 < n; ++i)
        triangles.push_back({polygon[0], polygon[i], polygon[i + 1]});
    for (std::size_t i = 2; i < n; ++i)
        triangles.push_back({polygon[1], polygon[(i + 1) % n], polygon[i]});
    return triangles;
}

HullSurface planar_hull(std::span<const Vec3> points, const std::vector<std::uint32_t>& span) {
    // An axis along which the spanning triangle projects to a positive area.
    const auto area_along = [&](int axis) {
        return orient2d(points[span[0]], points[span[1]], points[span[2]], axis);
    };
    int axis = 0;
    while (area_along(axis) == 0)
        ++axis;
    HullSurface hull{2, polygon_hull(points, axis), {}};
    hull.triangles = cover_both_sides(hull.vertices);
    return hull;
}

/// The vertices where at least three planes meet.
std::vector<std::uint32_t> extreme_vertices(std::span<const Vec3> points,
                                            std::span<const IndexTriangle> triangles) {
    const std::vector<std::uint32_t> plane = coplanar_groups(points, triangles);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> planes_at;
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (const std::uint32_t v : triangles[i])
            planes_at.emplace_back(v, plane[i]);
    std::sort(planes_at.begin(), planes_at.end());
    planes_at.erase(std::unique(planes_at.begin(), planes_at.end()), planes_at.end());
    std::vector<std::uint32_t> extreme;
    for (std::size_t i = 0; i + 2 < planes_at.size(); ++i)
        if (planes_at[i].first == planes_at[i + 2].first &&
            (extreme.empty() || extreme.back() != planes_at[i].first))
            extreme.push_back(planes_at[i].first);
    return extreme;
}

} // namespace

HullSurface exact_hull(std::span<const Vec3> points) {
    const std::vector<std::uint32_t> span = spanning_points(points);
    if (span.size() == 3)
        return planar_hull(points, span);
    if (span.size() < 3) {
        const auto before = [&](std::uint32_t i, std::uint32_t j) {
            const Vec3 &p = points[i], &q = points[j];
            return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
        };
        std::vector<std::uint32_t> all(points.size());
        std::iota(all.begin(), all.end(), 0);
        const auto [low, high] = std::minmax_element(all.begin(), all.end(), before);
        if (span.size() == 1)
            return {0, {*low}, {}};
        return {1, {*low, *high}, {}};
    }
    HullSurface hull{3, extreme_vertices(points, QuickHull(points, span).run()), {}};
    // A point on an edge or a face of the hull may have been added before the corners around it.
    // The hull of the extreme points alone has no such vertex.
    std::vector<Vec3> corners;
    for (const std::uint32_t v : hull.vertices)
        corners.push_back(points[v]);
    hull.triangles = QuickHull(corners, spanning_points(corners)).run();
    for (IndexTriangle& t : hull.triangles)
        for (std::uint32_t& v : t)
            v = hull.vertices[v];
    return hull;
}

} // namespace abut
