#pragma once

#include <abut/types.h>

#include "store/store_file.h"
#include "walk/box_tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// What is read from the store at once: a mesh that lies whole in one block, or one block of a larger
/// mesh.
struct StoredPiece {
    std::int64_t number = 0; ///< of the mesh, or the block
    std::uint32_t bytes = 0; ///< of a Model of it, at most
    bool is_block = false;
};

/// All parts of a store by their boxes. A part whose mesh was cut has an entry for each piece, any
/// other one. Entries are numbered as the lanes of their tree are. Never changes once made: any thread
/// may read it.
///
/// Some 45 bytes an entry and 16 a piece stay in memory.
class PartTable {
public:
    /// Errors      those of the store; Error{bad_argument}, naming it, if an import has not ended.
    explicit PartTable(StoreFile& store);

    [[nodiscard]] const BoxTree& tree() const { return tree_; }
    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(rows_.size()); }
    /// The row of its part.
    [[nodiscard]] std::int64_t row(std::uint32_t entry) const { return rows_[entry]; }
    [[nodiscard]] std::uint32_t piece_of(std::uint32_t entry) const { return pieces_of_[entry]; }
    [[nodiscard]] const StoredPiece& piece(std::uint32_t piece) const { return pieces_[piece]; }
    /// The entries of the part with a row; empty if there is none.
    [[nodiscard]] std::span<const std::uint32_t> entries(std::int64_t row) const;
    /// Bytes of the largest piece.
    [[nodiscard]] std::uint64_t largest_piece() const;
    [[nodiscard]] std::size_t bytes() const;

    /// Boxes of the tree are about the middle of the parts, so that single precision is spent where they
    /// are. Encloses the box.
    [[nodiscard]] Aabb narrow(const Box3& box) const;
    [[nodiscard]] Vec3 narrow(const Vec3& point) const { return point - middle_; }

private:
    Vec3 middle_;
    BoxTree tree_;
    std::vector<std::int64_t> rows_;       ///< by entry
    std::vector<std::uint32_t> pieces_of_; ///< by entry
    std::vector<std::uint32_t> by_row_;    ///< entries
    std::vector<StoredPiece> pieces_;
};

} // namespace abut
