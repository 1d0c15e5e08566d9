#pragma once

#include "deform/leaf_features.h"
#include "deform/moving_vertex.h"
#include "tree/moving_tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Which nodes hold triangles that certainly do not meet each other during a step, but where they
/// hang together: those below form a disc that, seen along some direction, shows one side of all
/// its triangles and has a border that does not cross itself, always. Then no two of its points are
/// behind each other: a map of a disc that turns no triangle over takes as many points to a place
/// as its border winds around it, and a simple border winds around no place twice.
///
/// Source      normal cones and contours [Volino, Magnenat-Thalmann 1994]; of moving triangles
///             [Tang, Curtis, Yoon, Manocha 2009]. Differs: the border is tested always, by separating
///             lines that hold at both ends of the motion.
class FlatRegions {
public:
    FlatRegions() = default;
    /// Finds the borders, which depend on topology alone.
    FlatRegions(const MovingTree& tree, const FeatureRuns& faces, const SurfaceView& surface);

    /// Finds which nodes are flat during a step.
    void fit(const FeatureRuns& faces, std::span<const IndexTriangle> triangles,
             std::span<const MovingVertex> vertices);

    /// By node: not 0 where it is flat and lies in no larger one that is.
    [[nodiscard]] std::span<const std::uint8_t> flat() const { return flat_; }
    [[nodiscard]] std::size_t bytes() const;

private:
    /// A disc below a node.
    struct Region {
        std::uint32_t node = 0;
        std::uint32_t first_leaf = 0, last_leaf = 0; ///< the latter one beyond
        std::uint32_t first_border = 0, last_border = 0;
    };

    std::vector<Region> regions_;       ///< one that holds others comes before them
    std::vector<std::uint32_t> outer_;  ///< regions that lie in no other
    std::vector<std::uint32_t> border_; ///< vertices around the regions
    std::vector<std::uint8_t> flat_;
};

} // namespace abut
