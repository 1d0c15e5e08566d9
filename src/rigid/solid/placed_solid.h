#pragma once

#include "rigid/model/placed_model.h"
#include "rigid/model/solid.h"
#include "rigid/solid/world_solid.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace abut {

/// A placed model that may bound a solid.
class PlacedSolid final : public WorldSolid {
public:
    /// In          solid: of the model; it must outlive this.
    /// Errors      as PlacedModel.
    PlacedSolid(const Model& model, const Solid& solid, const Transform& world_from_model,
                const std::optional<Vec3>& origin = {});

    [[nodiscard]] const PlacedModel& model() const { return model_; }
    [[nodiscard]] const Solid& solid() const { return solid_; }
    /// Returns whether the transform mirrors.
    [[nodiscard]] bool mirrored() const { return mirrored_; }

    [[nodiscard]] std::unique_ptr<WorldSolid> seen_from(const Vec3& origin) const override {
        auto seen = std::make_unique<PlacedSolid>(model_.model(), solid_, model_.world(), origin);
        seen->keeps_faces_ = true;
        return seen;
    }
    [[nodiscard]] bool closed() const override { return solid_.closed; }
    [[nodiscard]] bool bounds_solid() const override { return solid_.solid; }
    /// Returns solid().outward in the world: a mirroring transform reverses it.
    [[nodiscard]] int outward() const override {
        return mirrored_ ? -solid_.outward : solid_.outward;
    }
    [[nodiscard]] std::vector<Vec3> component_points() const override;
    [[nodiscard]] Vec3 middle() const override { return model_.middle(); }
    [[nodiscard]] double reach() const override { return model_.reach(); }
    [[nodiscard]] Box3 world_box() const override;
    [[nodiscard]] Triangle world_triangle(std::uint32_t triangle) const override {
        return model_.world_triangle(triangle);
    }
    [[nodiscard]] std::vector<EdgeFace> faces_around(std::uint32_t triangle,
                                                     std::size_t edge) const override;
    [[nodiscard]] bool on_surface(const Vec3& point) const override {
        return model_.on_surface(point);
    }
    using WorldSolid::nearest;
    [[nodiscard]] Nearest nearest(const Vec3& point, const NearestSearch& search) const override {
        return nearest_point(model_, point, search, kept());
    }
    /// A slot is that of the tree.
    [[nodiscard]] Triangle world_slot(std::uint32_t slot) const override {
        return model_.world_slot(slot);
    }
    [[nodiscard]] std::uint32_t triangle_at(std::uint32_t slot) const override {
        return model_.data().triangle_at(slot);
    }
    [[nodiscard]] Bounds bounds() const override {
        return {model_.tree_from_world(), model_.world_from_tree(), model_.data().tree().bounds};
    }
    /// Visits the model, whatever the region.
    void for_each_block(const Box3& region,
                        const std::function<bool(const Block&)>& visit) const override;

protected:
    [[nodiscard]] std::optional<int> crossings(const Vec3& from, const Vec3& to) const override {
        return abut::crossings(model_, from, to, kept());
    }
    [[nodiscard]] double winding(const Vec3& point) const override;

private:
    [[nodiscard]] PreparedFaces* kept() const { return keeps_faces_ ? &faces() : nullptr; }

    PlacedModel model_;
    const Solid& solid_;
    bool mirrored_;
    bool keeps_faces_ = false; ///< for later queries, because only one thread uses this
};

} // namespace abut
