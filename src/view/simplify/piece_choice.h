#pragma once

#include "view/simplify/stick.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A piece of a surface (triangles of one part that are connected) and the forms it can have.
struct PieceForms {
    struct Form {
        std::uint32_t triangles = 0;
        double added = 0; ///< bound of the distance from the piece, both ways; more for its shade
    };
    std::vector<Form> forms; ///< with fewer and fewer triangles; the first is the piece as it is
    double error = 0;        ///< that the piece has already
    double size = 0;         ///< diagonal of its box
    Stick stick;             ///< of the piece as it is
};

/// The decisions about the pieces of a surface.
struct PieceChoice {
    static constexpr int kLeftOut = -1; ///< the piece is no longer than the error
    static constexpr int kRests = -2;   ///< it is left out, because another piece is near all of it
    std::vector<int> form;              ///< by piece: number of a form, or one of the above
    std::uint64_t triangles = 0;
    double error = 0; ///< the largest of all errors
    /// No point of a piece that rests, now or in an earlier choice, is farther from what is kept.
    double resting = 0;
    bool is_possible = true; ///< whether all pieces are within the error
};

/// Chooses forms within a common error.
///
/// A piece rests on another one that is kept if all its points are within the error of it. Larger
/// pieces are kept first. So of many parallel pipes some remain, at an error of their spacing; to
/// leave one out without a neighbour costs its length.
class PieceChooser {
public:
    /// In          pieces: must outlive this object; resting: of the surface that they are of.
    PieceChooser(std::span<const PieceForms> pieces, double resting);

    /// Chooses the fewest triangles within an error.
    [[nodiscard]] PieceChoice within(double error, bool with_rest) const;

    /// Chooses the least error with at most this number of triangles, as far as it is possible.
    ///
    /// Cost        O(n^2) for n pieces, a few nanoseconds a pair.
    [[nodiscard]] PieceChoice least_error(std::uint64_t triangles) const;

private:
    [[nodiscard]] double base(const PieceForms& piece) const;
    [[nodiscard]] double left_out_error(const PieceForms& piece) const;
    [[nodiscard]] double least_without_rest(std::uint64_t triangles) const;

    std::span<const PieceForms> pieces_;
    std::vector<std::uint32_t> order_; ///< the largest first
    double resting_;
};

} // namespace abut
