#include "world/curved/curved_on_surface.h"

#include "core/borrowed.h"
#include "math/transform.h"
#include "rigid/model/model_data.h"
#include "world/curved/curved_seeds.h"
#include "world/solids/contact_candidate.h"
#include "world/solids/four_points.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace abut {

namespace {

/// Memory that a thread uses again for its next pair.
struct CurvedMemory {
    CurvedPatch patch;
    CurvedSeeds found;
    std::vector<CurvedSeed> kept;
    std::vector<std::uint32_t> order;
    std::vector<std::vector<CurvedPlace>> groups; ///< the places of each manifold
    std::vector<Vec3> normals; ///< of each manifold, from the surface to the solid
};

/// Groups the places of one pair into manifolds.
class CurvedManifolds {
public:
    CurvedManifolds(const SupportShape& at_origin, const PatchBounds& bounds, CurvedMemory& memory)
        : solid_(at_origin), bounds_(bounds), memory_(memory) {}

    void group() {
        leave_soonest();
        sort();
        memory_.groups.clear(), memory_.normals.clear();
        for (const std::uint32_t i : memory_.order)
            add(memory_.found.seeds[i]);
    }

private:
    /// Of the ways out of a part of the surface without hollows, keeps the shortest, and others only if they
    /// lead nearly the same way.
    void leave_soonest() {
        constexpr double kSameWay = 0.9; // 26 degrees
        std::vector<CurvedSeed>& seeds = memory_.found.seeds;
        const auto leaves_late = [&](const CurvedSeed& seed) {
            return std::any_of(seeds.begin(), seeds.end(), [&](const CurvedSeed& shorter) {
                return shorter.body == seed.body && shorter.depth >= -bounds_.rounding &&
                       shorter.depth < seed.depth && dot(shorter.up, seed.up) < kSameWay;
            });
        };
        memory_.kept.clear();
        std::copy_if(seeds.begin(), seeds.end(), std::back_inserter(memory_.kept),
                     [&](const CurvedSeed& seed) { return !leaves_late(seed); });
        seeds.swap(memory_.kept);
    }

    /// The deepest first; of directions that are as deep but for rounding, in the order of the triangles.
    void sort() {
        const auto& seeds = memory_.found.seeds;
        memory_.order.resize(seeds.size());
        std::iota(memory_.order.begin(), memory_.order.end(), 0U);
        std::stable_sort(
            memory_.order.begin(), memory_.order.end(),
            [&](std::uint32_t i, std::uint32_t k) { return seeds[i].depth > seeds[k].depth; });
    }

    /// Adds the places of a seed to the manifold with nearly its normal, or to a new one.
    void add(const CurvedSeed& seed) {
        constexpr double kSameNormal = 0.966; // 15 degrees
        std::size_t k = 0;
        while (k < memory_.normals.size() && !(dot(memory_.normals[k], seed.up) > kSameNormal))
            ++k;
        if (k == memory_.normals.size()) {
            memory_.normals.push_back(seed.up);
            memory_.groups.emplace_back();
        }
        const Vec3& up = memory_.normals[k];
        for (std::uint32_t i = seed.begin; i < seed.end; ++i) {
            CurvedPlace place = memory_.found.places[i];
            if (up != seed.up && !turn(place, up))
                continue;
            if (place.depth >= -bounds_.margin - bounds_.rounding)
                add_once(memory_.groups[k], place);
        }
    }

    /// Measures a place along another direction: from its point on the surface, or, where the line misses the
    /// solid, as at a rim, from its point on the solid. Returns whether the other end is found.
    [[nodiscard]] bool turn(CurvedPlace& place, const Vec3& up) const {
        if (const auto inside = part_inside(solid_, place.on_surface, up)) {
            place.depth = -inside->begin;
            place.on_solid = place.on_surface + inside->begin * up;
            return true;
        }
        std::optional<CurvedPlace> nearest;
        for (const NearTriangle& t : memory_.patch.triangles()) {
            constexpr double kUpright = 0.1;
            if (!(dot(t.normal, up) > kUpright))
                continue;
            const auto foot = foot_on(t, place.on_solid, up, bounds_.rounding);
            const double depth = foot ? dot(up, *foot - place.on_solid) : 0;
            if (foot && (!nearest ||
                         std::abs(depth - place.depth) < std::abs(nearest->depth - place.depth)))
                nearest = CurvedPlace{*foot, place.on_solid, depth, place.feature, t.triangle};
        }
        if (nearest)
            place = *nearest;
        return nearest.has_value();
    }

    /// Of places with one name, the deepest remains.
    static void add_once(std::vector<CurvedPlace>& places, const CurvedPlace& place) {
        for (CurvedPlace& known : places)
            if (known.feature == place.feature) {
                if (place.depth > known.depth)
                    known = place;
                return;
            }
        places.push_back(place);
    }

    const SupportShape& solid_;
    const PatchBounds& bounds_;
    CurvedMemory& memory_;
};

/// Writes four of the places of a manifold.
///
/// In          centre: of the solid.
ModelManifold manifold_of(const std::vector<CurvedPlace>& places, const Vec3& up,
                          const Vec3& centre, bool solid_is_a, bool is_smooth,
                          const PatchBounds& bounds, std::span<const std::uint64_t> last) {
    // The frame is the same whichever body comes first.
    const ContactFrame frame({}, up);
    std::vector<RegionPoint> points;
    for (const CurvedPlace& place : places) {
        const Vec3 at = frame.coordinates(place.on_solid);
        points.push_back(
            {at.x, at.y, place.depth, solid_is_a ? place.feature : turned_round(place.feature)});
    }
    ModelManifold m;
    m.normal = solid_is_a ? -up : up;
    m.status = Status::bound_only;
    for (const std::size_t i : four_points(points, bounds.rounding, last)) {
        const CurvedPlace& place = places[i];
        ContactPoint& point = m.points.at(m.count++);
        const Vec3 on_surface = centre + place.on_surface, on_solid = centre + place.on_solid;
        point.point_a = solid_is_a ? on_solid : on_surface;
        point.point_b = solid_is_a ? on_surface : on_solid;
        point.depth = std::max(place.depth, -bounds.margin);
        point.feature = points[i].feature;
        (solid_is_a ? point.triangle_b : point.triangle_a) = place.triangle;
    }
    // The one point of a smooth body keeps its name while it goes over triangles and their edges.
    if (m.count == 1 && is_smooth)
        m.points[0].feature = 0;
    return m;
}

} // namespace

std::optional<double> add_curved_on_surface(const SupportShape& solid, const Model& surface,
                                            const Transform& world_from_surface, bool solid_is_a,
                                            double margin, std::span<const std::uint64_t> last,
                                            std::vector<ModelManifold>& manifolds) {
    const Solid& bounded = surface.data().solid();
    if (!has_curved_side(solid) || (bounded.closed && bounded.outward == 0))
        return std::nullopt;
    static thread_local CurvedMemory kept;
    Borrowed<CurvedMemory> borrowed(kept);
    CurvedMemory& memory = *borrowed;
    const PlacedModel placed(surface, world_from_surface, solid.centre);
    const int facing = !bounded.closed                ? 0
                       : is_mirroring(placed.world()) ? -bounded.outward
                                                      : bounded.outward;
    const PatchBounds bounds{margin,
                             0x1p-48 * (sum_of_sizes(solid.centre) + solid.reach + placed.reach())};
    if (!memory.patch.collect(solid, placed, facing, bounds))
        return std::nullopt;
    SupportShape at_origin = solid;
    at_origin.centre = {};
    find_seeds(at_origin, memory.patch, bounds, memory.found);
    CurvedManifolds(at_origin, bounds, memory).group();
    for (std::size_t k = 0; k < memory.groups.size(); ++k)
        if (!memory.groups[k].empty())
            manifolds.push_back(manifold_of(memory.groups[k], memory.normals[k], solid.centre,
                                            solid_is_a, solid.kind == CoreKind::ellipsoid, bounds,
                                            last));
    return bounds.rounding;
}

} // namespace abut
