#pragma once

#include <abut/mesh.h>

#include <vector>

namespace abut {

/// The positions that triangles use. If a mesh uses all of its positions, they are not copied.
class UsedPositions {
public:
    /// In          a valid mesh, which must outlive this.
    explicit UsedPositions(const Mesh& mesh);
    [[nodiscard]] const std::vector<Vec3>& get() const { return all_ != nullptr ? *all_ : some_; }

private:
    const std::vector<Vec3>* all_;
    std::vector<Vec3> some_;
};

/// The box of positions under a transform, each placed by `apply`. Empty if there are none.
Box3 world_box(const std::vector<Vec3>& positions, const Transform& world_from_mesh);

} // namespace abut
