#include <abut/progress.h>
#include <abut/scene.h>
#include <abut/store.h>
#include <abut/vector.h>
#include <abut/walk.h>

#include "measure.h"
#include "scenes/plant/plant.h"
#include "scratch_folder.h"
#include "suite.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace abut::bench {

namespace {

struct WalkSuiteOptions {
    std::string store;                    ///< empty: a plant in which no mesh is shared
    std::uint64_t triangles = 15'432'126; ///< of that plant
    std::vector<std::uint64_t> memory = {std::uint64_t{512} << 20, std::uint64_t{128} << 20,
                                         std::uint64_t{64} << 20};
    double seconds = 120; ///< of each walk, in real time
    std::string only;     ///< runs only the cases whose name contains this
    std::uint64_t seed = 1;
};

constexpr double kFrame = 1.0 / 60;

/// A person: 1.8 m tall, y up.
const Capsule kPerson{{{0, -0.6, 0}, {0, 0.6, 0}}, 0.3};

/// The settings of one walk.
struct WalkCase {
    std::string name;
    double speed = 1.4;    ///< m/s
    double jump_every = 0; ///< seconds between jumps to another place; 0: none
    int moving_parts = 0;  ///< number of parts of the store that are moved in every frame
    bool prefetch = true;
};

Vec3 plus(const Vec3& a, double s, const Vec3& b) {
    return {a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

/// Crowded places of the plant, each next to a part with others around it. Each lies within 20 m of
/// the previous one, or anywhere.
std::vector<Vec3> make_places(const Store& store, bool anywhere, int count, std::uint64_t seed) {
    Walk guide(store, {.memory = std::uint64_t{16} << 20, .prefetch = false});
    const Probe point(Sphere{{}, 0});
    const Box3 bounds = summary(store).bounds;
    std::mt19937_64 engine(seed);
    const auto draw = [&](double lower, double upper) {
        return std::uniform_real_distribution<double>(lower, upper)(engine);
    };
    std::vector<Vec3> places;
    for (int tries = 0; static_cast<int>(places.size()) < count && tries < 100 * count; ++tries) {
        constexpr double kHighest = 45; // the height at which floors end
        Vec3 at{draw(bounds.lower.x, bounds.upper.x), draw(bounds.lower.y, kHighest),
                draw(bounds.lower.z, bounds.upper.z)};
        if (!anywhere && !places.empty())
            at = {places.back().x + draw(-20, 20), places.back().y + draw(-4, 4),
                  places.back().z + draw(-20, 20)};
        const NearestPart nearest = guide.distance(point, Pose{at});
        at = plus(nearest.gap.point_part, 1, nearest.gap.normal);
        constexpr std::size_t kAround = 20;
        if (guide.within(point, Pose{at}, 2.5).parts.size() >= kAround)
            places.push_back(at);
    }
    return places;
}

/// Walks straight from each place to the next. Where a part is in the way, it slides along it.
class Wanderer {
public:
    Wanderer(std::vector<Vec3> places, double speed)
        : places_(std::move(places)), speed_(speed), at_(places_.at(0)) {}

    [[nodiscard]] const Vec3& position() const { return at_; }
    [[nodiscard]] const Vec3& velocity() const { return velocity_; }

    void jump() { at_ = goal(), ++reached_; }
    void advance(const NearestPart& nearest) {
        const Vec3 way = plus(goal(), -1, at_);
        const double left = std::sqrt(dot(way, way));
        constexpr int kPatience = 60;
        if (left < 2 * speed_ * kFrame || blocked_ > kPatience) {
            ++reached_;
            blocked_ = 0;
            return;
        }
        velocity_ = plus({}, speed_ / left, way);
        constexpr double kSkin = 0.05;
        const Vec3& n = nearest.gap.normal; // towards the walker
        const double inward = dot(velocity_, n);
        if (nearest.found && nearest.gap.distance < kSkin && inward < 0) {
            velocity_ = plus(velocity_, -1.2 * inward, n);
            ++blocked_;
        }
        at_ = plus(at_, kFrame, velocity_);
        way_ += kFrame * std::sqrt(dot(velocity_, velocity_));
    }
    [[nodiscard]] double way() const { return way_; }

private:
    [[nodiscard]] const Vec3& goal() const { return places_[(reached_ + 1) % places_.size()]; }

    std::vector<Vec3> places_;
    double speed_;
    Vec3 at_, velocity_;
    std::size_t reached_ = 0;
    int blocked_ = 0;
    double way_ = 0;
};

/// The wall time of a loop that computes for this long and queries nothing. It shows what the
/// machine's other load adds.
double spin(double seconds) {
    const double start = wall_seconds(), computed = thread_seconds();
    while (thread_seconds() - computed < seconds) {
    }
    return wall_seconds() - start;
}

double percentile(std::vector<double> values, double share) {
    if (values.empty())
        return 0;
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

/// Parts near the walker that swing back and forth.
class MovingParts {
public:
    MovingParts(Walk& walk, const Vec3& near, int count) : walk_(walk) {
        if (count == 0)
            return;
        const Probe reach(Sphere{{}, 0.1});
        for (double radius = 1; static_cast<int>(parts_.size()) < count && radius < 100;
             radius *= 2) {
            parts_.clear();
            for (const WalkGap& gap : walk.within(reach, Pose{near}, radius).parts)
                if (static_cast<int>(parts_.size()) < count)
                    parts_.push_back({gap.part, walk.world_from_part(gap.part)});
        }
    }
    void swing(int frame) {
        for (const auto& [part, from] : parts_) {
            Transform to = from;
            to.m[9] += 0.2 * std::sin(0.05 * frame);
            walk_.move(part, to);
        }
    }

private:
    Walk& walk_;
    std::vector<std::pair<WalkPart, Transform>> parts_;
};

/// The measurements of the frames of a walk.
struct WalkFigures {
    std::vector<double> distance_ms, processor_ms, spin_ms, within_ms, move_ms, part_ms, jump_ms;
    std::uint64_t near = 0, late = 0, missed_frames = 0, touching = 0, candidates = 0;
    double sum_of_distances = 0;

    void add_to(std::map<std::string, double>& c, int frames) const {
        c["distance, 99th percentile, ms"] = percentile(distance_ms, 0.99);
        c["distance, 99.9th percentile, ms"] = percentile(distance_ms, 0.999);
        c["distance, worst, ms"] = percentile(distance_ms, 1);
        c["distance, worst, processor ms"] = percentile(processor_ms, 1);
        c["as long of nothing, 99.9th percentile, ms"] = percentile(spin_ms, 0.999);
        c["as long of nothing, worst, ms"] = percentile(spin_ms, 1);
        c["within 1 m, median, ms"] = percentile(within_ms, 0.5);
        c["within 1 m, 99th percentile, ms"] = percentile(within_ms, 0.99);
        c["parts within 1 m"] = static_cast<double>(near) / frames;
        c["move_to, median, us"] = 1e3 * percentile(move_ms, 0.5);
        c["move_to, worst, ms"] = percentile(move_ms, 1);
        if (!jump_ms.empty()) {
            c["distance after a jump, median, ms"] = percentile(jump_ms, 0.5);
            c["distance after a jump, worst, ms"] = percentile(jump_ms, 1);
        }
        c["frames with a miss, %"] = 100.0 * static_cast<double>(missed_frames) / frames;
        c["frames late, %"] = 100.0 * static_cast<double>(late) / frames;
        c["frames that touch, %"] = 100.0 * static_cast<double>(touching) / frames;
        c["mean distance, m"] = sum_of_distances / frames;
        c["candidates a frame"] = static_cast<double>(candidates) / frames;
    }
};

WalkFigures walk_frames(const WalkCase& what, int frames, Walk& walk, Wanderer& wanderer,
                        MovingParts& moving) {
    const Probe person(kPerson);
    WalkFigures figures;
    NearestPart nearest;
    auto next = std::chrono::steady_clock::now();
    for (int frame = 0; frame < frames; ++frame) {
        wanderer.advance(nearest);
        const bool jumps =
            what.jump_every > 0 && frame % static_cast<int>(what.jump_every / kFrame) == 0;
        if (jumps)
            wanderer.jump();
        const double t0 = wall_seconds();
        walk.move_to(wanderer.position(), wanderer.velocity());
        const double t1 = wall_seconds();
        moving.swing(frame);
        const double t2 = wall_seconds();
        const double computed = thread_seconds();
        nearest = walk.distance(person, Pose{wanderer.position()});
        const double processor_seconds = thread_seconds() - computed;
        const double t3 = wall_seconds();
        figures.near += walk.within(person, Pose{wanderer.position()}, 1).parts.size();
        figures.within_ms.push_back(1e3 * (wall_seconds() - t3));
        figures.processor_ms.push_back(1e3 * processor_seconds);
        figures.move_ms.push_back(1e3 * (t1 - t0)), figures.part_ms.push_back(1e3 * (t2 - t1));
        (jumps ? figures.jump_ms : figures.distance_ms).push_back(1e3 * (t3 - t2));
        figures.missed_frames += nearest.misses > 0 ? 1 : 0;
        figures.touching += nearest.gap.distance <= 0 ? 1 : 0;
        figures.candidates += nearest.candidates;
        figures.sum_of_distances += nearest.gap.distance;
        figures.spin_ms.push_back(1e3 * spin(processor_seconds));
        // A frame is 1/60 s of wall time. A late frame does not shorten the next ones.
        next += std::chrono::duration_cast<std::chrono::steady_clock::duration>(
            std::chrono::duration<double>(kFrame));
        const auto now = std::chrono::steady_clock::now();
        figures.late += now > next ? 1 : 0;
        next = std::max(next, now);
        std::this_thread::sleep_until(next);
    }
    return figures;
}

Row walk_row(const Store& store, const WalkCase& what, std::uint64_t memory,
             const WalkSuiteOptions& options) {
    Row row{fmt::format("{}, {} MiB", what.name, memory >> 20), 0, "", {}, "ms", 2, {}};
    std::map<std::string, double>& c = row.counters;
    constexpr double kMeanWay = 12;
    const double legs = 2 + options.seconds * std::max(what.speed / kMeanWay, 1.0);
    Wanderer wanderer(make_places(store, what.jump_every > 0, static_cast<int>(legs), options.seed),
                      what.speed);
    const double start = wall_seconds();
    Walk walk(store, {.memory = memory, .prefetch = what.prefetch});
    c["open, s"] = wall_seconds() - start;
    walk.move_to(wanderer.position(), {});
    const double before_wait = wall_seconds();
    walk.wait();
    c["first fill, s"] = wall_seconds() - before_wait;
    MovingParts moving(walk, wanderer.position(), what.moving_parts);

    const auto frames = static_cast<int>(options.seconds / kFrame);
    const WalkStatistics begin = walk.statistics();
    const WalkFigures figures = walk_frames(what, frames, walk, wanderer, moving);
    const WalkStatistics end = walk.statistics();
    const auto lookups = static_cast<double>(end.lookups - begin.lookups);
    row.ours = percentile(figures.distance_ms, 0.5);
    figures.add_to(c, frames);
    if (what.moving_parts > 0)
        c["moving the parts, median, us"] = 1e3 * percentile(figures.part_ms, 0.5);
    c["hit rate, %"] =
        100 * (1 - static_cast<double>(end.misses - begin.misses) / std::max(1.0, lookups));
    c["frames"] = frames;
    c["way, m"] = wanderer.way();
    c["read ahead, parts"] = static_cast<double>(end.read_ahead - begin.read_ahead);
    c["read in queries, parts"] = static_cast<double>(end.read_in_query - begin.read_in_query);
    c["parts in memory at the end"] = static_cast<double>(end.parts_in_memory);
    c["tables, MiB"] = static_cast<double>(end.table_bytes) / (1 << 20);
    c["peak of the walk, MiB"] = static_cast<double>(end.peak_bytes) / (1 << 20);
    c["peak resident so far, MiB"] = peak_resident_mib();
    return row;
}

/// A person walks, flies and jumps through a store, frame by frame. Measures the time to find the
/// distance to the nearest part.
///
/// Errors      as open_store and Walk.
Report run_walk_suite(const WalkSuiteOptions& options) {
    Report report{"walk", {}, {}};
    const ScratchFolder folder;
    std::string path = options.store;
    if (path.empty()) {
        const std::string model = folder / "plant.glb";
        write_glb(make_plant({.triangles = options.triangles, .distinct = true}).scene, model);
        path = folder / "plant.abut";
        (void)import_models({model}, path);
    }
    const Store store = open_store(path);
    // Smallest memory first, because the process's peak never falls.
    std::vector<std::uint64_t> memory = options.memory;
    std::sort(memory.begin(), memory.end());
    std::vector<std::pair<WalkCase, std::uint64_t>> cases;
    cases.reserve(memory.size() + 5);
    for (const std::uint64_t bytes : memory)
        cases.push_back({{.name = "walking, 1.4 m/s"}, bytes});
    const std::uint64_t some = memory.front();
    cases.push_back({{.name = "walking, ten parts move", .moving_parts = 10}, some});
    cases.push_back({{.name = "flying, 10 m/s", .speed = 10}, some});
    cases.push_back({{.name = "flying, 50 m/s", .speed = 50}, some});
    cases.push_back({{.name = "jumping every second", .jump_every = 1}, some});
    cases.push_back({{.name = "walking, nothing read ahead", .prefetch = false}, some});
    for (const auto& [what, bytes] : cases)
        if (what.name.find(options.only) != std::string::npos)
            report.rows.push_back(walk_row(store, what, bytes, options));
    report.notes.push_back(
        "median time of a distance query a frame; frames of 1/60 s of wall time, a second thread "
        "reads ahead");
    return report;
}

const Suite kWalkSuite(
    "walk", "Through a store in little memory: a distance in every frame",
    [](CLI::App& suite) -> RunSuite {
        const auto options = std::make_shared<WalkSuiteOptions>();
        suite.add_option("--store", options->store, "Of a model in metres, y up; else a plant");
        suite.add_option("--triangles", options->triangles, "Of the plant");
        suite.add_option("--memory", options->memory, "Bytes of the walk, each in turn");
        suite.add_option("--seconds", options->seconds, "Of each walk")->check(CLI::PositiveNumber);
        add_only(suite, options->only);
        suite.add_option("--seed", options->seed, "Of the paths");
        return [options] { return run_walk_suite(*options); };
    });

} // namespace

} // namespace abut::bench
