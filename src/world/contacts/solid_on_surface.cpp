#include "world/contacts/solid_on_surface.h"

#include "core/borrowed.h"
#include "core/stop.h"
#include "geometry/point_triangle_distance.h"
#include "math/transform.h"
#include "rigid/manifold/meeting_regions.h"
#include "rigid/model/model_data.h"
#include "world/contacts/patch_points.h"
#include "world/contacts/surface_patch.h"
#include "world/solids/four_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace abut {

namespace {

/// Memory that a thread uses again for its next pair.
struct PatchMemory {
    SurfacePatch patch;
    std::vector<const PatchTriangle*> by_region, region, part;
    std::vector<TriangleMeeting> meetings;
    std::vector<std::uint32_t> part_of;
    std::vector<PatchPoint> points;
    std::vector<RegionPoint> places;
};

/// The transform from a surface to a solid's frame. The difference of their places is taken first, so
/// that bodies far from the origin lose nothing.
Transform solid_from(const ConvexFaces& solid, const Transform& world_from_surface) {
    const Transform& to = solid.world_from_solid;
    const auto& m = world_from_surface.m;
    Transform result;
    for (std::size_t k = 0; k < 9; k += 3) {
        const Vec3 axis = pull_back(to, {m[k], m[k + 1], m[k + 2]});
        result.m[k] = axis.x, result.m[k + 1] = axis.y, result.m[k + 2] = axis.z;
    }
    const Vec3 place = pull_back(to, Vec3{m[9], m[10], m[11]} - Vec3{to.m[9], to.m[10], to.m[11]});
    result.m[9] = place.x, result.m[10] = place.y, result.m[11] = place.z;
    return result;
}

/// +1 if a surface's triangles face out of its solid, -1 if in; 0 if it bounds none, or not by one sign.
double facing_of(const Model& surface, const Transform& world_from_surface) {
    const int outward = surface.data().solid().outward;
    return is_mirroring(world_from_surface) ? -outward : outward;
}

/// A direction from the surface to the solid, and how far they are apart along it; negative if they
/// overlap.
struct Separation {
    Vec3 up;
    double gap = -HUGE_VAL;
    bool looks_away = false; ///< the surface's face looks away from the solid
    bool in_doubt = false;   ///< some triangle may be nearest at an edge, which no face tells
};

/// Gaps that differ by at most this many roundings are equal.
constexpr double kDoubt = 64;

/// Finds the contacts of one solid and one surface.
class SolidOnSurface {
public:
    SolidOnSurface(const ConvexFaces& solid, const PatchLimits& limits, bool solid_is_a,
                   std::span<const std::uint64_t> last, const NearestOfPair& nearest,
                   PatchMemory& memory)
        : solid_(solid), limits_(limits), solid_is_a_(solid_is_a), last_(last), nearest_(nearest),
          memory_(memory) {}

    /// Returns false if a region does not tell its normal.
    bool add_regions(std::vector<ModelManifold>& manifolds) {
        auto& sorted = memory_.by_region;
        sorted.clear();
        for (const PatchTriangle& t : memory_.patch.triangles())
            sorted.push_back(&t);
        // Triangles lie in a row in memory, in the order of their slots.
        std::sort(sorted.begin(), sorted.end(), [](const auto* s, const auto* t) {
            return s->region != t->region ? s->region < t->region : s < t;
        });
        for (auto begin = sorted.begin(), end = begin; begin != sorted.end(); begin = end) {
            poll_stop();
            end = std::find_if(begin, sorted.end(),
                               [&](const auto* t) { return t->region != (*begin)->region; });
            memory_.region.assign(begin, end);
            if (solid_.is_surface && is_region_inside())
                return false;
            const std::uint32_t parts = split();
            for (std::uint32_t k = 0; k < parts; ++k) {
                memory_.part.clear();
                for (std::size_t i = 0; i < memory_.region.size(); ++i)
                    if (memory_.part_of[i] == k)
                        memory_.part.push_back(memory_.region[i]);
                if (!memory_.part.empty() && !add_part(manifolds))
                    return false;
            }
        }
        return true;
    }

private:
    /// Whether the region lies inside the solid, clear of its faces.
    [[nodiscard]] bool is_region_inside() const {
        const auto is_inside = [&](const Vec3& p) {
            return std::all_of(solid_.planes.begin(), solid_.planes.end(),
                               [&](const ConvexFaces::Plane& plane) {
                                   return dot(plane.normal, p) < plane.offset - limits_.rounding;
                               });
        };
        return std::all_of(memory_.region.begin(), memory_.region.end(), [&](const auto* t) {
            return std::all_of(t->corners.begin(), t->corners.end(), is_inside);
        });
    }
    /// Splits a region that bends around a hollow. Returns the number of parts.
    std::uint32_t split() {
        const auto& region = memory_.region;
        memory_.part_of.assign(region.size(), 0);
        Vec3 sum;
        double total = 0;
        for (const PatchTriangle* t : region)
            sum = sum + t->near_area * t->normal, total += t->near_area;
        constexpr double kHardlyBent = 0.866;
        if (!(total > 0) || length(sum) >= kHardlyBent * total)
            return 1;
        memory_.meetings.clear();
        for (const PatchTriangle* t : region) {
            TriangleMeeting m;
            m.normal_a = t->normal, m.weight = t->near_area;
            m.from = m.to = (1.0 / 3) * (t->corners[0] + t->corners[1] + t->corners[2]);
            memory_.meetings.push_back(m);
        }
        return split_where_hollow(memory_.meetings, memory_.part_of);
    }

    /// The normal of a part that the solid clearly enters. Zero if it is in doubt.
    [[nodiscard]] Vec3 normal_of_overlap() const {
        Vec3 sum;
        double total = 0;
        for (const PatchTriangle* t : memory_.part)
            sum = sum + t->deep_area, total += length(t->deep_area);
        constexpr double kClear = 0.1;
        if (!(length(sum) > kClear * total))
            return {};
        const Vec3 direction = normalized_or_zero(sum);
        return snapped(direction, total);
    }

    /// The normal of a plane in which a good part of the overlap lies, if it is near a direction: that
    /// of the surface, or of the solid's face.
    [[nodiscard]] Vec3 snapped(const Vec3& direction, double total) const {
        constexpr double kCosOfCone = 0.866, kOnePlane = 0.995, kLeastShare = 0.25;
        Vec3 sum;
        double within = 0;
        for (const PatchTriangle* t : memory_.part)
            if (dot(t->normal, direction) > kCosOfCone)
                sum = sum + t->deep_area, within += length(t->deep_area);
        if (within >= kLeastShare * total && length(sum) >= kOnePlane * within)
            return normalized_or_zero(sum);
        std::size_t best = 0;
        for (std::size_t i = 1; i < solid_.planes.size(); ++i)
            if (dot(solid_.planes[i].normal, direction) <
                dot(solid_.planes[best].normal, direction))
                best = i;
        const Vec3& face = solid_.planes[best].normal;
        const Border curve = border(best);
        return -dot(face, direction) > kCosOfCone && curve.in_plane >= kLeastShare * curve.all
                   ? -face
                   : direction;
    }

    /// The curve where the surface enters the solid: its length, and that in one of the planes.
    struct Border {
        double all = 0, in_plane = 0;
    };
    [[nodiscard]] Border border(std::size_t plane) const {
        Border found;
        for (const PatchTriangle* t : memory_.part) {
            if (t->deep_area == Vec3{})
                continue;
            ClippedTriangle deep(t->corners);
            deep.keep_inside(solid_, -SurfacePatch::kClear * limits_.rounding);
            const auto& corners = deep.corners;
            for (std::size_t k = 0; k < corners.size(); ++k) {
                if (corners[k].side < ClippedTriangle::kFirstPlane)
                    continue;
                const double size =
                    length(corners[k + 1 == corners.size() ? 0 : k + 1].at - corners[k].at);
                found.all += size;
                found.in_plane +=
                    corners[k].side == ClippedTriangle::kFirstPlane + plane ? size : 0;
            }
        }
        return found;
    }

    /// Returns the direction across a face of either in which a triangle and the solid are farthest apart.
    /// The triangle's own normal comes first where others are as good.
    [[nodiscard]] Separation separation(const PatchTriangle& t) const {
        Separation found;
        double lowest = HUGE_VAL;
        for (const Vec3& v : solid_.vertices)
            lowest = std::min(lowest, dot(t.normal, v - t.corners[0]));
        found.up = t.normal, found.gap = lowest;
        double clearly_more = kDoubt * limits_.rounding;
        for (const ConvexFaces::Plane& plane : solid_.planes) {
            const double least =
                std::min({dot(plane.normal, t.corners[0]), dot(plane.normal, t.corners[1]),
                          dot(plane.normal, t.corners[2])}) -
                plane.offset;
            if (least > found.gap + clearly_more)
                found.up = -plane.normal, found.gap = least, clearly_more = 0;
        }
        constexpr double kLooksAway = 0.5; // by more than 120 degrees
        found.looks_away = dot(found.up, t.normal) < -kLooksAway;
        return found;
    }

    /// Returns false if the part's normal is in doubt.
    bool add_part(std::vector<ModelManifold>& manifolds) {
        const bool is_deep = std::any_of(memory_.part.begin(), memory_.part.end(),
                                         [](const auto* t) { return t->deep_area != Vec3{}; });
        if (is_deep) {
            // A thin part wholly inside, as the border of a plate, has areas that cancel out: the solid
            // leaves it as the pair does. A whole component inside is no such part.
            Vec3 normal = normal_of_overlap();
            if (normal == Vec3{} && border(0).all > 0)
                normal = nearest_.of_pair().up;
            if (normal == Vec3{})
                return false;
            find_patch_points(solid_, memory_.part, normal, solid_is_a_, limits_, memory_.points);
            if (!(deepest_point() > 0))
                return false;
            write(normal, manifolds);
            return true;
        }
        const Separation nearest = nearest_separation();
        if (nearest.in_doubt)
            return add_nearest_place(manifolds);
        if (nearest.gap > limits_.margin + limits_.rounding)
            return true;
        find_patch_points(solid_, memory_.part, nearest.up, solid_is_a_, limits_, memory_.points);
        if (std::abs(deepest_point() + nearest.gap) > kDoubt * limits_.rounding)
            return add_nearest_place(manifolds);
        write(nearest.up, manifolds);
        return true;
    }

    [[nodiscard]] double deepest_point() const {
        double deepest = -HUGE_VAL;
        for (const PatchPoint& p : memory_.points)
            deepest = std::max(deepest, p.depth);
        return deepest;
    }

    /// Adds a part that an edge or a vertex of the solid is nearest to. Returns false if no direction is
    /// known there.
    bool add_nearest_place(std::vector<ModelManifold>& manifolds) {
        const double error = kDoubt * limits_.rounding;
        SolidPlace place = nearest_.of_pair();
        if (place.distance > limits_.margin)
            return true;
        const auto holds_place = [&](const PatchTriangle* t) {
            return nearest_on_triangle(place.on_surface, t->corners).distance_sq <= error * error;
        };
        if (std::none_of(memory_.part.begin(), memory_.part.end(), holds_place)) {
            place.distance = limits_.margin + error;
            for (const PatchTriangle* t : memory_.part)
                if (const SolidPlace here = nearest_.of_triangle(t->corners, place.distance);
                    here.distance < place.distance)
                    place = here;
            if (place.distance > limits_.margin)
                return true;
            if (place.distance <= error)
                return false;
        }
        if (place.up == Vec3{} || std::abs(place.distance) > limits_.margin + error ||
            place.distance < -error)
            return false;
        // Where they hardly touch, rounding may have turned the direction round: a convex solid lies on
        // its side of a plane that it touches.
        if (dot(place.up, solid_.middle - place.on_surface) < 0)
            place.up = -place.up;
        find_patch_points(solid_, memory_.part, place.up, solid_is_a_, limits_, memory_.points);
        std::erase_if(memory_.points,
                      [&](const PatchPoint& p) { return p.depth > error - place.distance; });
        if (!(std::abs(deepest_point() + place.distance) <= error))
            add_place_of_features(place.on_surface, place.on_solid, place.up, memory_.part, solid_,
                                  solid_is_a_, memory_.points);
        write(place.up, manifolds);
        return true;
    }

    /// Returns the separation of the nearest triangle. Triangles that look away, or that are nearest at
    /// edges, do not count. If none is left, the gap is infinite.
    [[nodiscard]] Separation nearest_separation() const {
        Separation nearest;
        nearest.gap = HUGE_VAL;
        for (const PatchTriangle* t : memory_.part) {
            const Separation here = separation(*t);
            const bool is_known = here.gap >= -kDoubt * limits_.rounding,
                       in_doubt = nearest.in_doubt || !is_known;
            if (is_known && !here.looks_away && here.gap < nearest.gap)
                nearest = here;
            nearest.in_doubt = in_doubt;
        }
        return nearest;
    }

    /// Adds a manifold of four of the points.
    void write(const Vec3& up, std::vector<ModelManifold>& manifolds) const {
        std::vector<RegionPoint>& places = memory_.places;
        places.clear();
        for (const PatchPoint& p : memory_.points)
            places.push_back({p.x, p.y, p.depth, p.feature});
        const Transform& to_world = solid_.world_from_solid;
        ModelManifold& m = manifolds.emplace_back();
        const Vec3 normal = apply_linear(to_world, up);
        m.normal = solid_is_a_ ? -normal : normal;
        m.status = Status::bound_only;
        for (const std::size_t i : four_points(places, limits_.rounding, last_)) {
            const PatchPoint& p = memory_.points[i];
            const Vec3 on_surface = apply(to_world, p.on_surface),
                       on_solid = apply(to_world, p.on_solid);
            m.points[m.count++] = {solid_is_a_ ? on_solid : on_surface,
                                   solid_is_a_ ? on_surface : on_solid,
                                   p.depth,
                                   p.feature,
                                   solid_is_a_ ? 0 : p.triangle,
                                   solid_is_a_ ? p.triangle : 0};
        }
    }

    const ConvexFaces& solid_;
    PatchLimits limits_;
    bool solid_is_a_;
    std::span<const std::uint64_t> last_;
    const NearestOfPair& nearest_;
    PatchMemory& memory_;
};

} // namespace

std::optional<double> add_solid_on_surface(const ConvexFaces& solid, const Model& surface,
                                           const Transform& world_from_surface, bool solid_is_a,
                                           double margin, std::span<const std::uint64_t> last,
                                           const NearestOfPair& nearest,
                                           std::vector<ModelManifold>& manifolds) {
    static thread_local PatchMemory kept;
    Borrowed<PatchMemory> borrowed(kept);
    PatchMemory& memory = *borrowed;
    const Transform solid_from_surface = solid_from(solid, world_from_surface);
    const PlacedModel placed(surface, solid_from_surface);
    if (placed.world() != solid_from_surface)
        return std::nullopt; // flattened: a copy of the surface, in world coordinates
    const auto& m = solid.world_from_solid.m;
    const double rounding =
        0x1p-48 * (sum_of_sizes(Vec3{m[9], m[10], m[11]}) + solid.reach + placed.reach());
    memory.patch.collect(solid, placed, facing_of(surface, world_from_surface), margin, rounding);
    const std::size_t first = manifolds.size();
    SolidOnSurface finder(solid, {margin, rounding}, solid_is_a, last, nearest, memory);
    // Triangles that only look away from the solid are those of a body around it.
    if (finder.add_regions(manifolds) &&
        (manifolds.size() > first || memory.patch.triangles().empty()))
        return SurfacePatch::kClear * rounding;
    manifolds.erase(manifolds.begin() + static_cast<std::ptrdiff_t>(first), manifolds.end());
    return std::nullopt;
}

} // namespace abut
