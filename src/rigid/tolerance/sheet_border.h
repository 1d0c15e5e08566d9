#pragma once

#include "rigid/tolerance/box_index.h"
#include "rigid/tolerance/sheet.h"

#include <cstdint>
#include <vector>

namespace abut {

/// The border of a sheet, and what of another sheet lies beyond it: the points whose nearest point of
/// the sheet is on its border.
///
/// What lies beyond the border begins at the planes through it, upright to the sheet.
class SheetBorder {
public:
    /// In      surface: that of the sheet, in the same frame. near: positions that are no farther
    ///         apart are one.
    SheetBorder(const Sheet& sheet, const WorldSolid& surface, double near);

    /// What the border means to a triangle of another sheet.
    struct Division {
        bool is_near = false;             ///< parts of it may lie beyond the border
        std::vector<DirectedPiece> lines; ///< where what lies beyond the border begins
    };
    /// Looks at what is within `reach` of the border.
    ///
    /// Cost        some tens of searches for a nearest point for each border edge in reach whose plane
    ///             cuts the triangle.
    [[nodiscard]] Division division_of(const Triangle& face, const Vec3& normal,
                                       double reach) const;

    /// Returns whether the nearest point of the sheet is on its border.
    [[nodiscard]] bool is_beyond(const Vec3& point) const;

private:
    [[nodiscard]] bool is_nearest(const FaceSide& side, const Vec3& point, double reach) const;
    void add_lines(const FaceSide& side, const LinePiece& chord, double reach,
                   std::vector<DirectedPiece>& lines) const;

    const WorldSolid& surface_;
    const double near_;
    const std::vector<FaceSide> sides_;
    const BoxIndex index_;
};

} // namespace abut
