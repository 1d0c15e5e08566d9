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

double volume_of(const Mesh& mesh) {
    const Body body(mesh);
    const auto volume = solid_volume(body.placed);
    EXPECT_TRUE(volume);
    if (!volume)
        return -1;
    EXPECT_LE(volume->error, 1e-3);
    return volume->volume;
}

/// Common parts count once, however the solids are turned.
TEST(TJunctionSolids, UnionsHaveAVolume) {
    const Mesh unit = box_mesh({0, 0, 0}, {1, 1, 1});
    EXPECT_NEAR(volume_of(joined(unit, box_with_t_junctions({2, 0, 0}))), 2, 1e-4);
    for (const bool inwards : {false, true}) {
        const auto other = [&](const Vec3& at) {
            const Mesh m = box_with_t_junctions(at);
            return inwards ? reversed(m) : m;
        };
        EXPECT_NEAR(volume_of(joined(unit, other({0.5, 0, 0}))), 1.5, 1e-4);
        EXPECT_NEAR(volume_of(joined(box_with_t_junctions({0, 0, 0}), other({0.5, 0.25, 0}))),
                    1.625, 1e-4);
        // In an outer one: nothing is added if both face one way, else it is a cavity.
        Mesh outer = box_with_t_junctions({-1, -1, -1});
        for (Vec3& p : outer.positions)
            p = 3.0 * p + Vec3{2, 2, 2};
        EXPECT_NEAR(volume_of(joined(outer, other({0.5, 0.25, 0.5}))), inwards ? 26 : 27, 1e-3);
        // Beside these, a third one that is turned inside out.
        EXPECT_NEAR(volume_of(joined(joined(outer, other({0.5, 0.25, 0.5})),
                                     reversed(box_with_t_junctions({5, 0, 0})))),
                    27, 1e-3);
    }
}

/// Two boxes that share a face or an edge are their union, whichever of them is turned inside out.
TEST(TJunctionSolids, EachIsOrientedByItself) {
    const Mesh unit = box_mesh({0, 0, 0}, {1, 1, 1});
    const Transform askew({0.8, 0.6, 0, -0.6, 0.8, 0, 0, 0, 1, 3, -7, 2});
    for (const Vec3& at : {Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{0, 1, 0},
                           Vec3{-1, 0, 0}, Vec3{1, 0, 1}, Vec3{1, 1, 1}})
        for (int kind = 0; kind < 32; ++kind) {
            SCOPED_TRACE(testing::Message() << at.x << ' ' << at.y << ' ' << at.z << ' ' << kind);
            const bool closed_a = (kind & 1) != 0, closed_b = (kind & 2) != 0;
            Mesh a = closed_a ? unit : box_with_t_junctions({0, 0, 0}),
                 b = closed_b ? box_mesh(at, at + Vec3{1, 1, 1}) : box_with_t_junctions(at);
            if ((kind & 4) != 0)
                a = reversed(a);
            if ((kind & 8) != 0)
                b = reversed(b);
            Mesh both = (kind & 16) != 0 ? with_merged_vertices(joined(a, b)) : joined(b, a);
            EXPECT_NEAR(volume_of(both), 2, 1e-3);
            const Model model(both);
            EXPECT_EQ(contains(model, {}, {0.5, 0.4, 0.3}).side, Side::inside);
            EXPECT_EQ(contains(model, {}, at + Vec3{0.5, 0.4, 0.3}).side, Side::inside);
            EXPECT_EQ(contains(model, {}, at + Vec3{0.5, 0.4, 1.3}).side,
                      at.z == -1 ? Side::inside : Side::outside);
            EXPECT_NEAR(volume_of(transformed(both, askew)), 2, 1e-3);
            const Body slab(box_mesh({-3, -3, 0.25}, {3, 3, 0.75})), body(both);
            const auto common = overlap_volume(body.placed, slab.placed);
            ASSERT_TRUE(common);
            EXPECT_NEAR(common->volume, at.z == 0 ? 1 : 0.5, 1e-3);
            EXPECT_LE(std::abs(common->volume - (at.z == 0 ? 1 : 0.5)), common->error);
        }
}

/// As box_with_t_junctions, with the four squares on the face x = 1, y = 1 or z = 1 (axis 0, 1, 2).
Mesh turned_box_with_t_junctions(const Vec3& at, int axis) {
    Mesh m = box_with_t_junctions({0, 0, 0});
    for (Vec3& p : m.positions)
        p = (axis == 0 ? Vec3{p.z, p.x, p.y} : axis == 1 ? Vec3{p.y, p.z, p.x} : p) + at;
    return m;
}

/// Two boxes with only an edge in common: where one of its faces is cut in halves, an edge has but one face of
/// each box, as if these were neighbours.
TEST(TJunctionSolids, EdgesInCommonJoinNoBoxes) {
    for (int axis_a = 0; axis_a < 3; ++axis_a)
        for (int axis_b = 0; axis_b < 3; ++axis_b)
            for (int inwards = 0; inwards < 4; ++inwards)
                for (const Vec3& at :
                     {Vec3{1, 1, 0}, Vec3{-1, 1, 0}, Vec3{1, 0, 1}, Vec3{0, -1, 1}}) {
                    SCOPED_TRACE(testing::Message() << axis_a << axis_b << inwards);
                    Mesh a = turned_box_with_t_junctions({0, 0, 0}, axis_a),
                         b = turned_box_with_t_junctions(at, axis_b);
                    a = (inwards & 1) != 0 ? reversed(a) : a;
                    b = (inwards & 2) != 0 ? reversed(b) : b;
                    const Mesh both = with_merged_vertices(joined(a, b));
                    EXPECT_NEAR(volume_of(both), 2, 1e-3);
                    EXPECT_EQ(contains(Model(both), {}, at + Vec3{0.5, 0.4, 0.3}).side,
                              Side::inside);
                }
}

/// A box on a part of another one's face, with an edge of it in common.
TEST(SolidsInsideOut, BoxesOnAPartOfAFace) {
    const Mesh large = box_mesh({1, 2, 0}, {3, 3, 3}), small = box_mesh({0, 2, 1}, {1, 3, 3});
    for (int inwards = 0; inwards < 4; ++inwards) {
        const Mesh both = joined((inwards & 1) != 0 ? reversed(small) : small,
                                 (inwards & 2) != 0 ? reversed(large) : large);
        EXPECT_NEAR(volume_of(both), 8, 1e-9);
        EXPECT_EQ(contains(Model(both), {}, {0.5, 2.4, 2}).side, Side::inside);
    }
}

/// A sheet that hangs by an edge or a vertex of a solid with T-junctions bounds nothing, and hides nothing.
TEST(TJunctionSolids, SheetsThatHangByThemHideNone) {
    const Mesh solid = box_with_t_junctions({0, 0, 0});
    for (const Vec3& to : {Vec3{1, 0, 1}, Vec3{2, 0, 1}}) {
        const Mesh sheet{{{1, 0, 0}, {2, 0, 0}, {2, 0, 1}, to}, {{0, 1, 2}, {0, 2, 3}}};
        const Mesh all = joined(sheet, solid);
        EXPECT_NEAR(volume_of(all), 1, 1e-4);
        EXPECT_EQ(kind_between(all, box_mesh({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75})),
                  ClashKind::contained);
        const Model model(all);
        EXPECT_EQ(contains(model, {}, {1.5, 0.1, 0.5}).side, Side::outside);
        EXPECT_EQ(examine_solid(all).open.size(), to.x == 1 ? 2U : 1U);
    }
}

} // namespace
} // namespace abut::test
