#pragma once

#include <abut/scene.h>
#include <abut/store.h>

#include "clash/part_instances.h"
#include "store/database/store_file.h"

#include <bit>
#include <cstring>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

namespace abut::test {

inline bool same_bits(const Mesh& a, const Mesh& b) {
    return a.positions.size() == b.positions.size() && a.triangles == b.triangles &&
           (a.positions.empty() || std::memcmp(a.positions.data(), b.positions.data(),
                                               a.positions.size() * sizeof(Vec3)) == 0);
}

/// The content of one model file in a store, in the form that read_scene returns, and the boxes of
/// its parts.
struct StoredScene {
    Scene scene;
    std::vector<Box3> boxes;
    std::vector<std::uint64_t> generations;
};

inline StoredScene stored_scene(StoreFile& file, const ModelRow& model) {
    StoredScene result;
    result.scene.file = model.file;
    std::map<std::int64_t, std::uint32_t> number_of;
    file.for_each_part(model, [&](const PartRow& row) {
        const auto [found, is_new] =
            number_of.try_emplace(row.mesh, static_cast<std::uint32_t>(result.scene.meshes.size()));
        if (is_new)
            result.scene.meshes.push_back(file.read_mesh(row.mesh));
        result.scene.parts.push_back(
            {row.id, row.name, row.type, found->second, row.world_from_mesh, row.colour});
        result.boxes.push_back(row.box);
        result.generations.push_back(row.generation);
    });
    return result;
}

/// Expects the same parts with the same geometry, bit for bit. Meshes may have other numbers, since
/// a store holds equal meshes once.
inline void expect_same_scene(const Scene& a, const Scene& b) {
    ASSERT_EQ(a.parts.size(), b.parts.size());
    for (std::size_t i = 0; i < a.parts.size(); ++i) {
        const Part &p = a.parts[i], &q = b.parts[i];
        ASSERT_EQ(p.id, q.id);
        ASSERT_EQ(p.name, q.name);
        ASSERT_EQ(p.type, q.type);
        ASSERT_EQ(p.colour, q.colour) << p.id;
        ASSERT_EQ(std::memcmp(p.world_from_mesh.m.data(), q.world_from_mesh.m.data(),
                              sizeof p.world_from_mesh.m),
                  0)
            << "transform of " << p.id;
        ASSERT_TRUE(same_bits(a.meshes.at(p.mesh), b.meshes.at(q.mesh))) << "mesh of " << p.id;
    }
}

/// Expects that the store holds this scene as its model file number `index`, with the boxes that
/// the clash job computes.
inline void expect_stored(const std::string& store, Scene scene, std::size_t index = 0) {
    StoreFile file(store, true);
    const std::vector<ModelRow> models = file.models();
    ASSERT_LT(index, models.size());
    EXPECT_FALSE(models[index].importing);
    EXPECT_EQ(models[index].unit, scene.unit);
    EXPECT_EQ(models[index].up, scene.up);
    turn_up(scene, models[index].world_up);
    const StoredScene stored = stored_scene(file, models[index]);
    expect_same_scene(scene, stored.scene);
    const PartInstances instances = gather_parts({scene});
    for (std::size_t i = 0; i < scene.parts.size(); ++i)
        ASSERT_EQ(instances.parts[i].box, stored.boxes.at(i)) << scene.parts[i].id;
}

} // namespace abut::test
