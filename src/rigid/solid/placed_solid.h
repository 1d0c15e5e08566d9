#pragma once

#include "rigid/model/placed_model.h"
#include "rigid/model/solid.h"
#include "rigid/solid/placed_boundary.h"
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
    [[nodiscard]] int weight(std::uint32_t triangle) const override {
        return mirrored_ ? -solid_.weight(triangle) : solid_.weight(triangle);
    }
    [[nodiscard]] bool is_oriented() const override { return solid_.is_oriented(); }
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
        return model_.on_surface(point) && boundary_.is_near(point);
    }
    using WorldSolid::nearest;
    [[nodiscard]] Nearest nearest(const Vec3& point, const NearestSearch& search) const override {
        return nearest_point(surface(), point, search, kept());
    }
    /// A slot is that of the tree of surface().
    [[nodiscard]] Triangle world_slot(std::uint32_t slot) const override {
        return surface().world_slot(slot);
    }
    [[nodiscard]] std::uint32_t triangle_at(std::uint32_t slot) const override {
        return boundary() != nullptr ? boundary_.triangle_at(slot)
                                     : model_.data().triangle_at(slot);
    }
    [[nodiscard]] bool is_mirrored() const override { return mirrored_; }
    [[nodiscard]] const SolidBoundary* boundary() const override { return boundary_.get(); }
    [[nodiscard]] bool knows_boundary() const override { return boundary_.is_known(); }
    /// Returns the surface without the faces that lie inside the solid.
    [[nodiscard]] const PlacedModel& surface() const {
        return boundary() != nullptr ? boundary_.placed() : model_;
    }
    [[nodiscard]] Bounds bounds() const override {
        return {model_.tree_from_world(), model_.world_from_tree(), model_.data().tree().bounds};
    }
    /// Visits the model, whatever the region.
    void for_each_block(const Box3& region,
                        const std::function<bool(const Block&)>& visit) const override;
    void for_each_surface_block(const Box3& region,
                                const std::function<bool(const Block&)>& visit) const override;

protected:
    [[nodiscard]] bool is_on_inner_face(const Vec3& point) const override {
        return !boundary_.is_near(point) && model_.on_surface(point);
    }
    [[nodiscard]] std::optional<int> crossings(const Vec3& from, const Vec3& to) const override;
    [[nodiscard]] double winding(const Vec3& point) const override;

private:
    /// The kept faces are those of surface().
    [[nodiscard]] PreparedFaces* kept() const { return keeps_faces_ ? &faces() : nullptr; }

    PlacedModel model_;
    const Solid& solid_;
    PlacedBoundary boundary_;
    bool mirrored_;
    bool keeps_faces_ = false; ///< for later queries, because only one thread uses this
};

} // namespace abut
