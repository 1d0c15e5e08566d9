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
#include <vector>

namespace abut {

namespace {

/// Pieces of faces that may be examined to decide whether one part beside a curve is near.
constexpr std::uint32_t kBudget = 20'000;

/// Positions that are no farther apart than this many lengths by which one sheet is moved are one. A
/// corner of a line in which triangles cross is off by at most 2^-36 of an edge.
constexpr double kNear = 8;
/// A curve that is not larger than this many such lengths may be there only because of the shift.
constexpr double kTinyCurve = 4;

/// By which factor the distance grows up to which borders are looked at.
constexpr double kStep = 8;
/// The relative accuracy of a depth that no corner reaches.
constexpr double kAccuracy = 0x1p-12;
/// Relative distances from the depth of a corner at which it is proven to be the depth.
constexpr double kAccuracyAtCorner = 0x1p-30;

/// Two surfaces with the lines in which they cross.
class SheetPair {
public:
    SheetPair(const WorldSolid& a, const WorldSolid& b, std::span<const Contact> contacts,
              double tolerance)
        : origin_(a.world_triangle(contacts[0].pair.a)[0]),
          near_(kNear * length(sheet_shift(a, b))), sheets_{Sheet(a, origin_, near_),
                                                            Sheet(b, origin_, near_)},
          surfaces_{a.seen_from(origin_), b.seen_from(origin_)},
          borders_{SheetBorder(sheets_[0], *surfaces_[0], near_),
                   SheetBorder(sheets_[1], *surfaces_[1], near_)},
          distances_{CornerDistances(*surfaces_[0]), CornerDistances(*surfaces_[1])},
          tolerance_(tolerance) {
        options_ = {.rounding = depth_rounding(a, b) + length(sheet_shift(a, b)),
                    .both_sides = true,
                    .budget = kBudget};
        for (const Contact& contact : contacts) {
            const Triangle s = a.world_triangle(contact.pair.a),
                           t = b.world_triangle(contact.pair.b);
            const Intersection common = triangle_triangle_segment(s, t);
            if (common.count != 2 || projection_axis(s) < 0 || projection_axis(t) < 0)
                continue;
            const LinePiece line{common.corners[0] - origin_, common.corners[1] - origin_};
            crossings_[0].push_back(
                {contact.pair.a, contact.pair.b, directed(line, contact.pair), 0});
        }
        find_curves();
        for (const SheetCrossing& c : crossings_[0])
            crossings_[1].push_back({c.other, c.own, c.line, c.curve});
        for (const WorldSolid* surface : {surfaces_[0].get(), surfaces_[1].get()})
            extend(box_, surface->world_box().lower), extend(box_, surface->world_box().upper);
    }

    SheetOverlap overlap() {
        SheetOverlap result;
        double before = 0;
        ReachBounds known;
        for (double reach = tolerance_; !curves_.empty();) {
            divide(reach);
            const Proof within = within_limit(reach);
            if (reach == tolerance_)
                result.within = within;
            const bool is_last = reach >= length(box_.upper - box_.lower);
            if (within == Proof::holds)
                narrow(before, reach);
            if (within == Proof::holds || is_last || result.within == Proof::open)
                break;
            // Where places on borders were missed, the next depth may be less than what is known.
            before = reach;
            known = reach_by(&SheetParts::reach_beyond);
            reach *= kStep;
        }
        ReachBounds bounds = parts_[0] ? reach_by(&SheetParts::reach_beyond) : ReachBounds{};
        if (bounds.low <= before)
            bounds = known;
        if (bounds.low > options_.rounding)
            result.depth = bounds.low, result.point = origin_ + bounds.point,
            result.of_b = bounds.of_second;
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

    /// Divides both sheets, with borders up to a distance.
    void divide(double reach) {
        for (std::size_t side = 0; side < 2; ++side)
            parts_[side] = std::make_unique<SheetParts>(
                sheets_[side],
                OtherSheet{sheets_[1 - side], borders_[1 - side], *surfaces_[1 - side],
                           distances_[1 - side]},
                crossings_[side], reach + options_.rounding, near_, options_);
    }

    /// Decides whether along each curve one of the sheets goes at most `limit` beyond the other one.
    Proof within_limit(double limit) {
        Proof all = Proof::holds;
        for (const std::uint32_t curve : curves_) {
            Proof ends = parts_[0]->ends_within(curve, limit);
            if (ends != Proof::holds)
                ends = either_holds(ends, parts_[1]->ends_within(curve, limit));
            all = both_hold(all, ends);
        }
        return all;
    }

    using ReachOfCurve = ReachBounds (SheetParts::*)(std::uint32_t);
    [[nodiscard]] ReachBounds reach_by(ReachOfCurve reach) const {
        ReachBounds most;
        for (const std::uint32_t curve : curves_) {
            ReachBounds of_second = ((*parts_[1]).*reach)(curve);
            of_second.of_second = true;
            most = greater(most, lesser(((*parts_[0]).*reach)(curve), of_second));
        }
        return most;
    }

    /// Finds the depth, which is between two lengths. The farthest point is often a corner.
    void narrow(double low, double high) {
        constexpr int kMostSteps = 60;
        const double rounding = options_.rounding;
        for (int i = 0; i < kMostSteps && high - low > kAccuracy * high + 4 * rounding; ++i) {
            const double likely = reach_by(&SheetParts::likely_reach).low;
            const double over = likely * (1 + kAccuracyAtCorner) + rounding,
                         under = likely * (1 - kAccuracyAtCorner) - 2 * rounding;
            const double next = low < over && over < high     ? over
                                : low < under && under < high ? under
                                                              : 0.5 * (low + high);
            (within_limit(next) == Proof::holds ? high : low) = next;
        }
        if (low > 0 && reach_by(&SheetParts::reach_beyond).low < low)
            within_limit(low);
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
                               std::span<const Contact> contacts, double tolerance) {
    return contacts.empty() ? SheetOverlap{} : SheetPair(a, b, contacts, tolerance).overlap();
}

Vec3 sheet_shift(const WorldSolid& a, const WorldSolid& b) {
    // A direction in general position to the axes and to other such directions.
    constexpr Vec3 kDirection{0.30115, 0.54772, 0.78056};
    const double far = std::max(max_abs(a.middle()), max_abs(b.middle()));
    return std::max(0x1p-40 * std::max(a.world_size(), b.world_size()), 0x1p-46 * far) * kDirection;
}

} // namespace abut
