#pragma once

#include <abut/model.h>
#include <abut/types.h>

#include "math/transform.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace abut {

/// Triangles of a large mesh that lie together, with a hierarchy of their own.
struct ModelBlock {
    Model model;
    std::vector<std::uint32_t> numbers; ///< that its triangles have in the whole, ascending
};

/// What a mesh in blocks is as a whole: as Solid says of a mesh in memory.
struct BlocksSolid {
    std::vector<Vec3> component_points; ///< a vertex of each connected component
    bool closed = false, solid = false;
    int outward = 0;
};

/// A large mesh as blocks that need not be in memory all at once. Any number of threads may ask.
class ModelBlocks {
public:
    /// A block has fewer triangles than this, and a mesh fewer blocks: the two fit into one number.
    static constexpr unsigned kTriangleBits = 17, kBlockBits = 32 - kTriangleBits;

    /// In          triangles: of all blocks together; boxes: of each, in the mesh's frame. folder,
    ///             memory: where, and in how many bytes, solid() may work.
    /// Errors      Error{unsupported} if there are more blocks than a number has room for.
    ModelBlocks(std::uint64_t triangles, std::vector<Box3> boxes, std::string folder,
                std::size_t memory);
    ModelBlocks(const ModelBlocks&) = delete;
    ModelBlocks& operator=(const ModelBlocks&) = delete;
    virtual ~ModelBlocks() = default;

    [[nodiscard]] std::uint64_t triangles() const { return triangles_; }
    [[nodiscard]] std::size_t size() const { return boxes_.size(); }
    /// In the mesh's frame, of the vertices that its triangles use; empty: it has none, and is not
    /// asked for.
    [[nodiscard]] const Box3& box(std::size_t i) const { return boxes_[i]; }
    /// Errors      of whatever it is read from.
    [[nodiscard]] virtual std::shared_ptr<const ModelBlock> block(std::size_t i) const = 0;

    /// Whether the mesh bounds a solid; the first question reads all blocks.
    [[nodiscard]] const BlocksSolid& solid() const;

private:
    std::uint64_t triangles_;
    std::vector<Box3> boxes_;
    std::string folder_;
    std::size_t memory_;
    mutable std::once_flag once_;
    mutable BlocksSolid solid_;
};

/// As examine_solid, of blocks one after the other.
///
/// Accuracy    closed, components: exact; outward as examine_solid, to rounding.
/// Cost        reads each block two to four times; sorts vertices and edges on the disk, in `memory`
///             bytes, a bit and 4 bytes a vertex on top.
BlocksSolid examine_solid(const ModelBlocks& blocks, const std::string& folder, std::size_t memory);

} // namespace abut
