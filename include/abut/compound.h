#pragma once

#include <abut/convex_pieces.h>
#include <abut/rigid_shape.h>
#include <abut/types.h>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace abut {

class CompoundData;

/// Several rigid shapes that move as one body of a `World`, such as a table of a box and four capsules.
/// Copies share the data.
class Compound {
public:
    /// A shape in its place in the compound's frame.
    struct Piece {
        RigidShape shape;
        Pose pose{};
    };

    /// The pieces may overlap, and need not touch.
    ///
    /// Accuracy    a piece with a pose other than the identity: its corners are rounded once.
    /// Errors      Error{bad_argument} if there is no piece, or if a value of a pose is not finite or a
    ///             quaternion has zero length; the message names the piece.
    /// Cost        for each piece with a pose, that of a new Convex or Model.
    explicit Compound(std::span<const Piece> pieces);
    /// The convex pieces of a solid, which are quicker than its triangles. They lie inside the solid, and
    /// their inner faces are not the solid's: a body that sinks in deep may be pushed out across one.
    Compound(const ConvexPieces& solid); // NOLINT: the pieces are a shape; the conversion is meant.

    [[nodiscard]] std::size_t size() const noexcept; ///< number of pieces
    [[nodiscard]] const CompoundData& data() const noexcept { return *data_; }

private:
    std::shared_ptr<const CompoundData> data_;
};

} // namespace abut
