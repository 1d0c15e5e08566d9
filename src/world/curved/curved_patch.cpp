#include "world/curved/curved_patch.h"

#include "convex/support/support_gap.h"
#include "core/stop.h"
#include "geometry/point_triangle_distance.h"
#include "geometry/rounded_box_distance.h"
#include "rigid/model/solid.h"

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <numeric>

namespace abut {

namespace {

/// Faces lie in one plane if the cosine between their normals is larger: to 10^-6 radians.
constexpr double kSamePlane = 1 - 0x1p-41;

/// The corners of the box around a solid along its axes, relative to its centre.
std::array<Vec3, 8> corners_of_box(const SupportShape& solid) {
    std::array<Vec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            corners.at(i) = corners.at(i) +
                            ((i >> k & 1U) != 0 ? solid.half[k] : -solid.half[k]) * solid.axis[k];
    return corners;
}

/// Whether points are all beyond one side of the box around a solid by more than a distance.
template <std::size_t kCount>
bool is_beside(const SupportShape& solid, const std::array<Vec3, kCount>& points, double distance) {
    for (std::size_t k = 0; k < 3; ++k) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (const Vec3& p : points) {
            const double along = dot(solid.axis[k], p);
            low = std::min(low, along), high = std::max(high, along);
        }
        if (low > solid.half[k] + distance || high < -solid.half[k] - distance)
            return true;
    }
    return false;
}

/// Whether a triangle is certainly farther from the solid than a distance: beyond a side of its box, or
/// because the solid lies beyond its plane.
bool is_far(const SupportShape& solid, const Triangle& t, const Vec3& normal, double distance) {
    if (is_beside(solid, t, distance))
        return true;
    const double height = dot(normal, t[0]);
    return height > dot(normal, farthest(solid, normal)) + distance ||
           height < dot(normal, farthest(solid, -normal)) - distance;
}

/// An edge as a shape, in a frame whose origin is at the solid's centre.
SupportShape support_of_edge(const NearEdge& edge) {
    return support_of(Triangle{edge.from, edge.to, edge.to});
}

} // namespace

void CurvedPatch::add(const SupportShape& solid, const PlacedModel& surface, std::uint32_t slot,
                      int facing, const PatchBounds& bounds) {
    NearTriangle t;
    t.corners = surface.world_slot(slot);
    const auto& [p, q, r] = t.corners;
    t.normal = normalized_or_zero(cross(q - p, r - p));
    if (t.normal == Vec3{})
        return; // a needle: its neighbours hold its edges
    if (facing < 0)
        t.normal = -t.normal;
    if (is_far(solid, t.corners, t.normal, bounds.margin + bounds.rounding))
        return;
    t.triangle = surface.data().triangle_at(slot);
    const auto& corners = surface.data().mesh().triangles[t.triangle];
    const auto& vertex_of = surface.data().solid().topology.vertex_of;
    t.vertices = {vertex_of[corners[0]], vertex_of[corners[1]], vertex_of[corners[2]]};
    triangles_.push_back(t);
    distances_sq_.push_back(nearest_on_triangle({}, t.corners).distance_sq);
}

void CurvedPatch::find_edges() {
    sides_.clear(), edges_.clear();
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint64_t v = triangles_[i].vertices[k],
                                w = triangles_[i].vertices[(k + 1) % 3];
            sides_.push_back({std::min(v, w) << 32U | std::max(v, w), i, k});
        }
    std::sort(sides_.begin(), sides_.end(), [](const Side& s, const Side& t) {
        return s.key != t.key ? s.key < t.key : s.triangle < t.triangle;
    });
    for (std::size_t i = 0, end = 0; i < sides_.size(); i = end) {
        for (end = i; end < sides_.size() && sides_[end].key == sides_[i].key;)
            ++end;
        if (end - i > 2)
            continue; // where three triangles meet, faces tell what there is
        const Side& side = sides_[i];
        const NearTriangle& t = triangles_[side.triangle];
        const std::uint32_t next = (side.corner + 1) % 3;
        NearEdge& edge = edges_.emplace_back();
        edge.from = t.corners[side.corner], edge.to = t.corners[next];
        edge.vertices = {t.vertices[side.corner], t.vertices[next]};
        edge.triangles = {side.triangle, sides_[end - 1].triangle};
        edge.is_border = end - i == 1;
    }
}

/// Turns the triangles of an open surface to the solid's centre, the nearest first, and with each those that
/// hang together with it.
void CurvedPatch::face_centre() {
    std::vector<boost::container::static_vector<std::uint32_t, 3>> edges_at(triangles_.size());
    for (std::uint32_t k = 0; k < edges_.size(); ++k)
        if (!edges_[k].is_border)
            for (const std::uint32_t i : edges_[k].triangles)
                edges_at[i].push_back(k);
    std::vector<std::uint32_t> order(triangles_.size()), next;
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t k) {
        return distances_sq_[i] < distances_sq_[k];
    });
    std::vector<std::uint8_t> is_turned(triangles_.size(), 0);
    const auto inward = [&](std::uint32_t i, const NearEdge& edge) {
        const Triangle& t = triangles_[i].corners;
        return t[0] + t[1] + t[2] - 1.5 * (edge.from + edge.to); // from the edge into the triangle
    };
    for (const std::uint32_t first : order) {
        if (is_turned[first] != 0)
            continue;
        NearTriangle& nearest = triangles_[first];
        if (dot(nearest.normal, nearest.corners[0]) > 0)
            nearest.normal = -nearest.normal;
        is_turned[first] = 1;
        for (next.assign(1, first); !next.empty();) {
            const std::uint32_t i = next.back();
            next.pop_back();
            for (const std::uint32_t k : edges_at[i]) {
                const NearEdge& edge = edges_[k];
                const std::uint32_t other =
                    edge.triangles[0] == i ? edge.triangles[1] : edge.triangles[0];
                if (is_turned[other] != 0)
                    continue;
                // Both normals are on one side of the surface if their turns about the edge are opposite.
                const Vec3 way = edge.to - edge.from;
                const double here = dot(triangles_[i].normal, cross(way, inward(i, edge))),
                             there = dot(triangles_[other].normal, cross(way, inward(other, edge)));
                if ((here > 0) == (there > 0))
                    triangles_[other].normal = -triangles_[other].normal;
                is_turned[other] = 1;
                next.push_back(other);
            }
        }
    }
}

void CurvedPatch::mark_edges(const SupportShape& solid, const PatchBounds& bounds) {
    for (NearEdge& edge : edges_) {
        edge.is_near =
            !is_beside(solid, std::array{edge.from, edge.to}, bounds.margin + bounds.rounding);
        if (edge.is_border)
            continue;
        const NearTriangle &s = triangles_[edge.triangles[0]], &t = triangles_[edge.triangles[1]];
        edge.is_flat = dot(s.normal, t.normal) > kSamePlane;
        double highest = -HUGE_VAL; // of the second triangle over the plane of the first
        for (const Vec3& corner : t.corners)
            highest = std::max(highest, dot(s.normal, corner - edge.from));
        edge.is_convex = edge.is_flat || highest <= bounds.rounding;
    }
}

/// Numbers planes, and triangles that hang together inside the solid.
void CurvedPatch::join(const SupportShape& solid, const PatchBounds& bounds) {
    const auto count = static_cast<std::uint32_t>(triangles_.size());
    sets_.reset(count);
    for (const NearEdge& edge : edges_)
        if (edge.is_flat)
            sets_.unite(edge.triangles[0], edge.triangles[1]);
    for (std::uint32_t i = 0; i < count; ++i)
        triangles_[i].plane = sets_.root(i);
    SupportShape at_origin = solid;
    at_origin.centre = {};
    Vec3 direction;
    for (const NearEdge& edge : edges_) {
        if (edge.is_border || edge.is_flat || !edge.is_convex ||
            sets_.root(edge.triangles[0]) == sets_.root(edge.triangles[1]))
            continue;
        const double touching = bounds.rounding;
        if (support_gap(support_of_edge(edge), at_origin, touching, SupportDepths::no, direction)
                .distance <= touching)
            sets_.unite(edge.triangles[0], edge.triangles[1]);
    }
    for (std::uint32_t i = 0; i < count; ++i)
        triangles_[i].body = sets_.root(i);
}

bool CurvedPatch::is_outside() const {
    if (triangles_.empty())
        return true;
    constexpr double kBesideSq = 1 + 0x1p-19;
    const double nearest_sq = *std::min_element(distances_sq_.begin(), distances_sq_.end());
    for (std::size_t i = 0; i < triangles_.size(); ++i)
        if (distances_sq_[i] <= kBesideSq * nearest_sq && triangles_[i].is_front)
            return true;
    return false;
}

bool CurvedPatch::collect(const SupportShape& solid, const PlacedModel& surface, int facing,
                          const PatchBounds& bounds) {
    slots_.clear(), triangles_.clear(), distances_sq_.clear();
    const std::array<Vec3, 8> around = corners_of_box(solid);
    surface.for_each_near_hull(around, bounds.margin + bounds.rounding,
                               [&](std::uint32_t slot) { slots_.push_back(slot); });
    // The order in which a tree is traversed differs between processors.
    std::sort(slots_.begin(), slots_.end());
    for (const std::uint32_t slot : slots_) {
        poll_stop();
        add(solid, surface, slot, facing, bounds);
    }
    find_edges();
    if (facing == 0)
        face_centre();
    for (NearTriangle& t : triangles_)
        t.is_front = dot(t.normal, t.corners[0]) < 0;
    mark_edges(solid, bounds);
    join(solid, bounds);
    return is_outside();
}

} // namespace abut
