#include <abut/error.h>
#include <abut/model.h>
#include <abut/rigid.h>
#include <abut/scene.h>

#include "measure.h"
#include "peers/peer_rigid.h"
#include "scenes/bodies.h"
#include "suite.h"
#include "suites/far_apart_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace abut::bench {

namespace {

struct RigidSuiteOptions {
    std::vector<std::string> files; ///< two for each pair
    /// Triangles of each model of a generated pair; 100,000 and 1,000,000 if nothing is given.
    std::vector<std::uint32_t> generated;
    std::size_t poses = 500; ///< in each regime
    int rounds = 3;
    bool alone = false;     ///< without peers
    bool far_apart = false; ///< in place of the models: two plates that face each other
    bool volumes = false;   ///< also with every other kind of bounding volume, and with some mixed
    std::string only;       ///< runs only the cases whose name contains this
    std::uint64_t seed = 1;
};

constexpr double kNear = 0.005, kFar = 0.1; ///< tolerances, in diagonals
/// Time to try each of FCL's volumes for a case: with some, a pose takes seconds.
constexpr double kSampleSeconds = 2;

double sum(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

struct RigidCase {
    const char* name = "";
    RigidQuery query = RigidQuery::first_contact;
    Regime regime = Regime::deep;
    double tolerance = 0;
};
constexpr std::array kRigidCases{
    RigidCase{"first contact, deep", RigidQuery::first_contact, Regime::deep},
    RigidCase{"first contact, graze in", RigidQuery::first_contact, Regime::graze_in},
    RigidCase{"first contact, graze out", RigidQuery::first_contact, Regime::graze_out},
    RigidCase{"all contacts, deep", RigidQuery::all_contacts, Regime::deep},
    RigidCase{"all contacts, graze in", RigidQuery::all_contacts, Regime::graze_in},
    RigidCase{"distance, graze out", RigidQuery::distance, Regime::graze_out},
    RigidCase{"distance, separated", RigidQuery::distance, Regime::separated},
    RigidCase{"distance, coherent path", RigidQuery::distance, Regime::path},
    RigidCase{"within 0.005, graze out", RigidQuery::within, Regime::graze_out, kNear},
    RigidCase{"within 0.1, graze out", RigidQuery::within, Regime::graze_out, kFar},
    RigidCase{"within 0.1, separated", RigidQuery::within, Regime::separated, kFar},
};

/// Kinds of two models: a few of the swept spheres, and two that only boxes can compare.
constexpr std::array kMixedKinds{
    std::array{Volume::sphere, Volume::rss}, std::array{Volume::lss, Volume::rss},
    std::array{Volume::ssv, Volume::rss}, std::array{Volume::obb, Volume::rss}};

/// The times of each pose, and their median over the rounds.
class PoseTimes {
public:
    explicit PoseTimes(std::size_t poses) : seconds_(poses) {}
    void add(std::size_t pose, double seconds) { seconds_[pose].push_back(seconds); }
    [[nodiscard]] double median_us() const {
        std::vector<double> each;
        for (const auto& rounds : seconds_)
            each.push_back(median(rounds));
        return 1e6 * median(each);
    }

private:
    std::vector<std::vector<double>> seconds_;
};

struct Answer {
    double value = 0;
    Counters counters;
};

class RigidSuite {
public:
    /// In: alone, to leave out the peers when kinds of volumes are compared with each other.
    RigidSuite(const RigidSuiteOptions& options, const RigidScene& scene, Report& report,
               std::array<Volume, 2> kinds, bool alone)
        : options_(options), scene_(scene), report_(report), kinds_(kinds),
          a_(scene.a, {.volume = kinds[0]}), b_(scene.b, {.volume = kinds[1]}) {
        if (alone)
            return;
        peers_ = make_fcl_peers(scene.a, scene.b);
        fcl_ = peers_.size();
        if (auto cgal = make_cgal_peer(scene.a, scene.b))
            peers_.push_back(std::move(cgal));
        if (auto embree = make_embree_peer(scene.a, scene.b))
            peers_.push_back(std::move(embree));
    }

    void run() {
        for (const RigidCase& c : kRigidCases)
            if (options_.only.empty() ||
                std::string_view(c.name).find(options_.only) != std::string_view::npos)
                run(c);
    }

private:
    Answer ours(const RigidCase& c, const PosedPair& poses, WarmStart* warm_start) {
        switch (c.query) {
        case RigidQuery::first_contact:
        case RigidQuery::all_contacts: {
            const auto mode =
                c.query == RigidQuery::all_contacts ? ContactMode::all : ContactMode::first;
            const Contacts contacts = collide(a_, poses.a, b_, poses.b, {.mode = mode});
            return {static_cast<double>(contacts.pairs.size()), contacts.counters};
        }
        case RigidQuery::distance: {
            const Gap gap = distance(a_, poses.a, b_, poses.b, {.warm_start = warm_start});
            return {gap.distance, gap.counters};
        }
        default:
            return {within(a_, poses.a, b_, poses.b, c.tolerance) ? 1.0 : 0.0, {}};
        }
    }

    /// FCL's fastest volume for the case, on a sample of the poses.
    RigidPeer* best_fcl(const RigidCase& c) {
        RigidPeer* best = nullptr;
        double least = 0;
        std::string line = fmt::format("{}, {}: FCL on a sample, us:", scene_.name, c.name);
        const auto& poses = scene_.of(c.regime);
        for (std::size_t i = 0; i < fcl_; ++i) {
            RigidPeer& peer = *peers_[i];
            if (!peer.answers(c.query))
                continue;
            std::vector<double> seconds;
            const std::size_t sample = std::min<std::size_t>(poses.size(), 25);
            for (std::size_t k = 0; k < sample && sum(seconds) < kSampleSeconds; ++k) {
                const PosedPair& posed = poses[k * poses.size() / sample];
                peer.place(posed);
                const double start = wall_seconds();
                peer.run(c.query, posed, c.tolerance);
                seconds.push_back(wall_seconds() - start);
            }
            const double us = 1e6 * median(seconds);
            line += fmt::format(" {} {:.3g}", peer.name(), us);
            if (best == nullptr || us < least)
                best = &peer, least = us;
        }
        if (best != nullptr)
            report_.notes.push_back(line);
        return best;
    }

    void run(const RigidCase& c) {
        std::vector<RigidPeer*> opponents;
        if (RigidPeer* fcl = best_fcl(c))
            opponents.push_back(fcl);
        for (std::size_t i = fcl_; i < peers_.size(); ++i)
            if (peers_[i]->answers(c.query))
                opponents.push_back(peers_[i].get());
        if (opponents.empty())
            opponents.push_back(nullptr);
        for (RigidPeer* peer : opponents)
            compare(c, peer);
    }

    void compare(const RigidCase& c, RigidPeer* peer) {
        const auto& poses = scene_.of(c.regime);
        PoseTimes our_times(poses.size()), their_times(poses.size());
        std::vector<Answer> our_answers(poses.size());
        std::vector<double> their_answers(poses.size());
        // Takes turns, some poses each. Either side then has its own data in the caches, as a user
        // would.
        constexpr std::size_t kBatch = kPathSteps;
        for (int round = 0; round < options_.rounds; ++round)
            for (std::size_t first = 0; first < poses.size(); first += kBatch) {
                const std::size_t end = std::min(first + kBatch, poses.size());
                WarmStart warm_start;
                for (std::size_t i = first; i < end; ++i) {
                    const double start = wall_seconds();
                    our_answers[i] =
                        ours(c, poses[i], c.regime == Regime::path ? &warm_start : nullptr);
                    our_times.add(i, wall_seconds() - start - clock_);
                }
                for (std::size_t i = first; i < end && peer != nullptr; ++i) {
                    peer->place(poses[i]);
                    const double start = wall_seconds();
                    their_answers[i] = peer->run(c.query, poses[i], c.tolerance);
                    their_times.add(i, wall_seconds() - start - clock_);
                }
            }

        std::string volume;
        if (kinds_[0] != kinds_[1])
            volume = fmt::format(", {} with {}", to_string(kinds_[0]), to_string(kinds_[1]));
        else if (kinds_[0] != Volume::automatic)
            volume = fmt::format(", {}", to_string(kinds_[0]));
        Row row{scene_.name + ", " + c.name + volume, our_times.median_us(), {}, {}, "us", 1, {}};
        if (peer != nullptr)
            row.peer = peer->name(), row.theirs = their_times.median_us();
        std::vector<double> volumes, primitives, values;
        for (const Answer& answer : our_answers) {
            volumes.push_back(static_cast<double>(answer.counters.volume_tests));
            primitives.push_back(static_cast<double>(answer.counters.primitive_tests));
            values.push_back(answer.value);
        }
        row.counters["volume tests"] = median(volumes);
        row.counters["triangle tests"] = median(primitives);
        row.counters["answer"] = median(values);
        if (peer != nullptr && peer->name().starts_with("FCL"))
            row.counters["disagreements"] =
                static_cast<double>(count_disagreements(c, our_answers, their_answers));
        report_.rows.push_back(row);
    }

    /// Counts disagreements. FCL is not exact: contacts may differ if triangles almost touch.
    /// Distances should not differ.
    static std::size_t count_disagreements(const RigidCase& c, const std::vector<Answer>& ours,
                                           const std::vector<double>& theirs) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < ours.size(); ++i)
            count +=
                std::abs(ours[i].value - theirs[i]) > (c.query == RigidQuery::distance ? 1e-12 : 0);
        return count;
    }

    const RigidSuiteOptions& options_;
    const RigidScene& scene_;
    Report& report_;
    std::array<Volume, 2> kinds_; ///< of both models
    Model a_, b_;
    std::vector<std::unique_ptr<RigidPeer>> peers_;
    /// Subtracted from each time: the shortest queries take no longer than reading the clock.
    double clock_ = clock_seconds();
    std::size_t fcl_ = 0; ///< the number of peers that are FCL; they come first
};

/// Measures the build. Compares it with the peers only if the volume is chosen automatically.
void run_build(const std::string& name, const Mesh& mesh, int rounds, Volume volume,
               Report& report) {
    const bool alone = volume != Volume::automatic;
    set_threads(1);
    std::vector<double> ours, embree, fcl;
    std::size_t bytes = 0;
    double fcl_bytes = 0;
    for (int round = 0; round < rounds; ++round) {
        Mesh copy = mesh;
        const double start = thread_seconds();
        const Model model(std::move(copy), {.volume = volume});
        ours.push_back(1e3 * (thread_seconds() - start));
        bytes = model.bytes();
        if (alone)
            continue;
        if (const auto seconds = embree_build_seconds(mesh))
            embree.push_back(1e3 * *seconds);
        if (round < 1)
            if (const auto built = fcl_build(mesh))
                fcl.push_back(1e3 * built->seconds), fcl_bytes = built->bytes;
    }
    set_threads(0);
    const auto triangles = static_cast<double>(mesh.triangles.size());
    Row row{fmt::format("{} ({} triangles), build{}", name, mesh.triangles.size(),
                        alone ? fmt::format(", {}", to_string(volume)) : ""),
            median(ours),
            {},
            {},
            "ms",
            1,
            {}};
    row.counters["bytes a triangle"] = static_cast<double>(bytes) / triangles;
    if (!embree.empty()) {
        row.peer = "Embree 3, medium", row.theirs = median(embree);
        report.rows.push_back(row);
    }
    if (!fcl.empty()) {
        row.peer = "FCL OBBRSS", row.theirs = median(fcl);
        if (fcl_bytes > 0)
            row.counters["FCL's bytes a triangle"] = fcl_bytes / triangles;
    }
    if (!fcl.empty() || embree.empty())
        report.rows.push_back(row);
}

/// Measures collide, distance and within on pairs of models, and their build, against FCL, CGAL and
/// Embree.
///
/// Errors      as read_mesh; Error{bad_argument} for an odd number of files.
Report run_rigid_suite(const RigidSuiteOptions& options) {
    if (options.files.size() % 2 != 0)
        throw Error(ErrorCode::bad_argument, "an odd number of files: they come in pairs");
    Report report;
    report.suite = "rigid";
    if (options.far_apart) {
        add_far_apart_rows(options.rounds, options.alone, report);
        return report;
    }
    const auto run = [&](const std::string& name_a, Mesh a, const std::string& name_b, Mesh b) {
        const RigidScene scene = make_rigid_scene(name_a + " / " + name_b, std::move(a),
                                                  std::move(b), options.poses, options.seed);
        if (options.only.empty() || options.only == "build") {
            run_build(name_a, scene.a, options.rounds, Volume::automatic, report);
            run_build(name_b, scene.b, options.rounds, Volume::automatic, report);
        }
        RigidSuite(options, scene, report, {Volume::automatic, Volume::automatic}, options.alone)
            .run();
        if (!options.volumes)
            return;
        for (const Volume volume : kVolumes) {
            if (volume == Volume::automatic)
                continue;
            if (options.only.empty() || options.only == "build")
                run_build(name_a, scene.a, 1, volume, report);
            RigidSuite(options, scene, report, {volume, volume}, true).run();
        }
        for (const auto& kinds : kMixedKinds)
            RigidSuite(options, scene, report, kinds, true).run();
    };
    const auto stem = [](const std::string& file) {
        return std::filesystem::path(file).stem().string();
    };
    for (std::size_t i = 0; i + 1 < options.files.size(); i += 2)
        run(stem(options.files[i]), read_mesh(options.files[i]), stem(options.files[i + 1]),
            read_mesh(options.files[i + 1]));
    std::vector<std::uint32_t> generated = options.generated;
    if (options.files.empty() && generated.empty())
        generated = {100000, 1000000};
    for (const std::uint32_t triangles : generated)
        run(fmt::format("boulder {}k", triangles / 1000), scenes::boulder(triangles),
            fmt::format("knot {}k", triangles / 1000), scenes::knot(triangles));
    return report;
}

const Suite
    kRigidSuite("rigid", "Queries on pairs of models in four regimes, against FCL, CGAL and Embree",
                [](CLI::App& suite) -> RunSuite {
                    const auto options = std::make_shared<RigidSuiteOptions>();
                    suite.add_option("files", options->files, "Model files, two a pair");
                    suite.add_option("--generated", options->generated,
                                     "Pairs of generated models of so many triangles each");
                    suite.add_option("--poses", options->poses, "In each regime");
                    add_rounds(suite, options->rounds);
                    add_only(suite, options->only);
                    suite.add_flag("--alone", options->alone, "Without peers");
                    suite.add_flag("--far-apart", options->far_apart,
                                   "In place of models: two plates, 1 to 10,000 m apart");
                    suite.add_flag("--volumes", options->volumes,
                                   "Also with every kind of bounding volume, and with mixed ones");
                    suite.add_option("--seed", options->seed, "Of the poses");
                    return [options] { return run_rigid_suite(*options); };
                });

} // namespace

} // namespace abut::bench
