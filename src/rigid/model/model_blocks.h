#pragma once

#include <abut/model.h>
#include <abut/types.h>

#include "math/transform.h"
#include "rigid/model/solid_boundary.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace abut {

/// A mesh block of a large mesh, with a hierarchy of its own.
struct ModelBlock {
    Model model;
    std::vector<std::uint32_t> numbers; ///< of its triangles in the whole mesh, ascending
};

/// Whether a mesh in blocks bounds a solid; the fields mean the same as in Solid. Triangles go by
/// their numbers in the whole mesh.
struct BlocksSolid {
    std::vector<Vec3> component_points; ///< a vertex of each connected component
    bool closed = false, solid = false;
    int outward = 0;
    std::vector<std::int8_t> weights;
    bool has_parity_only = false;
    BoundarySearch boundary; ///< of the whole mesh

    [[nodiscard]] int weight(std::uint32_t triangle) const {
        return weights.empty() ? outward : weights[triangle];
    }
    [[nodiscard]] bool is_oriented() const {
        return solid && !has_parity_only && (outward != 0 || !weights.empty());
    }
};

/// A large mesh as mesh blocks that need not be in memory at the same time. Safe for concurrent
/// use.
class ModelBlocks {
public:
    /// A block has fewer than 2^kTriangleBits triangles, and a mesh has at most 2^kBlockBits
    /// blocks, so both numbers fit into 32 bits.
    static constexpr unsigned kTriangleBits = 17, kBlockBits = 32 - kTriangleBits;

    /// In          triangles: number in all blocks. boxes: one for each block, in the mesh's frame.
    ///             folder, memory: where, and within how many bytes, solid() may work.
    /// Errors      Error{unsupported} if there are more than 2^kBlockBits blocks.
    ModelBlocks(std::uint64_t triangles, std::vector<Box3> boxes, std::string folder,
                std::size_t memory);
    ModelBlocks(const ModelBlocks&) = delete;
    ModelBlocks& operator=(const ModelBlocks&) = delete;
    virtual ~ModelBlocks() = default;

    [[nodiscard]] std::uint64_t triangles() const { return triangles_; }
    [[nodiscard]] std::size_t size() const { return boxes_.size(); }
    /// The box of the vertices that the block's triangles use, in the mesh's frame. Empty if the
    /// block has no triangles; block() is not called for it then.
    [[nodiscard]] const Box3& box(std::size_t i) const { return boxes_[i]; }
    /// Errors      those of reading the block.
    [[nodiscard]] virtual std::shared_ptr<const ModelBlock> block(std::size_t i) const = 0;

    /// Tells whether the mesh bounds a solid. The first call reads all blocks.
    [[nodiscard]] const BlocksSolid& solid() const;

private:
    std::uint64_t triangles_;
    std::vector<Box3> boxes_;
    std::string folder_;
    std::size_t memory_;
    mutable std::once_flag once_;
    mutable BlocksSolid solid_;
};

/// As examine_solid for a mesh, reading one block after the other.
///
/// Where `memory` is enough for the whole mesh, its examination and its boundary, the answer is that of
/// examine_solid and find_boundary. Otherwise triangles are neither dropped nor turned: a mesh with duplicates is not
/// closed, and if it has several components, only parity tells the inside, so that shells that
/// overlap are no union.
///
/// Accuracy    closed, components: exact; outward: as examine_solid, to rounding.
/// Cost        reads each block two to four times; once if `memory` is enough. Sorts vertices and
///             edges on disk with `memory` bytes, plus 4 bytes and a bit for each vertex.
BlocksSolid examine_solid(const ModelBlocks& blocks, const std::string& folder, std::size_t memory);

} // namespace abut
