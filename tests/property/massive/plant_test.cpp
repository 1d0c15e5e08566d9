#include <abut/error.h>
#include <abut/mesh.h>

#include "scenes/plant/plant.h"
#include "tests/property/massive/plant_reference.h"
#include "tests/support/folder.h"
#include "tests/support/sanitizer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <unordered_map>

namespace abut {
namespace {

Plant plant_of(std::uint64_t triangles, int clashes, std::uint64_t seed, double clearance = 0.05) {
    return make_plant(
        {.triangles = triangles, .clashes = clashes, .seed = seed, .clearance = clearance});
}

using PartPair = std::pair<std::uint32_t, std::uint32_t>;

std::map<PartPair, const PlantedClash*> truth_by_part(const Plant& plant) {
    std::unordered_map<std::string, std::uint32_t> part_of_id;
    for (std::uint32_t i = 0; i < plant.scene.parts.size(); ++i) {
        part_of_id.emplace(plant.scene.parts[i].id, i);
    }
    std::map<PartPair, const PlantedClash*> result;
    for (const PlantedClash& clash : plant.truth) {
        const PartPair pair = std::minmax(part_of_id.at(clash.a), part_of_id.at(clash.b));
        EXPECT_TRUE(result.emplace(pair, &clash).second) << "a pair planted twice";
    }
    return result;
}

/// FNV-1a hash of everything in a plant.
std::uint64_t hash_of(const Plant& plant) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    const auto mix = [&](std::uint64_t value) {
        for (int byte = 0; byte < 8; ++byte) {
            hash = (hash ^ (value >> (8 * byte) & 255)) * 0x100000001b3U;
        }
    };
    const auto text = [&](const std::string& s) {
        for (const char c : s) {
            mix(static_cast<std::uint64_t>(c));
        }
    };
    for (const Mesh& mesh : plant.scene.meshes) {
        for (const Vec3& p : mesh.positions) {
            mix(std::bit_cast<std::uint64_t>(p.x));
            mix(std::bit_cast<std::uint64_t>(p.y));
            mix(std::bit_cast<std::uint64_t>(p.z));
        }
        for (const auto& t : mesh.triangles) {
            std::for_each(t.begin(), t.end(), mix);
        }
    }
    for (const Part& part : plant.scene.parts) {
        text(part.id + part.name + part.type);
        mix(part.mesh);
        for (const double v : part.world_from_mesh.m) {
            mix(std::bit_cast<std::uint64_t>(v));
        }
    }
    text(plant_truth_json(plant));
    return hash;
}

TEST(Plant, HitsItsNumberOfTriangles) {
    for (const std::uint64_t target : {10'000U, 23'000U, 50'000U, 200'000U, 900'000U,
                                       test::reduced_for_threads(6'000'000U, 1'000'000U)}) {
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            const Plant plant = plant_of(target, 50, seed);
            std::uint64_t counted = 0;
            for (const Part& part : plant.scene.parts) {
                counted += plant.scene.meshes[part.mesh].triangles.size();
            }
            EXPECT_EQ(counted, plant.triangles);
            EXPECT_NEAR(static_cast<double>(counted), static_cast<double>(target),
                        0.05 * static_cast<double>(target))
                << "seed " << seed;
        }
    }
}

TEST(Plant, SolidsAreClosedAndOutward) {
    for (const std::uint64_t target : {12'000U, 300'000U, 9'000'000U}) { // three tessellations
        const Plant plant = plant_of(target, 60, 5);
        std::size_t open = 0;
        for (std::size_t i = 0; i < plant.scene.meshes.size(); ++i) {
            const Mesh& mesh = plant.scene.meshes[i];
            const MeshReport report = inspect(mesh);
            EXPECT_EQ(report.closed, plant.mesh_closed[i]) << "mesh " << i;
            EXPECT_EQ(report.degenerate_triangles, 0U) << "mesh " << i;
            EXPECT_EQ(report.duplicate_triangles, 0U) << "mesh " << i;
            EXPECT_EQ(report.flipped_edges, 0U) << "mesh " << i;
            double volume = 0;
            for (const auto& [a, b, c] : mesh.triangles) {
                const Vec3 &p = mesh.positions[a], &q = mesh.positions[b], &r = mesh.positions[c];
                volume += p.x * (q.y * r.z - q.z * r.y) + p.y * (q.z * r.x - q.x * r.z) +
                          p.z * (q.x * r.y - q.y * r.x);
            }
            EXPECT_TRUE(!plant.mesh_closed[i] || volume > 0) << "mesh " << i;
            open += plant.mesh_closed[i] ? 0 : 1;
        }
        EXPECT_GE(open, 3U);
        EXPECT_LE(open, plant.scene.meshes.size() / 4);
    }
}

TEST(Plant, CoordinatesAreFloatsAndPosesRigid) {
    const Plant plant = plant_of(100'000, 50, 7);
    for (const Mesh& mesh : plant.scene.meshes) {
        for (const Vec3& p : mesh.positions) {
            for (const double v : {p.x, p.y, p.z}) {
                ASSERT_EQ(v, static_cast<double>(static_cast<float>(v)));
            }
        }
    }
    std::size_t slanting = 0;
    for (const Part& part : plant.scene.parts) {
        const auto& m = part.world_from_mesh.m;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                const double product =
                    m[3 * i] * m[3 * k] + m[3 * i + 1] * m[3 * k + 1] + m[3 * i + 2] * m[3 * k + 2];
                ASSERT_NEAR(product, i == k ? 1 : 0, 1e-12) << part.name;
            }
        }
        const double det = m[0] * (m[4] * m[8] - m[5] * m[7]) - m[3] * (m[1] * m[8] - m[2] * m[7]) +
                           m[6] * (m[1] * m[5] - m[2] * m[4]);
        ASSERT_NEAR(det, 1, 1e-12) << part.name;
        for (std::size_t i = 9; i < 12; ++i) {
            ASSERT_EQ(m[i] * 1024, std::floor(m[i] * 1024)) << part.name;
        }
        slanting +=
            std::any_of(m.begin(), m.begin() + 9, [](double v) { return v != std::floor(v); });
    }
    EXPECT_GE(slanting, 4U);
}

TEST(Plant, EveryPartHasAColourAndPipesHaveThatOfTheirSystem) {
    const Plant plant = make_plant({.triangles = 30'000, .clashes = 20, .seed = 3});
    std::map<std::string, std::set<std::string>> of_line; // colours of segments and elbows
    std::set<std::string> of_pipes;
    for (const Part& part : plant.scene.parts) {
        ASSERT_TRUE(part.colour) << part.type;
        const std::size_t run = part.name.find(" run ");
        if (!part.type.starts_with("IfcPipe") || run == std::string::npos)
            continue;
        const std::string line = part.name.substr(0, part.name.find(' ', run + 5));
        of_line[line].insert(to_string(*part.colour));
        of_pipes.insert(to_string(*part.colour));
    }
    EXPECT_GT(of_line.size(), 5U);
    for (const auto& [line, colours] : of_line)
        EXPECT_EQ(colours.size(), 1U) << line;
    EXPECT_GT(of_pipes.size(), 3U);
}

TEST(Plant, IdsAreUnique) {
    const Plant plant = plant_of(1'000'000, 50, 3);
    std::set<std::string> ids;
    for (const Part& part : plant.scene.parts) {
        EXPECT_EQ(part.id.size(), 22U);
        EXPECT_FALSE(part.name.empty());
        EXPECT_TRUE(part.type.starts_with("Ifc")) << part.type;
        ids.insert(part.id);
    }
    EXPECT_EQ(ids.size(), plant.scene.parts.size());
}

TEST(Plant, HoldsBoltsAndHundredMetreBeams) {
    const Plant plant = plant_of(200'000, 50, 1);
    std::map<std::string, int> parts_of_type;
    double smallest = std::numeric_limits<double>::infinity(), longest_beam = 0;
    for (const Part& part : plant.scene.parts) {
        const Box3 box = inspect(plant.scene.meshes[part.mesh]).bounds;
        const std::array<double, 3> size{box.upper.x - box.lower.x, box.upper.y - box.lower.y,
                                         box.upper.z - box.lower.z};
        ++parts_of_type[part.type];
        if (part.type == "IfcMechanicalFastener") {
            smallest = std::min(smallest, *std::min_element(size.begin(), size.end()));
        }
        if (part.type == "IfcBeam") {
            longest_beam = std::max(longest_beam, *std::max_element(size.begin(), size.end()));
        }
    }
    EXPECT_LT(smallest, 0.025);
    EXPECT_EQ(longest_beam, 100);
    for (const char* type : {"IfcBeam", "IfcColumn", "IfcMember", "IfcSlab", "IfcPipeSegment",
                             "IfcPipeFitting", "IfcTank", "IfcCableCarrierSegment",
                             "IfcDuctSegment", "IfcStairFlight", "IfcRailing", "IfcPump"}) {
        EXPECT_GE(parts_of_type[type], 9) << type;
    }
    EXPECT_GE(parts_of_type["IfcMechanicalFastener"], 200);
    EXPECT_GE(plant.scene.parts.size(), 10 * plant.scene.meshes.size()) << "instancing";
}

TEST(Plant, SeedDecides) {
    const std::uint64_t first = hash_of(plant_of(20'000, 20, 1));
    EXPECT_EQ(first, hash_of(plant_of(20'000, 20, 1)));
    EXPECT_NE(first, hash_of(plant_of(20'000, 20, 2)));
    // The hash is the same on every machine. Change it only when the generator changes.
    EXPECT_EQ(first, 0x24f3d90dd68a45adU);
}

TEST(Plant, PlantsTheKindsInTurn) {
    for (const int clashes : {0, 1, 7, 50, 203}) {
        const Plant plant = plant_of(60'000, clashes, 11);
        ASSERT_EQ(plant.truth.size(), static_cast<std::size_t>(clashes));
        for (std::size_t i = 0; i < plant.truth.size(); ++i) {
            EXPECT_EQ(plant.truth[i].kind,
                      kClashKinds[i % (kClashKinds.size() - 1)]); // no `undecided`
        }
        truth_by_part(plant); // fails if a pair is planted twice
    }
    for (const PlantedClash& clash : plant_of(20'000, 20, 1, 0).truth) {
        EXPECT_NE(clash.kind, ClashKind::clearance) << "no gap is below a clearance of zero";
    }
}

TEST(Plant, TruthAsJson) {
    const Plant plant = plant_of(30'000, 25, 2);
    const auto json = nlohmann::json::parse(plant_truth_json(plant));
    ASSERT_EQ(json["clashes"].size(), 25U);
    EXPECT_EQ(json["counts"]["contained"], 5);
    EXPECT_EQ(json["triangles"], plant.triangles);
    for (std::size_t i = 0; i < 25; ++i) {
        EXPECT_EQ(json["clashes"][i]["a"], plant.truth[i].a);
        EXPECT_EQ(json["clashes"][i]["kind"], to_string(plant.truth[i].kind));
        EXPECT_EQ(json["clashes"][i]["distance"].is_null(), !plant.truth[i].distance.has_value());
    }
}

TEST(Plant, RefusesOptionsOutsideTheirDomain) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const PlantOptions& options :
         {PlantOptions{.triangles = 9'999}, PlantOptions{.clashes = -1},
          PlantOptions{.clearance = -0.01}, PlantOptions{.clearance = 0.3},
          PlantOptions{.clearance = nan}}) {
        try {
            make_plant(options);
            ADD_FAILURE() << "no error";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::bad_argument);
        }
    }
}

/// The essential test, independent of the library: the pairs that are near are exactly the planted
/// ones.
void expect_only_planted(const Plant& plant) {
    std::uint64_t examined = 0;
    const auto near =
        reference::near_pairs(plant.scene, plant.mesh_closed, plant.separation, examined);
    const auto truth = truth_by_part(plant);
    EXPECT_GT(examined, truth.size() + 30) << "too few pairs to prove anything";
    for (const auto& [pair, nearness] : near) {
        EXPECT_TRUE(truth.contains(pair))
            << plant.scene.parts[pair.first].name << " and " << plant.scene.parts[pair.second].name
            << ": " << nearness.distance;
    }
    for (const auto& [pair, clash] : truth) {
        const auto found = near.find(pair);
        ASSERT_NE(found, near.end()) << clash->what;
        const auto [distance, contained] = found->second;
        SCOPED_TRACE(clash->what);
        switch (clash->kind) {
        case ClashKind::clearance:
            EXPECT_FALSE(contained);
            EXPECT_GT(distance, 0);
            EXPECT_LT(distance, plant.options.clearance);
            EXPECT_NEAR(distance, clash->distance.value(), 1e-12);
            break;
        case ClashKind::contained:
            EXPECT_TRUE(contained);
            EXPECT_GT(distance, plant.options.clearance);
            EXPECT_NEAR(clash->distance.value_or(-distance), -distance, 1e-12);
            break;
        default:
            EXPECT_FALSE(contained);
            EXPECT_NEAR(distance, 0, 1e-12);
            EXPECT_LE(clash->distance.value_or(0), 0);
        }
    }
}

TEST(Plant, NothingElseIsNear) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE(seed);
        expect_only_planted(plant_of(20'000, 60, seed));
    }
    expect_only_planted(plant_of(120'000, 150, 8));
}

TEST(Plant, NothingElseIsNearAtOtherClearances) {
    for (const double clearance : {0.0, 0.015625, 0.02, 0.1, 0.25}) {
        SCOPED_TRACE(clearance);
        expect_only_planted(plant_of(25'000, 40, 9, clearance));
    }
}

/// The clash job reports the planted set: pairs, kinds, and distances where they are known.
void expect_found(const Plant& plant) {
    ClashOptions options;
    options.clearance = plant.options.clearance;
    const ClashReport report = find_clashes({plant.scene}, options);
    auto truth = truth_by_part(plant);
    for (const Clash& clash : report.clashes) {
        const PartPair pair = std::minmax(clash.part[0], clash.part[1]);
        const auto planted = truth.find(pair);
        if (planted == truth.end()) {
            ADD_FAILURE() << "not planted: " << plant.scene.parts[pair.first].name << " and "
                          << plant.scene.parts[pair.second].name << ", " << to_string(clash.kind)
                          << " " << clash.distance;
            continue;
        }
        SCOPED_TRACE(planted->second->what);
        EXPECT_STREQ(to_string(clash.kind), to_string(planted->second->kind)) << clash.distance;
        if (planted->second->distance) {
            EXPECT_NEAR(clash.distance, *planted->second->distance, 1e-9);
        }
        truth.erase(planted);
    }
    for (const auto& [pair, clash] : truth) {
        ADD_FAILURE() << "not found: " << clash->what;
    }
}

TEST(Plant, ClashJobFindsExactlyThePlanted) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        SCOPED_TRACE(seed);
        expect_found(plant_of(20'000, 100, seed));
        expect_found(plant_of(200'000, 200, seed));
    }
    expect_found(plant_of(2'000'000, 500, 5));
    expect_found(plant_of(50'000, 40, 6, 0));
    expect_found(plant_of(50'000, 40, 6, 0.2));
}

TEST(Plant, SurvivesWritingAndReading) {
    Plant plant = plant_of(40'000, 50, 12);
    const test::Folder folder;
    write_glb(plant.scene, folder / "plant.glb");
    Scene read = read_scene(folder / "plant.glb");
    ASSERT_EQ(read.parts.size(), plant.scene.parts.size());
    for (const Part& part : read.parts) {
        EXPECT_TRUE(part.type.starts_with("Ifc")) << part.type;
    }
    plant.scene = std::move(read);
    expect_found(plant);
}

} // namespace
} // namespace abut
