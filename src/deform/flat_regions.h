#pragma once

#include <abut/types.h>

#include "deform/leaf_features.h"
#include "tree/moving_tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The position of a vertex at the start and at the end of a step.
struct MovingVertex {
    Vec3 start, end;
};

/// The nodes whose triangles certainly do not meet each other during a step, except where they are
/// connected. The triangles below such a node form a disc. Seen along some direction, all of them
/// show the same side throughout the step, and the disc's border does not cross itself. Then no two
/// of its points lie behind each other: a map of a disc that turns no triangle over covers a place
/// as often as its border winds around it, and a simple border winds around no place twice.
///
/// Source      normal cones and contours [Volino, Magnenat-Thalmann 1994]; of moving triangles
///             [Tang, Curtis, Yoon, Manocha 2009]. Differs: the border is tested throughout the
///             step, by separating lines that hold at both ends of the motion.
class FlatRegions {
public:
    FlatRegions() = default;
    /// Finds the borders. They depend on topology alone.
    FlatRegions(const MovingTree& tree, const FeatureRuns& faces, const SurfaceView& surface);

    /// Finds the nodes that are flat during a step.
    void fit(const FeatureRuns& faces, std::span<const IndexTriangle> triangles,
             std::span<const MovingVertex> vertices);

    /// For each node: nonzero if it is flat and lies in no larger flat one.
    [[nodiscard]] std::span<const std::uint8_t> flat() const { return flat_; }
    [[nodiscard]] std::size_t bytes() const;

private:
    /// A disc of triangles below a node.
    struct Region {
        std::uint32_t node = 0;
        std::uint32_t first_leaf = 0, last_leaf = 0; ///< last_leaf is one past the end
        std::uint32_t first_border = 0, last_border = 0;
    };

    std::vector<Region> regions_;       ///< a region comes before those within it
    std::vector<std::uint32_t> outer_;  ///< regions that lie in no other
    std::vector<std::uint32_t> border_; ///< vertices around the regions
    std::vector<std::uint8_t> flat_;
};

} // namespace abut
