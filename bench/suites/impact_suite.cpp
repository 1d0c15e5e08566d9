#include <abut/error.h>
#include <abut/motion.h>
#include <abut/scene.h>

#include "measure.h"
#include "peers/peer_impact.h"
#include "suite.h"
#include "suites/long_motion_rows.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace abut::bench {

namespace {

struct ImpactSuiteOptions {
    std::vector<std::string> files; ///< first and second model of each pair
    bool is_long = false;           ///< also large bodies against small ones
    int motions = 200;
    int rounds = 3;
    std::uint64_t seed = 1;
    double peer_limit = 30; ///< seconds that the peer has for each row; 0: no peer
};

/// Moves the mesh to the origin, and scales it so that its bounding box has diagonal 1.
Mesh unit_diagonal(Mesh mesh) {
    const Box3 box = inspect(mesh).bounds;
    const Vec3 size{box.upper.x - box.lower.x, box.upper.y - box.lower.y,
                    box.upper.z - box.lower.z};
    const double scale = 1 / std::sqrt(size.x * size.x + size.y * size.y + size.z * size.z);
    for (Vec3& p : mesh.positions)
        p = {scale * (p.x - 0.5 * (box.lower.x + box.upper.x)),
             scale * (p.y - 0.5 * (box.lower.y + box.upper.y)),
             scale * (p.z - 0.5 * (box.lower.z + box.upper.z))};
    return mesh;
}

struct Ends {
    Pose from_a, to_a, from_b, to_b;
};

/// Random motions. Both bodies move by one diagonal, in opposite directions. At the end, b is
/// within a quarter of a diagonal of a along each axis. Each turns by `turn`.
class MotionMaker {
public:
    MotionMaker(std::uint64_t seed, double turn) : engine_(seed), turn_(turn) {}

    Ends make() {
        const auto [x, y, z] = direction();
        const Vec3 off{0.25 * uniform_(engine_), 0.25 * uniform_(engine_),
                       0.25 * uniform_(engine_)};
        Ends ends;
        rotate(ends.from_a, ends.to_a);
        rotate(ends.from_b, ends.to_b);
        ends.from_a.translation = {-x, -y, -z};
        ends.to_a.translation = {};
        ends.from_b.translation = {off.x + x, off.y + y, off.z + z};
        ends.to_b.translation = off;
        return ends;
    }

private:
    Vec3 direction() {
        const double x = normal_(engine_), y = normal_(engine_), z = normal_(engine_);
        const double length = std::sqrt(x * x + y * y + z * z);
        return {x / length, y / length, z / length};
    }
    void rotate(Pose& from, Pose& to) {
        for (double& q : from.rotation)
            q = normal_(engine_);
        const Vec3 axis = direction();
        const double w = std::cos(turn_ / 2), s = std::sin(turn_ / 2);
        const Vec3 v{s * axis.x, s * axis.y, s * axis.z};
        const auto& [fw, fx, fy, fz] = from.rotation;
        to.rotation = {
            w * fw - v.x * fx - v.y * fy - v.z * fz, w * fx + v.x * fw + v.y * fz - v.z * fy,
            w * fy + v.y * fw + v.z * fx - v.x * fz, w * fz + v.z * fw + v.x * fy - v.y * fx};
    }

    std::mt19937_64 engine_;
    std::normal_distribution<double> normal_;
    std::uniform_real_distribution<double> uniform_{-1, 1};
    double turn_;
};

struct Pair {
    std::string name;
    Mesh mesh_a, mesh_b;
};

/// Measures our query on every motion, and FCL's on as many as its time limit allows.
Row measure(const Pair& pair, const std::string& kind, double turn,
            const ImpactSuiteOptions& options) {
    const Model a(pair.mesh_a), b(pair.mesh_b);
    const auto fcl = options.peer_limit > 0 ? make_fcl_impact(pair.mesh_a, pair.mesh_b) : nullptr;
    MotionMaker motions(options.seed, turn);
    std::vector<double> ours, theirs;
    double hits = 0, undecided = 0, their_time = 0, missed = 0, late = 0, common = 0;
    Counters sum;
    for (int i = 0; i < options.motions; ++i) {
        const Ends ends = motions.make();
        const Motion motion_a = Motion::between(ends.from_a, ends.to_a),
                     motion_b = Motion::between(ends.from_b, ends.to_b);
        std::vector<double> rounds;
        Impact impact;
        for (int round = 0; round < options.rounds; ++round) {
            const double start = thread_seconds();
            impact = time_of_impact(a, motion_a, b, motion_b);
            rounds.push_back(thread_seconds() - start);
        }
        ours.push_back(median(rounds));
        hits += impact.meet ? 1 : 0;
        undecided += impact.status == Status::exact ? 0 : 1;
        sum.volume_tests += impact.counters.volume_tests;
        sum.primitive_tests += impact.counters.primitive_tests;
        if (!fcl || their_time > options.peer_limit)
            continue;
        const double start = thread_seconds();
        const auto time = fcl->time_of_impact(ends.from_a, ends.to_a, ends.from_b, ends.to_b);
        theirs.push_back(thread_seconds() - start);
        their_time += theirs.back();
        // What is proven is a contact no later than contact_time.
        if (impact.meet && impact.status == Status::exact) {
            common += 1;
            missed += time ? 0 : 1;
            late += time && *time > impact.contact_time ? 1 : 0;
        }
    }
    Row row{fmt::format("{}, {}", pair.name, kind), 1e3 * median(ours), {}, {}, "ms", 1, {}};
    if (!theirs.empty()) {
        row.peer = "FCL, conservative advancement";
        row.theirs = 1e3 * median(theirs);
        row.counters["motions that the peer had time for"] = static_cast<double>(theirs.size());
        row.counters["of them, with a proven hit"] = common;
        row.counters["of these, missed by the peer"] = missed;
        row.counters["of these, late in the peer"] = late;
    }
    std::sort(ours.begin(), ours.end());
    row.counters["ms, 90 % of the motions"] = 1e3 * ours[ours.size() * 9 / 10];
    row.counters["ms, slowest"] = 1e3 * ours.back();
    row.counters["motions"] = options.motions;
    row.counters["hits"] = hits;
    row.counters["undecided"] = undecided;
    row.counters["volume tests a motion"] = static_cast<double>(sum.volume_tests) / options.motions;
    row.counters["triangle tests a motion"] =
        static_cast<double>(sum.primitive_tests) / options.motions;
    return row;
}

/// Measures times of impact of random motions that let two models cross, against FCL's conservative
/// advancement.
///
/// Errors      as read_scene; Error{bad_argument} for an odd number of files.
Report run_impact_suite(const ImpactSuiteOptions& options) {
    if (options.files.size() % 2 != 0 || (options.files.empty() && !options.is_long))
        throw Error(ErrorCode::bad_argument, "impact: takes pairs of files, or --long");
    Report report;
    report.suite = "impact";
    report.notes.emplace_back("unit diagonals, each moved by one in opposite directions; thread "
                              "time; straight, and turning by a quarter each");
    for (std::size_t i = 0; i < options.files.size(); i += 2) {
        const auto stem = [&](std::size_t k) {
            return std::filesystem::path(options.files[k]).stem().string();
        };
        const Pair pair{stem(i) + " / " + stem(i + 1), unit_diagonal(read_mesh(options.files[i])),
                        unit_diagonal(read_mesh(options.files[i + 1]))};
        report.rows.push_back(measure(pair, "straight", 0, options));
        report.rows.push_back(measure(pair, "turning", 0.5 * std::numbers::pi, options));
    }
    if (options.is_long)
        for (Row& row : long_motion_rows(options.rounds))
            report.rows.push_back(std::move(row));
    return report;
}

const Suite kImpactSuite(
    "impact", "Time of impact of models that cross each other, against FCL",
    [](CLI::App& suite) -> RunSuite {
        const auto options = std::make_shared<ImpactSuiteOptions>();
        suite.add_option("files", options->files, "Pairs of model files");
        suite.add_flag("--long", options->is_long,
                       "Also large bodies that turn against small ones, slide and nest");
        suite.add_option("--motions", options->motions, "Random motions a row")
            ->check(CLI::Range(1, 1000000));
        add_rounds(suite, options->rounds);
        suite.add_option("--seed", options->seed, "Of the motions");
        suite.add_option("--peer-limit", options->peer_limit, "Seconds a row; 0 leaves FCL out")
            ->check(CLI::NonNegativeNumber);
        return [options] { return run_impact_suite(*options); };
    });

} // namespace

} // namespace abut::bench
