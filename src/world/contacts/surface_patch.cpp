#include "world/contacts/surface_patch.h"

#include "core/stop.h"
#include "rigid/model/solid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace abut {

namespace {

/// Faces lie in one plane if the cosine between their normals is larger: to 10^-6 radians.
constexpr double kOnePlane = 1 - 0x1p-41;

std::size_t mixed(std::uint64_t key) {
    key *= 0x9E3779B97F4A7C15U;
    return static_cast<std::size_t>(key ^ key >> 32U);
}

/// Where the heights of a triangle's corners over a solid's planes leave it.
enum class Lies : std::uint8_t { inside, across, outside };
Lies side_of(const Triangle& t, const ConvexFaces::Plane& plane, double outwards) {
    const double limit = plane.offset + outwards;
    const double a = dot(plane.normal, t[0]), b = dot(plane.normal, t[1]),
                 c = dot(plane.normal, t[2]);
    return a > limit && b > limit && c > limit      ? Lies::outside
           : a <= limit && b <= limit && c <= limit ? Lies::inside
                                                    : Lies::across;
}

} // namespace

void ClippedTriangle::keep_inside(const ConvexFaces& solid, double outwards) {
    decltype(corners) kept;
    for (std::uint32_t i = 0; i < solid.planes.size() && !corners.empty(); ++i) {
        const ConvexFaces::Plane& plane = solid.planes[i];
        const double limit = plane.offset + outwards;
        const auto height = [&](const Vec3& p) { return dot(plane.normal, p) - limit; };
        if (std::none_of(corners.begin(), corners.end(),
                         [&](const Corner& c) { return height(c.at) > 0; }))
            continue;
        kept.clear();
        double next = height(corners[0].at);
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const Corner &from = corners[k], &to = corners[k + 1 == corners.size() ? 0 : k + 1];
            const double here = next;
            next = height(to.at);
            if (here <= 0)
                kept.push_back(from);
            if ((here <= 0) == (next <= 0))
                continue;
            const Vec3 at = from.at + (here / (here - next)) * (to.at - from.at);
            kept.push_back({at, here <= 0 ? kFirstPlane + i : from.side});
        }
        corners.swap(kept);
    }
}

Vec3 ClippedTriangle::vector_area() const {
    Vec3 sum;
    for (std::size_t k = 2; k < corners.size(); ++k)
        sum = sum + cross(corners[k - 1].at - corners[0].at, corners[k].at - corners[0].at);
    return 0.5 * sum;
}

void SurfacePatch::collect(const ConvexFaces& solid, const PlacedModel& surface, double facing,
                           double margin, double rounding) {
    triangles_.clear(), edges_of_.clear();
    slots_.clear();
    const std::span<const Vec3> vertices(solid.vertices.data(), solid.vertices.size());
    surface.for_each_near_hull(vertices, margin + rounding,
                               [&](std::uint32_t slot) { slots_.push_back(slot); });
    // The order in which a tree is traversed differs between processors.
    std::sort(slots_.begin(), slots_.end());
    for (const std::uint32_t slot : slots_) {
        poll_stop();
        add(solid, surface, slot, facing, margin, rounding);
    }
    connect();
}

void SurfacePatch::add(const ConvexFaces& solid, const PlacedModel& surface, std::uint32_t slot,
                       double facing, double margin, double rounding) {
    const Triangle t = surface.world_slot(slot);
    const double grown = margin + rounding;
    bool is_across = false;
    for (const ConvexFaces::Plane& plane : solid.planes) {
        const Lies side = side_of(t, plane, grown);
        if (side == Lies::outside)
            return;
        is_across = is_across || side == Lies::across;
    }
    ClippedTriangle near(t);
    if (is_across)
        near.keep_inside(solid, grown);
    if (near.is_empty())
        return;
    PatchTriangle patch;
    patch.corners = t;
    const Vec3 area = cross(t[1] - t[0], t[2] - t[0]);
    patch.normal = normalized_or_zero(area);
    if (patch.normal == Vec3{})
        return; // a needle: its neighbours hold its edges
    const double height = dot(patch.normal, solid.middle - t[0]);
    if (facing != 0 ? facing < 0 : height < -rounding)
        patch.normal = -patch.normal;
    patch.near_area = length(near.vector_area());
    ClippedTriangle deep(t);
    deep.keep_inside(solid, -kClear * rounding);
    if (!deep.is_empty())
        patch.deep_area = length(deep.vector_area()) * patch.normal;
    const auto edges_of = [](const ClippedTriangle& part) {
        std::array<bool, 3> edges{};
        for (const ClippedTriangle::Corner& corner : part.corners)
            if (corner.side < ClippedTriangle::kFirstPlane)
                edges[corner.side] = true;
        return edges;
    };
    patch.triangle = surface.data().triangle_at(slot);
    const auto& corners = surface.data().mesh().triangles[patch.triangle];
    const auto& vertex_of = surface.data().solid().topology.vertex_of;
    patch.vertices = {vertex_of[corners[0]], vertex_of[corners[1]], vertex_of[corners[2]]};
    triangles_.push_back(patch);
    edges_of_.push_back({edges_of(near), edges_of(deep)});
}

void SurfacePatch::unite(std::uint32_t i, std::uint32_t k, bool is_deep) {
    const auto [low, high] = std::minmax({sets_.root(i), sets_.root(k)});
    // What the margin adds must not join regions that are two without it.
    if (low == high || (!is_deep && holds_deep_[low] && holds_deep_[high]))
        return;
    sets_.unite(low, high);
    holds_deep_[low] = holds_deep_[low] || holds_deep_[high];
}

void SurfacePatch::begin_edges(std::size_t count) {
    const std::size_t needed = std::bit_ceil(6 * count + 1);
    constexpr std::size_t kMostKept = std::size_t{1} << 16U;
    if (edges_.size() < needed || edges_.size() > std::max(needed, kMostKept) ||
        pass_ == std::numeric_limits<std::uint32_t>::max())
        edges_.assign(needed, {}), pass_ = 0;
    ++pass_;
    shared_.clear();
}

SurfacePatch::EdgeSlot& SurfacePatch::slot_of(std::uint64_t key) {
    const std::size_t mask = edges_.size() - 1;
    std::size_t place = mixed(key) & mask;
    while (edges_[place].used_in == pass_ && edges_[place].key != key)
        place = (place + 1) & mask;
    return edges_[place];
}

void SurfacePatch::connect() {
    const auto count = static_cast<std::uint32_t>(triangles_.size());
    sets_.reset(count), holds_deep_.resize(count);
    for (std::uint32_t i = 0; i < count; ++i)
        holds_deep_[i] = triangles_[i].deep_area != Vec3{};
    begin_edges(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        PatchTriangle& t = triangles_[i];
        for (std::uint8_t k = 0; k < 3; ++k) {
            t.is_flat[k] = !edges_of_[i].near[k];
            if (t.is_flat[k])
                continue;
            const std::uint64_t key = edge_key(t.vertices[k], t.vertices[(k + 1U) % 3]);
            EdgeSlot& slot = slot_of(key);
            if (slot.used_in != pass_) {
                slot = {key, i, pass_, k, 1};
                continue;
            }
            PatchTriangle& other = triangles_[slot.triangle];
            if (edges_of_[i].deep[k] && edges_of_[slot.triangle].deep[slot.edge])
                unite(i, slot.triangle, true);
            else
                shared_.push_back({i, slot.triangle});
            // The first of two or more triangles has the edge; the others leave it to that one.
            t.is_flat[k] = true;
            other.is_flat[slot.edge] = ++slot.count == 2 && dot(t.normal, other.normal) > kOnePlane;
        }
    }
    for (const auto& [i, k] : shared_)
        unite(i, k, false);
    regions_ = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t first = sets_.root(i);
        triangles_[i].region = first == i ? regions_++ : triangles_[first].region;
    }
}

} // namespace abut
