#pragma once

#include "math/vector.h"

#include <optional>
#include <vector>

namespace abut {

/// A straight piece of a line.
struct LinePiece {
    Vec3 p, q;
};

/// A straight piece of a line, with the line's direction: a short piece does not tell it well.
struct DirectedPiece {
    LinePiece piece;
    Vec3 along; ///< unit vector, either way
};

/// A part of a line piece, by the distances of its ends from the piece's first point.
struct LineSpan {
    double from = 0, to = 0;
    [[nodiscard]] double middle() const { return 0.5 * (from + to); }
};

/// Returns the part of a piece along which another one lies within `near`, if it is longer than
/// `longer_than`. The other one may be directed either way.
///
/// In          along: the unit vector from the piece's first point to its last one.
std::optional<LineSpan> common_span(const LinePiece& piece, const Vec3& along,
                                    const LinePiece& other, double near, double longer_than);

/// Returns the part of a piece that lies within `near` of another one, if there is any. In: as above.
std::optional<LineSpan> near_span(const LinePiece& piece, const Vec3& along, const LinePiece& other,
                                  double near);

/// Returns the parts of a span that no cover comes within `near` of, if they are longer than twice that.
std::vector<LineSpan> uncovered(const LineSpan& span, std::vector<LineSpan> covers, double near);

Box3 box_of(const LinePiece& piece);

double distance_to_piece(const LinePiece& piece, const Vec3& point);

} // namespace abut
