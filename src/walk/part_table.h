#pragma once

#include <abut/types.h>

#include "store/database/store_file.h"
#include "walk/box_tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The unit that is read from the store at once: a mesh that is stored in one block, or one mesh
/// block of a larger mesh.
struct StoredChunk {
    std::int64_t number = 0; ///< number of the mesh or the mesh block
    std::uint32_t bytes = 0; ///< upper bound of the size of its Model
    bool is_block = false;
};

/// All parts of a store, found by their boxes. A part has one entry, or one for each mesh block if
/// its mesh was cut. Entries are numbered as the lanes of the tree. The table never changes, so any
/// thread may read it.
///
/// It takes some 45 bytes per entry and 16 per stored chunk.
class PartTable {
public:
    /// Errors      those of the store; Error{bad_argument}, naming it, if an import has not ended.
    explicit PartTable(StoreFile& store);

    [[nodiscard]] const BoxTree& tree() const { return tree_; }
    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(rows_.size()); }
    /// The store row of the entry's part.
    [[nodiscard]] std::int64_t row(std::uint32_t entry) const { return rows_[entry]; }
    [[nodiscard]] std::uint32_t chunk_of(std::uint32_t entry) const { return chunks_of_[entry]; }
    [[nodiscard]] const StoredChunk& chunk(std::uint32_t chunk) const { return chunks_[chunk]; }
    /// Returns the entries of the part with this row; empty if there is no such part.
    [[nodiscard]] std::span<const std::uint32_t> entries(std::int64_t row) const;
    /// Bytes of the largest stored chunk.
    [[nodiscard]] std::uint64_t largest_chunk() const;
    [[nodiscard]] std::size_t bytes() const;

    /// Returns a single-precision box of the tree that encloses the box. The tree's frame has its
    /// origin in the middle of the first part, so that single precision is spent near the parts.
    [[nodiscard]] Aabb narrow(const Box3& box) const;
    [[nodiscard]] Vec3 narrow(const Vec3& point) const { return point - middle_; }

private:
    Vec3 middle_;
    BoxTree tree_;
    std::vector<std::int64_t> rows_;       ///< by entry
    std::vector<std::uint32_t> chunks_of_; ///< by entry
    std::vector<std::uint32_t> by_row_;    ///< entries, sorted by row
    std::vector<StoredChunk> chunks_;
};

} // namespace abut
