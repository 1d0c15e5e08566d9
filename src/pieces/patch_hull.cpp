#include "pieces/patch_hull.h"

#include "convex/exact_hull.h"
#include "geometry/triangle_triangle_intersect.h"
#include "math/predicates.h"

#include <algorithm>
#include <array>

namespace abut {

namespace {

/// Beyond so many vertices a hull's edges are not tried: some triangles then count as crossing it
/// that do not.
constexpr std::size_t kMostForEdges = 64;

bool contains(std::span<const std::uint32_t> numbers, std::uint32_t n) {
    return std::find(numbers.begin(), numbers.end(), n) != numbers.end();
}

void collect_vertices(std::span<const IndexTriangle> faces, std::vector<std::uint32_t>& vertices) {
    vertices.clear();
    for (const IndexTriangle& f : faces)
        vertices.insert(vertices.end(), f.begin(), f.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

} // namespace

void PatchHull::begin(const IndexTriangle& triangle) {
    front_ = {at(triangle[0]), at(triangle[1]), at(triangle[2])};
    now_.faces.clear();
    now_.planes.clear();
    now_.vertices.clear();
    for (const std::uint32_t v : triangle)
        if (!contains(now_.vertices, v))
            now_.vertices.push_back(v);
    has_front_ =
        now_.vertices.size() == 3 && !collinear(at(triangle[0]), at(triangle[1]), at(triangle[2]));
}

bool PatchHull::faces_alike(const Triangle& triangle) const {
    const Triangle front{front_.a, front_.b, front_.c};
    const int axis = projection_axis(front);
    return axis >= 0 && orient2d(front[0], front[1], front[2], axis) ==
                            orient2d(triangle[0], triangle[1], triangle[2], axis);
}

void PatchHull::add_face(const IndexTriangle& face) {
    next_.faces.push_back(face);
    next_.planes.emplace_back(at(face[0]), at(face[1]), at(face[2]));
}

void PatchHull::hull_of_all(std::uint32_t vertex) {
    std::vector<std::uint32_t> all = now_.vertices;
    all.push_back(vertex);
    std::vector<Vec3> points;
    points.reserve(all.size());
    for (const std::uint32_t v : all)
        points.push_back(at(v));
    const HullSurface hull = exact_hull(points);
    next_.vertices.clear();
    next_.faces.clear();
    next_.planes.clear();
    for (const std::uint32_t v : hull.vertices)
        next_.vertices.push_back(all[v]);
    if (hull.dimension == 3)
        for (const IndexTriangle& t : hull.triangles)
            add_face({all[t[0]], all[t[1]], all[t[2]]});
}

void PatchHull::gain_of_polygon(std::uint32_t vertex) {
    const auto& polygon = next_.vertices;
    const auto found = std::find(polygon.begin(), polygon.end(), vertex);
    grows_ = found != polygon.end();
    if (!grows_)
        return;
    const std::size_t n = polygon.size(), i = static_cast<std::size_t>(found - polygon.begin());
    for (const std::size_t k : {i, (i + 1) % n, (i + n - 1) % n})
        extend(gained_, at(polygon[k]));
    for (const std::uint32_t v : now_.vertices)
        if (!contains(polygon, v))
            extend(gained_, at(v));
}

void PatchHull::add_cone(std::uint32_t vertex) {
    visible_.clear();
    next_.faces.clear();
    next_.planes.clear();
    for (std::size_t i = 0; i < now_.faces.size(); ++i)
        if (now_.planes[i].side(at(vertex)) > 0) {
            visible_.push_back(now_.faces[i]);
        } else {
            next_.faces.push_back(now_.faces[i]);
            next_.planes.push_back(now_.planes[i]);
        }
    grows_ = !visible_.empty();
    if (!grows_) {
        next_.vertices = now_.vertices;
        return;
    }
    // The border of what is visible: edges whose other side is not.
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (const IndexTriangle& f : visible_)
        for (std::size_t k = 0; k < 3; ++k) {
            edges.push_back({f[k], f[(k + 1) % 3]});
            extend(gained_, at(f[k]));
        }
    extend(gained_, at(vertex));
    std::sort(edges.begin(), edges.end());
    for (const auto& [from, to] : edges)
        if (!std::binary_search(edges.begin(), edges.end(), std::array{to, from}))
            add_face({from, to, vertex});
    collect_vertices(next_.faces, next_.vertices);
}

void PatchHull::propose(std::uint32_t vertex) {
    gained_ = {};
    if (!is_flat()) {
        add_cone(vertex);
        return;
    }
    hull_of_all(vertex);
    if (next_.faces.empty()) {
        gain_of_polygon(vertex);
        return;
    }
    grows_ = true;
    for (const std::uint32_t v : next_.vertices)
        extend(gained_, at(v));
}

void PatchHull::take() {
    std::swap(now_, next_);
}

bool PatchHull::parts(const ExactPlane& plane, const Triangle& t) const {
    // The triangle's side; a plane through it says nothing of that.
    bool front = false, back = false;
    for (const Vec3& p : t) {
        const int s = plane.side(p);
        front = front || s > 0, back = back || s < 0;
    }
    if (front && back)
        return false;
    bool below = false, above = false;
    for (const std::uint32_t v : next_.vertices) {
        const int s = plane.side(at(v));
        below = below || s < 0, above = above || s > 0;
        if ((below && (above || back)) || (above && front))
            return false;
    }
    return below || above; // a hull in the plane itself has its inside on both sides
}

bool PatchHull::parts_edge(const Vec3& p, const Vec3& q, const Triangle& t) const {
    return std::any_of(t.begin(), t.end(), [&](const Vec3& r) { return parts({p, q, r}, t); });
}

bool PatchHull::is_free_of(const Triangle& triangle) const {
    const Triangle& t = triangle;
    const bool flat = next_.faces.empty();
    const auto in_front = [&](const ExactPlane& plane) {
        return plane.side(t[0]) >= 0 && plane.side(t[1]) >= 0 && plane.side(t[2]) >= 0;
    };
    if (flat && has_front_ && in_front(front_)) {
        const bool in_plane =
            std::all_of(t.begin(), t.end(), [&](const Vec3& p) { return front_.side(p) == 0; });
        if (!in_plane || collinear(t[0], t[1], t[2]) || faces_alike(t))
            return true;
    }
    // The latest faces first: what is looked at is near them.
    if (std::any_of(next_.planes.rbegin(), next_.planes.rend(), in_front) ||
        parts(ExactPlane(t), t))
        return true;
    const auto& vertices = next_.vertices;
    if (vertices.size() > kMostForEdges)
        return false;
    for (const std::uint32_t v : vertices)
        for (std::size_t k = 0; k < 3; ++k)
            if (parts({t[k], t[(k + 1) % 3], at(v)}, t))
                return true;
    if (flat) {
        for (std::size_t i = 0; i < vertices.size(); ++i)
            if (parts_edge(at(vertices[i]), at(vertices[(i + 1) % vertices.size()]), t))
                return true;
        return false;
    }
    for (const IndexTriangle& f : next_.faces)
        for (std::size_t k = 0; k < 3; ++k)
            if (f[k] < f[(k + 1) % 3] && parts_edge(at(f[k]), at(f[(k + 1) % 3]), t))
                return true;
    return false;
}

} // namespace abut
