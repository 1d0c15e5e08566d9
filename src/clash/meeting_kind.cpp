#include "clash/meeting_kind.h"

#include "clash/blocks_pair.h"
#include "geometry/triangle_triangle_distance.h"
#include "math/point_order.h"
#include "rigid/tolerance/overlap_within.h"
#include "rigid/tolerance/sheets_cross.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <vector>

namespace abut {

namespace {

/// Samples of each surface for a first depth.
constexpr int kSamples = 8;

/// Directions along which the parts are likely to overlap little: the axes, and the normals of some
/// faces in contact.
std::vector<Vec3> likely_directions(const WorldSolid& a, const WorldSolid& b,
                                    std::span<const Contact> contacts) {
    constexpr std::size_t kContacts = 3;
    std::vector<Vec3> directions{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::size_t count = std::min(kContacts, contacts.size());
    for (std::size_t i = 0; i < count; ++i) {
        const TrianglePair& pair = contacts[i * contacts.size() / count].pair;
        for (const Triangle& t : {a.world_triangle(pair.a), b.world_triangle(pair.b)})
            directions.push_back(cross(t[1] - t[0], t[2] - t[0]));
    }
    return directions;
}

/// The depth at a surface point of one part that lies in or beyond the other one.
LocalPenetration depth_at(const WorldSolid& a, const WorldSolid& b, const Vec3& point) {
    const double anywhere = std::numeric_limits<double>::infinity();
    const WorldSolid::Nearest on_a = a.nearest(point, anywhere), on_b = b.nearest(point, anywhere);
    LocalPenetration p;
    p.depth = std::max(on_a.distance, on_b.distance);
    p.at_most = std::numeric_limits<double>::infinity();
    p.point_a = on_a.point, p.point_b = on_b.point;
    p.direction = normalized_or_zero(p.point_a - p.point_b);
    p.triangles = {a.triangle_at(on_a.slot), b.triangle_at(on_b.slot)};
    return p;
}

/// The diameter of a ball in both parts as a depth, with the points of both surfaces nearest to its
/// middle.
LocalPenetration thickness_at(const WorldSolid& a, const WorldSolid& b, const Vec3& middle) {
    LocalPenetration p = depth_at(a, b, middle);
    const double to_a = length(p.point_a - middle), to_b = length(p.point_b - middle);
    p.depth = 2 * std::min(to_a, to_b);
    p.direction = normalized_or_zero(to_a < to_b ? p.point_a - middle : middle - p.point_b);
    return p;
}

/// Replaces a depth by a larger one. What is proven about the depth in solids stays.
void replace(LocalPenetration& depth, const LocalPenetration& larger) {
    const double at_most = depth.at_most, rounding = depth.rounding;
    depth = larger;
    depth.at_most = at_most, depth.rounding = rounding;
}

/// Makes a depth in a solid accurate, to 2^-20, unless the search takes too long. A depth that is a small
/// part of the touch tolerance or, without one, of the parts' size is not searched for.
void deepen(const WorldSolid& a, const WorldSolid& b, std::span<const Contact> contacts,
            double touch, LocalPenetration& depth) {
    constexpr double kPartOfTouch = 0x1p-7, kPartOfSize = 0x1p-23;
    constexpr std::uint32_t kPieces = 4096; // 20,000 take a quarter of a hospital's time
    const double size = std::min(a.world_size(), b.world_size()),
                 least = touch > 0 ? kPartOfTouch * touch : kPartOfSize * size;
    const std::vector<Vec3> directions = likely_directions(a, b, contacts);
    const SolidDepth found = solid_depth(a, b, {least, kPieces, directions}, depth.depth);
    if (found.depth > depth.depth)
        replace(depth, depth_at(a, b, found.point));
    depth.at_most = std::min(depth.at_most, found.at_most);
}

/// Decides whether two parts, one of them a solid, go at most `touch` into each other. If not, `depth`
/// becomes larger than that.
Proof overlaps_at_most(const WorldSolid& a, const WorldSolid& b, std::span<const Contact> contacts,
                       double touch, LocalPenetration& depth) {
    if (depth.depth > touch + rounding_of_lengths(a, b))
        return Proof::fails;
    const std::vector<Vec3> directions = likely_directions(a, b, contacts);
    if (extents_overlap_little(a, b, directions, touch))
        return Proof::holds;
    const ToleranceSearch search{.tolerance = touch, .directions = directions};
    Vec3 found;
    const Proof shallow =
        depth.at_most <= touch ? Proof::holds : nowhere_deeper(a, b, search, &found);
    if (shallow == Proof::fails)
        replace(depth, depth_at(a, b, found));
    if (shallow == Proof::fails || !a.bounds_solid() || !b.bounds_solid())
        return shallow;
    const Proof thin = nowhere_thicker(a, b, search, &found);
    if (thin == Proof::fails)
        replace(depth, thickness_at(a, b, found));
    return thin == Proof::holds ? shallow : thin;
}

/// The faces of a part that bound no solid, as those of open shells, or of two shells that are the same
/// but for their sides.
class Sheets {
public:
    explicit Sheets(const WorldSolid& part)
        : part_(part), step_(kThinnest * (part.world_size() + max_abs(part.middle()))) {}
    bool hold(std::uint32_t triangle) {
        if (!part_.bounds_solid())
            return true;
        const auto [at, is_new] = known_.try_emplace(triangle, false);
        if (is_new)
            at->second = bounds_nothing(triangle);
        return at->second;
    }

private:
    [[nodiscard]] bool bounds_nothing(std::uint32_t triangle) const {
        const Triangle t = part_.world_triangle(triangle);
        const Vec3 centre = (1.0 / 3) * (t[0] + t[1] + t[2]),
                   normal = normalized_or_zero(cross(t[1] - t[0], t[2] - t[0]));
        const int weight = part_.weight(triangle);
        const Vec3 outward = (weight < 0 ? -step_ : step_) * normal;
        const Vec3 over = centre + outward, under = centre - outward;
        if (weight != 0 && !has_another(triangle, {min(over, under), max(over, under)}))
            return false;
        return !part_.contains(under) && !part_.contains(over);
    }

    /// Returns whether the box of another triangle meets a box. If not, the solid lies under the face.
    [[nodiscard]] bool has_another(std::uint32_t triangle, const Box3& box) const {
        bool found = false;
        part_.for_each_block(box, [&](const WorldSolid::Block& block) {
            block.model.for_each_overlap(box, [&](std::uint32_t slot) {
                if (found || block.number(block.model.data().triangle_at(slot)) == triangle)
                    return;
                const Triangle t = block.model.world_slot(slot);
                found = overlap(box, {min(t[0], min(t[1], t[2])), max(t[0], max(t[1], t[2]))});
            });
            return !found;
        });
        return found;
    }

    /// Thinner shells bound nothing: some hundred roundings of their positions.
    static constexpr double kThinnest = 0x1p-44;

    const WorldSolid& part_;
    const double step_;                   ///< from a face to the points beside it
    std::map<std::uint32_t, bool> known_; ///< by triangle
};

/// The sheets of two parts.
class SheetsOfPair {
public:
    SheetsOfPair(const WorldSolid& a, const WorldSolid& b) : of_a_(a), of_b_(b) {}

    /// Returns whether both faces of a contact bound no solid.
    bool have(const Contact& contact) {
        return of_a_.hold(contact.pair.a) && of_b_.hold(contact.pair.b);
    }

private:
    Sheets of_a_, of_b_;
};

/// Returns whether a surface is the first of two, whatever their order and triangles: by their boxes. By
/// their first triangles, if these are equal.
bool is_first(const WorldSolid& a, const WorldSolid& b) {
    const auto places = [](const WorldSolid& surface) {
        const Triangle t = surface.world_triangle(0);
        const Box3 box = surface.world_box();
        return std::array{box.lower, box.upper, t[0], t[1], t[2]};
    };
    return std::ranges::lexicographical_compare(
        places(a), places(b), [](const Vec3& p, const Vec3& q) { return is_before(p, q); });
}

/// How far the faces that bound no solid, of a and of b moved by a vector, go beyond each other. The point
/// is told where b is not moved.
SheetOverlap overlap_if_moved(const ClashPart& a, const ClashPart& b, const Vec3& by, double touch,
                              const std::function<bool(const Contact&)>& are_sheets) {
    Transform world = b.world_from_mesh;
    world.m[9] += by.x, world.m[10] += by.y, world.m[11] += by.z;
    const ClashPart moved{b.model, b.blocks, world, grown(b.box, length(by)), b.rounding};
    const auto decide = [&](PartPair&& pair) {
        SheetContacts contacts;
        pair.for_each_contact([&](const Contact& contact) {
            (are_sheets(contact) ? contacts.of_sheets : contacts.of_solids).push_back(contact);
        });
        SheetOverlap overlap =
            overlap_of_sheets(pair.a().solid(), pair.b().solid(), contacts,
                              {.tolerance = touch, .rounding = a.rounding + b.rounding});
        if (overlap.of_b)
            overlap.point = overlap.point - by;
        return overlap;
    };
    return a.blocks != nullptr || b.blocks != nullptr ? decide(BlocksPair(a, moved))
                                                      : decide(WholePair(a, moved));
}

/// Decides whether two surfaces go at most `touch` beyond each other where both bound no solids. `depth`
/// becomes at least as deep as that.
Proof cross_at_most(PartPair& pair, SheetsOfPair& sheets, double touch, LocalPenetration& depth) {
    const WorldSolid &a = pair.a().solid(), &b = pair.b().solid();
    const ClashPart &of_a = pair.a().part(), &of_b = pair.b().part();
    const Vec3 shift = sheet_shift(a, b);
    // The same one of them is moved for either order.
    const SheetOverlap overlap =
        is_first(b, a) ? overlap_if_moved(of_b, of_a, shift, touch,
                                          [&](const Contact& c) {
                                              return sheets.have({{c.pair.b, c.pair.a}, c.kind});
                                          })
                       : overlap_if_moved(of_a, of_b, shift, touch,
                                          [&](const Contact& c) { return sheets.have(c); });
    if (overlap.depth > depth.depth)
        replace(depth, depth_at(a, b, overlap.point));
    return overlap.within;
}

/// A first depth, near contacts.
LocalPenetration first_depth(const WorldSolid& a, const WorldSolid& b,
                             std::span<const Contact> contacts) {
    DepthSearch options;
    options.threshold = 0;
    options.accuracy_budget = options.reach_budget = kSamples;
    return local_penetration(a, b, contacts, options);
}

/// The depth of parts that interpenetrate, whatever the tolerance.
LocalPenetration depth_of(const WorldSolid& a, const WorldSolid& b,
                          std::span<const Contact> contacts) {
    LocalPenetration found = first_depth(a, b, contacts);
    if (a.bounds_solid() || b.bounds_solid())
        deepen(a, b, contacts, 0, found);
    if (found.depth > 0)
        return found;
    // Solids that have next to nothing in common are not locked into each other.
    const double next_to_nothing = 0x1p-20 * std::min(a.world_size(), b.world_size());
    const bool solids = a.bounds_solid() && b.bounds_solid();
    return solids && nowhere_thicker(a, b, {next_to_nothing}) != Proof::fails
               ? found
               : locked_depth(a, b, contacts);
}

} // namespace

MeetingKind meeting_kind(PartPair& pair, std::span<const Contact> contacts, const Meeting& meeting,
                         double touch) {
    const WorldSolid &a = pair.a().solid(), &b = pair.b().solid();
    // The contacts of faces inside their own solid are left out, so the others do not tell all.
    const bool knows_all = touch == 0 || (a.boundary() == nullptr && b.boundary() == nullptr);
    if (knows_all && !meeting.interpenetrate)
        return {};
    MeetingKind result{ClashKind::hard, {}};
    if (touch == 0) {
        result.penetration = depth_of(a, b, contacts);
        return result;
    }
    const bool sheets_only = !a.bounds_solid() && !b.bounds_solid();
    if (!sheets_only)
        result.penetration = first_depth(a, b, contacts);
    const bool is_deep = result.penetration.depth > touch + rounding_of_lengths(a, b);
    Proof within = is_deep ? Proof::fails : Proof::holds;
    SheetsOfPair sheets(a, b);
    if (meeting.interpenetrate &&
        std::ranges::any_of(contacts, [&](const Contact& c) { return sheets.have(c); }))
        within = both_hold(within, cross_at_most(pair, sheets, touch, result.penetration));
    if (within != Proof::fails && !sheets_only)
        within = both_hold(within, overlaps_at_most(a, b, contacts, touch, result.penetration));
    if (within != Proof::fails)
        result.kind = within == Proof::holds ? ClashKind::touch : ClashKind::undecided;
    if (!sheets_only)
        deepen(a, b, contacts, touch, result.penetration);
    return result;
}

MeetingKind kind_of_partly_inside(PartPair& pair, const Vec3& point, double touch) {
    const WorldSolid &a = pair.a().solid(), &b = pair.b().solid();
    MeetingKind result{ClashKind::hard, depth_at(a, b, point)};
    if (touch > 0 && result.penetration.depth <= touch) {
        result.penetration.at_most = std::numeric_limits<double>::infinity();
        const Proof within = overlaps_at_most(a, b, {}, touch, result.penetration);
        if (within != Proof::fails)
            result.kind = within == Proof::holds ? ClashKind::touch : ClashKind::undecided;
    }
    deepen(a, b, {}, touch, result.penetration);
    return result;
}

Proof are_duplicates(PartPair& pair, double touch) {
    const Box3 &of_a = pair.a().part().box, &of_b = pair.b().part().box;
    const WorldSolid &a = pair.a().solid(), &b = pair.b().solid();
    const double allowed = touch + rounding_of_lengths(a, b);
    if (max_abs(of_a.lower - of_b.lower) > allowed || max_abs(of_a.upper - of_b.upper) > allowed)
        return Proof::fails;
    return everywhere_near(a, b, {touch});
}

} // namespace abut
