#include <abut/clash.h>
#include <abut/error.h>
#include <abut/model.h>
#include <abut/rigid.h>
#include <abut/scene.h>

#include "measure.h"
#include "peers/peer_fcl.h"
#include "suite.h"
#include "suites/clash_scene.h"
#include "suites/hard_pair_rows.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <fmt/format.h>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace abut::bench {

namespace {

struct ClashSuiteOptions {
    ClashSceneOptions scene;
    std::string part_file;   ///< empty: the bent pipe
    double clearance = 0.05; ///< in diagonals of the part
    int rounds = 5;
    int threads = 2;                ///< of the rows that use more than one
    double job_limit = 120;         ///< seconds after which the whole job is stopped
    std::vector<std::string> files; ///< if given: only the hard pairs between these models
};

constexpr std::size_t kBatch = 2048; ///< candidates that one side processes before the other's turn
constexpr std::size_t kListed = 10;  ///< number of disagreements listed in the notes

/// Sets a flag after some seconds, unless it is destroyed before.
class Alarm {
public:
    Alarm(double seconds, std::atomic<bool>& flag)
        : thread_([this, seconds, &flag](const std::stop_token& cancelled) {
              std::unique_lock lock(mutex_);
              if (!wake_.wait_for(lock, cancelled, std::chrono::duration<double>(seconds),
                                  [] { return false; }) &&
                  !cancelled.stop_requested())
                  flag = true;
          }) {}

private:
    std::mutex mutex_;
    std::condition_variable_any wake_;
    std::jthread thread_;
};

class ClashSuite {
public:
    explicit ClashSuite(const ClashSuiteOptions& options)
        : options_(options),
          scene_(options.part_file.empty()
                     ? make_clash_scene(options.scene)
                     : make_clash_scene(options.scene, read_mesh(options.part_file))),
          model_(scene_.part), fcl_(make_fcl_instances(scene_, options.clearance)) {
        report_.suite = "clash";
        report_.notes.push_back(fmt::format("{} instances of {} triangles, {} candidate pairs",
                                            scene_.placements.size(), scene_.part.triangles.size(),
                                            scene_.candidates.size()));
        if (fcl_)
            for (const std::string& line : fcl_->choice())
                report_.notes.push_back(line);
        else
            report_.notes.emplace_back("built without FCL (package libfcl-dev): no peer");
    }

    Report run() && {
        intersection();
        clearance();
        if (options_.job_limit > 0)
            whole_job();
        return std::move(report_);
    }

private:
    void collide_all(std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto& [a, b] = scene_.candidates[i];
            const Contacts contacts = collide(model_, scene_.placements[a], model_,
                                              scene_.placements[b], {.mode = ContactMode::first});
            ours_[i] = contacts.meet() ? 0 : 1;
            counters_[i] = contacts.counters;
        }
    }

    void measure_all(std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto& [a, b] = scene_.candidates[i];
            const Gap gap = distance(model_, scene_.placements[a], model_, scene_.placements[b],
                                     {.upper_bound = options_.clearance});
            ours_[i] = gap.distance;
            counters_[i] = gap.counters;
        }
    }

    void start_case() {
        ours_.assign(scene_.candidates.size(), 0);
        theirs_.assign(scene_.candidates.size(), 0);
        counters_.assign(scene_.candidates.size(), {});
    }

    [[nodiscard]] double pairs() const { return static_cast<double>(scene_.candidates.size()); }

    /// Measures both sides on one thread, then ours on one thread and on several.
    Row& compare(const std::string& name, const Work& ours, const Work& theirs,
                 const std::string& peer) {
        const double microseconds = 1e6 / pairs();
        const Turns turns = take_turns(scene_.candidates.size(), kBatch, options_.rounds, ours,
                                       fcl_ ? theirs : Work{});
        Row row{name, turns.ours * microseconds, {}, {}, "us/pair", 1, {}};
        if (fcl_)
            row.peer = peer, row.theirs = turns.theirs * microseconds;
        Counters sum;
        for (const Counters& c : counters_) {
            sum.volume_tests += c.volume_tests;
            sum.primitive_tests += c.primitive_tests;
            sum.exact_tests += c.exact_tests;
        }
        row.counters["candidates"] = pairs();
        row.counters["volume tests a pair"] = static_cast<double>(sum.volume_tests) / pairs();
        row.counters["triangle tests a pair"] = static_cast<double>(sum.primitive_tests) / pairs();
        row.counters["exact signs"] = static_cast<double>(sum.exact_tests);

        const auto on = [&](int threads) {
            on_threads(threads, scene_.candidates.size(), 256, ours);
        };
        std::vector<double> cores;
        const Turns threads = take_turns(
            options_.rounds,
            [&] {
                const double cpu = process_seconds(), wall = wall_seconds();
                on(options_.threads);
                cores.push_back((process_seconds() - cpu) / (wall_seconds() - wall));
            },
            [&] { on(1); });
        const std::size_t index = report_.rows.size();
        report_.rows.push_back(row);
        Row many{name + ", threads",
                 threads.ours * microseconds,
                 "abut, 1 thread (wall)",
                 threads.theirs * microseconds,
                 "us/pair",
                 options_.threads,
                 {}};
        // If this is less than the number of threads, other processes used the rest.
        many.counters["cores that the machine gave"] = median(cores);
        report_.rows.push_back(many);
        return report_.rows[index];
    }

    /// Counts the pairs for which the two sides disagree. FCL is not exact, so some may.
    void count_disagreements(Row& row, double tolerance) {
        if (!fcl_)
            return;
        std::size_t count = 0;
        for (std::size_t i = 0; i < ours_.size(); ++i) {
            if (std::abs(ours_[i] - theirs_[i]) <= tolerance)
                continue;
            if (++count > kListed)
                continue;
            const auto& [a, b] = scene_.candidates[i];
            const Gap gap = distance(model_, scene_.placements[a], model_, scene_.placements[b]);
            report_.notes.push_back(
                fmt::format("{}: instances {} and {}: ours {}, theirs {}; our distance {:.17g}",
                            row.name, a, b, ours_[i], theirs_[i], gap.distance));
        }
        row.counters["disagreements"] = static_cast<double>(count);
    }

    void intersection() {
        start_case();
        Row& row = compare(
            "intersection", [&](auto begin, auto end) { collide_all(begin, end); },
            [&](auto begin, auto end) {
                for (std::size_t i = begin; i < end; ++i) {
                    const auto& [a, b] = scene_.candidates[i];
                    theirs_[i] = fcl_->collide(a, b) ? 0 : 1;
                }
            },
            fcl_ ? fcl_->collide_name() : "");
        row.counters["intersecting"] =
            static_cast<double>(std::count(ours_.begin(), ours_.end(), 0.0));
        count_disagreements(row, 0);
    }

    void clearance() {
        start_case();
        Row& row = compare(
            "clearance", [&](auto begin, auto end) { measure_all(begin, end); },
            [&](auto begin, auto end) {
                for (std::size_t i = begin; i < end; ++i) {
                    const auto& [a, b] = scene_.candidates[i];
                    theirs_[i] = fcl_->distance(a, b, options_.clearance);
                }
            },
            fcl_ ? fcl_->distance_name() : "");
        row.counters["intersecting"] =
            static_cast<double>(std::count(ours_.begin(), ours_.end(), 0.0));
        row.counters["within the clearance"] = static_cast<double>(std::count_if(
            ours_.begin(), ours_.end(), [&](double d) { return d > 0 && d < options_.clearance; }));
        // Both compute in double; coordinates are of the size of the scene, about 10.
        count_disagreements(row, 1e-12);
    }

    void whole_job() {
        std::vector<Scene> models(1);
        models[0].file = "grid";
        models[0].meshes.push_back(scene_.part);
        for (std::size_t i = 0; i < scene_.placements.size(); ++i) {
            const std::string id = fmt::format("part {}", i);
            models[0].parts.push_back({id, id, {}, 0, scene_.placements[i]});
        }
        set_threads(options_.threads);
        std::atomic<double> done = 0;
        std::optional<ClashReport> found;
        {
            std::atomic<bool> stop = false;
            const Alarm alarm(options_.job_limit, stop);
            ClashOptions clash;
            clash.clearance = options_.clearance;
            clash.progress.stop = &stop;
            clash.progress.report = [&](std::string_view /*stage*/, double share) { done = share; };
            try {
                found = find_clashes(models, clash);
            } catch (const Error& error) {
                if (error.code() != ErrorCode::interrupted)
                    throw;
            }
        }
        set_threads(0);
        if (!found) {
            report_.notes.push_back(
                fmt::format("find_clashes: stopped after {} s with {:.1f} % of its last stage done",
                            options_.job_limit, 100 * done));
            return;
        }
        Row row{"find_clashes", found->seconds.total, {}, {}, "s", options_.threads, {}};
        row.counters["candidates"] = static_cast<double>(found->candidates);
        row.counters["seconds build"] = found->seconds.build;
        row.counters["seconds broad"] = found->seconds.broad;
        row.counters["seconds narrow"] = found->seconds.narrow;
        for (const ClashKind kind : kClashKinds)
            row.counters[to_string(kind)] =
                static_cast<double>(found->counts[static_cast<std::size_t>(kind)]);
        report_.rows.push_back(row);
    }

    ClashSuiteOptions options_;
    ClashScene scene_;
    Model model_;
    std::unique_ptr<FclInstances> fcl_;
    Report report_;
    /// For each candidate. Intersection: 0 if they meet, else 1. Clearance: the bounded distance.
    std::vector<double> ours_, theirs_;
    std::vector<Counters> counters_;
};

/// Measures intersection and clearance of all candidate pairs against FCL, then the whole clash
/// job.
Report run_clash_suite(const ClashSuiteOptions& options) {
    if (!options.files.empty()) {
        Report report;
        report.suite = "clash";
        add_hard_pair_rows(options.files, options.rounds, report);
        return report;
    }
    return ClashSuite(options).run();
}

const Suite kClashSuite(
    "clash", "2,000 instances of one part of 20,000 triangles: contact and clearance, against FCL",
    [](CLI::App& suite) -> RunSuite {
        const auto options = std::make_shared<ClashSuiteOptions>();
        suite.add_option("--instances", options->scene.instances, "Number of instances");
        suite.add_option("--spacing", options->scene.spacing, "Of the grid, in diagonals");
        suite.add_option("--bend", options->scene.bend, "Angle of the part's bend, radians");
        suite.add_option("--tube", options->scene.tube, "Radius of its tube, in radii of the bend");
        suite.add_flag_callback(
            "--tight", [options] { options->scene.boxes = CandidateBoxes::tight; },
            "Candidates by the placed parts' own boxes, not by boxes for any rotation");
        suite.add_option("--seed", options->scene.seed, "Of jitter and rotations");
        suite.add_option("--part", options->part_file,
                         "Model file to use instead of the bent pipe");
        suite.add_option("--files", options->files,
                         "Measure only the hard pairs between these model files: their depths and "
                         "volumes against the bare questions");
        suite.add_option("--clearance", options->clearance, "In diagonals of the part")
            ->check(CLI::PositiveNumber);
        add_rounds(suite, options->rounds);
        suite.add_option("--threads", options->threads, "Of the rows with several threads")
            ->check(CLI::Range(1, 1024));
        suite.add_option("--job-limit", options->job_limit, "Seconds; 0 leaves the whole job out")
            ->check(CLI::NonNegativeNumber);
        return [options] { return run_clash_suite(*options); };
    });

} // namespace

} // namespace abut::bench
