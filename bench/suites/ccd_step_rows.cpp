#include "suites/ccd_step_rows.h"

#include <abut/deformable.h>
#include <abut/model.h>
#include <abut/progress.h>

#include "measure.h"
#include "peers/peer_rigid.h"
#include "peers/peer_swept.h"
#include "scenes/deforming/deforming.h"
#include "suites/any_culling_rows.h"
#include "suites/rest_rows.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

namespace abut::bench {

namespace {

void add_counters(Row& row, const Impacts& impacts, const Deformable& surface) {
    double faces = 0;
    for (const FeatureImpact& impact : impacts.list)
        faces += impact.kind == ElementaryKind::vertex_face ? 1 : 0;
    const DeformableCounters& counters = impacts.counters;
    row.counters["vertex-face impacts"] = faces;
    row.counters["edge-edge impacts"] = static_cast<double>(impacts.list.size()) - faces;
    row.counters["triangle pairs"] = static_cast<double>(counters.triangle_pairs);
    row.counters["candidates"] =
        static_cast<double>(counters.candidates.vertex_face + counters.candidates.edge_edge);
    row.counters["elementary tests"] = static_cast<double>(counters.elementary_tests.vertex_face +
                                                           counters.elementary_tests.edge_edge);
    row.counters["exact fallbacks"] = static_cast<double>(counters.exact_fallbacks);
    row.counters["bytes a triangle"] =
        static_cast<double>(surface.bytes()) / static_cast<double>(surface.triangles().size());
}

/// A whole step: sets the motion, fits the hierarchy, finds all impacts.
Impacts do_step(Deformable& surface, const CcdStep& step) {
    surface.set_motion(step.start.positions, step.end);
    return self_impacts(surface);
}

Row all_impacts_row(const CcdStep& step, int rounds) {
    Deformable surface(step.start);
    Impacts impacts;
    std::optional<std::size_t> pairs;
    set_threads(1);
    const Turns turns = take_turns(
        rounds, [&] { impacts = do_step(surface, step); },
        [&] { pairs = embree_swept_pairs(step); });
    Row row{step.name + ", all impacts", kMilliseconds * turns.ours, {}, {}, "ms", 1, {}};
    if (pairs) {
        row.peer = "Embree 3, swept boxes of triangles only";
        row.theirs = kMilliseconds * turns.theirs;
        row.counters["triangle pairs of the peer"] = static_cast<double>(*pairs);
    }
    add_counters(row, impacts, surface);
    return row;
}

Row threads_row(const CcdStep& step, int rounds) {
    Deformable surface(step.start);
    const auto on = [&](int threads) {
        set_threads(threads);
        do_step(surface, step);
    };
    const Turns turns = take_turns(
        rounds, [&] { on(2); }, [&] { on(1); });
    return {step.name + ", all impacts, two threads",
            kMilliseconds * turns.ours,
            "abut, one thread",
            kMilliseconds * turns.theirs,
            "ms",
            2,
            {}};
}

Row earliest_row(const CcdStep& step, int rounds) {
    Deformable surface(step.start);
    std::optional<FeatureImpact> first;
    set_threads(1);
    const Turns turns = take_turns(
        rounds,
        [&] {
            surface.set_motion(step.start.positions, step.end);
            first = self_time_of_impact(surface);
        },
        [&] { do_step(surface, step); });
    Row row{step.name + ", earliest impact",
            kMilliseconds * turns.ours,
            "abut, all impacts",
            kMilliseconds * turns.theirs,
            "ms",
            1,
            {}};
    row.counters["its time"] = first ? first->time : 1;
    return row;
}

/// Compares two schemes. The counters are those of the second.
Row scheme_row(const CcdStep& step, const std::string& name, const DeformableOptions& first,
               const DeformableOptions& second, int rounds) {
    Deformable ours(step.start, first), theirs(step.start, second);
    Impacts impacts;
    set_threads(1);
    const Turns turns = take_turns(
        rounds, [&] { do_step(ours, step); }, [&] { impacts = do_step(theirs, step); });
    Row row{step.name + ", all impacts",
            kMilliseconds * turns.ours,
            "abut, " + name,
            kMilliseconds * turns.theirs,
            "ms",
            1,
            {}};
    add_counters(row, impacts, theirs);
    return row;
}

/// A scheme and its name in the report.
struct NamedOptions {
    std::string name;
    DeformableOptions options;
};

/// The schemes that take pairs of triangles one by one, and the names of the comparison in which all
/// of them have the same boxes and filters, and none has leaves or flat regions.
const char* const kOneByOne = ", all impacts, triangle pairs one by one";
std::vector<NamedOptions> one_by_one() {
    return {{"markup", {.scheme = Scheme::markup}},
            {"database", {.scheme = Scheme::database}},
            {"basic", {.scheme = Scheme::basic}}};
}

double impacts_of(const Row& row) {
    const auto all = row.counters.find("impacts");
    return all != row.counters.end()
               ? all->second
               : row.counters.at("vertex-face impacts") + row.counters.at("edge-edge impacts");
}

/// Adds the figures that [Curtis, Tamstorf, Manocha 2008] compares schemes by. Their elementary tests
/// are our candidates, since they have no filter between boxes and roots.
///
/// In          rows of one step or scene, that of representative triangles first.
void add_shares(std::vector<Row>& rows) {
    double pairs = 0; // the most of all rows: flat regions leave out some
    for (const Row& row : rows)
        if (const auto each = row.counters.find("triangle pairs"); each != row.counters.end())
            pairs = std::max(pairs, each->second);
    const double representatives = rows.front().counters.at("candidates");
    for (Row& row : rows) {
        const auto candidates = row.counters.find("candidates");
        if (candidates == row.counters.end() || candidates->second == 0)
            continue;
        row.counters["candidates over those of representatives"] =
            candidates->second / representatives;
        row.counters["% of 15 tests a pair culled"] = 100 - 100 * candidates->second / (15 * pairs);
        row.counters["% of candidates without an impact"] =
            100 - 100 * impacts_of(row) / candidates->second;
    }
}

} // namespace

std::vector<Row> ccd_step_rows(const CcdStep& step, int rounds) {
    std::vector<Row> rows{all_impacts_row(step, rounds), threads_row(step, rounds),
                          earliest_row(step, rounds), at_rest_row(step, rounds),
                          near_row(step, rounds)};
    const auto add = [&](const std::string& name, const DeformableOptions& options) {
        rows.push_back(scheme_row(step, name, {}, options, rounds));
    };
    add("lean", {.lean = true});
    add("markup", {.scheme = Scheme::markup});
    add("database", {.scheme = Scheme::database});
    add("basic", {.scheme = Scheme::basic});
    add("trees over features", {.scheme = Scheme::features});
    add("maximal assignment", {.assignment = Assignment::maximal});
    add("uniform assignment, vertices with edges", {.assignment = Assignment::uniform_vertex_edge});
    add("uniform assignment, edges alone", {.assignment = Assignment::uniform_edge_edge});
    add("grid", {.culling = Culling::grid});
    add("sweep and prune", {.culling = Culling::sweep});
    add("markup, maximal assignment",
        {.scheme = Scheme::markup, .assignment = Assignment::maximal});
    add("markup, uniform assignment, vertices with edges",
        {.scheme = Scheme::markup, .assignment = Assignment::uniform_vertex_edge});
    add("markup, uniform assignment, edges alone",
        {.scheme = Scheme::markup, .assignment = Assignment::uniform_edge_edge});
    for (const NamedOptions& each : one_by_one()) {
        rows.push_back(
            scheme_row(step, each.name, {.scheme = Scheme::pairwise}, each.options, rounds));
        rows.back().name = step.name + kOneByOne;
    }
    add_shares(rows);
    for (Row& row : any_culling_rows(step, rounds))
        rows.push_back(std::move(row));
    set_threads(0);
    return rows;
}

namespace {

/// One scheme, with its sums over the sampled frames of a scene.
struct SchemeSum {
    std::string name;
    DeformableOptions options;
    std::optional<Deformable> surface;
    double seconds = 0, bytes = 0, found = 0;
    DeformableCounters counters;

    void measure(const CcdStep& step, int rounds) {
        if (!surface)
            surface.emplace(step.start, options);
        else if (surface->triangles() != step.start.triangles ||
                 surface->vertex_count() != step.start.positions.size())
            surface->set_mesh(step.start);
        std::vector<double> times;
        Impacts impacts;
        for (int round = 0; round < rounds; ++round) {
            const double start = wall_seconds();
            impacts = do_step(*surface, step);
            times.push_back(wall_seconds() - start);
        }
        seconds += median(times);
        bytes += static_cast<double>(surface->bytes()) /
                 static_cast<double>(step.start.triangles.size());
        const DeformableCounters& c = impacts.counters;
        counters.triangle_pairs += c.triangle_pairs;
        counters.candidates.vertex_face += c.candidates.vertex_face;
        counters.candidates.edge_edge += c.candidates.edge_edge;
        counters.elementary_tests.vertex_face += c.elementary_tests.vertex_face;
        counters.elementary_tests.edge_edge += c.elementary_tests.edge_edge;
        counters.exact_fallbacks += c.exact_fallbacks;
        found += static_cast<double>(impacts.list.size());
    }
};

Row scene_row(const std::string& scene, const SchemeSum& sum, double ours, double measured,
              const Mesh& mesh) {
    Row row{scene + ", all impacts", ours, {}, {}, "ms/frame", 1, {}};
    if (sum.name != "representative") {
        row.peer = "abut, " + sum.name;
        row.theirs = kMilliseconds * sum.seconds / measured;
    }
    const auto mean = [&](std::uint64_t total) { return static_cast<double>(total) / measured; };
    row.counters["frames measured"] = measured;
    row.counters["triangles"] = static_cast<double>(mesh.triangles.size());
    row.counters["impacts"] = sum.found / measured;
    row.counters["triangle pairs"] = mean(sum.counters.triangle_pairs);
    row.counters["candidates"] =
        mean(sum.counters.candidates.vertex_face + sum.counters.candidates.edge_edge);
    row.counters["elementary tests"] =
        mean(sum.counters.elementary_tests.vertex_face + sum.counters.elementary_tests.edge_edge);
    row.counters["exact fallbacks"] = mean(sum.counters.exact_fallbacks);
    row.counters["bytes a triangle"] = sum.bytes / measured;
    return row;
}

/// Rows of all schemes, the first of which is `representative` and the last `pairwise`.
std::vector<Row> scene_rows(const std::string& scene, const std::vector<SchemeSum>& sums,
                            double measured, const Mesh& mesh) {
    const std::vector<NamedOptions> schemes = one_by_one();
    std::vector<Row> rows;
    rows.reserve(sums.size() + schemes.size());
    for (const SchemeSum& sum : sums)
        rows.push_back(
            scene_row(scene, sum, kMilliseconds * sums.front().seconds / measured, measured, mesh));
    add_shares(rows);
    for (const NamedOptions& each : schemes) {
        const auto other = std::find_if(
            sums.begin(), sums.end(), [&](const SchemeSum& sum) { return sum.name == each.name; });
        rows.push_back({scene + kOneByOne,
                        kMilliseconds * sums.back().seconds / measured,
                        "abut, " + each.name,
                        kMilliseconds * other->seconds / measured,
                        "ms/frame",
                        1,
                        {}});
    }
    return rows;
}

} // namespace

std::vector<Row> ccd_scene_rows(const std::string& scene_name, int samples, int rounds) {
    const auto* info =
        std::find_if(kDeformingScenes.begin(), kDeformingScenes.end(),
                     [&](const DeformingSceneInfo& each) { return each.name == scene_name; });
    const auto scene = make_deforming_scene(scene_name);
    std::vector<SchemeSum> sums;
    const auto add = [&](const std::string& name, const DeformableOptions& options) {
        sums.push_back({name, options, std::nullopt, 0, 0, 0, {}});
    };
    add("representative", {});
    add("markup", {.scheme = Scheme::markup});
    add("database", {.scheme = Scheme::database});
    add("basic", {.scheme = Scheme::basic});
    add("trees over features", {.scheme = Scheme::features});
    add("lean", {.lean = true});
    add("one by one", {.scheme = Scheme::pairwise});

    double measured = 0;
    CcdStep step{scene_name, scene->mesh(), {}};
    const auto every = std::max(1U, info->frames / static_cast<std::uint32_t>(samples));
    for (std::uint32_t frame = 1; frame <= info->frames; ++frame) {
        set_threads(0);
        scene->step();
        const bool moves = scene->mesh().triangles == step.start.triangles &&
                           scene->mesh().positions.size() == step.start.positions.size();
        if (frame % every == every / 2 && moves) {
            step.end = scene->mesh().positions;
            set_threads(1);
            for (SchemeSum& sum : sums)
                sum.measure(step, rounds);
            ++measured;
        }
        step.start = scene->mesh();
    }
    set_threads(0);

    return scene_rows(scene_name, sums, measured, step.start);
}

std::vector<Row> calibration_rows(int rounds) {
    constexpr int kSides = 1000, kStepsAlong = 500;
    Mesh mesh;
    for (int i = 0; i < kSides; ++i)
        for (int k = 0; k < kStepsAlong; ++k) {
            const double a = 2 * std::numbers::pi * i / kSides,
                         b = 2 * std::numbers::pi * k / kStepsAlong;
            const double r = 1 + 0.3 * std::cos(b) + 0.02 * std::sin(40 * a);
            mesh.positions.push_back({r * std::cos(a), r * std::sin(a), 0.3 * std::sin(b)});
            const auto at = [&](int u, int v) {
                return static_cast<std::uint32_t>(u % kSides * kStepsAlong + v % kStepsAlong);
            };
            mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
            mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
        }
    set_threads(1);
    std::vector<double> theirs;
    const Turns turns = take_turns(
        rounds, [&] { const Model model(mesh); },
        [&] {
            if (const auto seconds = embree_build_seconds(mesh))
                theirs.push_back(*seconds);
        });
    set_threads(0);
    Row row{"calibration: build of 1,000,000 triangles",
            kMilliseconds * turns.ours,
            {},
            {},
            "ms",
            1,
            {}};
    if (!theirs.empty()) {
        row.peer = "Embree 3, medium quality";
        row.theirs = kMilliseconds * median(theirs);
    }
    return {row};
}

} // namespace abut::bench
