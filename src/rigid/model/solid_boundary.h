#pragma once

#include <abut/model.h>

#include "rigid/model/faces_overlay.h"
#include "rigid/model/solid.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace abut {

/// The surface of a model without what lies inside its solid: of shells that overlap, the boundary
/// of their union, and sheets outside of it. Distances to the solid are measured to this.
struct SolidBoundary {
    Model model; ///< in the mesh's frame; faces are cut where others enter them
    std::vector<std::uint32_t> source; ///< by triangle of `model`, ascending: the mesh's triangle
    /// By triangle of `model`: +1 or -1 as Solid::weights. 0: it is a sheet, or another triangle lies
    /// on it and counts.
    std::vector<std::int8_t> weight;
    FacesUncertainty uncertainty; ///< in the mesh's units
};

struct BoundarySearch {
    /// Null if the whole surface is the boundary, or if it is not known.
    std::shared_ptr<const SolidBoundary> boundary;
    /// False if it has too many parts (FaceFragments::for_each), or if the solid has T-junctions and its
    /// weights contradict each other: it winds backwards around a point.
    bool is_known = true;
};

/// Finds the boundary of a solid.
///
/// In          solid: of the mesh, and oriented.
/// Accuracy    as FaceFragments.
/// Cost        O(n log n + pairs of faces that meet).
BoundarySearch find_boundary(const Mesh& mesh, const Solid& solid);

/// The boundary of one mesh, made on first use. Safe for concurrent use.
class LazyBoundary {
public:
    /// In          solid: of the mesh.
    [[nodiscard]] const BoundarySearch& of(const Mesh& mesh, const Solid& solid) const {
        static const BoundarySearch whole{}, unknown{nullptr, false};
        if (!solid.may_overlap && !solid.has_sheets)
            return whole;
        if (!solid.is_oriented())
            return unknown;
        std::call_once(once_, [&] { found_ = find_boundary(mesh, solid); });
        return found_;
    }

private:
    mutable std::once_flag once_;
    mutable BoundarySearch found_;
};

} // namespace abut
