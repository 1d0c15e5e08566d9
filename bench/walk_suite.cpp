#include <abut/progress.h>
#include <abut/scene.h>
#include <abut/store.h>
#include <abut/walk.h>

#include "measure.h"
#include "scenes/plant.h"
#include "scratch_folder.h"
#include "suites.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <random>
#include <thread>

namespace abut::bench {

namespace {

constexpr double kFrame = 1.0 / 60;

/// A person: 1.8 m tall, y up.
const Capsule kPerson{{{0, -0.6, 0}, {0, 0.6, 0}}, 0.3};

/// What is asked of a walk.
struct WalkCase {
    std::string name;
    double speed = 1.4;    ///< m/s
    double jump_every = 0; ///< seconds between jumps to another place; 0: none
    int moving_parts = 0;  ///< parts of the store that are moved in every frame
    bool prefetch = true;
};

/// A way through the plant at the height of a walker, from one place drawn at random to the next. Where
/// it would go into a part it slides along it.
class Wanderer {
public:
    Wanderer(const Box3& bounds, double speed, std::uint64_t seed)
        : bounds_(bounds), speed_(speed), engine_(seed), at_(somewhere()), goal_(somewhere()) {}

    [[nodiscard]] const Vec3& position() const { return at_; }
    [[nodiscard]] const Vec3& velocity() const { return velocity_; }

    void jump() { at_ = somewhere(), goal_ = somewhere(); }
    void advance(const NearestPart& nearest) {
        Vec3 way{goal_.x - at_.x, 0, goal_.z - at_.z};
        const double left = std::hypot(way.x, way.z);
        if (left < 2 * speed_ * kFrame || blocked_ > 60) {
            goal_ = somewhere();
            blocked_ = 0;
            return;
        }
        velocity_ = {speed_ * way.x / left, 0, speed_ * way.z / left};
        constexpr double kSkin = 0.05;
        const Vec3& n = nearest.gap.normal; // towards the walker
        const double inward = velocity_.x * n.x + velocity_.z * n.z;
        if (nearest.found && nearest.gap.distance < kSkin && inward < 0) {
            velocity_.x -= 1.2 * inward * n.x, velocity_.z -= 1.2 * inward * n.z;
            ++blocked_;
        }
        at_.x += kFrame * velocity_.x, at_.z += kFrame * velocity_.z;
    }

private:
    Vec3 somewhere() {
        const auto along = [&](double lower, double upper) {
            return std::uniform_real_distribution<double>(lower, upper)(engine_);
        };
        constexpr double kHeight = 1;
        return {along(bounds_.lower.x, bounds_.upper.x), kHeight,
                along(bounds_.lower.z, bounds_.upper.z)};
    }

    Box3 bounds_;
    double speed_;
    std::mt19937_64 engine_;
    Vec3 at_, goal_, velocity_;
    int blocked_ = 0;
};

double percentile(std::vector<double> values, double share) {
    if (values.empty())
        return 0;
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

/// Parts near the walker that swing to and fro.
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

Row walk_row(const Store& store, const WalkCase& what, std::uint64_t memory,
             const WalkSuiteOptions& options) {
    Row row{fmt::format("{}, {} MiB", what.name, memory >> 20), 0, "", {}, "ms", 2, {}};
    const double start = wall_seconds();
    Walk walk(store, {.memory = memory, .prefetch = what.prefetch});
    row.counters["open, s"] = wall_seconds() - start;
    Wanderer wanderer(summary(store).bounds, what.speed, options.seed);
    const Probe person(kPerson);
    walk.move_to(wanderer.position(), {});
    const double before_wait = wall_seconds();
    walk.wait();
    row.counters["first fill, s"] = wall_seconds() - before_wait;
    MovingParts moving(walk, wanderer.position(), what.moving_parts);

    const WalkStatistics begin = walk.statistics();
    const auto frames = static_cast<int>(options.seconds / kFrame);
    std::vector<double> distance_ms, move_ms, part_ms, jump_ms;
    std::uint64_t late = 0, missed_frames = 0, touching = 0, candidates = 0;
    double sum_of_distances = 0;
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
        nearest = walk.distance(person, Pose{wanderer.position()});
        const double t3 = wall_seconds();
        move_ms.push_back(1e3 * (t1 - t0)), part_ms.push_back(1e3 * (t2 - t1));
        (jumps ? jump_ms : distance_ms).push_back(1e3 * (t3 - t2));
        missed_frames += nearest.misses > 0 ? 1 : 0;
        touching += nearest.gap.distance <= 0 ? 1 : 0;
        candidates += nearest.candidates;
        sum_of_distances += nearest.gap.distance;
        // A frame is 1/60 s of wall time; one that is late does not make the next ones shorter.
        next += std::chrono::duration_cast<std::chrono::steady_clock::duration>(
            std::chrono::duration<double>(kFrame));
        const auto now = std::chrono::steady_clock::now();
        late += now > next ? 1 : 0;
        next = std::max(next, now);
        std::this_thread::sleep_until(next);
    }
    const WalkStatistics end = walk.statistics();
    const auto lookups = static_cast<double>(end.lookups - begin.lookups);
    row.ours = percentile(distance_ms, 0.5);
    auto& c = row.counters;
    c["distance, 99th percentile, ms"] = percentile(distance_ms, 0.99);
    c["distance, 99.9th percentile, ms"] = percentile(distance_ms, 0.999);
    c["distance, worst, ms"] = percentile(distance_ms, 1);
    c["move_to, median, us"] = 1e3 * percentile(move_ms, 0.5);
    c["move_to, worst, ms"] = percentile(move_ms, 1);
    if (!jump_ms.empty()) {
        c["distance after a jump, median, ms"] = percentile(jump_ms, 0.5);
        c["distance after a jump, worst, ms"] = percentile(jump_ms, 1);
    }
    if (what.moving_parts > 0)
        c["moving the parts, median, us"] = 1e3 * percentile(part_ms, 0.5);
    c["hit rate, %"] =
        100 * (1 - static_cast<double>(end.misses - begin.misses) / std::max(1.0, lookups));
    c["frames"] = frames;
    c["frames with a miss, %"] = 100.0 * static_cast<double>(missed_frames) / frames;
    c["frames late, %"] = 100.0 * static_cast<double>(late) / frames;
    c["frames that touch, %"] = 100.0 * static_cast<double>(touching) / frames;
    c["mean distance, m"] = sum_of_distances / frames;
    c["candidates a frame"] = static_cast<double>(candidates) / frames;
    c["read ahead, parts"] = static_cast<double>(end.read_ahead - begin.read_ahead);
    c["read in queries, parts"] = static_cast<double>(end.read_in_query - begin.read_in_query);
    c["parts in memory at the end"] = static_cast<double>(end.parts_in_memory);
    c["tables, MiB"] = static_cast<double>(end.table_bytes) / (1 << 20);
    c["peak of the walk, MiB"] = static_cast<double>(end.peak_bytes) / (1 << 20);
    c["peak resident so far, MiB"] = peak_resident_mib();
    return row;
}

} // namespace

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
    // Least memory first: the peak of the process only grows.
    std::vector<std::uint64_t> memory = options.memory;
    std::sort(memory.begin(), memory.end());
    std::vector<std::pair<WalkCase, std::uint64_t>> cases;
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

} // namespace abut::bench
