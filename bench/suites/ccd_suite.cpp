#include <abut/elementary_impact.h>
#include <abut/error.h>
#include <abut/frame.h>
#include <abut/progress.h>

#include "measure.h"
#include "peers/peer_elementary.h"
#include "placement.h"
#include "suite.h"
#include "suites/ccd_step_rows.h"
#include "suites/contact_rows.h"
#include "suites/rest_rows.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace abut::bench {

namespace {

struct CcdSuiteOptions {
    std::vector<std::string> files;  ///< of queries (see read_elementary_queries)
    std::vector<std::string> frames; ///< start and end of each step (see read_frame)
    std::vector<std::string> scenes; ///< names of deforming scenes
    int samples = 12;                ///< frames of each scene that are measured
    std::size_t pairs = 2000;        ///< of each generated case
    int rounds = 5;
    std::uint64_t seed = 1;
};

struct CcdCase {
    std::string name;
    std::vector<ElementaryPair> pairs;
    std::vector<bool> truth;
    double thickness = 0; ///< above 0: FCL is not measured
};

Vec3 plus(const Vec3& a, const Vec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vec3 blend(double t, const Vec3& a, const Vec3& b) {
    return {(1 - t) * a.x + t * b.x, (1 - t) * a.y + t * b.y, (1 - t) * a.z + t * b.z};
}

/// Features of size 1 in general position that move by up to a tenth, as in a small time step.
class PairMaker {
public:
    explicit PairMaker(std::uint64_t seed) : engine_(seed) {}

    /// Features at random places near each other.
    ElementaryPair near(ElementaryKind kind) {
        ElementaryPair pair{kind, {}, {}};
        for (std::size_t i = 0; i < 4; ++i) {
            pair.start.at(i) = vector(0.5);
            pair.end.at(i) = plus(pair.start.at(i), vector(0.1));
        }
        return pair;
    }
    /// Features that meet in the interior of both, at a time within [0, 1].
    ElementaryPair meeting(ElementaryKind kind) {
        ElementaryPair pair = near(kind);
        const bool face = kind == ElementaryKind::vertex_face;
        const double t = inner(), x = inner(), y = face ? inner() * (1 - x) : inner();
        const auto at = [&](std::size_t i) { return blend(t, pair.start.at(i), pair.end.at(i)); };
        const Vec3 first = face ? at(0) : blend(x, at(0), at(1));
        const Vec3 second =
            face ? blend(x + y, at(1), blend(y / (x + y), at(2), at(3))) : blend(y, at(2), at(3));
        const Vec3 gap{second.x - first.x, second.y - first.y, second.z - first.z};
        for (std::size_t i = 0; i < (face ? 1U : 2U); ++i) {
            pair.start.at(i) = plus(pair.start.at(i), gap);
            pair.end.at(i) = plus(pair.end.at(i), gap);
        }
        return pair;
    }

private:
    double inner() { return std::uniform_real_distribution<double>(0.01, 0.99)(engine_); }
    Vec3 vector(double half) {
        std::uniform_real_distribution<double> any(-half, half);
        const double x = any(engine_), y = any(engine_), z = any(engine_);
        return {x, y, z};
    }
    std::mt19937_64 engine_;
};

bool swept_boxes_overlap(const ElementaryPair& pair) {
    const auto box_of = [&](std::size_t begin, std::size_t end) {
        Box3 box;
        for (std::size_t i = begin; i < end; ++i)
            for (const Vec3& p : {pair.start.at(i), pair.end.at(i)})
                extend(box, p);
        return box;
    };
    const std::size_t second = pair.kind == ElementaryKind::vertex_face ? 1 : 2;
    const Box3 a = box_of(0, second), b = box_of(second, 4);
    return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y &&
           b.lower.y <= a.upper.y && a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

const char* name_of(ElementaryKind kind) {
    return kind == ElementaryKind::vertex_face ? "vertex-face" : "edge-edge";
}

/// For features of size 1.
constexpr double kThickness = 1e-3;

/// Pairs that meet, tested without and with a thickness.
std::vector<CcdCase> generated_cases(const CcdSuiteOptions& options) {
    std::vector<CcdCase> cases;
    PairMaker maker(options.seed);
    for (const auto kind : {ElementaryKind::vertex_face, ElementaryKind::edge_edge}) {
        CcdCase meeting{fmt::format("generated, {}, contacts", name_of(kind)), {}, {}};
        while (meeting.pairs.size() < options.pairs)
            meeting.pairs.push_back(maker.meeting(kind));
        meeting.truth.assign(meeting.pairs.size(), true);
        CcdCase thick = meeting;
        thick.name = fmt::format("generated, {}, within {}", name_of(kind), kThickness);
        thick.thickness = kThickness;
        cases.push_back(std::move(meeting));
        cases.push_back(std::move(thick));
    }
    return cases;
}

/// The queries of all files, by kind and truth, and all contacts of both kinds together.
std::vector<CcdCase> file_cases(const std::vector<std::string>& files) {
    std::array<CcdCase, 4> cases;
    CcdCase contacts{"queries, all contacts", {}, {}};
    for (const std::string& file : files) {
        const ElementaryQueries queries = read_elementary_queries(file);
        for (std::size_t i = 0; i < queries.truth.size(); ++i) {
            const ElementaryPair& pair = queries.pairs[i];
            const bool truth = queries.truth[i];
            CcdCase& c =
                cases.at((pair.kind == ElementaryKind::vertex_face ? 0 : 2) + (truth ? 0 : 1));
            c.name =
                fmt::format("queries, {}, {}", name_of(pair.kind), truth ? "contacts" : "misses");
            for (CcdCase* each : {&c, truth ? &contacts : nullptr})
                if (each != nullptr) {
                    each->pairs.push_back(pair);
                    each->truth.push_back(truth);
                }
        }
    }
    std::vector<CcdCase> result;
    for (CcdCase& c : cases)
        if (!c.pairs.empty())
            result.push_back(std::move(c));
    if (!contacts.pairs.empty())
        result.push_back(std::move(contacts));
    return result;
}

/// Nanoseconds of one test: the median over rounds of several tests of one pair, because a single
/// test is too short for the clock.
template <typename Test>
double nanoseconds_of(int rounds, const Test& test) {
    constexpr int kTests = 16;
    std::vector<double> seconds;
    for (int round = 0; round < rounds; ++round) {
        const double start = wall_seconds();
        for (int i = 0; i < kTests; ++i)
            test();
        seconds.push_back((wall_seconds() - start) / kTests);
    }
    return 1e9 * median(seconds);
}

double quantile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

Row measure_single(const CcdCase& c, const CcdSuiteOptions& options) {
    std::vector<double> ours, theirs;
    std::array<double, 3> decided{};
    double missed = 0, false_hits = 0, peer_missed = 0, peer_false = 0;
    for (std::size_t i = 0; i < c.pairs.size(); ++i) {
        const ElementaryPair& pair = c.pairs[i];
        ElementaryImpact impact;
        ours.push_back(nanoseconds_of(
            options.rounds, [&] { impact = elementary_impact(pair, {.thickness = c.thickness}); }));
        decided.at(static_cast<std::size_t>(impact.decided_by)) += 1;
        missed += c.truth[i] && !impact.meet ? 1 : 0;
        false_hits += impact.meet && !c.truth[i] ? 1 : 0;
        if (!has_fcl_elementary() || c.thickness > 0)
            continue;
        std::optional<double> time;
        theirs.push_back(
            nanoseconds_of(options.rounds, [&] { time = fcl_elementary_impact(pair); }));
        peer_missed += c.truth[i] && !time ? 1 : 0;
        peer_false += time && !c.truth[i] ? 1 : 0;
    }
    Row row{c.name, median(ours), {}, {}, "ns", 1, {}};
    if (!theirs.empty()) {
        row.peer = "FCL 0.7.0, cubic solver";
        row.theirs = median(theirs);
        row.counters["missed by the peer"] = peer_missed;
        row.counters["false hits of the peer"] = peer_false;
    }
    const auto count = static_cast<double>(c.pairs.size());
    double sum = 0;
    for (const double ns : ours)
        sum += ns;
    row.counters["pairs"] = count;
    row.counters["missed"] = missed;
    row.counters["false hits"] = false_hits;
    row.counters["% decided by the filter"] = 100 * decided[0] / count;
    row.counters["% decided by intervals"] = 100 * decided[1] / count;
    row.counters["% decided by integers"] = 100 * decided[2] / count;
    row.counters["ns, mean"] = sum / count;
    row.counters["ns, 90 %"] = quantile(ours, 0.9);
    row.counters["ns, 99 %"] = quantile(ours, 0.99);
    row.counters["ns, slowest"] = quantile(ours, 1);
    return row;
}

/// Many tests at once, on pairs whose swept boxes overlap, as a traversal would find them.
Row measure_many(ElementaryKind kind, double thickness, const CcdSuiteOptions& options) {
    const ElementaryOptions test{.thickness = thickness};
    PairMaker maker(options.seed + 1);
    std::vector<ElementaryPair> pairs;
    while (pairs.size() < 8 * options.pairs)
        if (const ElementaryPair pair = maker.near(kind); swept_boxes_overlap(pair))
            pairs.push_back(pair);
    std::array<double, 3> decided{};
    double hits = 0;
    for (const ElementaryImpact& impact : elementary_impacts(pairs, test)) {
        decided.at(static_cast<std::size_t>(impact.decided_by)) += 1;
        hits += impact.meet ? 1 : 0;
    }
    set_threads(1);
    const Turns turns = take_turns(
        pairs.size(), pairs.size(), options.rounds,
        [&](std::size_t, std::size_t) { elementary_impacts(pairs, test); },
        [&](std::size_t, std::size_t) {
            for (const ElementaryPair& pair : pairs)
                elementary_impact(pair, test);
        });
    set_threads(0);
    const auto count = static_cast<double>(pairs.size());
    Row row{fmt::format("candidates, {}{}, many at once", name_of(kind),
                        thickness > 0 ? fmt::format(", within {}", thickness) : ""),
            1e9 * turns.ours / count,
            "abut, one by one",
            1e9 * turns.theirs / count,
            "ns/pair",
            1,
            {}};
    row.counters["pairs"] = count;
    row.counters["% decided by the filter"] = 100 * decided[0] / count;
    row.counters["% decided by integers"] = 100 * decided[2] / count;
    row.counters["% hits"] = 100 * hits / count;
    return row;
}

CcdStep read_step(const std::string& start, const std::string& end) {
    return {std::filesystem::path(start).stem().string(), read_frame(start),
            read_frame(end).positions};
}

/// Measures elementary tests of continuous collision, by kind and truth, against FCL's cubic
/// solver, and whole steps of deforming surfaces, with other schemes compared with representative
/// triangles.
///
/// Errors      as read_elementary_queries and read_frame; Error{bad_argument} for an odd number of
///             frames.
Report run_ccd_suite(const CcdSuiteOptions& options) {
    Report report;
    report.suite = "ccd";
    report.notes.emplace_back("one test a call, one thread; a pair's time is the median of its "
                              "rounds, a row's the median of its pairs");
    for (const CcdCase& c : generated_cases(options))
        report.rows.push_back(measure_single(c, options));
    for (const CcdCase& c : file_cases(options.files))
        report.rows.push_back(measure_single(c, options));
    for (const auto kind : {ElementaryKind::vertex_face, ElementaryKind::edge_edge})
        for (const double thickness : {0.0, kThickness})
            report.rows.push_back(measure_many(kind, thickness, options));
    add_near_rows(report, options.rounds);
    add_contact_rows(report, options.rounds);
    if (options.frames.size() % 2 != 0)
        throw Error(ErrorCode::bad_argument, "frames come in pairs: start and end of a step");
    if (!options.frames.empty() || !options.scenes.empty())
        for (Row& row : calibration_rows(options.rounds))
            report.rows.push_back(std::move(row));
    for (std::size_t i = 0; i < options.frames.size(); i += 2)
        for (Row& row :
             ccd_step_rows(read_step(options.frames[i], options.frames[i + 1]), options.rounds))
            report.rows.push_back(std::move(row));
    for (const std::string& scene : options.scenes)
        for (Row& row : ccd_scene_rows(scene, options.samples, options.rounds))
            report.rows.push_back(std::move(row));
    return report;
}

const Suite kCcdSuite(
    "ccd", "Continuous collision: elementary tests against FCL, steps of deforming surfaces",
    [](CLI::App& suite) -> RunSuite {
        const auto options = std::make_shared<CcdSuiteOptions>();
        suite.add_option("files", options->files, "Files of queries (CSV)");
        suite.add_option("--frames", options->frames,
                         "Frames (PLY, OBJ): start and end of each step");
        suite.add_option("--scenes", options->scenes, "Deforming scenes (see abut scene)");
        suite.add_option("--samples", options->samples, "Frames of each scene that are measured")
            ->check(CLI::Range(1, 10000));
        suite.add_option("--pairs", options->pairs, "Generated pairs of each case")
            ->check(CLI::Range(1, 1000000));
        add_rounds(suite, options->rounds);
        suite.add_option("--seed", options->seed, "Of the generated pairs");
        return [options] { return run_ccd_suite(*options); };
    });

} // namespace

} // namespace abut::bench
