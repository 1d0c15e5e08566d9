#include "world/contacts/rounded_on_surface.h"

#include "core/borrowed.h"
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

/// A distance above this share of the coordinates tells its direction to 2^-28.
constexpr double kLeastDistance = 0x1p-24;
/// Places that are no farther apart than this share of the radius are one.
constexpr double kSamePlace = 0x1p-20;
/// By this share of the radius a wall rises over another.
constexpr double kLeastRise = 0x1p-10;

/// A triangle near the core, and where they are nearest.
struct TriangleBelow {
    Triangle corners;
    std::uint32_t slot = 0;
    Vec3 on_surface, on_core;
    double distance = 0;
};

/// Memory that a thread uses again for its next contact.
struct NearTriangles {
    std::vector<TriangleBelow> below;
    std::vector<const TriangleBelow*> rising;
};

/// Finds the contacts. All positions are relative to the middle of the core.
class RoundedOnSurface {
public:
    /// In          memory: of earlier contacts, used again.
    RoundedOnSurface(const RoundedBox& solid, const Model& surface,
                     const Transform& world_from_surface, double margin, NearTriangles& memory)
        : surface_(surface, world_from_surface, solid.centre), radius_(solid.radius),
          margin_(margin), is_ball_(dimension(solid) == 0), below_(memory.below),
          rising_(memory.rising) {
        below_.clear();
        if (!is_ball_) {
            const Segment axis = axis_of(solid);
            ends_ = {axis.a - solid.centre, axis.b - solid.centre};
        }
        size_ = sum_of_sizes(solid.centre) + surface_.reach() + length(ends_[0]) + radius_;
    }

    std::optional<RoundedContacts> find(const Vec3& centre, bool solid_is_a) {
        RoundedContacts found;
        found.rounding = kCoreRounding * size_;
        collect();
        if (below_.empty())
            return found;
        const TriangleBelow& nearest = *std::min_element(
            below_.begin(), below_.end(),
            [](const TriangleBelow& s, const TriangleBelow& t) { return s.distance < t.distance; });
        if (!(nearest.distance > kLeastDistance * size_) || !is_outside(nearest))
            return std::nullopt;
        find_walls(nearest);
        for (const Wall& wall : walls_)
            found.manifolds.push_back(contact_of(wall, centre, solid_is_a));
        return found;
    }

private:
    void collect() {
        const double bound = radius_ + margin_ + kCoreRounding * size_;
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
        });
        // The order in which a tree is traversed differs between processors.
        std::sort(below_.begin(), below_.end(),
                  [](const TriangleBelow& s, const TriangleBelow& t) { return s.slot < t.slot; });
    }

    /// Returns whether the core lies outside at the nearest place: before all triangles there. Both sides of
    /// an open surface are outside.
    [[nodiscard]] bool is_outside(const TriangleBelow& nearest) const {
        if (!surface_.data().solid().closed)
            return true;
        const double facing = facing_of_surface();
        return facing != 0 &&
               std::all_of(below_.begin(), below_.end(), [&](const TriangleBelow& t) {
                   return t.distance > kBeside * nearest.distance || is_before(t, facing);
               });
    }
    /// -1 if the triangles of a closed surface look inwards, +1 if outwards; 0 if they tell no side.
    [[nodiscard]] double facing_of_surface() const {
        const Solid& solid = surface_.data().solid();
        if (!solid.closed)
            return 0;
        return is_mirroring(surface_.world()) ? -solid.outward : solid.outward;
    }
    /// Whether the core is on the side to which a triangle looks.
    [[nodiscard]] static bool is_before(const TriangleBelow& t, double facing) {
        const Vec3 normal = cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
        return facing * dot(normal, t.on_core - t.on_surface) > 0;
    }

    /// A place where the surface holds the core.
    struct Wall {
        const TriangleBelow* at = nullptr;
        Vec3 up; ///< from the surface to the core
        [[nodiscard]] double height(const Vec3& p) const { return dot(p - at->on_surface, up); }
    };
    static Wall wall_at(const TriangleBelow& t) {
        return {&t, (1 / t.distance) * (t.on_core - t.on_surface)};
    }

    void find_walls(const TriangleBelow& nearest) {
        walls_.assign(1, wall_at(nearest));
        rising_.clear();
        for (const TriangleBelow& t : below_)
            if (rises(t) && is_outside_at(t) && is_nearest_there(t))
                rising_.push_back(&t);
        while (walls_.size() < walls_.capacity())
            if (const TriangleBelow* next = next_wall())
                walls_.push_back(wall_at(*next));
            else
                return;
    }
    /// Whether the place of a triangle lies over the planes of all walls so far.
    [[nodiscard]] bool rises(const TriangleBelow& t) const {
        return std::all_of(walls_.begin(), walls_.end(), [&](const Wall& wall) {
            return wall.height(t.on_surface) > kLeastRise * radius_;
        });
    }
    /// The triangle that meets the body, or if none does, is near it, whose direction differs most from the
    /// walls so far; nullptr if none rises over them.
    [[nodiscard]] const TriangleBelow* next_wall() const {
        const TriangleBelow* best = nullptr;
        double least = HUGE_VAL;
        bool best_meets = false;
        for (const TriangleBelow* t : rising_) {
            const bool meets = t->distance <= radius_;
            if (!rises(*t) || (best_meets && !meets))
                continue;
            double along = -1;
            for (const Wall& wall : walls_)
                along = std::max(along, dot(wall.up, wall_at(*t).up));
            if (meets > best_meets || along < least)
                best = t, least = along, best_meets = meets;
        }
        return best == nullptr ? nullptr : nearest_beside(*best);
    }
    /// The nearest of the triangles that have about the direction of one of them.
    [[nodiscard]] const TriangleBelow* nearest_beside(const TriangleBelow& one) const {
        constexpr double kSameDirection = 1 - 0x1p-12; // 1.3 degrees
        const Vec3 up = wall_at(one).up;
        const TriangleBelow* nearest = &one;
        for (const TriangleBelow* t : rising_)
            if (t->distance < nearest->distance && dot(wall_at(*t).up, up) > kSameDirection)
                nearest = t;
        return nearest;
    }
    [[nodiscard]] bool is_at_same_place(const TriangleBelow& s, const TriangleBelow& t) const {
        return s.distance <= kBeside * t.distance && t.distance <= kBeside * s.distance &&
               max_abs(s.on_surface - t.on_surface) <= kSamePlace * radius_;
    }
    /// As is_outside, for the triangles that meet at a place.
    [[nodiscard]] bool is_outside_at(const TriangleBelow& place) const {
        const double facing = facing_of_surface();
        return facing == 0 ||
               std::all_of(below_.begin(), below_.end(), [&](const TriangleBelow& t) {
                   return !is_at_same_place(t, place) || is_before(t, facing);
               });
    }
    /// Whether no triangle that holds the place is nearer to the core.
    [[nodiscard]] bool is_nearest_there(const TriangleBelow& place) const {
        const Vec3& p = place.on_surface;
        const double width = kSamePlace * radius_;
        return std::none_of(below_.begin(), below_.end(), [&](const TriangleBelow& t) {
            const auto& [q, r, s] = t.corners;
            const Vec3 beyond = max(min(q, min(r, s)) - p, p - max(q, max(r, s)));
            return t.distance + kCoreRounding * size_ < place.distance &&
                   std::max({beyond.x, beyond.y, beyond.z}) <= width &&
                   nearest_on_triangle(p, t.corners).distance_sq <= width * width;
        });
    }

    /// Whether a place of the surface belongs to a wall: the way from it to the core leads the same way as
    /// the wall's normal, and no other wall holds it.
    [[nodiscard]] bool belongs_to(const Vec3& up, const Vec3& place, const Vec3& way) const {
        return leads_same_way(way, up) &&
               std::all_of(walls_.begin(), walls_.end(), [&](const Wall& other) {
                   return other.up == up || (other.height(place) > kLeastRise * radius_ &&
                                             dot(way, other.up - up) <= kCoreRounding);
               });
    }

    ContactManifold contact_of(const Wall& wall, const Vec3& centre, bool solid_is_a) {
        const TriangleBelow& t = *wall.at;
        const Vec3& up = wall.up;
        ContactManifold m;
        m.normal = solid_is_a ? -up : up;
        m.count = 1;
        m.points[0] = point_at(t.on_surface, t.on_core - radius_ * up, radius_ - t.distance, t.slot,
                               centre, solid_is_a);
        if (!is_ball_) {
            const std::array contacts{contact_of_end(0, up, centre, solid_is_a),
                                      contact_of_end(1, up, centre, solid_is_a)};
            add_capsule_ends({centre + ends_[0], centre + ends_[1]}, contacts,
                             contact_between_ends(up, centre, solid_is_a), solid_is_a, m);
        }
        return m;
    }

    [[nodiscard]] ContactPoint point_at(const Vec3& on_surface, const Vec3& on_solid, double depth,
                                        std::uint32_t slot, const Vec3& centre,
                                        bool solid_is_a) const {
        const std::uint32_t triangle = surface_.data().triangle_at(slot);
        return solid_is_a
                   ? ContactPoint{centre + on_solid, centre + on_surface, depth, 0, 0, triangle}
                   : ContactPoint{centre + on_surface, centre + on_solid, depth, 0, triangle, 0};
    }

    /// The contact of an end, along the capsule's normal; none if no triangle has a normal for the ball there
    /// that leads the same way. The surface counts as flat beside the place that is nearest to the end.
    std::optional<ContactPoint> contact_of_end(std::size_t which, const Vec3& up,
                                               const Vec3& centre, bool solid_is_a) {
        const Vec3& end = ends_[which];
        double nearest_sq = HUGE_VAL, same_way_sq = HUGE_VAL;
        Vec3 up_there, on_surface;
        std::uint32_t slot = 0;
        for (const TriangleBelow& t : below_) {
            const NearestOnTriangle near = nearest_on_triangle(end, t.corners);
            nearest_sq = std::min(nearest_sq, near.distance_sq);
            if (!(near.distance_sq < same_way_sq))
                continue;
            if (const Vec3 way = normalized_or_zero(end - near.point);
                belongs_to(up, near.point, way))
                same_way_sq = near.distance_sq, on_surface = near.point, up_there = way,
                slot = t.slot;
        }
        depth_of_end_[which] = std::max(radius_ - std::sqrt(nearest_sq), -margin_);
        if (same_way_sq == HUGE_VAL)
            return std::nullopt;
        const Vec3 out = outwards_at_end(ends_[1 - which] - end, up);
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
            if (over > most &&
                belongs_to(up, t.on_surface, (1 / t.distance) * (t.on_core - t.on_surface)))
                most = over, best = &t;
        }
        if (best == nullptr || radius_ - best->distance < -margin_)
            return std::nullopt;
        // Below the axis is the side of the capsule.
        const Vec3 along = normalized_or_zero(way);
        const Vec3 out = normalized_or_zero(up - dot(up, along) * along),
                   up_there = (1 / best->distance) * (best->on_core - best->on_surface);
        const Vec3 on_solid = best->on_core - radius_ * out;
        const double depth =
            std::max(dot(up_there, best->on_surface - on_solid) / dot(up_there, up), -margin_);
        return point_at(on_solid + depth * up, on_solid, depth, best->slot, centre, solid_is_a);
    }

    PlacedModel surface_;
    double radius_, margin_;
    bool is_ball_;
    std::array<Vec3, 2> ends_{};
    std::array<double, 2> depth_of_end_{}; ///< at least minus the margin
    double size_ = 0;                      ///< bounds the coordinates
    std::vector<TriangleBelow>& below_;
    std::vector<const TriangleBelow*>& rising_; ///< over the nearest place
    boost::container::static_vector<Wall, RoundedContacts::kMostWalls> walls_;
};

} // namespace

std::optional<RoundedContacts> rounded_on_surface(const RoundedBox& solid, const Model& surface,
                                                  const Transform& world_from_surface,
                                                  bool solid_is_a, double margin) {
    static thread_local NearTriangles kept;
    Borrowed<NearTriangles> memory(kept);
    return RoundedOnSurface(solid, surface, world_from_surface, margin, *memory)
        .find(solid.centre, solid_is_a);
}

} // namespace abut
