#include "rigid/tolerance/sheet_parts.h"

#include "geometry/triangle_triangle_intersect.h"
#include "geometry/triangle_triangle_segment.h"

#include <algorithm>
#include <utility>

namespace abut {

namespace {

std::vector<SheetContact> sorted(std::vector<SheetContact> contacts) {
    std::stable_sort(contacts.begin(), contacts.end(),
                     [](const auto& c, const auto& d) { return c.own < d.own; });
    return contacts;
}

} // namespace

std::vector<SheetCrossing> crossings_in(std::span<const SheetContact> contacts, const Sheet& own,
                                        const Sheet& other) {
    std::vector<SheetCrossing> crossings;
    for (const SheetContact& c : contacts) {
        const Triangle &t = own.triangle(c.own), &u = other.triangle(c.other);
        if (projection_axis(u) < 0)
            continue;
        for (std::size_t k = 0; k < 3; ++k)
            if (segment_triangle_intersect(t[k], t[(k + 1) % 3], u))
                crossings.push_back({own.edge(c.own, k), c.other, c.contact});
    }
    std::sort(crossings.begin(), crossings.end(), [](const auto& c, const auto& d) {
        return std::tie(c.edge, c.other, c.contact) < std::tie(d.edge, d.other, d.contact);
    });
    return crossings;
}

SheetParts::SheetParts(const Sheet& own, const Sheet& other, std::vector<SheetContact> contacts,
                       const WorldSolid& surface, const ReachSearch::Options& options)
    : own_(own), other_(other), contacts_(sorted(std::move(contacts))),
      origin_(other.triangle(0)[0]), seen_(surface.seen_from(origin_)), options_(options),
      crossings_(crossings_in(contacts_, own, other)), sets_(own.vertices()) {
    unite_along_edges();
    unite_on_edges();
}

bool SheetParts::is_crossed(const Sheet::Edge& edge) const {
    const auto at =
        std::lower_bound(crossings_.begin(), crossings_.end(), edge,
                         [](const SheetCrossing& c, const Sheet::Edge& e) { return c.edge < e; });
    return at != crossings_.end() && at->edge == edge;
}

void SheetParts::unite_along_edges() {
    for (std::uint32_t i = 0; i < own_.triangles(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            if (const Sheet::Edge e = own_.edge(i, k); !is_crossed(e))
                sets_.unite(e.first, e.second);
}

/// Returns whether a segment crosses the other sheet.
bool SheetParts::crosses(const Vec3& p, const Vec3& q) const {
    return std::ranges::any_of(contacts_, [&](const SheetContact& c) {
        const Triangle& t = other_.triangle(c.other);
        return projection_axis(t) >= 0 && segment_triangle_intersect(p, q, t);
    });
}

/// Connects vertices of pieces with the ends of the edges on which they lie.
void SheetParts::unite_on_edges() {
    // Positions of vertices are rounded far less than the other sheet was moved.
    const double off = 0.25 * options_.rounding;
    for (std::uint32_t v = own_.first_new_vertex(); v < own_.vertices(); ++v) {
        const Vec3& at = own_.position(v);
        for (std::uint32_t i = 0; i < own_.triangles(); ++i) {
            const Triangle& t = own_.triangle(i);
            Box3 box;
            for (const Vec3& corner : t)
                extend(box, corner);
            if (!encloses(grown(box, off), {at, at}))
                continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 &p = t[k], &q = t[(k + 1) % 3];
                const Vec3 along = normalized_or_zero(q - p);
                if (dot(at - p, along) <= 0 || dot(q - at, along) <= 0 ||
                    length(cross(at - p, along)) > off)
                    continue;
                if (!crosses(at, p))
                    sets_.unite(v, own_.corners(i)[k]);
                if (!crosses(at, q))
                    sets_.unite(v, own_.corners(i)[(k + 1) % 3]);
            }
        }
    }
}

Proof SheetParts::ends_at(const SheetCrossing& crossing) {
    const Proof first = is_near(crossing.edge.first);
    return first == Proof::holds ? first : either_holds(first, is_near(crossing.edge.second));
}

/// Decides whether the part that holds a vertex is near the other sheet.
Proof SheetParts::is_near(std::uint32_t vertex) {
    const std::uint32_t part = sets_.root(vertex);
    const auto [at, is_new] = near_.try_emplace(part, Proof::holds);
    if (is_new)
        at->second = examine(part);
    return at->second;
}

std::span<const std::uint32_t> SheetParts::triangles_of(std::uint32_t part) {
    if (by_part_.empty()) {
        for (std::uint32_t i = 0; i < own_.triangles(); ++i)
            for (const std::uint32_t vertex : own_.corners(i))
                by_part_[sets_.root(vertex)].push_back(i);
        for (auto& [number, triangles] : by_part_)
            triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    }
    return by_part_[part];
}

Proof SheetParts::examine(std::uint32_t part) {
    ReachSearch search(*seen_, options_);
    for (const std::uint32_t i : triangles_of(part)) {
        const Triangle& t = own_.triangle(i);
        std::vector<Vec3> in_part;
        for (std::size_t k = 0; k < 3; ++k)
            if (sets_.root(own_.corners(i)[k]) == part)
                in_part.push_back(t[k]);
        if (in_part.size() == 3 ? !add(t[0], t[1], t[2], search)
                                : !add_beyond_curve(i, in_part, search))
            break;
    }
    if (search.proof() == Proof::fails) {
        const Vec3& point = search.counterexample();
        const double length = seen_->nearest(point, {}).distance;
        if (!beyond_ || length < beyond_->length)
            beyond_ = {length, origin_ + point};
    }
    return search.proof();
}

/// Returns whether a triangle, and all before, are near.
bool SheetParts::add(const Vec3& p, const Vec3& q, const Vec3& r, ReachSearch& search) const {
    return search.add({p - origin_, q - origin_, r - origin_}) == Proof::holds;
}

/// Adds what lies between the corners of a crossed triangle that are in the part and the curve.
bool SheetParts::add_beyond_curve(std::uint32_t triangle, const std::vector<Vec3>& in_part,
                                  ReachSearch& search) const {
    const Triangle& t = own_.triangle(triangle);
    const auto [first, last] =
        std::equal_range(contacts_.begin(), contacts_.end(), SheetContact{triangle, 0, 0},
                         [](const auto& c, const auto& d) { return c.own < d.own; });
    if (first == last) // crossed only since the shift
        return add(t[0], t[1], t[2], search);
    for (auto at = first; at != last; ++at) {
        const Intersection common = triangle_triangle_segment(t, other_.triangle(at->other));
        if (common.count == 0)
            continue;
        const Vec3 &p = common.corners[0], &q = common.corners[common.count - 1];
        for (const Vec3& corner : in_part)
            if (!add(corner, p, q, search))
                return false;
        if (in_part.size() == 2 &&
            (!add(in_part[0], in_part[1], p, search) || !add(in_part[0], in_part[1], q, search)))
            return false;
    }
    return true;
}

} // namespace abut
