#include <abut/error.h>
#include <abut/penetration.h>

#include "core/arguments.h"
#include "geometry/triangle_triangle_distance.h"
#include "rigid/penetration/contact_evidence.h"
#include "rigid/penetration/contact_regions.h"
#include "rigid/penetration/local_penetration.h"
#include "rigid/penetration/separation_search.h"
#include "rigid/solid/containment.h"

#include <algorithm>
#include <limits>

namespace abut {

namespace {

/// Two placed models, their contacts, and the components of each that lie inside the other.
class Overlap {
public:
    Overlap(const PlacedSolid& a, const PlacedSolid& b, std::vector<Contact> contacts,
            const DepthSearch& options)
        : a_(a), b_(b), contacts_(std::move(contacts)), options_(options) {
        std::sort(contacts_.begin(), contacts_.end(),
                  [](const Contact& c, const Contact& d) { return c.pair < d.pair; });
        std::vector<std::uint32_t> of_a, of_b;
        for (const Contact& c : contacts_) {
            of_a.push_back(c.pair.a);
            of_b.push_back(c.pair.b);
        }
        inside_b_ = contained_triangles(a, b, of_a);
        inside_a_ = contained_triangles(b, a, of_b);
    }

    Depth describe() {
        Depth result;
        const bool contains = !inside_b_.empty() || !inside_a_.empty();
        result.interpenetrate = contains;
        if (!contacts_.empty()) {
            meeting_ = examine_meeting(a_, b_, contacts_);
            result.interpenetrate |= meeting_.interpenetrate;
            add_regions(result);
        }
        if (contains)
            result.regions.push_back(contained_region());
        for (const ContactRegion& r : result.regions) {
            result.depth_at_most = std::max(result.depth_at_most, r.depth_at_most);
            if (r.depth <= result.depth)
                continue;
            result.depth = r.depth;
            result.direction = r.direction, result.point_a = r.point_a, result.point_b = r.point_b;
        }
        const bool ran_out = options_.steps->ran_out();
        if (!ran_out && meeting_.interpenetrate && result.depth == 0)
            set_locked(result);
        else if (ran_out || result.depth_at_most > result.depth + 2 * rounding_)
            result.status = Status::bound_only;
        // A motion of another length may separate open shells, and locked models.
        if (locked_ || (result.depth > 0 && !a_.bounds_solid() && !b_.bounds_solid()))
            result.status = Status::bound_only;
        return result;
    }

    /// Directions along which b may separate soon: those of the regions, deepest first, and their
    /// normals.
    [[nodiscard]] std::vector<Vec3> ways_out(const Depth& depth) const {
        constexpr std::size_t kRegions = 16;
        std::vector<const ContactRegion*> regions;
        for (const ContactRegion& r : depth.regions)
            regions.push_back(&r);
        std::stable_sort(regions.begin(), regions.end(),
                         [](const auto* r, const auto* s) { return r->depth > s->depth; });
        regions.resize(std::min(regions.size(), kRegions));
        std::vector<Vec3> ways{meeting_.parting};
        Vec3 mean;
        for (const ContactRegion* r : regions) {
            ways.push_back(r->direction);
            ways.push_back(r->normal);
            mean = mean + r->area * r->normal;
        }
        ways.push_back(normalized_or_zero(mean));
        return ways;
    }

    /// Returns whether the depth is the length of a separating motion, since neither surface
    /// reaches inside the other.
    [[nodiscard]] bool is_locked() const { return locked_; }

private:
    void set_locked(Depth& result) {
        locked_ = true;
        const LocalPenetration p = locked_depth(a_, b_, contacts_);
        result.depth = p.depth;
        result.depth_at_most = std::max(result.depth_at_most, p.depth);
        result.direction = p.direction, result.point_a = p.point_a, result.point_b = p.point_b;
    }

    void add_regions(Depth& result) {
        const std::vector<RegionContacts> regions = find_regions(a_, b_, contacts_);
        const RegionCells cells(regions);
        for (std::uint32_t i = 0; i < regions.size(); ++i) {
            SurfacePart part;
            part.cells = regions.size() > 1 ? &cells : nullptr;
            part.region = i;
            result.regions.push_back(region(regions[i], part));
        }
    }

    [[nodiscard]] static SurfacePart without(SurfacePart part, const std::vector<bool>& contained) {
        part.contained = contained.empty() ? nullptr : &contained;
        return part;
    }

    [[nodiscard]] ContactRegion region(const RegionContacts& region, const SurfacePart& part) {
        ContactRegion result;
        for (const Contact& c : region.contacts)
            result.pairs.push_back(c.pair);
        if (meeting_.interpenetrate)
            set_depth(result,
                      local_penetration(a_, b_, region.contacts, options_, without(part, inside_b_),
                                        without(part, inside_a_)));
        const bool crosses =
            std::any_of(region.contacts.begin(), region.contacts.end(),
                        [](const Contact& c) { return c.kind == TriangleContact::cross; });
        result.touching = !crosses && result.depth == 0;
        if (result.touching) {
            const TouchingArea touching = touching_area(a_, region);
            result.area = touching.area;
            result.normal = normalized_or_zero(touching.weighted_normal);
        } else {
            const Vec3 enclosed = enclosed_area(a_, b_, region);
            result.area = length(enclosed);
            result.normal = normalized_or_zero(enclosed);
        }
        if (result.depth == 0) {
            const TrianglePair& pair = result.pairs.front();
            const ClosestPoints common =
                triangle_triangle_distance(a_.world_triangle(pair.a), b_.world_triangle(pair.b));
            result.point_a = common.a, result.point_b = common.b;
        }
        return result;
    }

    [[nodiscard]] ContactRegion contained_region() {
        ContactRegion result;
        // A surface without contained components contributes no triangles.
        const std::vector<bool> none_of_a(a_.model().data().mesh().triangles.size()),
            none_of_b(b_.model().data().mesh().triangles.size());
        const auto part = [](const std::vector<bool>& contained, const std::vector<bool>& none) {
            SurfacePart p;
            p.contained = contained.empty() ? &none : &contained;
            p.in_contained = true;
            return p;
        };
        set_depth(result, local_penetration(a_, b_, {}, options_, part(inside_b_, none_of_a),
                                            part(inside_a_, none_of_b)));
        return result;
    }

    void set_depth(ContactRegion& region, const LocalPenetration& p) {
        region.depth = p.depth, region.depth_at_most = p.at_most + p.rounding;
        rounding_ = std::max(rounding_, p.rounding);
        region.point_a = p.point_a, region.point_b = p.point_b;
        region.direction = p.direction;
    }

    const PlacedSolid& a_;
    const PlacedSolid& b_;
    std::vector<Contact> contacts_;
    const DepthSearch& options_;
    std::vector<bool> inside_b_, inside_a_; ///< triangles of a, of b; empty if none
    Meeting meeting_;
    double rounding_ = 0; ///< the margin by which the depths' bounds are proven
    bool locked_ = false;
};

/// Limits the bounds of depths by the length of a translation that separates.
void limit_depths(Depth& result, const Vec3& separation) {
    if (separation == Vec3{})
        return;
    const double most = length(separation) * (1 + 0x1p-50);
    result.depth_at_most = std::min(result.depth_at_most, most);
    for (ContactRegion& region : result.regions)
        region.depth_at_most = std::min(region.depth_at_most, most);
}

/// The answer if the steps ended before all contacts were found: the bounds that the boxes give.
Depth undecided(const PlacedSolid& a, const PlacedSolid& b, const PenetrationOptions& options,
                const SearchSteps& steps, Counters& counters) {
    const Vec3 separation = separation_of_boxes(a, b, counters);
    Depth result;
    result.meet = result.interpenetrate = true;
    result.depth_at_most = std::numeric_limits<double>::infinity();
    limit_depths(result, separation);
    if (options.separation)
        result.separation = separation;
    result.status = Status::bound_only;
    result.out_of_steps = true;
    result.steps = steps.count();
    result.counters = counters;
    return result;
}

} // namespace

Depth penetration(const Model& a, const Transform& world_from_a, const Model& b,
                  const Transform& world_from_b, const PenetrationOptions& options) {
    require_not_negative(options.relative_error, "relative error");
    const StopScope stopping(options.progress);
    const PlacedPair pair(a, world_from_a, b, world_from_b);
    if (pair.world_from_a() != world_from_a || pair.world_from_b() != world_from_b)
        // A transform was flattened: the pair holds copies of the meshes in world coordinates.
        return penetration(Model(pair.a().mesh()), {}, Model(pair.b().mesh()), {}, options);
    Counters counters;
    SearchSteps steps(options.max_steps.value_or(std::numeric_limits<std::uint64_t>::max()));
    std::vector<Contact> contacts = find_contacts(pair, ContactMode::all, counters, &steps);
    const PlacedSolid placed_a(a, a.data().solid(), world_from_a),
        placed_b(b, b.data().solid(), world_from_b);
    if (steps.ran_out())
        return undecided(placed_a, placed_b, options, steps, counters);
    DepthSearch search;
    search.relative_error = options.relative_error;
    search.steps = &steps;
    Overlap overlap(placed_a, placed_b, std::move(contacts), search);
    Depth result = overlap.describe();
    result.meet = !result.regions.empty() || result.interpenetrate;
    if (options.separation && result.meet)
        result.separation =
            find_separation(placed_a, placed_b, overlap.ways_out(result),
                            overlap.is_locked() ? 0 : result.depth, counters, &steps);
    if (steps.ran_out()) {
        result.out_of_steps = true;
        limit_depths(result, options.separation
                                 ? result.separation
                                 : separation_of_boxes(placed_a, placed_b, counters));
    }
    result.steps = steps.count();
    result.counters = counters;
    return result;
}

} // namespace abut
