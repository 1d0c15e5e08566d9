#pragma once

#include <abut/clash.h>
#include <abut/scene.h>

#include "tests/support/random.h"
#include "tests/support/shapes.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

/// Random scenes whose parts clash, and comparisons of reports.
namespace abut::test {

inline Mesh some_body(Random& random) {
    const double size = random.uniform(0.1, 0.5);
    const Vec3 half{size, random.uniform(0.1, 0.5), random.uniform(0.1, 0.5)};
    switch (random.integer(0, 3)) {
    case 0:
        return box_mesh({-half.x, -half.y, -half.z}, half);
    case 1:
        return sphere_mesh(size, random.integer(5, 30), random.integer(4, 15));
    case 2:
        return torus_mesh(size, 0.3 * size, random.integer(5, 40), random.integer(4, 15));
    default:
        return soup_mesh(random, random.integer(1, 30), size, 0.2);
    }
}

/// Parts in a flat box. It is so crowded that about every third pair of nearby boxes is a clash.
inline Scene some_scene(Random& random, int parts, double reach) {
    Scene scene;
    PropertiesBuilder properties;
    for (int i = 0; i < parts; ++i) {
        if (scene.meshes.empty() || random.chance(0.7))
            scene.meshes.push_back(some_body(random));
        Transform world = random.pose(0);
        world.m[9] = random.uniform(-reach, reach);
        world.m[10] = random.uniform(-1, 1);
        world.m[11] = random.uniform(-reach, reach);
        scene.parts.push_back({"part" + std::to_string(i), "name" + std::to_string(i % 7),
                               "type" + std::to_string(i % 3),
                               static_cast<std::uint32_t>(
                                   random.integer(0, static_cast<int>(scene.meshes.size()) - 1)),
                               world});
        properties.add("extras.level", std::to_string(i % 4));
        properties.next_part();
    }
    scene.properties = properties.finish(scene.parts.size());
    return scene;
}

inline std::vector<ClashRule> some_rules(Random& random) {
    if (random.chance(0.5))
        return {};
    ClashRule first, rest;
    first.name = "first";
    first.a.type = {"type0"};
    first.clearance = 0.2;
    first.ignore.same_name_prefix = 5;
    rest.name = "rest";
    rest.severity = "low";
    if (random.chance(0.5))
        rest.tolerated_depth = random.uniform(0, 0.1);
    if (random.chance(0.5))
        rest.kinds = {ClashKind::hard, ClashKind::clearance};
    if (random.chance(0.5))
        rest.a.query = PartQuery::parse("name != name3 and extras.level < 2");
    return {first, rest};
}

inline void expect_equal(const ClashReport& report, const std::vector<Scene>& models,
                         const ClashReport& truth, const std::vector<Scene>& truth_models) {
    ASSERT_EQ(report.candidates, truth.candidates);
    ASSERT_EQ(report.counts, truth.counts);
    ASSERT_EQ(report.left_out, truth.left_out);
    ASSERT_EQ(report.neighbours, truth.neighbours);
    ASSERT_EQ(report.clashes.size(), truth.clashes.size());
    ASSERT_EQ(report.models.size(), truth.models.size());
    for (std::size_t i = 0; i < truth.models.size(); ++i) {
        ASSERT_EQ(report.models[i].file, truth.models[i].file);
        ASSERT_EQ(report.models[i].parts, truth.models[i].parts);
        ASSERT_EQ(report.models[i].triangles, truth.models[i].triangles);
    }
    for (std::size_t i = 0; i < truth.clashes.size(); ++i) {
        const Clash &a = report.clashes[i], &b = truth.clashes[i];
        ASSERT_EQ(a.id, b.id);
        ASSERT_EQ(a.kind, b.kind);
        ASSERT_EQ(a.model, b.model);
        // Depths are found to 2^-20, and of equally deep points any may be told.
        ASSERT_NEAR(a.distance, b.distance, a.distance < 0 ? -0x1p-19 * a.distance : 0);
        if (a.distance == b.distance && a.kind != ClashKind::hard) {
            ASSERT_EQ(a.point_a, b.point_a);
            ASSERT_EQ(a.point_b, b.point_b);
            ASSERT_EQ(a.direction, b.direction);
        }
        ASSERT_EQ(a.triangle_pairs, b.triangle_pairs);
        ASSERT_EQ(a.rule, b.rule);
        ASSERT_EQ(a.severity, b.severity);
        ASSERT_EQ(a.neighbours, b.neighbours);
        ASSERT_EQ(a.volume, b.volume);
        ASSERT_EQ(a.volume_error, b.volume_error);
        for (std::size_t side = 0; side < 2; ++side) {
            const Part &p = models.at(a.model.at(side)).parts.at(a.part.at(side)),
                       &q = truth_models.at(b.model.at(side)).parts.at(b.part.at(side));
            ASSERT_EQ(p.id, q.id);
            ASSERT_EQ(p.name, q.name);
            ASSERT_EQ(p.type, q.type);
        }
    }
}

} // namespace abut::test
