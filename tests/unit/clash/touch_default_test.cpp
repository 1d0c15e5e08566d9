// The touch tolerance of a job that names none: what the files of each pair tell apart.

#include <abut/clash.h>
#include <abut/store.h>
#include <abut/store_clash.h>

#include "clash/rules/pair_precision.h"
#include "math/rounding.h"
#include "math/transform.h"
#include "store/database/sqlite.h"
#include "tests/support/folder.h"
#include "tests/support/random.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace abut::test {
namespace {

/// A cube of a metre and a cube beside it, in two models, that overlap by `depth`.
std::vector<Scene> two_cubes(double depth, const ModelPrecision& a, const ModelPrecision& b) {
    std::vector<Scene> models(2);
    for (std::size_t i = 0; i < 2; ++i) {
        models[i].file = i == 0 ? "a.ifc" : "b.glb";
        models[i].precision = i == 0 ? a : b;
        models[i].meshes = {box_mesh({0, 0, 0}, {1, 1, 1})};
        Transform place;
        place.m[9] = i == 0 ? 0 : 1 - depth;
        models[i].parts = {{i == 0 ? "wall" : "slab", "", "", 0, place}};
    }
    return models;
}

ClashReport report_of(double depth, const ModelPrecision& a, const ModelPrecision& b,
                      const ClashOptions& options = {}) {
    return find_clashes(two_cubes(depth, a, b), options);
}

std::optional<ClashKind> kind_of(const ClashReport& report) {
    return report.clashes.empty() ? std::nullopt : std::optional(report.clashes.front().kind);
}

constexpr double kStated = 1e-5; // of most IFC files
const ModelPrecision kIfc{kStated, true, false}, kExact{}, kSingle{0, true, false};

TEST(TouchDefault, IsTheStatedPrecisionOfTheCoarserFile) {
    for (const bool exchanged : {false, true}) {
        const ModelPrecision finer{1e-7, true, false};
        const ModelPrecision &a = exchanged ? finer : kIfc, &b = exchanged ? kIfc : finer;
        const ClashReport shallow = report_of(0.5 * kStated, a, b);
        EXPECT_EQ(kind_of(shallow), ClashKind::touch);
        EXPECT_EQ(shallow.touch_tolerance, kStated);
        EXPECT_EQ(shallow.least_touch_tolerance, kStated);
        EXPECT_EQ(shallow.touch_source, TouchSource::precision);
        EXPECT_EQ(shallow.touch_file, exchanged ? "b.glb" : "a.ifc");
        EXPECT_EQ(shallow.models[exchanged ? 1 : 0].precision, kStated);
        EXPECT_EQ(kind_of(report_of(2 * kStated, a, b)), ClashKind::hard);
    }
}

TEST(TouchDefault, IsTheSumOfTheRoundingsWhereTheyAreCoarser) {
    const ClashReport report = report_of(0x1p-25, kSingle, kSingle);
    // Each coordinate of a cube of a metre is off by at most 2^-24, a point by the root of three.
    const double sum = 2 * std::sqrt(3) * 0x1p-24;
    EXPECT_GE(report.touch_tolerance, sum);
    EXPECT_LE(report.touch_tolerance, sum * (1 + 1e-6));
    EXPECT_EQ(report.touch_source, TouchSource::rounding);
    EXPECT_EQ(kind_of(report), ClashKind::touch);
    EXPECT_NEAR(report.clashes.front().rounding, report.touch_tolerance, 1e-13);
    EXPECT_EQ(kind_of(report_of(4 * sum, kSingle, kSingle)), ClashKind::hard);
    const ClashReport one = report_of(0x1p-25, kExact, kSingle);
    EXPECT_NEAR(one.touch_tolerance, sum / 2, 1e-6 * sum);
    EXPECT_EQ(one.touch_file, "b.glb");
}

TEST(TouchDefault, IsExactForModelsOfAProgramAndForZero) {
    const ClashReport exact = report_of(1e-9, kExact, kExact);
    EXPECT_EQ(kind_of(exact), ClashKind::hard);
    EXPECT_EQ(exact.touch_tolerance, 0);
    EXPECT_EQ(exact.touch_source, TouchSource::none);
    EXPECT_EQ(exact.touch_file, "");
    const ClashReport zero = report_of(1e-9, kIfc, kIfc, {.touch_tolerance = 0});
    EXPECT_EQ(kind_of(zero), ClashKind::hard);
    EXPECT_EQ(zero.touch_tolerance, 0);
    EXPECT_EQ(zero.touch_source, TouchSource::option);
    EXPECT_EQ(kind_of(report_of(5e-4, kIfc, kIfc, {.touch_tolerance = 1e-3})), ClashKind::touch);
}

TEST(TouchDefault, HoldsForRulesAndCellsThatNameNone) {
    const auto kind_with = [](const ClashOptions& options) {
        return kind_of(report_of(0.5 * kStated, kIfc, kExact, options));
    };
    ClashOptions rule;
    rule.rules.resize(1);
    EXPECT_EQ(kind_with(rule), ClashKind::touch);
    rule.rules[0].touch_tolerance = 0;
    EXPECT_EQ(kind_with(rule), ClashKind::hard);
    rule.rules[0].touch_tolerance.reset();
    rule.touch_tolerance = 0;
    EXPECT_EQ(kind_with(rule), ClashKind::hard);
    ClashOptions cell;
    cell.matrix.groups = {{"all", {}}};
    cell.matrix.cells.resize(1);
    EXPECT_EQ(kind_with(cell), ClashKind::touch);
    cell.matrix.cells[0].terms.touch_tolerance = 0;
    EXPECT_EQ(kind_with(cell), ClashKind::hard);
    // A tolerated depth below the files' precision does not leave out what only touches.
    ClashOptions tolerant;
    tolerant.rules.resize(1);
    tolerant.rules[0].tolerated_depth = 0.1 * kStated;
    EXPECT_EQ(kind_with(tolerant), ClashKind::touch);
    tolerant.rules[0].tolerated_depth = 10 * kStated;
    EXPECT_EQ(kind_with(tolerant), std::nullopt);
}

TEST(TouchDefault, DiffersByPair) {
    std::vector<Scene> models = two_cubes(0, kSingle, kSingle);
    Transform far;
    far.m[10] = 1; // on the other side of the first cube
    models[1].meshes.push_back(box_mesh({1000, 0, 0}, {1001, 1, 1}));
    far.m[9] = -1000;
    models[1].parts.push_back({"far", "", "", 1, far});
    const ClashReport report = find_clashes(models, {});
    EXPECT_EQ(report.candidates, 2U);
    EXPECT_GT(report.touch_tolerance, 0x1p-15); // of a coordinate of 1001
    EXPECT_LT(report.least_touch_tolerance, 0x1p-21);
}

TEST(TouchDefault, PairsWithinItAreCandidates) {
    // Apart by half the precision, so that their boxes do not meet.
    EXPECT_EQ(report_of(-0.5 * kStated, kIfc, kIfc).candidates, 1U);
    EXPECT_EQ(report_of(-0.5 * kStated, kIfc, kIfc, {.touch_tolerance = 0}).candidates, 0U);
    EXPECT_EQ(report_of(-2 * kStated, kIfc, kIfc).candidates, 0U);
    EXPECT_EQ(report_of(-2 * kStated, kIfc, kIfc, {.touch_tolerance = 1e-3}).candidates, 1U);
}

TEST(TouchDefault, OfAStoreIsThatOfItsFiles) {
    const Folder folder;
    std::vector<std::string> files;
    for (const Scene& model : two_cubes(0x1p-26, kExact, kExact)) {
        files.push_back(folder / (model.parts[0].id + ".glb"));
        write_glb(model, files.back());
    }
    const std::string path = folder / "cubes.abut";
    import_models(files, path);
    const auto ask = [&](const ClashOptions& options) {
        return find_clashes(open_store(path, {.read_only = false}), options).report;
    };
    const ClashReport of_files = find_clashes(read_scenes(files), {});
    const ClashReport of_store = ask({});
    EXPECT_EQ(of_files.touch_source, TouchSource::rounding);
    EXPECT_GT(of_files.touch_tolerance, 0);
    EXPECT_EQ(of_store.touch_tolerance, of_files.touch_tolerance);
    EXPECT_EQ(of_store.least_touch_tolerance, of_files.least_touch_tolerance);
    EXPECT_EQ(of_store.touch_source, of_files.touch_source);
    EXPECT_EQ(of_store.touch_file, of_files.touch_file);
    for (std::size_t m = 0; m < 2; ++m)
        EXPECT_EQ(of_store.models[m].rounding, of_files.models[m].rounding);
    ASSERT_EQ(kind_of(of_store), kind_of(of_files));
    EXPECT_EQ(of_store.clashes[0].rounding, of_files.clashes[0].rounding);
    // Again, from the record.
    EXPECT_EQ(ask({}).clashes[0].status, of_store.clashes[0].status);
    EXPECT_EQ(ask({}).clashes[0].rounding, of_files.clashes[0].rounding);
    // Another tolerance is another question.
    EXPECT_EQ(ask({.touch_tolerance = 0}).touch_source, TouchSource::option);
    EXPECT_EQ(kind_of(ask({.touch_tolerance = 0})), ClashKind::hard);
    EXPECT_EQ(kind_of(ask({})), kind_of(of_files));

    // A store as earlier versions wrote it has no precisions: its question is that of zero.
    {
        Database database(path, OpenMode::read_write);
        database.run("DROP TABLE model_precision");
    }
    const ClashReport earlier = ask({});
    EXPECT_EQ(earlier.touch_tolerance, 0);
    EXPECT_EQ(earlier.touch_source, TouchSource::none);
    EXPECT_EQ(kind_of(earlier), ClashKind::hard);
    EXPECT_LT(earlier.clashes[0].rounding, 1e-12);
}

TEST(TouchDefault, AnotherPrecisionOfAFileTestsItsPairsAgain) {
    const Folder folder;
    std::vector<Scene> models = two_cubes(0x1p-26, kExact, kExact);
    const std::vector<std::string> files{folder / "wall.glb", folder / "slab.glb"};
    for (std::size_t m = 0; m < 2; ++m)
        write_glb(models[m], files[m]);
    const std::string path = folder / "cubes.abut";
    import_models(files, path);
    {
        Database database(path, OpenMode::read_write);
        database.run("DROP TABLE model_precision");
    }
    const auto ask = [&](const ClashOptions& options) {
        return find_clashes(open_store(path, {.read_only = false}), options);
    };
    EXPECT_EQ(kind_of(ask({}).report), ClashKind::hard);
    Transform far;
    far.m[9] = 50;
    for (std::size_t m = 0; m < 2; ++m) {
        models[m].parts.push_back({"far", "", "", 0, far});
        far.m[9] += 10;
        write_glb(models[m], files[m]);
    }
    for (const ImportedModel& model : import_models(files, path).models) {
        EXPECT_EQ(model.added, 1U);
        EXPECT_EQ(model.changed, 1U); // the cube, whose place is the same
    }
    const StoreClashReport again = ask({});
    EXPECT_EQ(again.counters.recalled_pairs, 0U);
    EXPECT_EQ(kind_of(again.report), ClashKind::touch);
    EXPECT_EQ(kind_of(ask({.touch_tolerance = 0}).report), ClashKind::hard);
}

TEST(TouchDefault, RoundingIsABoundThatIsReached) {
    Random random(20261127);
    std::size_t near = 0;
    constexpr std::size_t kRounds = 300;
    for (std::size_t round = 0; round < kRounds; ++round) {
        const Transform world = random.linear_map(random.chance(0.5));
        const double size = std::exp2(random.uniform(-10, 20));
        Box3 box;
        std::vector<Vec3> exact, rounded;
        for (int i = 0; i < 400; ++i) {
            const Vec3 p{random.uniform(-size, size), random.uniform(-size, size),
                         random.uniform(-size, size)};
            const Vec3 q{to_float(p.x), to_float(p.y), to_float(p.z)};
            exact.push_back(p), rounded.push_back(q);
            box.lower = min(box.lower, q), box.upper = max(box.upper, q);
        }
        const double bound = single_rounding(kSingle, reach_of(box), world);
        double most = 0;
        for (std::size_t i = 0; i < exact.size(); ++i)
            most = std::max(most, length(apply_linear(world, exact[i] - rounded[i])));
        ASSERT_LE(most, bound * (1 + 1e-12)) << "round " << round;
        near += most > 0.5 * bound ? 1 : 0;
        EXPECT_EQ(single_rounding(kExact, reach_of(box), world), 0);
    }
    EXPECT_GT(near, kRounds / 3); // the bound is not far above what occurs
}

TEST(TouchDefault, LengthsThatAreRoundingReadAsZero) {
    Clash clash;
    clash.distance = -1e-9;
    EXPECT_EQ(told_distance(clash), -1e-9);
    clash.rounding = 1e-8;
    EXPECT_EQ(told_distance(clash), 0);
    clash.distance = -1e-7;
    EXPECT_EQ(told_distance(clash), -1e-7);
    for (const double tiny : {2e-308, -2e-308, 5e-324, 1e-13}) {
        clash = {};
        clash.distance = tiny;
        EXPECT_EQ(told_distance(clash), 0) << tiny;
    }
    // Steps of doubles a million metres away.
    std::vector<Scene> far = two_cubes(0x1p-28, kExact, kExact);
    for (Scene& model : far)
        model.parts[0].world_from_mesh.m[9] += 1 << 20;
    const ClashReport there = find_clashes(far, {});
    ASSERT_EQ(there.clashes.size(), 1U);
    EXPECT_GT(there.clashes[0].rounding, 1e-9);
    EXPECT_EQ(told_distance(there.clashes[0]), 0);
    // JSON has the number that people read, too.
    const std::vector<Scene> models = two_cubes(1e-9, kSingle, kSingle);
    const ClashReport report = find_clashes(models, {.touch_tolerance = 0});
    ASSERT_EQ(kind_of(report), ClashKind::hard);
    EXPECT_LT(report.clashes[0].distance, 0);
    const auto written = nlohmann::json::parse(to_json(report, models));
    EXPECT_EQ(written["clashes"][0]["distance"].dump(), "0");
}

} // namespace
} // namespace abut::test
