#include <abut/broad_phase.h>
#include <abut/progress.h>

#include "measure.h"
#include "peers/peer_boxes.h"
#include "suite.h"
#include "suites/box_scene.h"
#include "suites/curved_rows.h"
#include "suites/flight_rows.h"
#include "suites/rest_rows.h"
#include "suites/schedule_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace abut::bench {

namespace {

struct WorldSuiteOptions {
    std::vector<std::size_t> counts{1000, 10000, 100000, 1000000};
    int steps = 20;        ///< at least, for each case
    bool alone = false;    ///< without peers
    bool methods = false;  ///< also each broad phase by itself
    std::string only;      ///< runs only the cases whose name contains this
    double peer_limit = 4; ///< approximate seconds per step beyond which a peer is left out
    std::uint64_t seed = 1;
};

struct Layout {
    BoxLayout layout;
    const char* name;
};
constexpr std::array kLayouts{Layout{BoxLayout::uniform, "uniform"},
                              Layout{BoxLayout::clustered, "clustered"},
                              Layout{BoxLayout::spanned, "uniform and one around the world"},
                              Layout{BoxLayout::crossed, "uniform and a hundred around the world"},
                              Layout{BoxLayout::planes, "on ten floors"},
                              Layout{BoxLayout::sizes, "of many sizes"},
                              Layout{BoxLayout::piles, "in piles"},
                              Layout{BoxLayout::heap, "in a heap"}};

struct MotionName {
    BoxMotion motion;
    const char* name;
};
constexpr std::array kMotions{
    MotionName{BoxMotion::coherent, "coherent"}, MotionName{BoxMotion::teleport, "teleport"},
    MotionName{BoxMotion::bursts, "bursts"}, MotionName{BoxMotion::resets, "resets"}};
/// With more boxes than this, the pairs of a hundred boxes around the world do not fit into memory.
constexpr std::size_t kMostCrossed = 200'000;

/// Whether a motion is measured for a layout: all motions for the uniform layout, two for the
/// others.
bool is_measured(BoxLayout layout, BoxMotion motion, std::size_t count) {
    if (layout == BoxLayout::crossed && count > kMostCrossed)
        return false;
    return layout == BoxLayout::uniform || motion == BoxMotion::coherent ||
           motion == BoxMotion::teleport;
}

std::vector<MakeBoxPeer> all_peers() {
    std::vector<MakeBoxPeer> peers;
    for (const auto& some :
         {bullet_box_peers(), cgal_box_peers(), embree_box_peers(), fcl_box_peers()})
        peers.insert(peers.end(), some.begin(), some.end());
    return peers;
}

/// The mean rather than the median, because some peers defer work to later steps.
double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values)
        sum += value;
    return sum / static_cast<double>(std::max<std::size_t>(values.size(), 1));
}

/// The times of one broad phase.
struct Times {
    std::string name;
    std::size_t pairs = 0; ///< in the last step
    std::vector<double> seconds{};
};

/// The time that a peer took last, and an estimate of its time for more boxes. For some peers the
/// time grows with the square of their number, for others little more than linearly.
struct Experience {
    std::size_t boxes = 0;
    double seconds = 0;
    [[nodiscard]] double expected(std::size_t count) const {
        return seconds * std::pow(static_cast<double>(count) / static_cast<double>(boxes), 1.25);
    }
};
/// Inserting all boxes is taken to be worth this many steps.
constexpr double kStepsOfBuild = 5;

class WorldSuite {
public:
    explicit WorldSuite(const WorldSuiteOptions& options) : options_(options) {
        report_.suite = "world";
        report_.notes.push_back("ms a step with all pairs, and what begins and ends for ours; "
                                "processor time, one thread; 'theirs' is the fastest peer's");
    }

    Report run() && {
        set_threads(1);
        for (const Layout& layout : kLayouts)
            for (const MotionName& motion : kMotions)
                for (const std::size_t count : options_.counts) {
                    const std::string name =
                        fmt::format("{} {}, {}", count, layout.name, motion.name);
                    if (is_measured(layout.layout, motion.motion, count) &&
                        name.find(options_.only) != std::string::npos)
                        run_case(name, layout.layout, motion.motion, count);
                }
        if (options_.only.empty() || options_.only == "flight")
            add_flight_rows(report_, 1000, options_.seed);
        if (options_.only.empty() || options_.only == "deformable")
            add_refresh_row(report_, 60);
        if (options_.only.empty() || options_.only == "curved")
            add_curved_rows(report_, 1000, options_.seed);
        if (options_.only.empty() || options_.only == "schedule")
            add_schedule_rows(report_, options_.seed);
        set_threads(0);
        return std::move(report_);
    }

private:
    void run_case(const std::string& name, BoxLayout layout, BoxMotion motion, std::size_t count) {
        BoxScene scene(layout, count, options_.seed);
        std::vector<BroadPhaseMethod> methods{BroadPhaseMethod::automatic};
        if (options_.methods)
            methods = {BroadPhaseMethod::automatic, BroadPhaseMethod::tree, BroadPhaseMethod::sweep,
                       BroadPhaseMethod::sweep_and_prune};
        std::vector<BroadPhase> phases;
        std::vector<Times> ours;
        for (const BroadPhaseMethod method : methods) {
            phases.emplace_back(BroadPhaseOptions{method, {}});
            phases.back().update(scene.boxes());
            ours.push_back({to_string(method)});
        }
        std::vector<std::unique_ptr<BoxPeer>> peers;
        std::vector<Times> theirs;
        if (!options_.alone)
            for (const MakeBoxPeer make : all_peers())
                add_peer(make, scene, motion, peers, theirs);
        const int steps = steps_of(count);
        for (int step = -1; step < steps; ++step) { // one step to warm up
            scene.step(motion);
            for (std::size_t i = 0; i < phases.size(); ++i)
                time_step(step, ours[i], [&] {
                    phases[i].update(scene.boxes());
                    return phases[i].pairs().size();
                });
            for (std::size_t i = 0; i < peers.size(); ++i)
                time_step(step, theirs[i], [&] { return peers[i]->step(scene.boxes()); });
        }
        for (const Times& peer : theirs) {
            Experience& last = last_[{peer.name, motion}];
            last.seconds = std::max(last.seconds, mean(peer.seconds));
        }
        add_rows(name, count, ours, theirs);
    }

    /// Fewer boxes get more steps, because their steps are short.
    [[nodiscard]] int steps_of(std::size_t count) const {
        return std::max(options_.steps, static_cast<int>(50'000 / std::max<std::size_t>(count, 1)));
    }

    /// Adds a peer, unless its times with fewer boxes show that it would be too slow.
    void add_peer(MakeBoxPeer make, const BoxScene& scene, BoxMotion motion,
                  std::vector<std::unique_ptr<BoxPeer>>& peers, std::vector<Times>& theirs) {
        const std::string name = make(std::span<const Box3>())->name();
        const std::size_t count = scene.boxes().size();
        for (const BoxMotion pattern : {BoxMotion::coherent, motion}) {
            const auto last = last_.find({name, pattern});
            if (last != last_.end() && last->second.expected(count) > options_.peer_limit)
                return;
        }
        const double start = process_seconds();
        peers.push_back(make(scene.boxes()));
        peers.back()->step(scene.boxes());
        theirs.push_back({name});
        Experience& built = last_[{name, motion}];
        built = {count, (process_seconds() - start) / kStepsOfBuild};
    }

    template <typename Step>
    static void time_step(int step, Times& times, const Step& work) {
        const double start = process_seconds();
        times.pairs = work();
        if (step >= 0)
            times.seconds.push_back(process_seconds() - start);
    }

    void add_rows(const std::string& name, std::size_t count, const std::vector<Times>& ours,
                  const std::vector<Times>& theirs) {
        const Times* best = nullptr;
        for (const Times& peer : theirs)
            if (best == nullptr || mean(peer.seconds) < mean(best->seconds))
                best = &peer;
        for (const Times& our : ours) {
            Row row{ours.size() > 1 ? name + ", " + our.name : name,
                    1e3 * mean(our.seconds),
                    {},
                    {},
                    "ms/step",
                    1,
                    {}};
            row.counters["pairs a box"] =
                static_cast<double>(our.pairs) / static_cast<double>(count);
            if (best != nullptr) {
                row.peer = best->name;
                row.theirs = 1e3 * mean(best->seconds);
            }
            for (const Times& peer : theirs) {
                row.counters[peer.name + ", ms"] = 1e3 * mean(peer.seconds);
                if (peer.pairs != our.pairs)
                    row.counters[peer.name + ", pairs too many"] =
                        static_cast<double>(peer.pairs) - static_cast<double>(our.pairs);
            }
            report_.rows.push_back(row);
        }
    }

    const WorldSuiteOptions& options_;
    Report report_;
    std::map<std::pair<std::string, BoxMotion>, Experience> last_; ///< of each peer and motion
};

/// Measures overlapping pairs of moving boxes, against Bullet, CGAL, Embree and FCL.
Report run_world_suite(const WorldSuiteOptions& options) {
    return WorldSuite(options).run();
}

const Suite kWorldSuite(
    "world", "Overlapping pairs of moving boxes, against Bullet, CGAL, Embree and FCL",
    [](CLI::App& suite) -> RunSuite {
        const auto options = std::make_shared<WorldSuiteOptions>();
        suite.add_option("--boxes", options->counts, "Numbers of boxes");
        suite.add_option("--steps", options->steps, "At least, of each case; means are taken")
            ->check(CLI::Range(1, 100000));
        add_only(suite, options->only);
        suite.add_flag("--alone", options->alone, "Without peers");
        suite.add_flag("--methods", options->methods, "Also each broad phase by itself");
        suite.add_option("--peer-limit", options->peer_limit, "Seconds a step, about")
            ->check(CLI::NonNegativeNumber);
        suite.add_option("--seed", options->seed, "Of the boxes");
        return [options] { return run_world_suite(*options); };
    });

} // namespace

} // namespace abut::bench
