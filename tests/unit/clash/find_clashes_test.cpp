// Small scenes worked by hand: every kind, rules, order, errors.

#include <abut/clash.h>
#include <abut/error.h>

#include "tests/support/shapes.h"

#include <atomic>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <set>
#include <unistd.h>

namespace abut::test {
namespace {

void add(Scene& scene, const std::string& id, const Mesh& mesh, const Transform& world = {},
         const std::string& type = "Thing") {
    scene.meshes.push_back(mesh);
    scene.parts.push_back(
        {id, "name of " + id, type, static_cast<std::uint32_t>(scene.meshes.size() - 1), world});
}
Scene scene_of(const std::string& file, const Mesh& mesh) {
    Scene scene;
    scene.file = file;
    add(scene, file + "-part", mesh);
    return scene;
}

std::string numbered(int i) {
    std::string id("p");
    id += std::to_string(i);
    return id;
}

const Mesh kBox = box_mesh({0, 0, 0}, {1, 1, 1});

/// The one clash of two parts in two model files; none if there is none.
std::optional<Clash> clash_of(const Mesh& a, const Mesh& b, const ClashOptions& options = {}) {
    const ClashReport report = find_clashes({scene_of("a", a), scene_of("b", b)}, options);
    EXPECT_LE(report.clashes.size(), 1U);
    const std::uint64_t counted = report.counts[0] + report.counts[1] + report.counts[2] +
                                  report.counts[3] + report.counts[4];
    EXPECT_EQ(counted, report.clashes.size());
    if (report.clashes.empty())
        return std::nullopt;
    EXPECT_EQ(report.counts[static_cast<std::size_t>(report.clashes[0].kind)], 1U);
    return report.clashes[0];
}

TEST(FindClashes, Hard) {
    const auto clash = clash_of(kBox, box_mesh({0.9, 0.25, 0.25}, {2, 0.75, 0.75}));
    ASSERT_TRUE(clash);
    EXPECT_EQ(clash->kind, ClashKind::hard);
    EXPECT_NEAR(clash->distance, -0.1, 1e-3);
    EXPECT_GT(clash->direction.x, 0.9);
    EXPECT_GT(clash->triangle_pairs, 0U);
    EXPECT_NEAR(length(clash->point_a - clash->point_b), 0.1, 1e-3);
}

TEST(FindClashes, Touch) {
    const auto clash = clash_of(kBox, box_mesh({1, 0.25, 0.25}, {2, 0.75, 0.75}));
    ASSERT_TRUE(clash);
    EXPECT_EQ(clash->kind, ClashKind::touch);
    EXPECT_EQ(clash->distance, 0);
    EXPECT_EQ(clash->point_a, clash->point_b);
    EXPECT_EQ(clash->point_a.x, 1);
}

TEST(FindClashes, Contained) {
    const auto inside = clash_of(kBox, box_mesh({0.25, 0.25, 0.25}, {0.5, 0.5, 0.5}));
    ASSERT_TRUE(inside);
    EXPECT_EQ(inside->kind, ClashKind::contained);
    EXPECT_EQ(inside->distance, -0.25);
    const auto around = clash_of(box_mesh({0.25, 0.25, 0.25}, {0.5, 0.5, 0.5}), kBox);
    ASSERT_TRUE(around);
    EXPECT_EQ(around->kind, ClashKind::contained);
    // An open shell contains nothing.
    EXPECT_FALSE(clash_of(open_box_mesh({0, 0, 0}, {1, 1, 1}),
                          box_mesh({0.25, 0.25, 0.25}, {0.5, 0.5, 0.5})));
    const auto near = clash_of(open_box_mesh({0, 0, 0}, {1, 1, 1}),
                               box_mesh({0.25, 0.25, 0.25}, {0.5, 0.5, 0.5}), {.clearance = 0.3});
    ASSERT_TRUE(near);
    EXPECT_EQ(near->kind, ClashKind::clearance);
    EXPECT_EQ(near->distance, 0.25);
    // One component is inside and one outside, and the surfaces do not meet.
    const auto partly = clash_of(joined(kBox, box_mesh({5, 0, 0}, {6, 1, 1})),
                                 joined(box_mesh({0.25, 0.25, 0.25}, {0.5, 0.5, 0.5}),
                                        box_mesh({3, 0.25, 0.25}, {3.5, 0.5, 0.5})));
    ASSERT_TRUE(partly);
    EXPECT_EQ(partly->kind, ClashKind::hard);
    EXPECT_EQ(partly->distance, -0.5); // at the corner in the middle of the unit box
}

/// A part whose shells overlap is their union: what lies across a face inside is contained.
TEST(FindClashes, ContainedInTheUnionOfShells) {
    const Mesh shells =
        joined(box_mesh({0, 0, 0}, {1, 0.8, 0.6}), box_mesh({0.5, 0, 0}, {1.5, 0.8, 0.6}));
    for (const double x : {0.2, 0.45, 0.5, 0.7, 0.95}) {
        const Mesh inner = box_mesh({x, 0.35, 0.25}, {x + 0.1, 0.43, 0.31});
        const auto clash = clash_of(shells, inner, {.touch_tolerance = 1e-9});
        ASSERT_TRUE(clash) << x;
        EXPECT_EQ(clash->kind, ClashKind::contained) << x;
        EXPECT_NEAR(clash->distance, x < 0.25 ? -x : -0.25, 1e-12) << x;
        EXPECT_NEAR(clash->volume, 0.1 * 0.08 * 0.06, 1e-9) << x;
    }
    // Without a tolerance, the triangles decide: these meet a face inside.
    EXPECT_EQ(clash_of(shells, box_mesh({0.45, 0.35, 0.25}, {0.55, 0.43, 0.31}))->kind,
              ClashKind::hard);
    // Across the boundary, it is hard, with the volume of the union.
    const auto hard = clash_of(shells, box_mesh({0.6, 0.2, 0.5}, {0.9, 0.4, 0.7}));
    ASSERT_TRUE(hard);
    EXPECT_EQ(hard->kind, ClashKind::hard);
    EXPECT_NEAR(hard->distance, -0.1, 2e-3);
    EXPECT_NEAR(hard->volume, 0.3 * 0.2 * 0.1, 1e-9);
}

/// A triangle too many does not open a solid, and parts that are open are counted by name.
TEST(FindClashes, SolidsWithFaultsContain) {
    Mesh copy = kBox, flap = kBox;
    copy.triangles.push_back(copy.triangles[3]);
    flap.positions.push_back({-1, 0, -1});
    flap.triangles.push_back({0, 1, 8});
    const Mesh inner = box_mesh({0.25, 0.25, 0.25}, {0.5, 0.5, 0.5});
    for (const Mesh& outer : {copy, flap}) {
        const auto clash = clash_of(outer, inner);
        ASSERT_TRUE(clash);
        EXPECT_EQ(clash->kind, ClashKind::contained);
        EXPECT_NEAR(clash->distance, -0.25, 1e-12);
    }
    Scene scene = scene_of("a", open_box_mesh({0, 0, 0}, {1, 1, 1}));
    add(scene, "flap", flap);
    add(scene, "sheet", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    add(scene, "empty", {});
    const ClashReport report = find_clashes({scene}, {});
    EXPECT_EQ(report.surfaces.count, 2U);
    ASSERT_EQ(report.surfaces.first.size(), 2U);
    EXPECT_EQ(report.surfaces.first[0].id, "a-part");
    EXPECT_EQ(report.surfaces.first[1].name, "name of sheet");
    EXPECT_NE(to_json(report, {scene}).find("\"surfaces\":{\"count\":2"), std::string::npos);
}

TEST(FindClashes, Duplicate) {
    Mesh turned = kBox; // other order of triangles and vertices, other orientation
    std::reverse(turned.triangles.begin(), turned.triangles.end());
    for (auto& t : turned.triangles)
        std::swap(t[0], t[2]);
    for (const Mesh& twin : {kBox, turned}) {
        const auto clash = clash_of(kBox, twin);
        ASSERT_TRUE(clash);
        EXPECT_EQ(clash->kind, ClashKind::duplicate);
        EXPECT_EQ(clash->distance, 0);
        EXPECT_EQ(clash->direction, Vec3{});
    }
    Mesh other_diagonal = kBox;
    other_diagonal.triangles[0] = {0, 2, 1}, other_diagonal.triangles[1] = {1, 2, 3};
    const auto clash = clash_of(kBox, other_diagonal);
    ASSERT_TRUE(clash);
    EXPECT_EQ(clash->kind, ClashKind::hard); // the same solid with different triangles
}

TEST(FindClashes, Clearance) {
    const Mesh near = box_mesh({1.25, 0, 0}, {2, 1, 1});
    EXPECT_FALSE(clash_of(kBox, near));
    EXPECT_FALSE(clash_of(kBox, near, {.clearance = 0.25})); // only distances strictly less count
    const auto clash = clash_of(kBox, near, {.clearance = 0.250001});
    ASSERT_TRUE(clash);
    EXPECT_EQ(clash->kind, ClashKind::clearance);
    EXPECT_EQ(clash->distance, 0.25);
    EXPECT_EQ(clash->direction, (Vec3{1, 0, 0}));
    EXPECT_EQ(clash->triangle_pairs, 0U);
}

TEST(FindClashes, TouchTolerance) {
    const Mesh in = box_mesh({0.99, 0.25, 0.25}, {2, 0.75, 0.75}),
               aligned = box_mesh({0.99, 0, 0}, {2, 1, 1});
    for (const Mesh& b : {in, aligned}) {
        EXPECT_EQ(clash_of(kBox, b)->kind, ClashKind::hard);
        EXPECT_EQ(clash_of(kBox, b, {.touch_tolerance = 0.005})->kind, ClashKind::hard);
        EXPECT_EQ(clash_of(kBox, b, {.touch_tolerance = 0.02})->kind, ClashKind::touch);
        EXPECT_NEAR(clash_of(kBox, b, {.touch_tolerance = 0.02})->distance, -0.01, 1e-4);
    }
}

Scene three_in_a_row(const std::string& file) {
    Scene scene;
    scene.file = file;
    add(scene, "left", kBox);
    add(scene, "middle", kBox, translation(0.9, 0.1, 0.1));
    add(scene, "right", kBox, translation(1.95, 0.2, 0.2));
    return scene;
}

TEST(FindClashes, OneModelIsComparedWithItself) {
    const ClashReport report = find_clashes({three_in_a_row("m.glb")}, {.clearance = 0.1});
    ASSERT_EQ(report.clashes.size(), 2U);
    EXPECT_EQ(report.clashes[0].part, (std::array{0U, 1U}));
    EXPECT_EQ(report.clashes[0].kind, ClashKind::hard);
    EXPECT_EQ(report.clashes[1].part, (std::array{1U, 2U}));
    EXPECT_EQ(report.clashes[1].kind, ClashKind::clearance);
    EXPECT_NEAR(report.clashes[1].distance, 0.05, 1e-15);
    EXPECT_EQ(report.models[0].parts, 3U);
    EXPECT_EQ(report.models[0].triangles, 36U);
    EXPECT_EQ(report.candidates, 2U);
}

TEST(FindClashes, SelfAddsThePairsWithinAModel) {
    std::vector<Scene> models{three_in_a_row("m.glb"),
                              scene_of("n.glb", box_mesh({0.5, 0.5, -5}, {0.6, 0.6, 5}))};
    const ClashReport across = find_clashes(models, {});
    EXPECT_EQ(across.clashes.size(), 1U);
    for (const Clash& c : across.clashes)
        EXPECT_EQ(c.model, (std::array{0U, 1U}));
    EXPECT_EQ(find_clashes(models, {.self = true}).clashes.size(), 2U);
}

ClashRule rule(const std::string& name, const PartSelector& a, const PartSelector& b) {
    ClashRule r;
    r.name = name;
    r.a = a, r.b = b;
    return r;
}

std::vector<std::string> rule_names(const ClashReport& report) {
    std::vector<std::string> names;
    for (const Clash& c : report.clashes)
        names.push_back(c.rule);
    return names;
}

TEST(FindClashes, RulesSelectInEitherOrderAndTheFirstWins) {
    std::vector<Scene> models{three_in_a_row("dir/m.glb")};
    models[0].parts[1].type = "Pipe";
    ClashOptions options;
    options.rules = {rule("pipes", {{}, {}, {"Pi?e"}}, {{}, {"*left"}, {}}), rule("rest", {}, {})};
    options.clearance = 0.1;
    EXPECT_EQ(rule_names(find_clashes(models, options)),
              (std::vector<std::string>{"pipes", "rest"}));
    std::swap(options.rules[0], options.rules[1]);
    EXPECT_EQ(rule_names(find_clashes(models, options)),
              (std::vector<std::string>{"rest", "rest"}));
    options.rules = {rule("only left", {{}, {"left"}, {}}, {})}; // selects by id
    EXPECT_EQ(rule_names(find_clashes(models, options)).size(), 1U);
    options.rules = {rule("file", {{"m.glb"}, {}, {}}, {{"dir/*"}, {}, {}})};
    EXPECT_EQ(rule_names(find_clashes(models, options)).size(), 2U);
    options.rules = {rule("none", {{"M.glb"}, {}, {}}, {})}; // names are case-sensitive
    EXPECT_EQ(find_clashes(models, options).clashes.size(), 0U);
    EXPECT_EQ(find_clashes(models, options).candidates, 0U);
    options.rules = {rule("one of", {{}, {"x", "name of r*"}, {}}, {})};
    EXPECT_EQ(find_clashes(models, options).clashes.size(), 1U);
}

TEST(FindClashes, RulesHaveTheirOwnTolerances) {
    const std::vector<Scene> models{three_in_a_row("m.glb")};
    ClashOptions options;
    options.rules = {rule("all", {}, {})};
    options.rules[0].clearance = 0.1;
    EXPECT_EQ(find_clashes(models, options).clashes.size(), 2U);
    options.rules[0].touch_tolerance = 0.2;
    EXPECT_EQ(find_clashes(models, options).clashes[0].kind, ClashKind::touch);
    options.rules[0].clearance = 0;
    options.clearance = 1;
    EXPECT_EQ(find_clashes(models, options).clashes.size(), 2U); // one of them a gap within 0.2
    options.rules[0].touch_tolerance = 0;
    EXPECT_EQ(find_clashes(models, options).clashes.size(), 1U);
}

TEST(FindClashes, IgnoreRules) {
    std::vector<Scene> models{three_in_a_row("m.glb"), scene_of("n.glb", kBox)};
    ClashOptions options;
    options.self = true;
    options.rules = {rule("all", {}, {})};
    const auto count = [&] { return find_clashes(models, options).clashes.size(); };
    const std::size_t all = count();
    EXPECT_EQ(all, 3U);
    options.rules[0].ignore.same_file = true;
    EXPECT_EQ(count(), 2U);
    options.rules[0].ignore = {};
    options.rules[0].ignore.same_type = true;
    EXPECT_EQ(count(), 0U);
    models[0].parts[0].type = "Other";
    EXPECT_EQ(count(), 2U);
    options.rules[0].ignore = {};
    options.rules[0].ignore.same_name_prefix = 8;
    EXPECT_EQ(count(), 0U);
    options.rules[0].ignore.same_name_prefix = 9; // "name of l", "name of m", "name of n"
    EXPECT_EQ(count(), 3U);
    options.rules[0].ignore.same_name_prefix = 1000; // longer than any name
    EXPECT_EQ(count(), 3U);
    // A pair that the first rule ignores is not taken up by a later one.
    options.rules[0].ignore = {.same_file = true};
    options.rules.push_back(rule("again", {}, {}));
    EXPECT_EQ(count(), 2U);
}

TEST(FindClashes, ModelsOfOtherAxesAreTurnedIntoTheFrameOfTheFirst) {
    // With z up from (0, 0, 3) to (1, 1, 4); with y up this is from (0, 3, -1) to (1, 4, 0).
    Scene z_up = scene_of("z", box_mesh({0, 0, 3}, {1, 1, 4}));
    z_up.up = UpAxis::z;
    const Scene y_up = scene_of("y", box_mesh({0.375, 3.375, -0.25}, {0.625, 3.625, 5}));
    const ClashReport first_z = find_clashes({z_up, y_up}, {});
    const ClashReport first_y = find_clashes({y_up, z_up}, {});
    EXPECT_EQ(first_z.frame.up, UpAxis::z);
    EXPECT_EQ(first_z.frame.of, "z");
    EXPECT_EQ(first_y.frame.up, UpAxis::y);
    ASSERT_EQ(first_z.clashes.size(), 1U);
    ASSERT_EQ(first_y.clashes.size(), 1U);
    EXPECT_EQ(first_z.clashes[0].distance, first_y.clashes[0].distance);
    EXPECT_EQ(first_z.models[1].up, UpAxis::y);
    // Away from the wall: along -y if z is up, along z if y is up.
    EXPECT_LT(first_z.clashes[0].point_a.y, 0.51);
    EXPECT_GE(first_z.clashes[0].point_a.z, 3.2);
    EXPECT_GT(first_y.clashes[0].point_a.z, -0.51);
    EXPECT_GE(first_y.clashes[0].point_a.y, 3.2);
    EXPECT_TRUE(first_z.warnings.empty());
    const Scene same_axes = scene_of("y", box_mesh({0.375, 3.375, -0.25}, {0.625, 3.625, 5}));
    z_up.up = UpAxis::y;
    EXPECT_EQ(find_clashes({z_up, same_axes}, {}).clashes.size(), 0U);
}

TEST(FindClashes, GroupsOfModelsThatShareNoSpaceAreNamed) {
    const auto at = [](const std::string& file, double x) {
        return scene_of(file, box_mesh({x, 0, 0}, {x + 1, 1, 1}));
    };
    // a and c share a face, b and d overlap 100 km away, e is 2 m from a.
    const std::vector<Scene> models{at("a", 0), at("b", 1e5), at("c", 1), at("d", 1e5 + 0.5),
                                    at("e", -3)};
    const auto warnings = find_clashes(models, {}).warnings;
    ASSERT_EQ(warnings.size(), 2U);
    EXPECT_EQ(warnings[0], "the boxes of a and e are 2 m apart: they share no space");
    EXPECT_EQ(warnings[1], "the boxes of c and b are 100 km apart: they share no space");
    const auto reaching = find_clashes(models, {.clearance = 2}).warnings;
    ASSERT_EQ(reaching.size(), 2U);
    EXPECT_EQ(reaching[0], warnings[1]);
    EXPECT_EQ(reaching[1], "a clearance of 2 m: did you mean 2mm? The largest model measures 1 m");
    EXPECT_TRUE(find_clashes({at("a", 0), Scene{}, at("c", 1)}, {}).warnings.empty());
    EXPECT_TRUE(find_clashes({at("a", 0)}, {}).warnings.empty());
}

TEST(FindClashes, InstancesShareAMesh) {
    Scene scene;
    scene.file = "bolts.glb";
    scene.meshes.push_back(kBox);
    for (int i = 0; i < 20; ++i)
        scene.parts.push_back({numbered(i), "", "", 0, translation(i, 0, 0)});
    const ClashReport report = find_clashes({scene}, {});
    EXPECT_EQ(report.counts[static_cast<std::size_t>(ClashKind::touch)], 19U);
    EXPECT_EQ(report.clashes.size(), 19U);
    EXPECT_EQ(report.models[0].triangles, 240U);
    // Mirrored and rotated instances are solids as well.
    scene.parts[1].world_from_mesh = Transform({-1, 0, 0, 0, 1, 0, 0, 0, 1, 1.5, 0, 0});
    EXPECT_GT(find_clashes({scene}, {}).counts[0], 0U);
}

TEST(FindClashes, DegenerateAndEmptyParts) {
    Scene scene;
    scene.file = "odd.glb";
    add(scene, "box", kBox);
    add(scene, "point", {{{0.5, 0.5, 1}}, {{0, 0, 0}}});
    add(scene, "segment", {{{0.5, 0.25, 0.5}, {0.5, 0.25, 2}}, {{0, 1, 0}}});
    add(scene, "nothing", {});
    add(scene, "unused vertex", {{{0.5, 0.5, 0.5}}, {}});
    add(scene, "flat", kBox, compose(translation(0, 0, 1), scaling(1, 1, 0)));
    const ClashReport report = find_clashes({scene}, {.clearance = 0.1});
    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (const Clash& c : report.clashes) {
        pairs.emplace(c.part[0], c.part[1]);
        EXPECT_TRUE(is_finite(c.point_a) && is_finite(c.point_b) && is_finite(c.direction));
    }
    EXPECT_TRUE(pairs.contains({0, 1}));
    EXPECT_TRUE(pairs.contains({0, 2}));
    EXPECT_TRUE(pairs.contains({0, 5}));
    for (const auto& [a, b] : pairs)
        EXPECT_TRUE(a != 3 && b != 3 && a != 4 && b != 4);
}

TEST(FindClashes, NothingToCompare) {
    EXPECT_TRUE(find_clashes({}, {}).clashes.empty());
    EXPECT_TRUE(find_clashes({Scene{}}, {}).clashes.empty());
    EXPECT_TRUE(find_clashes({Scene{}, scene_of("a", kBox)}, {.clearance = 5}).clashes.empty());
}

TEST(FindClashes, IdsAreStableAndDistinct) {
    const ClashReport one = find_clashes({three_in_a_row("/here/m.glb")}, {.clearance = 0.1});
    const ClashReport two = find_clashes({three_in_a_row("/elsewhere/m.glb")}, {.clearance = 0.1});
    ASSERT_EQ(one.clashes.size(), 2U);
    EXPECT_EQ(one.clashes[0].id, two.clashes[0].id);
    EXPECT_NE(one.clashes[0].id, one.clashes[1].id);
    const ClashReport soft = find_clashes({three_in_a_row("m.glb")}, {.touch_tolerance = 1});
    EXPECT_NE(soft.clashes[0].id, one.clashes[0].id); // another kind
    const ClashReport other = find_clashes({three_in_a_row("n.glb")}, {.clearance = 0.1});
    EXPECT_NE(other.clashes[0].id, one.clashes[0].id); // another file
}

TEST(FindClashes, TheSameForAnyNumberOfThreads) {
    Random random(1201);
    Scene scene;
    scene.file = "many.glb";
    scene.meshes = {kBox, sphere_mesh(0.6, 12, 8), open_box_mesh({0, 0, 0}, {1, 1, 0.5}),
                    torus_mesh(0.7, 0.2, 12, 6)};
    for (int i = 0; i < 300; ++i) {
        Pose pose = random.pose(4.5);
        if (i % 3 == 0)
            pose = {{std::round(pose.translation.x), std::round(pose.translation.y),
                     std::round(pose.translation.z)},
                    {1, 0, 0, 0}};
        scene.parts.push_back({numbered(i), "", "", static_cast<std::uint32_t>(i % 4), pose});
    }
    set_threads(1);
    const ClashReport one = find_clashes({scene}, {.clearance = 0.05});
    set_threads(2);
    const ClashReport two = find_clashes({scene}, {.clearance = 0.05});
    set_threads(0);
    ASSERT_EQ(one.clashes.size(), two.clashes.size());
    EXPECT_EQ(one.candidates, two.candidates);
    EXPECT_GT(one.clashes.size(), 300U);
    for (std::size_t i = 0; i < one.clashes.size(); ++i) {
        const Clash &a = one.clashes[i], &b = two.clashes[i];
        ASSERT_TRUE(a.id == b.id && a.kind == b.kind && a.part == b.part &&
                    a.distance == b.distance && a.point_a == b.point_a && a.point_b == b.point_b &&
                    a.direction == b.direction && a.triangle_pairs == b.triangle_pairs)
            << i;
        if (i > 0) {
            ASSERT_LT(one.clashes[i - 1].part, a.part);
        }
    }
    for (const ClashKind kind : {ClashKind::hard, ClashKind::touch, ClashKind::clearance})
        EXPECT_GT(one.counts[static_cast<std::size_t>(kind)], 0U) << to_string(kind);
}

void expect_error(ErrorCode code, const std::string& text, const auto& action) {
    try {
        (void)action();
        FAIL() << "no error: " << text;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code) << error.what();
        EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
}

TEST(FindClashes, BadTolerancesAreErrors) {
    const std::vector<Scene> models{three_in_a_row("m.glb")};
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {-0.01, kNaN, std::numeric_limits<double>::infinity()}) {
        expect_error(ErrorCode::bad_argument, "clearance",
                     [&] { return find_clashes(models, {.clearance = bad}); });
        expect_error(ErrorCode::bad_argument, "touch",
                     [&] { return find_clashes(models, {.touch_tolerance = bad}); });
        ClashOptions options;
        options.rules = {rule("r", {}, {})};
        options.rules[0].clearance = bad;
        expect_error(ErrorCode::bad_argument, "clearance",
                     [&] { return find_clashes(models, options); });
    }
}

TEST(FindClashes, BadModelsAreErrorsThatNameTheFile) {
    std::vector<Scene> models{three_in_a_row("bad.glb")};
    models[0].meshes[1].triangles[0][0] = 99;
    expect_error(ErrorCode::bad_mesh, "bad.glb", [&] { return find_clashes(models, {}); });
    models = {three_in_a_row("bad.glb")};
    models[0].parts[2].mesh = 7;
    expect_error(ErrorCode::bad_mesh, "bad.glb", [&] { return find_clashes(models, {}); });
    models = {three_in_a_row("bad.glb")};
    models[0].parts[2].world_from_mesh.m[3] = std::numeric_limits<double>::quiet_NaN();
    expect_error(ErrorCode::bad_mesh, "bad.glb", [&] { return find_clashes(models, {}); });
}

TEST(FindClashes, StopsWhenAsked) {
    const std::atomic<bool> stop{true};
    ClashOptions options;
    options.progress.stop = &stop;
    expect_error(ErrorCode::interrupted, "",
                 [&] { return find_clashes({three_in_a_row("m.glb")}, options); });
}

TEST(FindClashes, ProgressRunsUpToOneInEveryStage) {
    std::set<std::string> finished;
    double last = 0;
    std::string stage_before;
    ClashOptions options;
    options.progress.report = [&](std::string_view stage, double fraction) {
        if (stage == stage_before) {
            EXPECT_GE(fraction, last);
        }
        EXPECT_LE(fraction, 1);
        stage_before = stage, last = fraction;
        if (fraction == 1)
            finished.emplace(stage);
    };
    (void)find_clashes({three_in_a_row("m.glb")}, options);
    EXPECT_EQ(finished, (std::set<std::string>{"broad phase", "hierarchies", "narrow phase"}));
}

class ReadRules : public testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::string file(const std::string& text) {
        std::string path = folder_ + "/rules.json";
        std::ofstream(path) << text;
        return path;
    }
    void expect_fault(const std::string& text, const std::string& word) {
        const std::string path = file(text);
        expect_error(ErrorCode::malformed, word, [&] { return read_rules(path); });
        expect_error(ErrorCode::malformed, path, [&] { return read_rules(path); });
    }

private:
    std::string folder_ = testing::TempDir() + "abut_rules_" + "_" +
                          testing::UnitTest::GetInstance()->current_test_info()->name() +
                          std::to_string(getpid());
};

TEST_F(ReadRules, AllKeys) {
    const auto rules = read_rules(file(R"({"rules": [
        {"name": "one", "a": {"file": "f*", "name": ["n", "m?"], "type": "t"}, "b": {}, "clearance": 0.5,
         "touch": 0, "ignore": {"same_file": true, "same_type": false, "same_name_prefix": 3}},
        {"name": "two"}]})"));
    ASSERT_EQ(rules.size(), 2U);
    EXPECT_EQ(rules[0].name, "one");
    EXPECT_EQ(rules[0].a.file, std::vector<std::string>{"f*"});
    EXPECT_EQ(rules[0].a.name, (std::vector<std::string>{"n", "m?"}));
    EXPECT_EQ(rules[0].a.type, std::vector<std::string>{"t"});
    EXPECT_TRUE(rules[0].b.file.empty());
    EXPECT_EQ(rules[0].clearance, 0.5);
    EXPECT_EQ(rules[0].touch_tolerance, 0.0);
    EXPECT_TRUE(rules[0].ignore.same_file);
    EXPECT_FALSE(rules[0].ignore.same_type);
    EXPECT_EQ(rules[0].ignore.same_name_prefix, 3U);
    EXPECT_FALSE(rules[1].clearance);
    EXPECT_FALSE(rules[1].touch_tolerance);
}

TEST_F(ReadRules, Faults) {
    expect_fault("", "JSON");
    expect_fault("{\"rules\": [", "JSON");
    expect_fault("[]", "object");
    expect_fault("{}", "rules");
    expect_fault(R"({"rules": []})", "at least one");
    expect_fault(R"({"rules": {}})", "rules");
    expect_fault(R"({"rules": [1]})", "rules[0]");
    expect_fault(R"({"rules": [{"name": "x"}], "colour": 1})", "\"colour\"");
    expect_fault(R"({"rules": [{"name": "x", "clearence": 1}]})", "\"clearence\"");
    expect_fault(R"({"rules": [{"name": "x", "a": {"id": "y"}}]})", "\"id\"");
    expect_fault(R"({"rules": [{"name": "x", "ignore": {"all": true}}]})", "\"all\"");
    expect_fault(R"({"rules": [{}]})", "rules[0].name");
    expect_fault(R"({"rules": [{"name": 1}]})", "rules[0].name");
    expect_fault(R"({"rules": [{"name": "x"}, {"name": "y", "clearance": -1}]})",
                 "rules[1].clearance");
    expect_fault(R"({"rules": [{"name": "x", "touch": "1"}]})", "rules[0].touch");
    expect_fault(R"({"rules": [{"name": "x", "touch": null}]})", "rules[0].touch");
    expect_fault(R"({"rules": [{"name": "x", "clearance": 1e999}]})", "number");
    expect_fault(R"({"rules": [{"name": "x", "a": []}]})", "rules[0].a");
    expect_fault(R"({"rules": [{"name": "x", "a": {"file": 1}}]})", "rules[0].a.file");
    expect_fault(R"({"rules": [{"name": "x", "b": {"type": []}}]})", "rules[0].b.type");
    expect_fault(R"({"rules": [{"name": "x", "b": {"type": ["a", 1]}}]})", "rules[0].b.type");
    expect_fault(R"({"rules": [{"name": "x", "ignore": {"same_file": 1}}]})", "same_file");
    expect_fault(R"({"rules": [{"name": "x", "ignore": {"same_name_prefix": -1}}]})",
                 "same_name_prefix");
    expect_fault(R"({"rules": [{"name": "x", "ignore": {"same_name_prefix": 1.5}}]})",
                 "same_name_prefix");
    expect_error(ErrorCode::file_not_found, "no/such/rules.json",
                 [] { return read_rules("no/such/rules.json"); });
}

} // namespace
} // namespace abut::test
