#pragma once

#include <abut/deformable.h>

#include "deform/leaf_features.h"
#include "mesh/representatives.h"
#include "tree/tree.h"

#include <cstddef>
#include <span>
#include <vector>

namespace abut {

struct MovingVertex {
    Vec3 start, end;
};

/// The hierarchy over a surface's swept triangles, and the boxes of the features in its leaves.
struct SweptTree {
    Tree tree;
    LeafFeatures leaves;
};

class DeformableData {
public:
    DeformableOptions options;
    std::vector<IndexTriangle> triangles;
    SurfaceFeatures features;
    std::vector<Represented> represented; ///< by each triangle
    std::vector<MovingVertex> vertices;
    SweptTree swept;

    [[nodiscard]] SurfaceView surface() const { return {vertices.size(), triangles, features}; }

    /// Builds the hierarchy anew.
    void build();
    /// Fits all boxes to the motion; builds the hierarchy anew where that is worth it.
    void refit();

private:
    [[nodiscard]] double looseness() const;

    double looseness_when_built_ = 0;
};

/// Fits all boxes to what moves until time `until`, in (0, 1].
void refit(SweptTree& swept, const DeformableData& data, double until);

} // namespace abut
