#pragma once

#include <abut/types.h>

#include <cstdint>
#include <vector>

namespace abut {

/// Triangles of a leaf. Small leaves are hidden and left out more often, but cost more draw calls.
inline constexpr std::uint32_t kLeafTriangles = 2048;
inline constexpr std::uint32_t kNoSlice = 0xffffffff;

/// A part, or a mesh block of a part whose mesh is large.
struct LevelItem {
    std::uint64_t place = 0;  ///< its centre along a Morton curve
    std::uint64_t digest = 0; ///< hash of all that its triangles depend on
    std::int64_t part = 0;
    std::int64_t block = 0; ///< of the mesh; 0: the whole mesh
    std::uint32_t triangles = 0;
    std::uint32_t shared = 0xffffffff; ///< index in the list of shared meshes; or none
    std::int8_t size_class = 0;

    [[nodiscard]] bool is_instance() const { return shared != 0xffffffff; }
    /// A strict order: by size, then by place.
    friend bool operator<(const LevelItem& a, const LevelItem& b);
};

/// Size class of a part: parts of one class differ by at most a factor of eight in size.
std::int8_t size_class(const Box3& box);

/// Places of boxes along a Morton curve through cells that stay the same when the bounds change
/// little.
///
/// Source      [Morton 1966], 21 bits an axis.
class PlaceCurve {
public:
    explicit PlaceCurve(const Box3& bounds);
    [[nodiscard]] std::uint64_t place(const Box3& box) const;

private:
    Vec3 lower_;
    double cell_ = 1;
};

/// A node of the tree before its geometry is made.
struct PlannedNode {
    std::uint32_t first_child = 0, children = 0; ///< contiguous and after their parent
    std::uint32_t begin = 0, end = 0;            ///< items below
    /// Of a leaf: the part of its single item that it shows, of `slices`; kNoSlice: all of it.
    std::uint32_t slice = kNoSlice, slices = 0;
    [[nodiscard]] bool is_leaf() const { return children == 0; }
};

/// Builds the tree over the items, which it sorts. Node 0 is the root; there is none without items.
///
/// Parts of one size class that lie together share a leaf; small and large parts do not. Cells are
/// halved at fixed places, so that a change of some parts changes few leaves
/// [Lauterbach, Garland, Sengupta, Luebke, Manocha 2009].
std::vector<PlannedNode> plan_levels(std::vector<LevelItem>& items);

} // namespace abut
