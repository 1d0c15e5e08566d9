#pragma once

#include "deform/deformable_data.h"
#include "deform/triangle_pairs.h"

#include <cstddef>
#include <memory>

namespace abut {

/// Pairs of triangles whose swept boxes overlap, found without a hierarchy: representative
/// triangles go with any way of finding them.
class TriangleCulling {
public:
    TriangleCulling() = default;
    TriangleCulling(const TriangleCulling&) = delete;
    TriangleCulling& operator=(const TriangleCulling&) = delete;
    virtual ~TriangleCulling() = default;

    [[nodiscard]] virtual std::size_t tasks() const = 0;
    /// Visits the pairs of one task; all tasks together visit each pair once.
    virtual void run(std::size_t task, TrianglePairVisitor& visitor) const = 0;
};

/// A uniform grid. A pair is visited in the cell that holds the lowest corner of what both boxes
/// share.
/// Cost        boxes are entered in all the cells that they touch; best where all are of about one
///             size.
std::unique_ptr<const TriangleCulling> make_grid_culling(const DeformableData& a,
                                                         const DeformableData& b, float margin);

/// Boxes sorted along the axis on which they lie farthest spread; each is compared with those
/// that begin before it ends.
/// Source      [Baraff 1992], one axis.
std::unique_ptr<const TriangleCulling> make_sweep_culling(const DeformableData& a,
                                                          const DeformableData& b, float margin);

} // namespace abut
