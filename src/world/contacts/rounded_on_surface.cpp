#include "world/contacts/rounded_on_surface.h"

#include "core/borrowed.h"
#include "geometry/supporting_normal.h"
#include "geometry/triangle_triangle_distance.h"
#include "rigid/model/placed_model.h"
#include "world/contacts/capsule_contacts.h"
#include "world/narrow_phase/body.h"
#include "world/narrow_phase/core_gap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

namespace {

/// Triangles that are farther than the nearest one by at most this factor are at the same place.
constexpr double kBeside = 1 + 0x1p-20;

/// A triangle near the core, and where they are nearest.
struct TriangleBelow {
    Triangle corners;
    std::uint32_t slot = 0;
    Vec3 on_surface, on_core;
    double distance = 0;
};

/// Finds the contact. All positions are relative to the middle of the core.
class RoundedOnSurface {
public:
    /// In          memory: of earlier contacts, used again.
    RoundedOnSurface(const RoundedBox& solid, const Model& surface,
                     const Transform& world_from_surface, double margin,
                     std::vector<TriangleBelow>& memory)
        : surface_(surface, world_from_surface, solid.centre), radius_(solid.radius),
          margin_(margin), is_ball_(dimension(solid) == 0), below_(memory) {
        below_.clear();
        if (!is_ball_) {
            const Segment axis = axis_of(solid);
            ends_ = {axis.a - solid.centre, axis.b - solid.centre};
        }
        size_ = sum_of_sizes(solid.centre) + surface_.reach() + length(ends_[0]) + radius_;
    }

    std::optional<RoundedContact> find(const Vec3& centre, bool solid_is_a) {
        RoundedContact found;
        found.rounding = kCoreRounding * size_;
        collect();
        if (below_.empty())
            return found;
        const TriangleBelow& nearest = *std::min_element(
            below_.begin(), below_.end(),
            [](const TriangleBelow& s, const TriangleBelow& t) { return s.distance < t.distance; });
        if (!(nearest.distance > kTellsDirection * size_) || !is_outside(nearest))
            return std::nullopt;
        const Vec3 up = (1 / nearest.distance) * (nearest.on_core - nearest.on_surface);
        ContactManifold& m = found.manifold;
        m.normal = solid_is_a ? -up : up;
        m.count = 1;
        m.points[0] = point_at(nearest.on_surface, nearest.on_core - radius_ * up,
                               radius_ - nearest.distance, nearest.slot, centre, solid_is_a);
        if (!is_ball_) {
            const std::array contacts{contact_of_end(0, up, centre, solid_is_a),
                                      contact_of_end(1, up, centre, solid_is_a)};
            add_capsule_ends({centre + ends_[0], centre + ends_[1]}, contacts,
                             contact_between_ends(up, centre, solid_is_a), solid_is_a, m);
        }
        return found;
    }

private:
    void collect() {
        double bound = radius_ + margin_ + kCoreRounding * size_;
        const std::span<const Vec3> core(ends_.data(), is_ball_ ? 1 : 2);
        const Vec3 low = min(ends_[0], ends_[1]), high = max(ends_[0], ends_[1]);
        surface_.for_each_near_hull(core, bound, [&](std::uint32_t slot) {
            TriangleBelow t;
            t.corners = surface_.world_slot(slot);
            const auto& [p, q, r] = t.corners;
            const Vec3 between =
                max(max(min(p, min(q, r)) - high, low - max(p, max(q, r))), Vec3{});
            if (length_sq(between) > bound * bound)
                return;
            t.slot = slot;
            double sq = 0;
            if (is_ball_) {
                const NearestOnTriangle near = nearest_on_triangle(ends_[0], t.corners);
                t.on_surface = near.point, t.on_core = ends_[0], sq = near.distance_sq;
            } else {
                const ClosestPoints near =
                    triangle_triangle_distance(t.corners, {ends_[0], ends_[1], ends_[1]});
                t.on_surface = near.a, t.on_core = near.b, sq = near.distance_sq;
            }
            t.distance = std::sqrt(sq);
            if (!(t.distance <= bound))
                return;
            below_.push_back(t);
            // A ball needs the nearest triangles only, and those beside them.
            if (is_ball_)
                bound = std::min(bound, kBeside * t.distance);
        });
        // The order in which a tree is traversed differs between processors.
        std::sort(below_.begin(), below_.end(),
                  [](const TriangleBelow& s, const TriangleBelow& t) { return s.slot < t.slot; });
    }

    /// Returns whether the core lies outside at the nearest place: before all triangles there. Both sides of
    /// an open surface are outside.
    [[nodiscard]] bool is_outside(const TriangleBelow& nearest) const {
        const Solid& solid = surface_.data().solid();
        if (!solid.closed)
            return true;
        const double facing = is_mirroring(surface_.world()) ? -solid.outward : solid.outward;
        if (facing == 0)
            return false;
        return std::all_of(below_.begin(), below_.end(), [&](const TriangleBelow& t) {
            const Vec3 normal = cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
            return t.distance > kBeside * nearest.distance ||
                   facing * dot(normal, t.on_core - t.on_surface) > 0;
        });
    }

    [[nodiscard]] ContactPoint point_at(const Vec3& on_surface, const Vec3& on_solid, double depth,
                                        std::uint32_t slot, const Vec3& centre,
                                        bool solid_is_a) const {
        const std::uint32_t triangle = surface_.data().triangle_at(slot);
        return solid_is_a
                   ? ContactPoint{centre + on_solid, centre + on_surface, depth, 0, 0, triangle}
                   : ContactPoint{centre + on_surface, centre + on_solid, depth, 0, triangle, 0};
    }

    /// The contact of an end, along the capsule's normal; none if the normal of the ball there leads another
    /// way. The surface counts as flat beside the place that is nearest to the end.
    std::optional<ContactPoint> contact_of_end(std::size_t which, const Vec3& up,
                                               const Vec3& centre, bool solid_is_a) {
        const Vec3& end = ends_[which];
        double nearest_sq = HUGE_VAL;
        Vec3 on_surface;
        std::uint32_t slot = 0;
        for (const TriangleBelow& t : below_)
            if (const NearestOnTriangle near = nearest_on_triangle(end, t.corners);
                near.distance_sq < nearest_sq)
                nearest_sq = near.distance_sq, on_surface = near.point, slot = t.slot;
        const Vec3 up_there = normalized_or_zero(end - on_surface);
        depth_of_end_[which] = std::max(radius_ - std::sqrt(nearest_sq), -margin_);
        if (!leads_same_way(up_there, up))
            return std::nullopt;
        // Below the higher end of a capsule that leans is its side, not the ball.
        const Vec3 inwards = normalized_or_zero(ends_[1 - which] - end);
        const double leans = std::min(dot(up, inwards), 0.0);
        const Vec3 out = normalized_or_zero(up - leans * inwards);
        const Vec3 on_solid = end - radius_ * out;
        double depth = dot(up_there, on_surface - on_solid) / dot(up_there, up);
        if (depth < -margin_ - kCoreRounding * size_ || out == Vec3{})
            return std::nullopt;
        depth = std::max(depth, -margin_);
        return point_at(on_solid + depth * up, on_solid, depth, slot, centre, solid_is_a);
    }

    /// Returns the contact of the place that lies deepest below the line between the depths of the ends, as
    /// over a ridge. Returns none if no place does so clearly.
    [[nodiscard]] std::optional<ContactPoint>
    contact_between_ends(const Vec3& up, const Vec3& centre, bool solid_is_a) const {
        const Vec3 way = ends_[1] - ends_[0];
        double most = kDeeperThanEnds * length(way);
        const TriangleBelow* best = nullptr;
        for (const TriangleBelow& t : below_) {
            const double share = dot(t.on_core - ends_[0], way) / length_sq(way);
            const double over =
                radius_ - t.distance - ((1 - share) * depth_of_end_[0] + share * depth_of_end_[1]);
            if (over > most && leads_same_way((1 / t.distance) * (t.on_core - t.on_surface), up))
                most = over, best = &t;
        }
        if (best == nullptr || radius_ - best->distance < -margin_)
            return std::nullopt;
        const Vec3 on_solid = best->on_core - radius_ * up;
        const double depth = radius_ - best->distance;
        return point_at(on_solid + depth * up, on_solid, depth, best->slot, centre, solid_is_a);
    }

    PlacedModel surface_;
    double radius_, margin_;
    bool is_ball_;
    std::array<Vec3, 2> ends_{};
    std::array<double, 2> depth_of_end_{}; ///< at least minus the margin
    double size_ = 0;                      ///< bounds the coordinates
    std::vector<TriangleBelow>& below_;
};

} // namespace

std::optional<RoundedContact> rounded_on_surface(const RoundedBox& solid, const Model& surface,
                                                 const Transform& world_from_surface,
                                                 bool solid_is_a, double margin) {
    static thread_local std::vector<TriangleBelow> kept;
    Borrowed<std::vector<TriangleBelow>> memory(kept);
    return RoundedOnSurface(solid, surface, world_from_surface, margin, *memory)
        .find(solid.centre, solid_is_a);
}

} // namespace abut
