#pragma once

#include "clash/classify_pair.h"
#include "rigid/solid/placed_blocks.h"
#include "rigid/solid/placed_solid.h"

#include <memory>
#include <optional>
#include <span>

namespace abut {

/// The models that a part consists of: its only model, or the mesh blocks of a large mesh. Not
/// thread-safe.
class BlockList {
public:
    /// In          part: it and all that it refers to must outlive the list.
    explicit BlockList(const ClashPart& part) : part_(part) {
        if (part.blocks != nullptr)
            placed_.emplace(*part.blocks, part.world_from_mesh);
    }

    /// One of the models. `block` keeps it in memory; it is null if the part is not in blocks.
    struct Held {
        std::shared_ptr<const ModelBlock> block;
        const Model* model = nullptr;
        /// Index in the whole mesh of each triangle of the block; empty if the model is the whole
        /// mesh.
        std::span<const std::uint32_t> numbers;

        [[nodiscard]] std::uint32_t number(std::uint32_t triangle) const {
            return numbers.empty() ? triangle : numbers[triangle];
        }
    };

    [[nodiscard]] const ClashPart& part() const { return part_; }
    [[nodiscard]] std::uint64_t triangles() const {
        return placed_ ? part_.blocks->triangles() : part_.model->mesh().triangles.size();
    }
    [[nodiscard]] std::size_t size() const { return placed_ ? placed_->size() : 1; }
    /// World box of model i.
    [[nodiscard]] const Box3& box(std::size_t i) const {
        return placed_ ? placed_->box(i) : part_.box;
    }
    [[nodiscard]] Held hold(std::size_t i) const {
        if (!placed_)
            return {nullptr, part_.model, {}};
        auto block = placed_->block(i);
        const Model* const model = &block->model;
        const std::span<const std::uint32_t> numbers = block->numbers;
        return {std::move(block), model, numbers};
    }
    /// The part's blocks; null if the part is one model.
    [[nodiscard]] PlacedBlocks* placed() { return placed_ ? &*placed_ : nullptr; }
    /// The part as a solid.
    ///
    /// Cost        the first call examines a model, or reads all blocks, unless that was done before.
    [[nodiscard]] const WorldSolid& solid() {
        if (placed_)
            return *placed_;
        if (!solid_)
            solid_.emplace(*part_.model, part_.model->data().solid(), part_.world_from_mesh);
        return *solid_;
    }

private:
    const ClashPart& part_;
    std::optional<PlacedBlocks> placed_;
    std::optional<PlacedSolid> solid_;
};

/// Whether two parts consist of the same triangles at the same place. The order of the triangles
/// and of their corners does not matter.
///
/// Accuracy    compares boxes and numbers of triangles, then hashes of 128 bits. An accidental
///             match is not to be expected.
/// Cost        one pass over both parts, only if their boxes and numbers of triangles are equal.
bool same_triangles(const BlockList& a, const BlockList& b);

} // namespace abut
