#include "clash/viewpoint/mesh_runs.h"

#include "math/transform.h"

#include <algorithm>
#include <cmath>

namespace abut {

namespace {

constexpr std::size_t kRunLength = 64;
/// Bound of the relative rounding error of a placed box.
constexpr double kBoxRounding = 1e-12;

} // namespace

MeshRuns::MeshRuns(const Mesh& mesh) {
    boxes_.resize((mesh.triangles.size() + kRunLength - 1) / kRunLength);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (const std::uint32_t corner : mesh.triangles[i])
            extend(boxes_[i / kRunLength], mesh.positions[corner]);
}

void MeshRuns::gather(const Mesh& mesh, const Transform& world_from_mesh, const Box3& box,
                      std::vector<Triangle>& triangles) const {
    for (std::size_t run = 0; run < boxes_.size(); ++run) {
        if (!overlap(placed_box(boxes_[run], world_from_mesh), box))
            continue;
        const std::size_t end = std::min(mesh.triangles.size(), (run + 1) * kRunLength);
        for (std::size_t i = run * kRunLength; i < end; ++i) {
            Triangle placed{};
            Box3 around;
            for (std::size_t k = 0; k < 3; ++k) {
                placed.at(k) = apply(world_from_mesh, mesh.positions[mesh.triangles[i].at(k)]);
                extend(around, placed.at(k));
            }
            if (overlap(around, box))
                triangles.push_back(placed);
        }
    }
}

Box3 placed_box(const Box3& box, const Transform& world_from_mesh) {
    if (is_empty(box))
        return box;
    const Vec3 middle = 0.5 * box.lower + 0.5 * box.upper;
    const Vec3 half = box.upper - middle;
    const Vec3 at = apply(world_from_mesh, middle);
    const auto& m = world_from_mesh.m;
    const auto reach = [&](std::size_t row) {
        return std::abs(m.at(row)) * half.x + std::abs(m.at(row + 3)) * half.y +
               std::abs(m.at(row + 6)) * half.z;
    };
    const Vec3 by{reach(0), reach(1), reach(2)};
    return grown({at - by, at + by}, kBoxRounding * (max_abs(at) + max_abs(by) +
                                                     sum_of_sizes(world_from_mesh) *
                                                         (max_abs(middle) + max_abs(half))));
}

} // namespace abut
