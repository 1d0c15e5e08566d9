#pragma once

#include "math/transform.h"
#include "rigid/model/model_blocks.h"
#include "rigid/solid/placed_boundary.h"
#include "rigid/solid/world_solid.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace abut {

/// A large mesh in mesh blocks, under its transform. It answers as PlacedSolid does, with few blocks
/// in memory at a time. One answer differs: an open surface that bounds no solid winds around nothing.
///
/// Only one thread may use it. The blocks must outlive it.
class PlacedBlocks final : public WorldSolid {
public:
    /// Errors      Error{bad_argument} if the transform is not finite; of all members: those of the
    ///             blocks.
    PlacedBlocks(const ModelBlocks& blocks, const Transform& world_from_mesh,
                 const std::optional<Vec3>& origin = {});

    [[nodiscard]] const Transform& world() const { return world_; }
    [[nodiscard]] std::size_t size() const { return boxes_.size(); }
    [[nodiscard]] const Box3& box(std::size_t i) const { return boxes_[i]; }
    [[nodiscard]] std::shared_ptr<const ModelBlock> block(std::size_t i) const {
        return blocks_.block(i);
    }

    /// Tells in which blocks the triangles lie that queries name by number: sorted pairs of a triangle's
    /// number and its name.
    void set_known(std::vector<std::pair<std::uint32_t, std::uint32_t>> names) {
        known_ = std::move(names);
    }
    /// Returns the name of triangle `local` of a block: both numbers in one.
    static std::uint32_t name(std::size_t block, std::uint32_t local) {
        return static_cast<std::uint32_t>(block) << ModelBlocks::kTriangleBits | local;
    }

    [[nodiscard]] std::unique_ptr<WorldSolid> seen_from(const Vec3& origin) const override;
    [[nodiscard]] bool closed() const override { return blocks_.solid().closed; }
    [[nodiscard]] bool bounds_solid() const override { return blocks_.solid().solid; }
    [[nodiscard]] int outward() const override {
        return mirrored_ ? -blocks_.solid().outward : blocks_.solid().outward;
    }
    [[nodiscard]] int weight(std::uint32_t triangle) const override {
        return mirrored_ ? -blocks_.solid().weight(triangle) : blocks_.solid().weight(triangle);
    }
    [[nodiscard]] bool is_oriented() const override { return blocks_.solid().is_oriented(); }
    [[nodiscard]] bool is_mirrored() const override { return mirrored_; }
    [[nodiscard]] const SolidBoundary* boundary() const override { return placed_boundary().get(); }
    [[nodiscard]] bool knows_boundary() const override { return placed_boundary().is_known(); }
    [[nodiscard]] std::vector<Vec3> component_points() const override;
    [[nodiscard]] Vec3 middle() const override { return middle_; }
    [[nodiscard]] double reach() const override { return reach_; }
    [[nodiscard]] Box3 world_box() const override { return box_; }
    /// Answers only for triangles of set_known(), as faces_around() does.
    [[nodiscard]] Triangle world_triangle(std::uint32_t triangle) const override;
    [[nodiscard]] std::vector<EdgeFace> faces_around(std::uint32_t triangle,
                                                     std::size_t edge) const override;
    [[nodiscard]] bool on_surface(const Vec3& point) const override;
    using WorldSolid::nearest;
    [[nodiscard]] Nearest nearest(const Vec3& point, const NearestSearch& search) const override;
    [[nodiscard]] Triangle world_slot(std::uint32_t slot) const override;
    [[nodiscard]] std::uint32_t triangle_at(std::uint32_t slot) const override;
    [[nodiscard]] Bounds bounds() const override;
    void for_each_block(const Box3& region,
                        const std::function<bool(const Block&)>& visit) const override;
    void for_each_surface_block(const Box3& region,
                                const std::function<bool(const Block&)>& visit) const override;

protected:
    [[nodiscard]] bool is_on_inner_face(const Vec3& point) const override {
        return !placed_boundary().is_near(point) && is_on_triangle(point);
    }
    [[nodiscard]] std::optional<int> crossings(const Vec3& from, const Vec3& to) const override;
    [[nodiscard]] double winding(const Vec3& point) const override;

private:
    struct PlacedBlock {
        PlacedBlock(std::shared_ptr<const ModelBlock> held, const Transform& world,
                    const std::optional<Vec3>& origin)
            : block(std::move(held)), placed(block->model, world, origin) {}
        std::shared_ptr<const ModelBlock> block;
        PlacedModel placed;
    };
    /// Returns a block. The last one is kept in memory.
    [[nodiscard]] std::shared_ptr<const PlacedBlock> placed(std::size_t i) const;
    [[nodiscard]] Vec3 to_world(const Vec3& p) const {
        return apply(world_, p) - origin_.value_or(Vec3{});
    }
    [[nodiscard]] std::uint32_t name_of(std::uint32_t triangle) const;
    /// Returns whether a triangle is dropped from the solid's boundary.
    [[nodiscard]] bool bounds_nothing(std::uint32_t triangle) const;
    /// Returns whether a point lies on a triangle. Exact.
    [[nodiscard]] bool is_on_triangle(const Vec3& point) const;
    /// The boundary is placed when it is first asked for, because most solids have none.
    [[nodiscard]] const PlacedBoundary& placed_boundary() const;

    const ModelBlocks& blocks_;
    Transform world_;
    std::optional<Vec3> origin_;
    std::vector<Box3> boxes_; ///< of each block, in the world
    Box3 box_;
    Vec3 middle_;
    double reach_ = 0;
    bool mirrored_ = false;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> known_;
    mutable std::shared_ptr<const PlacedBlock> last_;
    mutable std::size_t last_index_ = 0;
    mutable std::optional<PlacedBoundary> boundary_;
};

} // namespace abut
