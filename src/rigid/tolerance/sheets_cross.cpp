#include "rigid/tolerance/sheets_cross.h"

#include "core/disjoint_sets.h"
#include "geometry/triangle_triangle_intersect.h"
#include "geometry/triangle_triangle_segment.h"
#include "rigid/penetration/local_penetration.h"
#include "rigid/tolerance/sheet_parts.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace abut {

namespace {

/// Pieces of faces that may be examined to decide whether one part beside a curve is near.
constexpr std::uint32_t kBudget = 20'000;

/// Positions that are no farther apart than this many lengths by which one sheet is moved are one. A
/// corner of a line in which triangles cross is off by at most 2^-36 of an edge.
constexpr double kNear = 8;
/// Positions that are no farther apart than this many roundings of the surfaces are one, too: each may
/// lie off by one. So borders that were in one line before a file rounded them are in one line.
constexpr double kNearByRounding = 2;
/// A curve that is not larger than this many such lengths may be there only because of the shift.
constexpr double kTinyCurve = 4;

/// By which factor a length grows until the depth is not more.
constexpr double kStep = 8;
/// The relative accuracy of a depth that no corner reaches: the four digits that are printed are right.
constexpr double kAccuracy = 0x1p-15;
/// Relative distances from the depth of a corner at which it is proven to be the depth.
constexpr double kAccuracyAtCorner = 0x1p-30;

/// Two surfaces with the lines in which they cross.
class SheetPair {
public:
    SheetPair(const WorldSolid& a, const WorldSolid& b, const SheetContacts& contacts,
              const SheetSearch& search)
        : origin_(a.world_triangle(contacts.of_sheets[0].pair.a)[0]),
          near_(std::max(kNear * length(sheet_shift(a, b)), kNearByRounding * search.rounding)),
          sheets_{Sheet(a, origin_, near_), Sheet(b, origin_, near_)},
          surfaces_{a.seen_from(origin_), b.seen_from(origin_)},
          borders_{SheetBorder(sheets_[0], *surfaces_[0], near_),
                   SheetBorder(sheets_[1], *surfaces_[1], near_)},
          distances_{CornerDistances(*surfaces_[0]), CornerDistances(*surfaces_[1])},
          tolerance_(search.tolerance) {
        options_ = {.rounding = depth_rounding(a, b) + length(sheet_shift(a, b)),
                    .both_sides = true,
                    .budget = kBudget};
        add_crossings(a, b, contacts.of_sheets);
        find_curves();
        add_crossings(a, b, contacts.of_solids);
        for (const SheetCrossing& c : crossings_[0])
            crossings_[1].push_back({c.other, c.own, c.line, c.curve});
        for (std::size_t side = 0; side < 2; ++side)
            parts_[side] =
                std::make_unique<SheetParts>(sheets_[side],
                                             OtherSheet{sheets_[1 - side], borders_[1 - side],
                                                        *surfaces_[1 - side], distances_[1 - side]},
                                             crossings_[side], near_, options_);
        for (const WorldSolid* surface : {surfaces_[0].get(), surfaces_[1].get()})
            extend(box_, surface->world_box().lower), extend(box_, surface->world_box().upper);
    }

    SheetOverlap overlap() {
        SheetOverlap result;
        // Corners tell most of what goes farther, and cost less than a search.
        const bool are_corners_within = corners_within_limit(tolerance_ + options_.rounding);
        result.within = are_corners_within ? within_limit(tolerance_) : Proof::fails;
        if (result.within != Proof::open)
            find_depth(result.within);
        const FarPoint farthest = least_depth();
        if (farthest.distance > options_.rounding)
            result.depth = farthest.distance, result.point = origin_ + farthest.point,
            result.of_b = farthest.of_second;
        return result;
    }

private:
    /// A line in which two triangles cross. If it is short, their normals tell its direction.
    [[nodiscard]] DirectedPiece directed(const LinePiece& line, const TrianglePair& pair) const {
        constexpr double kLong = 4096, kSteep = 1e-3;
        const Vec3 of_planes = cross(sheets_[0].normal(pair.a), sheets_[1].normal(pair.b));
        const bool is_short = length(line.q - line.p) < kLong * near_;
        return {line, normalized_or_zero(is_short && length(of_planes) > kSteep ? of_planes
                                                                                : line.q - line.p)};
    }

    /// Adds the lines of contacts, on no curve.
    void add_crossings(const WorldSolid& a, const WorldSolid& b,
                       std::span<const Contact> contacts) {
        for (const Contact& contact : contacts) {
            const Triangle s = a.world_triangle(contact.pair.a),
                           t = b.world_triangle(contact.pair.b);
            const Intersection common = triangle_triangle_segment(s, t);
            if (common.count != 2 || projection_axis(s) < 0 || projection_axis(t) < 0)
                continue;
            const LinePiece line{common.corners[0] - origin_, common.corners[1] - origin_};
            crossings_[0].push_back({contact.pair.a, contact.pair.b, directed(line, contact.pair)});
        }
    }

    /// Lines are on one curve where their ends meet. Curves that may be there only because of the shift
    /// are dropped.
    void find_curves() {
        std::vector<SheetCrossing>& crossings = crossings_[0];
        std::vector<Box3> ends;
        for (const SheetCrossing& c : crossings)
            for (const Vec3& end : {c.line.piece.p, c.line.piece.q})
                ends.push_back({end, end});
        const BoxIndex index(ends);
        DisjointSets curves(crossings.size());
        for (std::uint32_t i = 0; i < ends.size(); ++i)
            index.for_each_overlap(grown(ends[i], near_),
                                   [&](std::uint32_t j) { curves.unite(i / 2, j / 2); });
        std::map<std::uint32_t, Box3> extent;
        for (std::uint32_t i = 0; i < crossings.size(); ++i) {
            crossings[i].curve = curves.root(i);
            Box3& box = extent[crossings[i].curve];
            extend(box, crossings[i].line.piece.p), extend(box, crossings[i].line.piece.q);
        }
        for (const auto& [curve, box] : extent)
            if (max_abs(box.upper - box.lower) > kTinyCurve * near_)
                curves_.push_back(curve);
    }

    /// Decides whether along each curve one of the sheets goes at most `limit` beyond the other one.
    Proof within_limit(double limit) {
        Proof all = Proof::holds;
        for (std::size_t i = 0; i < curves_.size() && all != Proof::fails; ++i) {
            Proof ends = parts_[0]->ends_within(curves_[i], limit);
            if (ends != Proof::holds)
                ends = either_holds(ends, parts_[1]->ends_within(curves_[i], limit));
            all = both_hold(all, ends);
            if (ends == Proof::fails) // the next limit, too, likely fails here
                std::swap(curves_[0], curves_[i]);
        }
        return all;
    }
    /// As within_limit(), for the corners of the parts.
    bool corners_within_limit(double limit) {
        return std::ranges::all_of(curves_, [&](std::uint32_t curve) {
            return parts_[0]->corners_end_within(curve, limit) ||
                   parts_[1]->corners_end_within(curve, limit);
        });
    }

    /// A point that lies at most as far beyond the other sheet as the depth.
    [[nodiscard]] FarPoint least_depth() const {
        FarPoint most;
        for (const std::uint32_t curve : curves_) {
            FarPoint of_second = parts_[1]->least_reach(curve);
            of_second.of_second = true;
            most = std::max(most, std::min(parts_[0]->least_reach(curve), of_second));
        }
        return most;
    }
    /// The depth if no point of a part is farther than its corners.
    [[nodiscard]] double depth_of_corners() const {
        double most = 0;
        for (const std::uint32_t curve : curves_)
            most = std::max(most, std::min(parts_[0]->reach_of_corners(curve),
                                           parts_[1]->reach_of_corners(curve)));
        return most;
    }

    /// Finds the depth, which is often that of a corner.
    ///
    /// In          within: whether the depth is at most the tolerance.
    void find_depth(Proof within) {
        const double size = length(box_.upper - box_.lower); // no point is farther
        for (double limit = tolerance_; limit < size && !corners_within_limit(limit);)
            limit *= kStep;
        if (within == Proof::holds)
            narrow(0, tolerance_);
        else
            narrow(tolerance_, size);
    }

    /// Finds the depth, which is between two lengths.
    void narrow(double low, double high) {
        constexpr int kMostSteps = 100;
        const double rounding = options_.rounding;
        double growth = 1.01;
        bool is_corner = true; // as far as is known, the farthest point is one
        for (int i = 0; i < kMostSteps; ++i) {
            low = std::max(low, least_depth().distance);
            if (high - low <= kAccuracy * high + 4 * rounding)
                return;
            const double corners = depth_of_corners(),
                         over = corners * (1 + kAccuracyAtCorner) + rounding,
                         under = corners * (1 - kAccuracyAtCorner) - 2 * rounding;
            double next = 0.5 * (low + high);
            if (is_corner && low < over && over < high)
                next = over;
            else if (low < under && under < high)
                next = under;
            else if (low > 0)
                next = std::min(next, growth * low);
            if (within_limit(next) == Proof::holds) {
                high = next;
            } else {
                is_corner = is_corner && next != over;
                growth *= next == growth * low ? growth : 1;
                low = next;
            }
        }
    }

    const Vec3 origin_;
    const double near_;
    const std::array<Sheet, 2> sheets_;
    const std::array<std::unique_ptr<const WorldSolid>, 2> surfaces_;
    const std::array<SheetBorder, 2> borders_;
    std::array<CornerDistances, 2> distances_; ///< from each surface
    const double tolerance_;
    ReachSearch::Options options_;
    Box3 box_;
    std::array<std::vector<SheetCrossing>, 2> crossings_; ///< as each sheet has them
    std::vector<std::uint32_t> curves_;
    std::array<std::unique_ptr<SheetParts>, 2> parts_;
};

} // namespace

SheetOverlap overlap_of_sheets(const WorldSolid& a, const WorldSolid& b,
                               const SheetContacts& contacts, const SheetSearch& search) {
    return contacts.of_sheets.empty() ? SheetOverlap{}
                                      : SheetPair(a, b, contacts, search).overlap();
}

Vec3 sheet_shift(const WorldSolid& a, const WorldSolid& b) {
    // A direction in general position to the axes and to other such directions.
    constexpr Vec3 kDirection{0.30115, 0.54772, 0.78056};
    const double far = std::max(max_abs(a.middle()), max_abs(b.middle()));
    return std::max(0x1p-40 * std::max(a.world_size(), b.world_size()), 0x1p-46 * far) * kDirection;
}

} // namespace abut
