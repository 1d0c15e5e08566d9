#pragma once

#include <abut/mesh.h>
#include <abut/types.h>

#include <fcl/fcl.h>
#include <memory>
#include <vector>

/// Meshes and transforms in FCL's types. Requires FCL.
namespace abut::bench {

template <class BoundingVolume>
std::shared_ptr<fcl::BVHModel<BoundingVolume>> fcl_model(const Mesh& mesh) {
    std::vector<fcl::Vector3d> vertices;
    std::vector<fcl::Triangle> triangles;
    for (const Vec3& p : mesh.positions)
        vertices.emplace_back(p.x, p.y, p.z);
    for (const auto& t : mesh.triangles)
        triangles.emplace_back(t[0], t[1], t[2]);
    auto model = std::make_shared<fcl::BVHModel<BoundingVolume>>();
    model->beginModel();
    model->addSubModel(vertices, triangles);
    model->endModel();
    return model;
}

inline fcl::Transform3d fcl_transform(const Transform& t) {
    fcl::Transform3d result = fcl::Transform3d::Identity();
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            result(row, column) = t.m[static_cast<std::size_t>(3 * column + row)];
    return result;
}

} // namespace abut::bench
