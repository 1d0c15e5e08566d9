#pragma once

#include <abut/scene.h>
#include <abut/walk.h>

#include "store/database/store_file.h"
#include "tests/support/folder.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"
#include "walk/probe.h"
#include "world/narrow_phase/narrow_phase.h"

#include <map>
#include <string>
#include <vector>

/// Random stores and probes for tests of walks.
namespace abut::test {

inline constexpr double kSceneReach = 5; ///< half the size of the scene

inline Mesh some_body(Random& random) {
    const double size = random.uniform(0.1, 0.5);
    switch (random.integer(0, 3)) {
    case 0:
        return box_mesh({-size, -0.2, -0.3}, {size, 0.3, 0.2});
    case 1:
        return sphere_mesh(size, random.integer(5, 30), random.integer(4, 15));
    case 2:
        return torus_mesh(size, 0.3 * size, random.integer(5, 40), random.integer(4, 15));
    default:
        return soup_mesh(random, random.integer(1, 30), size, 0.2);
    }
}

inline Transform some_place(Random& random) {
    Transform world = random.chance(0.8) ? random.linear_map(false) : random.linear_map(true);
    const Vec3 at{random.uniform(-kSceneReach, kSceneReach), random.uniform(-1, 1),
                  random.uniform(-kSceneReach, kSceneReach)};
    world.m[9] = at.x, world.m[10] = at.y, world.m[11] = at.z;
    return world;
}

/// A store of random parts, some of which share a mesh. With `with_large`, one mesh is so large
/// that it is cut into blocks.
inline std::string some_store(Random& random, const Folder& folder, bool with_large) {
    Scene scene;
    const int parts = random.integer(50, 250);
    if (with_large)
        scene.meshes.push_back(torus_mesh(3, 1, 300, 150));
    for (int i = 0; i < parts; ++i) {
        if (scene.meshes.size() < (with_large ? 2 : 1) || random.chance(0.6))
            scene.meshes.push_back(some_body(random));
        const auto last = static_cast<int>(scene.meshes.size()) - 1;
        const int mesh = with_large && i < 2 ? 0 : random.integer(with_large ? 1 : 0, last);
        scene.parts.push_back({"part" + std::to_string(i), "name" + std::to_string(i), "type",
                               static_cast<std::uint32_t>(mesh), some_place(random)});
    }
    write_glb(scene, folder / "parts.glb");
    (void)import_models({folder / "parts.glb"}, folder / "parts.abut");
    return folder / "parts.abut";
}

struct KnownPart {
    BodyShape shape;
    Transform world;
    bool is_cut = false;
};

/// A random probe of any kind, small compared with the scene.
struct SomeProbe {
    Probe probe;
    Transform world;
};
inline SomeProbe some_probe(Random& random, const Vec3& near) {
    const auto make = [&]() -> Probe {
        switch (random.integer(0, 4)) {
        case 0:
            return Sphere{random.in_cube(0.1), random.uniform(0, 0.3)};
        case 1:
            return Capsule{{{0, -0.4, 0}, {0, 0.4, 0}}, random.uniform(0, 0.3)};
        case 2:
            return Box3{{-0.2, -0.1, -0.3}, {0.1, 0.2, 0.2}};
        case 3:
            return Convex(std::vector<Vec3>{{0, 0, 0}, {0.3, 0, 0}, {0, 0.4, 0}, {0, 0, 0.3}});
        default:
            return Model(some_body(random));
        }
    };
    Pose pose = random.pose(0.5);
    pose.translation = pose.translation + near;
    return {make(), pose};
}

/// All parts of a store, in memory.
inline std::map<WalkPart, KnownPart> parts_of(const std::string& path) {
    std::map<WalkPart, KnownPart> known;
    StoreFile file(path, true);
    file.for_each_part([&](const PartRow& part) {
        const MeshRow mesh = file.mesh(part.mesh);
        known.emplace(WalkPart{part.part}, KnownPart{Model(file.read_mesh(part.mesh)),
                                                     part.world_from_mesh, mesh.blocks > 1});
    });
    return known;
}

inline BodyGap gap_of(const KnownPart& part, const Probe& probe, const Transform& world,
                      Depths depths) {
    PairWarmStart warm_start;
    return gap_between({part.shape, part.world}, {probe.data().shape(), world}, HUGE_VAL, depths,
                       warm_start);
}
inline bool touches(const KnownPart& part, const Probe& probe, const Transform& world) {
    PairWarmStart warm_start;
    return touch({part.shape, part.world}, {probe.data().shape(), world}, warm_start);
}

} // namespace abut::test
