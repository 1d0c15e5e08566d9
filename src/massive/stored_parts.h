#pragma once

#include <abut/broad_phase.h>
#include <abut/clash.h>
#include <abut/types.h>

#include "core/hash.h"
#include "massive/block_cache.h"
#include "massive/rule_table.h"
#include "store/store_file.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace abut {

/// What a job out of core keeps of a part.
struct StoredPart {
    std::int64_t row = 0;   ///< of the store
    std::uint32_t mesh = 0; ///< index in StoredParts::meshes
    std::uint32_t model = 0;
    std::uint32_t generation =
        0; ///< of the import that brought or changed it; kLastGeneration: or a later
};
inline constexpr std::uint32_t kLastGeneration = 0xffffffff;

/// A job may have a million of them: 16 bytes each.
struct StoredMesh {
    std::int64_t mesh = 0;          ///< of the store
    std::uint32_t bytes = 0;        ///< of a Model of it, estimated; 0: it is large
    std::uint32_t stored_bytes = 0; ///< of its block; 0: it is large
};

/// A mesh that is never in memory as a whole.
struct StoredLargeMesh {
    std::uint32_t mesh = 0; ///< index in StoredParts::meshes
    std::uint64_t blocks = 0;
    std::uint64_t largest_block = 0; ///< bytes of a ModelBlock of it, estimated
    std::uint64_t bytes = 0;         ///< of all of them
};

/// Where along a large part another one lies: pairs of one cell need about the same blocks.
struct PairCell {
    std::uint32_t part = 0;
    Vec3 middle;            ///< of the other
    std::uint64_t cell = 0; ///< cells near each other have near numbers
};

struct StoredParts {
    std::vector<ModelRow> models;
    std::vector<StoredPart> parts; ///< by model, then as in its file
    std::vector<Box3> boxes;       ///< of the parts, world
    std::vector<StoredMesh> meshes;
    std::vector<StoredLargeMesh> large; ///< by mesh

    /// Of these tables, and of what LargeMeshes keeps of blocks.
    [[nodiscard]] std::uint64_t bytes() const;
    /// Null if a mesh is not large.
    [[nodiscard]] const StoredLargeMesh* find_large(std::uint32_t mesh) const;
    /// In          a pair with a large mesh; of two, that with more blocks counts.
    [[nodiscard]] PairCell cell_of(const IndexPair& pair) const;
};

/// Which parts there are, and in which state.
Hash128 parts_key(const std::vector<ModelRow>& models);
/// Errors      Error{unreadable}, naming the store: an import has changed it since the key was taken, or
///             is about to.
void require_parts(const std::vector<ModelRow>& models, const Hash128& key,
                   const std::string& store);

/// Finds parts by their rows in the store.
class PartsByRow {
public:
    explicit PartsByRow(const StoredParts& stored);
    /// The part's index in StoredParts; none if it is not there any more.
    [[nodiscard]] std::optional<std::uint32_t> find(std::int64_t row) const;

private:
    const std::vector<StoredPart>& parts_;
    std::vector<std::uint32_t> order_; ///< by row
};

/// In          rules: gets the parts in the same order; null: no rules will be asked.
/// Errors      those of the store; Error{bad_argument}, naming it, if an import has not ended.
StoredParts gather_parts(StoreFile& store, RuleTable* rules = nullptr);

/// The pairs of parts that are to be looked at, in order: boxes in reach of each other, and of
/// interest to the options and their rules.
std::vector<IndexPair> find_candidates(const StoredParts& parts, const RuleTable& rules,
                                       const ClashOptions& options);

} // namespace abut
