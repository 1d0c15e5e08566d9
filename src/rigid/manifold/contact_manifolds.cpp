#include <abut/error.h>
#include <abut/model_contacts.h>
#include <abut/penetration.h>

#include "core/arguments.h"
#include "geometry/triangle_triangle_distance.h"
#include "rigid/manifold/meeting_regions.h"
#include "rigid/manifold/region_frame.h"
#include "rigid/manifold/region_names.h"
#include "rigid/manifold/region_points.h"
#include "rigid/manifold/surface_manifolds.h"
#include "rigid/manifold/touching_direction.h"
#include "rigid/manifold/triangle_meeting.h"
#include "rigid/pair/separating_plane.h"
#include "rigid/solid/containment.h"
#include "rigid/solid/placed_solid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

namespace abut {

namespace {

/// Memory that a thread uses again for its next pair.
struct ManifoldMemory {
    TriangleMeetings meetings;
    MeetingRegions regions;
    std::vector<std::uint32_t> part;
    std::vector<TriangleMeeting> one_part, facing;
    std::vector<RegionFrame> frames; ///< of the parts

    /// Frees what one huge pair has needed.
    void trim() {
        constexpr std::size_t kMostKept = 1U << 14U;
        if (meetings.all.capacity() > kMostKept || meetings.points.capacity() > 4 * kMostKept ||
            meetings.faces.capacity() > 2 * kMostKept)
            meetings = {}, regions = {}; // the regions keep a list as long
        if (part.capacity() > kMostKept || one_part.capacity() > kMostKept ||
            facing.capacity() > kMostKept)
            part = {}, one_part = {}, facing = {};
    }
};

/// Whether the tree's box of `outer` holds a vertex of some component of `inner`.
bool may_hold_component(const PlacedSolid& outer, const PlacedSolid& inner) {
    const PlacedModel& model = outer.model();
    const Aabb& box = model.data().tree().bounds;
    const auto& components = inner.solid().components;
    return outer.bounds_solid() &&
           std::any_of(components.begin(), components.end(), [&](std::uint32_t t) {
               const Vec3 p = apply(model.tree_from_world(), inner.world_triangle(t)[0]);
               const auto within = [&](double x, std::size_t axis) {
                   const double low = double{box.lower[axis]}, high = double{box.upper[axis]};
                   // A point in the solid is farther than rounding from the box's sides, or near
                   // enough to the surface to be found there.
                   return low <= x && x <= high;
               };
               return within(p.x, 0) && within(p.y, 1) && within(p.z, 2);
           });
}

Depth depth_of(const Model& a, const Transform& world_from_a, const Model& b,
               const Transform& world_from_b) {
    PenetrationOptions options;
    options.separation = false;
    return penetration(a, world_from_a, b, world_from_b, options);
}

/// The manifold with the one point of a region that `penetration` found.
ModelManifold manifold_of(const ContactRegion& region) {
    ModelManifold m;
    m.normal = region.direction != Vec3{} ? region.direction : Vec3{0, 0, 1};
    m.count = 1;
    m.points[0] = {region.point_a, region.point_b, region.depth, point_name::kMiddle};
    m.status = Status::bound_only;
    return m;
}

/// The manifold of a solid inside the other, if there is one; their surfaces do not meet.
std::vector<ModelManifold> contained_manifold(const Model& a, const Transform& world_from_a,
                                              const Model& b, const Transform& world_from_b) {
    std::vector<ModelManifold> manifolds;
    const PlacedSolid side_a(a, a.data().solid(), world_from_a),
        side_b(b, b.data().solid(), world_from_b);
    const auto inside = [](const PlacedSolid& inner, const PlacedSolid& outer) {
        return may_hold_component(outer, inner) && any_component_inside(inner, outer);
    };
    if (!inside(side_b, side_a) && !inside(side_a, side_b))
        return manifolds;
    for (const ContactRegion& region : depth_of(a, world_from_a, b, world_from_b).regions)
        manifolds.push_back(manifold_of(region));
    return manifolds;
}

class ManifoldFinder {
public:
    ManifoldFinder(const PlacedPair& pair, const Model& a, const Model& b, const Vec3& origin,
                   const ManifoldOptions& options)
        : pair_(pair), model_a_(a), model_b_(b), origin_(origin), margin_(options.margin),
          a_(a, pair.world_from_a(), origin), b_(b, pair.world_from_b(), origin) {
        if (options.last == nullptr)
            return;
        last_names_.reserve(4 * options.last->size());
        for (const ModelManifold& m : *options.last)
            for (std::uint32_t i = 0; i < m.count; ++i)
                last_names_.push_back(m.points[i].feature);
    }

    std::vector<ModelManifold> find(const MeetingPairs& pairs) {
        static thread_local ManifoldMemory memory;
        describe_meetings(pair_, a_, b_, pairs, margin_, memory.meetings);
        memory.regions.group(memory.meetings);
        const std::span<const TriangleMeeting> all(memory.meetings.all);
        for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
            poll_stop();
            while (end < all.size() && all[end].region == all[begin].region)
                ++end;
            add_region(without_beside(all.subspan(begin, end - begin), memory.facing), memory);
        }
        nearest_ = memory.meetings.nearest;
        nearest_gap_ = std::sqrt(memory.meetings.nearest_sq);
        memory.trim();
        // The outer border of a ring stands for the inner one too.
        return std::move(manifolds_.empty() ? holes_ : manifolds_);
    }
    /// The nearest pair of triangles that are only near, and its distance: infinite if there is none.
    [[nodiscard]] const TrianglePair& nearest() const { return nearest_; }
    [[nodiscard]] double nearest_gap() const { return nearest_gap_; }
    /// A depth or gap of at most this may be rounding.
    [[nodiscard]] double slight_depth() const {
        constexpr double kSlightDepth = 16; // roundings
        return kSlightDepth * rounding_of_places(a_, b_);
    }

private:
    /// A region without faces around the corner, unless it has no others, or only such a face is as near
    /// as the nearest.
    static std::span<const TriangleMeeting> without_beside(std::span<const TriangleMeeting> region,
                                                           std::vector<TriangleMeeting>& facing) {
        const auto is_beside = [](const TriangleMeeting& m) { return m.is_beside; };
        if (std::none_of(region.begin(), region.end(), is_beside))
            return region;
        facing.clear();
        std::remove_copy_if(region.begin(), region.end(), std::back_inserter(facing), is_beside);
        const auto nearest = [](std::span<const TriangleMeeting> of) {
            double weight = 0;
            for (const TriangleMeeting& m : of)
                weight = std::max(weight, m.weight);
            return weight;
        };
        constexpr double kNearer = 1 + 0x1p-20;
        const bool keeps_nearest =
            !facing.empty() &&
            (!facing.front().is_gap() || nearest(region) <= kNearer * nearest(facing));
        return keeps_nearest ? std::span<const TriangleMeeting>(facing) : region;
    }

    /// The pairs of a region that meet; all of them if none does.
    static std::span<const TriangleMeeting> deciding(std::span<const TriangleMeeting> region) {
        const auto gap = std::find_if(region.begin(), region.end(),
                                      [](const TriangleMeeting& m) { return m.is_gap(); });
        const auto meeting = static_cast<std::size_t>(gap - region.begin());
        return meeting > 0 ? region.first(meeting) : region;
    }

    /// Adds a region. Pairs that are only near give points to what meets, and change nothing else.
    void add_region(std::span<const TriangleMeeting> region, ManifoldMemory& memory) {
        const std::span<const TriangleMeeting> decides = deciding(region);
        const RegionFrame frame = region_frame(a_, b_, decides, true);
        if ((frame.only_touches || frame.is_flush) && (a_.is_oriented() || b_.is_oriented()) &&
            add_doubtful(region, frame, memory.meetings))
            return;
        const std::uint32_t parts = split_where_hollow(decides, memory.part);
        if (parts == 1 || frame.is_hole) {
            add(region, memory.meetings, frame);
            return;
        }
        memory.frames.assign(parts, {});
        for (std::uint32_t k = 0; k < parts; ++k)
            if (take_part(decides, k, memory))
                memory.frames[k] = region_frame(a_, b_, memory.one_part, false);
        for (std::uint32_t k = 0; k < parts; ++k) {
            if (!take_part(decides, k, memory))
                continue;
            for (const TriangleMeeting& m : region.subspan(decides.size()))
                if (part_of_gap(m, memory.frames) == k)
                    memory.one_part.push_back(m);
            add(memory.one_part, memory.meetings, memory.frames[k]);
        }
    }
    /// Sets the meetings of one part. Returns whether there are any.
    static bool take_part(std::span<const TriangleMeeting> region, std::uint32_t part,
                          ManifoldMemory& memory) {
        memory.one_part.clear();
        for (std::size_t i = 0; i < region.size(); ++i)
            if (memory.part[i] == part)
                memory.one_part.push_back(region[i]);
        return !memory.one_part.empty();
    }
    /// The part whose normal is nearest to a gap's direction.
    static std::uint32_t part_of_gap(const TriangleMeeting& m,
                                     const std::vector<RegionFrame>& frames) {
        const auto along = [&](const RegionFrame& f) { return dot(f.normal, m.to - m.from); };
        return static_cast<std::uint32_t>(
            std::max_element(
                frames.begin(), frames.end(),
                [&](const RegionFrame& f, const RegionFrame& g) { return along(f) < along(g); }) -
            frames.begin());
    }

    /// Adds a region whose normal is in doubt: equal boxes, of which one is stacked a little inside
    /// the other, touch at their sides, or cross along rounding noise. Returns false, and adds
    /// nothing, if the interiors do not overlap, or if the frame agrees with what `penetration`
    /// finds.
    bool add_doubtful(std::span<const TriangleMeeting> region, const RegionFrame& frame,
                      const TriangleMeetings& meetings) {
        if (!depth_) {
            depth_ = depth_of(model_a_, pair_.world_from_a(), model_b_, pair_.world_from_b());
            depth_used_.assign(depth_->regions.size(), false);
        }
        // A depth that may be rounding tells no direction.
        if (!depth_->interpenetrate || !(depth_->depth > slight_depth()))
            return false;
        const std::optional<std::size_t> k = deepest_of(region);
        if (k) {
            const ContactRegion& found = depth_->regions[*k];
            if (frame.crosses && !frame.is_hole && agrees(region, meetings, frame, found))
                return false;
            if (!depth_used_[*k] &&
                !add_along(found.direction, region, meetings, frame, found.depth))
                manifolds_.push_back(manifold_of(found));
            depth_used_[*k] = true;
            return true;
        }
        if (frame.only_touches)
            add(region, meetings, frame, Status::bound_only);
        return frame.only_touches;
    }

    /// Adds a region with another normal, where several points along it are as deep as it should be. Returns
    /// false, and adds nothing, if they are not.
    bool add_along(const Vec3& normal, std::span<const TriangleMeeting> region,
                   const TriangleMeetings& meetings, const RegionFrame& frame, double depth) {
        constexpr double kSameDepth = 0x1p-10;
        RegionFrame along = frame;
        along.normal = normal, along.across = perpendicular(normal);
        along.upwards = cross(normal, along.across);
        along.is_given = true, along.is_hole = false;
        const ModelManifold m =
            choose_points(a_, b_, region, meetings, along, {margin_, last_names_});
        if (m.count < 2 || std::abs(m.points[0].depth - depth) > kSameDepth * depth)
            return false;
        add(m, Status::bound_only, manifolds_);
        return true;
    }

    /// The deepest region of depth_ that shares a triangle pair with a region; none if the
    /// depths of all of those may be rounding.
    [[nodiscard]] std::optional<std::size_t>
    deepest_of(std::span<const TriangleMeeting> region) const {
        std::optional<std::size_t> best;
        for (std::size_t k = 0; k < depth_->regions.size(); ++k) {
            const ContactRegion& found = depth_->regions[k];
            if (found.depth > (best ? depth_->regions[*best].depth : slight_depth()) &&
                found.direction != Vec3{} &&
                std::any_of(region.begin(), region.end(), [&](const TriangleMeeting& m) {
                    return std::binary_search(found.pairs.begin(), found.pairs.end(), m.pair);
                }))
                best = k;
        }
        return best;
    }

    /// Whether the frame's normal is near the direction of a region that `penetration` found, and
    /// points of about its depth are found along that normal.
    [[nodiscard]] bool agrees(std::span<const TriangleMeeting> region,
                              const TriangleMeetings& meetings, const RegionFrame& frame,
                              const ContactRegion& found) const {
        constexpr double kLeastCos = 0.5, kLeastDepth = 0.5;
        return dot(frame.normal, found.direction) > kLeastCos &&
               choose_points(a_, b_, region, meetings, frame, {margin_, last_names_})
                       .points[0]
                       .depth > kLeastDepth * found.depth;
    }

    void add(std::span<const TriangleMeeting> region, const TriangleMeetings& meetings,
             const RegionFrame& frame, Status at_best = Status::exact) {
        add(choose_points(a_, b_, region, meetings, frame, {margin_, last_names_}), at_best,
            frame.is_hole ? holes_ : manifolds_);
    }
    void add(ModelManifold m, Status at_best, std::vector<ModelManifold>& to) const {
        for (std::uint32_t i = 0; i < m.count; ++i) {
            m.points[i].point_a = m.points[i].point_a + origin_;
            m.points[i].point_b = m.points[i].point_b + origin_;
        }
        if (at_best == Status::bound_only)
            m.status = at_best;
        to.push_back(m);
    }

    const PlacedPair& pair_;
    const Model& model_a_;
    const Model& model_b_;
    Vec3 origin_;
    double margin_;
    ManifoldSide a_, b_;
    std::vector<std::uint64_t> last_names_;
    std::vector<ModelManifold> manifolds_, holes_;
    TrianglePair nearest_;
    double nearest_gap_ = HUGE_VAL;
    std::optional<Depth> depth_;   ///< computed when a region needs it
    std::vector<bool> depth_used_; ///< the regions of depth_ that have a manifold
};

/// The least gap of the points of manifolds.
double least_gap(const std::vector<ModelManifold>& manifolds) {
    double least = HUGE_VAL;
    for (const ModelManifold& m : manifolds)
        for (std::uint32_t i = 0; i < m.count; ++i)
            least = std::min(least, -m.points[i].depth);
    return least;
}

/// The manifold of the nearest pair of triangles. A solid inside the other looks at the back of its
/// faces, which have no region in common with it.
ModelManifold manifold_of_nearest(const PlacedPair& placed, const TrianglePair& pair) {
    const ClosestPoints nearest =
        triangle_triangle_distance(placed.triangle_a(pair.a), placed.triangle_b(pair.b));
    ModelManifold m;
    m.normal = normalized_or_zero(nearest.b - nearest.a);
    if (m.normal == Vec3{})
        m.normal = {0, 0, 1};
    m.count = 1;
    m.points[0] = {nearest.a,           nearest.b, -std::sqrt(nearest.distance_sq),
                   point_name::kMiddle, pair.a,    pair.b};
    m.status = Status::bound_only;
    return m;
}

/// Leaves out the pairs of triangles that are copies of others: piles of copies meet in as many pairs
/// as the product of their heights. Does nothing for few pairs; those that meet and those that are only
/// near are counted apart, so that a margin changes nothing that meets.
///
/// Cost        the first time for a model, that of slot_copies.
void leave_out_copies(const Model& a, const Model& b, MeetingPairs& pairs) {
    constexpr std::size_t kManyPairs = 4096;
    const bool many_meet = pairs.meeting.size() >= kManyPairs,
               many_are_near = pairs.near.size() >= kManyPairs;
    if (!many_meet && !many_are_near)
        return;
    const auto copies_of = [](const ModelData& data) {
        const std::vector<bool>& by_slot = data.slot_copies();
        std::vector<bool> copies(by_slot.size());
        for (std::uint32_t slot = 0; slot < by_slot.size(); ++slot)
            if (by_slot[slot])
                copies[data.triangle_at(slot)] = true;
        return copies;
    };
    const std::vector<bool> of_a = copies_of(a.data()), of_b = copies_of(b.data());
    const auto is_in = [](const std::vector<bool>& copies, std::uint32_t triangle) {
        return !copies.empty() && copies[triangle];
    };
    if (of_a.empty() && of_b.empty())
        return;
    const auto is_copy = [&](const TrianglePair& p) {
        return is_in(of_a, p.a) || is_in(of_b, p.b);
    };
    if (many_meet)
        std::erase_if(pairs.meeting, [&](const Contact& c) { return is_copy(c.pair); });
    if (many_are_near)
        std::erase_if(pairs.near, is_copy);
}

/// Tells what counts as contact of a solid inside the other one, where the surfaces share no point.
enum class Inside : std::uint8_t { apart, in_contact };

std::vector<ModelManifold> manifolds_of(const Model& a, const Transform& world_from_a,
                                        const Model& b, const Transform& world_from_b,
                                        const ManifoldOptions& options, Inside inside) {
    require_not_negative(options.margin, "margin");
    require(std::isfinite(options.margin), "margin must be finite");
    const StopScope stopping(options.progress);
    if (far_apart(a.data(), world_from_a, b.data(), world_from_b, options.margin))
        return {};
    const PlacedPair pair(a, world_from_a, b, world_from_b);
    if (pair.world_from_a() != world_from_a || pair.world_from_b() != world_from_b)
        // A transform was flattened: the pair holds copies of the meshes in world coordinates.
        return manifolds_of(Model(pair.a().mesh()), {}, Model(pair.b().mesh()), {}, options,
                            inside);
    MeetingPairs pairs = meeting_pairs(pair, options.margin);
    leave_out_copies(a, b, pairs);
    std::vector<ModelManifold> manifolds;
    if (inside == Inside::in_contact && pairs.meeting.empty())
        manifolds = contained_manifold(a, world_from_a, b, world_from_b);
    if (manifolds.empty() && !(pairs.meeting.empty() && pairs.near.empty())) {
        const TrianglePair& any =
            pairs.meeting.empty() ? pairs.near.front() : pairs.meeting.front().pair;
        ManifoldFinder finder(pair, a, b, pair.triangle_a(any.a)[0], options);
        manifolds = finder.find(pairs);
        // Faces that look away have no region, also where they are the nearest ones.
        const double nearest = finder.nearest_gap();
        if (nearest < HUGE_VAL && inside == Inside::apart && pairs.meeting.empty() &&
            !(least_gap(manifolds) <= (1 + 0x1p-20) * (nearest + finder.slight_depth())))
            manifolds.push_back(manifold_of_nearest(pair, finder.nearest()));
    }
    name_regions(manifolds, options.last);
    return manifolds;
}

} // namespace

std::vector<ModelManifold> contact_manifolds(const Model& a, const Transform& world_from_a,
                                             const Model& b, const Transform& world_from_b,
                                             const ManifoldOptions& options) {
    return manifolds_of(a, world_from_a, b, world_from_b, options, Inside::in_contact);
}

std::vector<ModelManifold> surface_manifolds(const Model& a, const Transform& world_from_a,
                                             const Model& b, const Transform& world_from_b,
                                             const ManifoldOptions& options) {
    return manifolds_of(a, world_from_a, b, world_from_b, options, Inside::apart);
}

} // namespace abut
