#pragma once

#include "math/point_order.h"
#include "rigid/tolerance/reach_search.h"
#include "rigid/tolerance/sheet.h"
#include "rigid/tolerance/sheet_border.h"

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <span>
#include <vector>

namespace abut {

/// A line along which a triangle of one sheet crosses one of another.
struct SheetCrossing {
    std::uint32_t own = 0, other = 0; ///< triangles
    DirectedPiece line;
    /// Of which the line is a part; kNoCurve if it only limits the sheets.
    std::uint32_t curve = kNoCurve;
    static constexpr std::uint32_t kNoCurve = 0xffffffff;
};

/// A point of a sheet, and its distance from another one.
struct FarPoint {
    double distance = 0;
    Vec3 point;
    bool of_second = false; ///< whether the point is on the second of two sheets

    friend bool operator<(const FarPoint& a, const FarPoint& b) { return a.distance < b.distance; }
};

/// The distances of points from a surface. A corner of several pieces is measured once.
class CornerDistances {
public:
    explicit CornerDistances(const WorldSolid& surface) : surface_(surface) {}
    struct Nearest {
        double distance = 0;
        std::uint32_t slot = 0; ///< of the surface
    };
    Nearest of(const Vec3& corner) {
        const auto [at, is_new] = known_.try_emplace(corner);
        if (is_new) {
            const auto nearest = surface_.nearest(corner, {.seed = last_ ? &*last_ : nullptr});
            at->second = {nearest.distance, nearest.slot};
            last_ = nearest.slot;
        }
        return at->second;
    }

private:
    struct Before {
        bool operator()(const Vec3& p, const Vec3& q) const { return is_before(p, q); }
    };
    const WorldSolid& surface_;
    std::map<Vec3, Nearest, Before> known_;
    std::optional<std::uint32_t> last_; ///< slot nearest to the last corner, likely near the next
};

/// Another sheet, as a sheet is divided along it.
struct OtherSheet {
    const Sheet& sheet;
    const SheetBorder& border;
    const WorldSolid& surface;  ///< of the sheet, in its frame
    CornerDistances& distances; ///< from the surface
};

/// The parts into which a sheet falls along the lines in which it crosses another one, and where it
/// leaves that one over its border. Bounds how far each part goes from the other sheet.
///
/// Faces are cut along these lines. Pieces are connected where their sides share more than some `near`,
/// and no line runs there. So neither how faces are divided into triangles nor vertices on edges matter.
/// A part is walked from the lines outward, the farthest piece first, only as far as a question needs.
class SheetParts {
public:
    /// In      own, other, crossings: must outlive the parts. options: of the searches; their limit is
    ///         not used.
    SheetParts(const Sheet& own, const OtherSheet& other, std::span<const SheetCrossing> crossings,
               double near, ReachSearch::Options options);

    /// Decides whether on one side of each line of a curve, the sheet goes at most `limit` from the other
    /// one.
    Proof ends_within(std::uint32_t curve, double limit);
    /// As ends_within(), for the corners of the sheet's pieces alone.
    bool corners_end_within(std::uint32_t curve, double limit);
    /// Returns the farthest point that was found on the side on which the sheet goes less far, the greatest
    /// along the curve. So the sheet goes at least that far.
    [[nodiscard]] FarPoint least_reach(std::uint32_t curve) const;
    /// Returns how far the corners go on that side. It is infinite if a part is not walked to its end.
    [[nodiscard]] double reach_of_corners(std::uint32_t curve) const;

private:
    struct Piece {
        std::uint32_t face = 0;
        std::vector<Vec3> polygon;
        Box3 box;
        std::uint32_t part = 0; ///< if it is reached; else kNone
        double at_most = 0; ///< if it is reached: no point of it is farther from the other sheet
        std::vector<FaceSide> sides;
        bool is_passed = false; ///< the walk went on from it to all pieces that are joined to it
    };
    struct Face {
        bool is_cut = false;
        std::vector<DirectedPiece> lines;
        std::uint32_t first = 0, last = 0; ///< pieces
    };
    /// A part, as far as it is walked.
    struct Part {
        FarPoint farthest;                                        ///< that was found
        double at_most = std::numeric_limits<double>::infinity(); ///< no point is farther
        std::vector<std::uint32_t> pieces;
        std::priority_queue<std::pair<double, std::uint32_t>> edge; ///< farthest first
        [[nodiscard]] bool is_walked() const { return !pieces.empty() && edge.empty(); }
    };
    /// The pieces on both sides of a line of a curve.
    struct Sides {
        std::vector<std::uint32_t> over, under;
        friend bool operator==(const Sides&, const Sides&) = default;
    };
    struct Curve {
        std::vector<std::uint32_t> crossings;
        std::size_t looked_at = 0; ///< crossings whose sides are found
        std::vector<Sides> sides;
    };
    using Examine = Proof (SheetParts::*)(std::uint32_t, double);
    using ReachOfPart = FarPoint (*)(const Part&);

    const Face& cut(std::uint32_t face);
    void add_piece(std::uint32_t face, std::vector<Vec3> polygon);
    /// The view stays valid when pieces are added.
    [[nodiscard]] std::span<const FaceSide> sides_of(std::uint32_t piece) const {
        return pieces_[piece].sides;
    }
    template <typename Visit>
    void for_each_face_at(std::uint32_t face, const Box3& box, const Visit& visit);
    [[nodiscard]] std::vector<LineSpan> covers_of(const LinePiece& common, std::uint32_t face);
    [[nodiscard]] bool share_free_edge(std::uint32_t p, std::uint32_t q) const;
    [[nodiscard]] bool are_joined(std::uint32_t p, std::uint32_t q);
    [[nodiscard]] bool goes_on(const FaceSide& side, const Vec3& point) const;
    void find_sides(const SheetCrossing& crossing);
    [[nodiscard]] std::vector<std::uint32_t> faces_along(const SheetCrossing& crossing);

    [[nodiscard]] std::uint32_t united(std::uint32_t part) const;
    std::uint32_t part_of(std::uint32_t piece);
    void reach(std::uint32_t piece, std::uint32_t part);
    void unite(std::uint32_t part, std::uint32_t other);
    void walk(std::uint32_t part, double limit);
    Proof examine(std::uint32_t piece, double limit);
    Proof examine_corners(std::uint32_t piece, double limit);
    Proof decide(std::uint32_t curve, double limit, Examine check);
    [[nodiscard]] FarPoint reach_of(std::uint32_t curve, ReachOfPart reach) const;

    const Sheet& own_;
    const OtherSheet other_;
    const double near_;
    const ReachSearch::Options options_;
    const std::span<const SheetCrossing> crossings_;
    const BoxIndex index_; ///< of the crossings
    std::vector<Face> faces_;
    std::vector<Piece> pieces_;
    std::map<std::uint32_t, Curve> curves_;
    std::vector<Part> parts_;
    std::vector<std::uint32_t> united_; ///< by part: the part it belongs to, or itself
};

} // namespace abut
