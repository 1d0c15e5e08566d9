#pragma once

#include "rigid/tolerance/box_index.h"
#include "rigid/tolerance/sheet.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The border of a sheet, and where another sheet leaves it over its border: at the planes through the
/// border, upright to the sheet, as far as the border is what is nearest there.
class SheetBorder {
public:
    /// In      surface: that of the sheet, in the same frame. near: positions that are no farther
    ///         apart are one.
    SheetBorder(const Sheet& sheet, const WorldSolid& surface, double near);

    /// A face of another sheet.
    struct OtherFace {
        const Triangle& corners;
        const Vec3& normal;                     ///< unit
        std::span<const DirectedPiece> crossed; ///< the lines in which it crosses this sheet
    };
    /// Returns the lines on a face along which it leaves this sheet.
    ///
    /// Accuracy    on each plane, the nearest point is asked for at some tens of places. The border
    ///             may be what is nearest at less than an eighth of a plane's line, and not be found.
    /// Cost        a search for each border edge that may be nearest to some point of the face, and for
    ///             each place at which that is not excluded.
    [[nodiscard]] std::vector<DirectedPiece> ends_on(const OtherFace& face) const;

private:
    /// Lines on a face, by the border edge that is nearest there.
    struct BorderLine {
        std::uint32_t side = 0;
        LinePiece line;
        /// Whether the edge stops to be nearest at either end; else the line goes on in another face.
        std::array<bool, 2> stops{};
    };
    /// A search for the lines on a face.
    struct Search {
        /// A slot of the surface that was nearest, or nearer than a border edge: likely so at the next
        /// place, too.
        std::uint32_t nearer = 0;
        std::vector<BorderLine> lines{}; ///< found so far
    };
    [[nodiscard]] double nearer_by(const FaceSide& side, const Vec3& point, Search& search) const;
    [[nodiscard]] bool is_nearest(const FaceSide& side, const Vec3& point, Search& search) const;
    [[nodiscard]] bool is_nowhere_nearest(const FaceSide& side, const LinePiece& line,
                                          const Search& search) const;
    [[nodiscard]] double end_of_part(const FaceSide& side, const LinePiece& chord, double in,
                                     double out, Search& search) const;
    void add_lines(std::uint32_t number, const LinePiece& chord, const OtherFace& face,
                   Search& search) const;
    void bridge(Search& search) const;
    [[nodiscard]] static std::vector<Vec3> stops_of(const BorderLine& line);
    [[nodiscard]] bool are_neighbours(std::uint32_t i, std::uint32_t j) const;

    const WorldSolid& surface_;
    const double near_;
    const std::vector<FaceSide> sides_;
    const BoxIndex index_;
};

} // namespace abut
