#pragma once

#include "core/disjoint_sets.h"
#include "rigid/tolerance/reach_search.h"
#include "rigid/tolerance/sheet.h"
#include "rigid/tolerance/sheet_border.h"

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <vector>

namespace abut {

/// A line along which a triangle of one sheet crosses one of another.
struct SheetCrossing {
    std::uint32_t own = 0, other = 0; ///< triangles
    DirectedPiece line;
    std::uint32_t curve = 0; ///< of which the line is a part
};

/// What is known of the greatest distance of some points from a surface.
struct ReachBounds {
    double low = 0; ///< reached at a point
    double high = 0;
    Vec3 point;
    bool of_second = false; ///< whether the point is on the second of two sheets
};
/// The bounds of the lesser and of the greater of two distances.
ReachBounds lesser(const ReachBounds& a, const ReachBounds& b);
ReachBounds greater(const ReachBounds& a, const ReachBounds& b);

/// Another sheet, as a sheet is divided along it.
struct OtherSheet {
    const Sheet& sheet;
    const SheetBorder& border;
    const WorldSolid& surface; ///< of the sheet, in its frame
};

/// The parts into which a sheet falls along the lines in which it crosses another one, and where it
/// leaves that one over its border. Bounds how far each part goes from the other sheet.
///
/// Faces are cut along these lines. Pieces are connected where their sides share more than some `near`,
/// no line runs there. So neither how faces are divided into
/// triangles nor vertices on edges matter.
class SheetParts {
public:
    /// In      border_reach: the other sheet's border matters as far from it as that. options: of the
    ///         searches; their limit is not used.
    SheetParts(const Sheet& own, const OtherSheet& other, std::span<const SheetCrossing> crossings,
               double border_reach, double near, ReachSearch::Options options);

    /// Decides whether on one side of each line of a curve, the sheet goes at most `limit` from the other
    /// one.
    Proof ends_within(std::uint32_t curve, double limit);
    /// How far it goes on the side on which it goes less far: the greatest along the curve.
    [[nodiscard]] ReachBounds reach_beyond(std::uint32_t curve) const;

    /// Looks at the corners of all parts whose reach is bounded from above.
    void look_at_corners();
    /// As reach_beyond(), but parts without an upper bound reach infinitely far.
    [[nodiscard]] ReachBounds likely_reach(std::uint32_t curve) const;

private:
    struct Piece {
        std::uint32_t face = 0;
        std::vector<Vec3> polygon;
    };
    /// The parts on both sides of a line of a curve.
    struct Sides {
        std::vector<std::uint32_t> over, under;
        friend auto operator<=>(const Sides&, const Sides&) = default;
    };
    using Choose = ReachBounds (*)(const ReachBounds&);

    void cut(std::span<const SheetCrossing> crossings, double border_reach);
    void connect_sides(const std::vector<FaceSide>& sides, const BoxIndex& index);
    [[nodiscard]] bool goes_on(const FaceSide& side, const Vec3& point) const;
    void find_sides(std::span<const SheetCrossing> crossings, const std::vector<FaceSide>& sides,
                    const BoxIndex& index);
    std::vector<FaceSide> open_sides();
    [[nodiscard]] Proof is_within(const std::vector<std::uint32_t>& parts, double limit);
    Proof examine(std::uint32_t part, double limit);
    [[nodiscard]] ReachBounds reach_of(std::uint32_t curve, Choose choose) const;

    const Sheet& own_;
    const OtherSheet other_;
    const double near_;
    const ReachSearch::Options options_;
    std::vector<Piece> pieces_;
    std::vector<std::uint32_t> first_piece_;            ///< by face; and the number of pieces
    std::vector<std::vector<DirectedPiece>> lines_;     ///< by face
    DisjointSets sets_{0};                              ///< of pieces
    std::map<std::uint32_t, std::vector<Sides>> sides_; ///< by curve
    std::map<std::uint32_t, std::vector<std::uint32_t>> pieces_of_; ///< by part beside a curve
    std::map<std::uint32_t, ReachBounds> reach_;                    ///< by part beside a curve
    std::set<std::uint32_t> looked_at_;                             ///< parts: at their corners
};

} // namespace abut
