#pragma once

#include <abut/broad_phase.h>
#include <abut/clash.h>
#include <abut/types.h>

#include "clash/rules/rule_table.h"
#include "core/hash.h"
#include "massive/work/block_cache.h"
#include "store/database/store_file.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace abut {

/// The data of a part that an out-of-core job keeps in memory.
struct StoredPart {
    std::int64_t row = 0;   ///< row in the store
    std::uint32_t mesh = 0; ///< index in StoredParts::meshes
    std::uint32_t model = 0;
    std::uint32_t generation =
        0; ///< of the import that added or last changed it, at most kLastGeneration
};
inline constexpr std::uint32_t kLastGeneration = 0xffffffff;

/// A mesh of the store. It takes 16 bytes, because a job may have a million of them.
struct StoredMesh {
    std::int64_t mesh = 0;          ///< row in the store
    std::uint32_t bytes = 0;        ///< estimated size of its Model; 0 for a large mesh
    std::uint32_t stored_bytes = 0; ///< compressed size in the store; 0 for a large mesh
};

/// A large mesh, which is in memory only block by block.
struct StoredLargeMesh {
    std::uint32_t mesh = 0; ///< index in StoredParts::meshes
    std::uint64_t blocks = 0;
    std::uint64_t largest_block = 0; ///< bytes of its largest ModelBlock, estimated
    std::uint64_t bytes = 0;         ///< of all its blocks
};

/// The cell of a part with a large mesh in which the other part of a pair lies. Pairs of one cell
/// need about the same mesh blocks.
struct PairCell {
    std::uint32_t part = 0; ///< with the large mesh
    Vec3 middle;            ///< of the other part's box
    std::uint64_t cell = 0; ///< nearby cells have nearby numbers
};

struct StoredParts {
    std::vector<ModelRow> models;
    std::vector<ModelPrecision> precisions; ///< by model
    std::vector<StoredPart> parts;          ///< by model, then in the file's order
    std::vector<Box3> boxes;                ///< world boxes, by part
    std::vector<StoredMesh> meshes;
    std::vector<StoredLargeMesh> large; ///< sorted by mesh
    ClashReport::Surfaces surfaces;     ///< the parts that bound no solid

    /// Bytes of these tables and of the lists of blocks that LargeMeshes keeps.
    [[nodiscard]] std::uint64_t bytes() const;
    /// Returns the large mesh of this index; null if the mesh is not large.
    [[nodiscard]] const StoredLargeMesh* find_large(std::uint32_t mesh) const;
    /// Returns the cell of a pair.
    /// In          pair: at least one of its meshes is large. If both are, the one with more blocks
    ///             is divided into cells.
    [[nodiscard]] PairCell cell_of(const IndexPair& pair) const;
};

/// Returns a key of all parts of the models and of their state. It changes when an import adds,
/// changes or removes parts.
Hash128 parts_key(const std::vector<ModelRow>& models);
/// Errors      Error{unreadable}, naming the store, if an import has changed it since the key was
///             taken or is under way.
void require_parts(const std::vector<ModelRow>& models, const Hash128& key,
                   const std::string& store);

/// Finds parts by their rows in the store.
class PartsByRow {
public:
    explicit PartsByRow(const StoredParts& stored);
    /// Returns the part's index in StoredParts; none if the part does not exist any more.
    [[nodiscard]] std::optional<std::uint32_t> find(std::int64_t row) const;

private:
    const std::vector<StoredPart>& parts_;
    std::vector<std::uint32_t> order_; ///< part indices, sorted by row
};

/// Reads the tables of parts and meshes from a store.
///
/// In          rules: the parts, what rules ask about them, and their relations are added to it in
///             the same order; may be null.
/// Errors      those of the store; Error{bad_argument}, naming it, if an import has not ended.
StoredParts gather_parts(StoreFile& store, RuleTable* rules = nullptr);

/// The number of pairs that are left out, by LeftOut.
using LeftOutCounts = decltype(ClashReport::left_out);

/// Returns the candidate pairs, sorted: pairs of parts whose boxes are within the reach of their
/// terms and which the options and their rules select.
///
/// In          left_out: receives the numbers of other pairs; may be null.
std::vector<IndexPair> find_candidates(const StoredParts& parts, const RuleTable& rules,
                                       const ClashOptions& options,
                                       LeftOutCounts* left_out = nullptr);

} // namespace abut
