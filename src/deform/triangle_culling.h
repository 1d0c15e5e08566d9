#pragma once

#include "deform/deformable_data.h"
#include "deform/triangle_pairs.h"

#include <cstddef>
#include <memory>

namespace abut {

/// Finds the pairs of triangles whose swept boxes overlap, without a hierarchy. Representative
/// triangles work with any way of finding them.
class TriangleCulling {
public:
    TriangleCulling() = default;
    TriangleCulling(const TriangleCulling&) = delete;
    TriangleCulling& operator=(const TriangleCulling&) = delete;
    virtual ~TriangleCulling() = default;

    [[nodiscard]] virtual std::size_t tasks() const = 0;
    /// Visits the pairs of one task. All tasks together visit each pair once.
    virtual void run(std::size_t task, TrianglePairVisitor& visitor) const = 0;
};

/// Culling with a uniform grid. A pair is visited in the cell that holds the lowest corner of the
/// intersection of both boxes.
///
/// Cost        boxes are entered in all the cells that they touch; best if all have about the same
///             size.
std::unique_ptr<const TriangleCulling> make_grid_culling(const DeformableData& a,
                                                         const DeformableData& b, float margin);

/// Culling by sweep and prune: boxes are sorted along the axis on which they are spread the most.
/// Each is compared with those that begin before it ends.
///
/// Source      [Baraff 1992], one axis.
std::unique_ptr<const TriangleCulling> make_sweep_culling(const DeformableData& a,
                                                          const DeformableData& b, float margin);

} // namespace abut
