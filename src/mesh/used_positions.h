#pragma once

#include <abut/mesh.h>

#include <vector>

namespace abut {

/// Positions that a triangle uses. Shares the mesh's own where it uses all of them.
class UsedPositions {
public:
    /// In          a valid mesh, which must outlive this.
    explicit UsedPositions(const Mesh& mesh);
    [[nodiscard]] const std::vector<Vec3>& get() const { return all_ != nullptr ? *all_ : some_; }

private:
    const std::vector<Vec3>* all_;
    std::vector<Vec3> some_;
};

/// The box of positions under a transform, each as `apply` places it; empty if there is none.
Box3 world_box(const std::vector<Vec3>& positions, const Transform& world_from_mesh);

} // namespace abut
