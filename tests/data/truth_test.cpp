// Clashes of real buildings against lists made by exact brute force.

#include <abut/clash.h>
#include <abut/mesh.h>

#include "tests/support/body.h"
#include "tests/support/paths.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace abut::test {
namespace {

using nlohmann::json;
using IdPair = std::pair<std::string, std::string>;

std::string in_buildings(const std::string& name) {
    return std::string(ABUT_SHARED_DATA) + "/bim/" + name;
}

class Truth : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        const std::string path = in_buildings("truth/") + GetParam();
        if (!std::filesystem::exists(path))
            GTEST_SKIP() << path << " is not there";
        truth_ = json::parse(std::ifstream(path));
        std::vector<std::string> files{in_buildings(truth_["a"].get<std::string>())};
        if (truth_["b"] != truth_["a"])
            files.push_back(in_buildings(truth_["b"].get<std::string>()));
        models_ = read_scenes(files);
    }

    [[nodiscard]] bool self() const { return models_.size() == 1; }
    [[nodiscard]] const Part& part(const Clash& c, std::size_t side) const {
        return models_[c.model.at(side)].parts[c.part.at(side)];
    }
    /// The ids of an unordered pair are sorted.
    [[nodiscard]] IdPair ids(std::string a, std::string b) const {
        if (self() && b < a)
            std::swap(a, b);
        return {a, b};
    }
    [[nodiscard]] const Part& part_of(const std::string& id) const {
        for (const Scene& model : models_)
            for (const Part& p : model.parts)
                if (p.id == id)
                    return p;
        throw std::runtime_error("no part " + id);
    }
    [[nodiscard]] const Mesh& mesh_of(const std::string& id) const {
        for (const Scene& model : models_)
            for (const Part& p : model.parts)
                if (p.id == id)
                    return model.meshes[p.mesh];
        throw std::runtime_error("no part " + id);
    }

    json truth_;
    std::vector<Scene> models_;
};

TEST_P(Truth, EveryPairAgrees) {
    const ClashReport report = find_clashes(
        models_, {.clearance = truth_["clearance"].get<double>(), .touch_tolerance = 0});
    EXPECT_EQ(report.candidates, truth_["box_pairs"].get<std::uint64_t>());

    std::set<IdPair> meeting, contained;
    std::map<IdPair, double> near;
    for (const Clash& c : report.clashes) {
        const IdPair pair = ids(part(c, 0).id, part(c, 1).id);
        if (c.kind == ClashKind::contained)
            contained.insert(std::minmax(pair.first, pair.second));
        // A contained part may also be near: its distance is that to the surface around it.
        if (c.kind == ClashKind::contained || c.kind == ClashKind::clearance)
            near.emplace(pair, std::abs(c.distance));
        else
            meeting.insert(pair);
    }

    std::set<IdPair> meeting_truth, contained_truth;
    for (const json& p : truth_["intersecting"])
        meeting_truth.insert(ids(p[0], p[1]));
    EXPECT_EQ(meeting, meeting_truth);
    EXPECT_GT(meeting.size(), 0U);

    for (const json& p : truth_["contained"])
        contained_truth.insert(std::minmax(p[0].get<std::string>(), p[1].get<std::string>()));
    for (const json& p : truth_["inside_not_closed"])
        if (std::abs(std::abs(p[2].get<double>()) - 1) < 1e-6)
            contained_truth.insert(std::minmax(p[0].get<std::string>(), p[1].get<std::string>()));
    // The truth takes the triangles as they are. A part with duplicates and sheets beside a closed
    // surface is not closed for it, and bounds a solid all the same (docs/solids.md).
    EXPECT_TRUE(std::ranges::includes(contained, contained_truth));
    for (const IdPair& pair : contained)
        EXPECT_TRUE(contained_truth.contains(pair) || !inspect(mesh_of(pair.first)).closed ||
                    !inspect(mesh_of(pair.second)).closed)
            << pair.first << ' ' << pair.second;

    std::map<IdPair, double> near_truth;
    for (const json& p : truth_["near"])
        near_truth.emplace(ids(p[0], p[1]), p[2].get<double>());
    double worst = 0;
    for (const auto& [pair, distance] : near_truth) {
        ASSERT_TRUE(near.contains(pair)) << pair.first << ' ' << pair.second;
        worst = std::max(worst, std::abs(near.at(pair) - distance));
    }
    EXPECT_LT(worst, 1e-9);
    for (const auto& [pair, distance] : near)
        EXPECT_TRUE(near_truth.contains(pair) || distance >= truth_["clearance"].get<double>())
            << pair.first << ' ' << pair.second;
    std::cout << meeting.size() << " meet, " << contained.size() << " contained, "
              << near_truth.size() << " near, largest difference " << worst << " m\n";

    if (std::string(GetParam()) == "duplex_mep__self.json") {
        EXPECT_EQ(report.counts[static_cast<std::size_t>(ClashKind::touch)], 810U);
        EXPECT_EQ(report.counts[static_cast<std::size_t>(ClashKind::hard)], 94U);
    }
}

TEST_P(Truth, WindingNumbersOfOpenParts) {
    double worst = 0;
    for (const json& p : truth_["inside_not_closed"]) {
        const Part& inner = part_of(p[0]);
        const Part& outer = part_of(p[1]);
        const Mesh& outer_mesh = mesh_of(p[1]);
        const Vec3 world =
            apply(inner.world_from_mesh, mesh_of(p[0]).positions[mesh_of(p[0]).triangles[0][0]]);
        const double winding =
            winding_number(transformed(outer_mesh, outer.world_from_mesh), world);
        // For integer winding numbers any point of the inner part gives the same; for others the
        // point matters.
        if (std::abs(std::abs(p[2].get<double>()) - 1) < 1e-6)
            worst = std::max(worst, std::abs(std::abs(winding) - std::abs(p[2].get<double>())));
        else
            EXPECT_GT(std::abs(std::abs(winding) - 1), kWindingRounding);
    }
    EXPECT_LT(worst, kWindingRounding);
}

INSTANTIATE_TEST_SUITE_P(Buildings, Truth,
                         testing::Values("duplex_design__duplex_mep.json", "duplex_mep__self.json",
                                         "hospital_structure__hospital_plumbing.json"));

} // namespace
} // namespace abut::test
