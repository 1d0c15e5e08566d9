// Solids with T-junctions that share edges, faces or vertices with closed ones in the same mesh.

#include <abut/clash.h>
#include <abut/shape_queries.h>

#include "rigid/penetration/overlap_volume.h"
#include "tests/support/body.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

namespace abut::test {
namespace {

/// The mesh with one vertex for each position.
Mesh with_merged_vertices(const Mesh& mesh) {
    std::map<std::tuple<double, double, double>, std::uint32_t> number;
    Mesh m;
    for (const auto& t : mesh.triangles) {
        auto& corners = m.triangles.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& p = mesh.positions[t.at(k)];
            const auto [at, is_new] =
                number.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(m.positions.size()));
            if (is_new)
                m.positions.push_back(p);
            corners.at(k) = at->second;
        }
    }
    return m;
}

/// A unit box whose top is four squares, so that it has T-junctions at the edges of its top.
Mesh box_with_t_junctions(const Vec3& at) {
    Mesh m = box_mesh({0, 0, 0}, {1, 1, 1});
    std::erase_if(m.triangles, [&](const auto& t) {
        return m.positions[t[0]].z + m.positions[t[1]].z + m.positions[t[2]].z == 3;
    });
    for (const double x : {0.0, 0.5})
        for (const double y : {0.0, 0.5}) {
            const auto n = static_cast<std::uint32_t>(m.positions.size());
            for (const Vec3& p : {Vec3{x, y, 1}, Vec3{x + 0.5, y, 1}, Vec3{x + 0.5, y + 0.5, 1},
                                  Vec3{x, y + 0.5, 1}})
                m.positions.push_back(p);
            m.triangles.push_back({n, n + 1, n + 2});
            m.triangles.push_back({n, n + 2, n + 3});
        }
    for (Vec3& p : m.positions)
        p = p + at;
    return m;
}

std::optional<ClashKind> kind_between(const Mesh& a, const Mesh& b) {
    std::vector<Scene> models(2);
    models[0].meshes = {a}, models[1].meshes = {b};
    for (Scene& model : models)
        model.parts = {{"part", "", "", 0, {}}};
    ClashOptions options;
    options.touch_tolerance = 0.01;
    const ClashReport report = find_clashes(models, options);
    EXPECT_EQ(report.surfaces.count, 0U);
    if (report.clashes.size() != 1)
        return std::nullopt;
    return report.clashes.front().kind;
}

/// The placements of a box beside a unit box: edge on edge, face on face, apart, corner on corner.
const std::vector<Vec3> kPlaces{{1, 0, 1}, {1, 0, 0}, {0, 0, 1}, {1.5, 0, 0}, {1, 1, 1}};

TEST(TJunctionSolids, BesideAClosedBoxTheyContainWhatIsInside) {
    const Mesh unit = box_mesh({0, 0, 0}, {1, 1, 1});
    for (const Vec3& at : kPlaces)
        for (const bool shares_vertices : {false, true})
            for (const bool inwards : {false, true}) {
                SCOPED_TRACE(testing::Message() << at.x << ' ' << at.y << ' ' << at.z);
                Mesh a = joined(unit, box_with_t_junctions(at));
                if (shares_vertices)
                    a = with_merged_vertices(a);
                if (inwards)
                    a = reversed(a);
                const Vec3 quarter{0.25, 0.25, 0.25}, most{0.75, 0.75, 0.75};
                const Mesh inner = box_mesh(at + quarter, at + most);
                EXPECT_EQ(kind_between(a, inner), ClashKind::contained);
                EXPECT_EQ(kind_between(inner, a), ClashKind::contained);
                EXPECT_EQ(kind_between(a, box_mesh(quarter, most)), ClashKind::contained);
                EXPECT_EQ(kind_between(a, box_mesh(at + quarter, at + most + Vec3{0, 0, 2.25})),
                          ClashKind::hard);
                const Model model(a);
                EXPECT_EQ(contains(model, {}, at + Vec3{0.5, 0.4, 0.5}).side, Side::inside);
                EXPECT_EQ(contains(model, {}, {0.4, 0.5, 0.5}).side, Side::inside);
                EXPECT_EQ(contains(model, {}, at + Vec3{0.5, 0.4, 1.5}).side, Side::outside);
            }
}

/// A sheet in the mesh hides no solid with T-junctions, whether it hangs by an edge or lies apart.
TEST(TJunctionSolids, SheetsHideNone) {
    const Mesh sheet{{{5, 5, 5}, {6, 5, 5}, {5, 6, 5}}, {{0, 1, 2}}};
    const Mesh solid = joined(box_with_t_junctions({0, 0, 0}), sheet);
    EXPECT_TRUE(examine_solid(solid).solid);
    EXPECT_EQ(kind_between(solid, box_mesh({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75})),
              ClashKind::contained);
    const Mesh all = with_merged_vertices(
        joined(joined(box_mesh({0, 0, 0}, {1, 1, 1}), sheet), box_with_t_junctions({1, 0, 1})));
    EXPECT_EQ(kind_between(all, box_mesh({1.25, 0.25, 1.25}, {1.75, 0.75, 1.75})),
              ClashKind::contained);
    const Model model(all);
    EXPECT_EQ(contains(model, {}, {1.5, 0.4, 1.5}).side, Side::inside);
    EXPECT_EQ(contains(model, {}, {5.2, 5.2, 4.99}).side, Side::outside);
    // A sheet that hangs by an edge of a closed box still bounds nothing.
    Mesh hanging = box_mesh({0, 0, 0}, {1, 1, 1});
    hanging.positions.push_back({-1, 0, -1});
    hanging.triangles.push_back({0, 4, 8});
    EXPECT_TRUE(examine_solid(hanging).closed);
    EXPECT_TRUE(examine_solid(hanging).has_sheets);
}

/// Solids that overlap one with T-junctions have no volume: what overlaps would count twice.
TEST(TJunctionSolids, NoVolumeIsToldThatCountsTwice) {
    const Mesh apart = joined(box_mesh({0, 0, 0}, {1, 1, 1}), box_with_t_junctions({2, 0, 0})),
               over = joined(box_mesh({0, 0, 0}, {1, 1, 1}), box_with_t_junctions({0.5, 0, 0}));
    const auto volume = solid_volume(Body(apart).placed);
    ASSERT_TRUE(volume);
    EXPECT_LE(std::abs(volume->volume - 2), volume->error);
    EXPECT_FALSE(solid_volume(Body(over).placed));
}

} // namespace
} // namespace abut::test
