#include "rigid/tolerance/sheets_cross.h"

#include "geometry/triangle_triangle_intersect.h"
#include "geometry/triangle_triangle_segment.h"
#include "rigid/penetration/local_penetration.h"
#include "rigid/tolerance/sheet_parts.h"
#include "rigid/tolerance/sheet_slits.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <vector>

namespace abut {

namespace {

/// Pieces of faces that may be examined to decide whether one part beyond a curve is near.
constexpr std::uint32_t kBudget = 20'000;

/// The width of a slit, as a multiple of the length by which one sheet is moved.
constexpr double kSlitWidth = 4;
/// A curve that is not longer than this many slits are wide may be there only because of the shift.
constexpr double kTinyCurve = 4;

/// The edges of a sheet that belong to one triangle only and pass through the other one.
std::vector<BorderCrossing> border_crossings(std::span<const SheetContact> contacts,
                                             const Sheet& own, const Sheet& other) {
    const std::vector<Sheet::Edge> edges = own.edges_of_faces();
    std::vector<BorderCrossing> crossings;
    for (const SheetContact& c : contacts) {
        const Triangle &t = own.triangle(c.own), &u = other.triangle(c.other);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [first, last] =
                std::equal_range(edges.begin(), edges.end(), own.edge(c.own, k));
            if (last - first == 1 && projection_axis(u) >= 0 &&
                segment_triangle_intersect(t[k], t[(k + 1) % 3], u))
                crossings.push_back({t, k, c.other});
        }
    }
    return crossings;
}

/// The contacts of a sheet's pieces with the other one.
std::vector<SheetContact> contacts_of_pieces(std::span<const SheetContact> contacts,
                                             const Sheet& own, const Sheet& other) {
    std::vector<SheetContact> found;
    for (const SheetContact& c : contacts) {
        const std::vector<std::uint32_t> pieces = own.pieces_of(c.own);
        for (const std::uint32_t piece : pieces)
            if (pieces.size() == 1 ||
                triangle_triangle_intersect(own.triangle(piece), other.triangle(c.other)) !=
                    TriangleContact::none)
                found.push_back({piece, c.other, c.contact});
    }
    return found;
}

/// Two surfaces with the curves in which they cross.
class SheetPair {
public:
    SheetPair(const WorldSolid& a, const WorldSolid& b, std::span<const Contact> contacts,
              double tolerance)
        : sheets_{Sheet(a), Sheet(b)}, curves_(contacts.size()) {
        const double shift = length(sheet_shift(a, b));
        options_ = {.limit = tolerance,
                    .rounding = depth_rounding(a, b) + shift,
                    .both_sides = true,
                    .budget = kBudget};
        slit_width_ = kSlitWidth * shift;
        for (std::uint32_t i = 0; i < contacts.size(); ++i) {
            contacts_[0].push_back({contacts[i].pair.a, contacts[i].pair.b, i});
            contacts_[1].push_back({contacts[i].pair.b, contacts[i].pair.a, i});
        }
        connect_curves();
        decide(0, b);
        decide(1, a);
    }

    /// Decides whether along each curve one of the sheets ends near the other one.
    [[nodiscard]] Proof proof() const {
        Proof all = Proof::holds;
        for (const auto& [curve, ends] : ends_)
            all = both_hold(
                all, either_holds(ends[0].value_or(Proof::fails), ends[1].value_or(Proof::fails)));
        return all;
    }
    /// A point that goes on beyond the other sheet, in the world.
    [[nodiscard]] const std::optional<SheetParts::Beyond>& beyond() const { return beyond_; }

private:
    /// Contacts are on one curve if an edge crosses a triangle where the curve passes on.
    void connect_curves() {
        std::vector<std::uint32_t> crossed;
        for (std::size_t side = 0; side < 2; ++side) {
            const std::vector<SheetCrossing> crossings =
                crossings_in(contacts_[side], sheets_[side], sheets_[1 - side]);
            for (std::size_t i = 0; i < crossings.size(); ++i) {
                crossed.push_back(crossings[i].contact);
                if (i > 0 && crossings[i].key() == crossings[i - 1].key())
                    curves_.unite(crossings[i].contact, crossings[i - 1].contact);
            }
        }
        // Sheets that only touch at a point cross there once they are shifted.
        std::map<std::uint32_t, Box3> extent;
        for (const std::uint32_t contact : crossed) {
            const SheetContact& c = contacts_[0][contact];
            const Intersection common =
                triangle_triangle_segment(sheets_[0].triangle(c.own), sheets_[1].triangle(c.other));
            Box3& box = extent[curves_.root(contact)];
            for (std::size_t k = 0; k < common.count; ++k)
                extend(box, common.corners[k]);
        }
        for (const auto& [curve, box] : extent)
            if (max_abs(box.upper - box.lower) > kTinyCurve * slit_width_)
                ends_[curve] = {};
    }

    /// Decides by curve whether one sheet ends near the other one, which is `surface`.
    void decide(std::size_t side, const WorldSolid& surface) {
        const Sheet& other = sheets_[1 - side];
        Sheet own = sheets_[side];
        cut_slits(own, border_crossings(contacts_[1 - side], other, own), options_.limit,
                  slit_width_);
        SheetParts parts(own, other, contacts_of_pieces(contacts_[side], own, other), surface,
                         options_);
        for (const SheetCrossing& c : parts.crossings()) {
            const auto curve = ends_.find(curves_.root(c.contact));
            if (curve == ends_.end())
                continue;
            std::optional<Proof>& known = curve->second[side];
            known = both_hold(known.value_or(Proof::holds), parts.ends_at(c));
        }
        if (const auto& beyond = parts.beyond();
            beyond && (!beyond_ || beyond->length < beyond_->length))
            beyond_ = beyond;
    }

    std::array<Sheet, 2> sheets_;
    std::array<std::vector<SheetContact>, 2> contacts_; ///< as each sheet has them
    DisjointSets curves_;                               ///< of contacts
    ReachSearch::Options options_;
    double slit_width_ = 0;
    /// By curve, for each sheet: whether it ends there; none if it has no crossing there.
    std::map<std::uint32_t, std::array<std::optional<Proof>, 2>> ends_;
    std::optional<SheetParts::Beyond> beyond_;
};

} // namespace

Proof sheets_cross_at_most(const WorldSolid& a, const WorldSolid& b,
                           std::span<const Contact> contacts, double tolerance,
                           std::optional<Vec3>* found) {
    const SheetPair pair(a, b, contacts, tolerance);
    if (found != nullptr && pair.beyond())
        *found = pair.beyond()->point;
    return pair.proof();
}

Vec3 sheet_shift(const WorldSolid& a, const WorldSolid& b) {
    // A direction in general position to the axes and to other such directions.
    constexpr Vec3 kDirection{0.30115, 0.54772, 0.78056};
    const double far = std::max(max_abs(a.middle()), max_abs(b.middle()));
    return std::max(0x1p-40 * std::max(a.world_size(), b.world_size()), 0x1p-46 * far) * kDirection;
}

} // namespace abut
