#pragma once

#include <abut/clash.h>
#include <abut/model.h>

#include "rigid/model/model_blocks.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace abut {

/// A part as the narrow phase sees it: a model, or the mesh blocks of a large mesh.
struct ClashPart {
    const Model* model = nullptr;        ///< null if the part is in blocks
    const ModelBlocks* blocks = nullptr; ///< null if the part is one model
    const Transform& world_from_mesh;
    const Box3& box; ///< world
    /// How far points may lie from where they were, because a file rounds them; metres. Both parts'
    /// together: open surfaces that are closer are one.
    double rounding = 0;
};

/// The version of the answers that classify_pair() gives. It grows with every change of the program that
/// alters one, so that a store does not keep the answers of an older program.
constexpr std::int64_t kAnswersVersion = 2;

/// Returns the clash of two parts, or none. All members are filled in except the ids, models, parts,
/// rule, severity and neighbours.
///
/// In          clearance, touch: metres, not negative.
/// Accuracy    whether surfaces meet, whether they cross and whether a part is contained are
///             decided exactly; `hard`, `touch` and `duplicate` at a touch tolerance are proven
///             (meeting_kind.h). The distance of parts that do not meet is exact to double rounding.
///             The depth of a `hard` clash in a solid is reached at its witness points; it is the
///             largest to 2^-20 (meeting_kind.h). A part in blocks gets the kind, distance and
///             contacts of the whole model, to the last bit, and its depth within the accuracy of
///             both. The bits do not depend on which mesh blocks are in memory.
///             The volume has its own bound of error; of parts in blocks, it is summed in another
///             order.
/// Cost        all contacts are in memory together, 12 to 28 bytes each; those of duplicates are
///             only counted.
std::optional<Clash> classify_pair(const ClashPart& a, const ClashPart& b, double clearance,
                                   double touch);

/// Calls classify_pair with the part whose id sorts first as its first argument, and exchanges the
/// sides of the result if needed. A pair therefore gets the same answer, to the last bit, in
/// whichever order a file lists its parts. If the ids are equal, a stays first.
std::optional<Clash> classify_by_id(const ClashPart& a, std::string_view id_a, const ClashPart& b,
                                    std::string_view id_b, double clearance, double touch);

/// Exchanges the witness points of a and b and negates the direction. The caller exchanges the
/// members that name the parts.
void exchange_sides(Clash& clash);

} // namespace abut
