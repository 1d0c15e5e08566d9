#include "suites/mesh_world_rows.h"

#include <abut/progress.h>
#include <abut/scene.h>
#include <abut/vector.h>
#include <abut/world.h>

#include "measure.h"
#include "peers/peer_mesh_world.h"
#include "placement.h"
#include "scenes/bodies.h"

#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <utility>

namespace abut::bench {

namespace {

Mesh unit_mesh(Mesh mesh) {
    normalise(mesh);
    return mesh;
}

MeshCrowd crowd_of(const MeshWorldOptions& options) {
    constexpr std::uint64_t kBoulders = 5;
    MeshCrowd crowd;
    for (const std::string& file : options.files)
        crowd.meshes.push_back(unit_mesh(read_mesh(file)));
    for (std::uint64_t i = 0; crowd.meshes.size() < kBoulders && options.files.empty(); ++i)
        crowd.meshes.push_back(unit_mesh(scenes::boulder(options.triangles, 7 + i)));
    for (std::size_t i = 0; i < options.bodies; ++i)
        crowd.mesh_of.push_back(i % crowd.meshes.size());
    return crowd;
}

/// Bodies on a jittered grid, each with a velocity and a spin.
class MovingCrowd {
public:
    MovingCrowd(std::size_t count, double spacing, std::uint64_t seed) {
        scenes::Random random(seed);
        const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(count)));
        for (std::size_t i = 0; i < count; ++i) {
            const auto cell = [&](std::size_t k) {
                return spacing * (static_cast<double>(k % side) + 0.6 * (unit(random) - 0.5));
            };
            const double x = cell(i), y = cell(i / side), z = cell(i / side / side);
            poses.push_back({{x, y, z}, random_rotation(random)});
            steps_.push_back(0.003 * random_direction(random));
            axes_.push_back(random_direction(random));
        }
    }
    /// Moves one body of `every`.
    void move(std::size_t every) {
        constexpr double kDegrees = 1.15;
        for (std::size_t i = 0; i < poses.size(); i += every) {
            poses[i].translation = poses[i].translation + steps_[i];
            poses[i].rotation = turned(poses[i].rotation, axes_[i], kDegrees);
        }
    }
    std::vector<Pose> poses;

private:
    std::vector<Vec3> steps_, axes_;
};

/// Our world and its peers, step by step.
class MeshWorldTrial {
public:
    MeshWorldTrial(const MeshCrowd& crowd, const std::vector<Model>& models, MovingCrowd bodies)
        : bodies_(std::move(bodies)) {
        for (std::size_t i = 0; i < crowd.mesh_of.size(); ++i)
            ids_.push_back(world_.add(models[crowd.mesh_of[i]], bodies_.poses[i]));
    }
    /// Returns a row. find() is our query and returns the number of pairs that touch.
    template <typename Find>
    Row measure(const std::string& name, int steps, std::size_t every,
                const std::vector<std::unique_ptr<MeshWorldPeer>>& peers, const Find& find) {
        std::vector<double> ours;
        std::vector<std::vector<double>> theirs(peers.size());
        Row row{name, 0, {}, {}, "ms/step", 1, {}};
        for (int step = 0; step < steps; ++step) {
            bodies_.move(every);
            double start = thread_seconds();
            for (std::size_t i = 0; i < ids_.size(); ++i)
                world_.move(ids_[i], bodies_.poses[i]);
            row.counters["touching"] = static_cast<double>(find(world_, row));
            ours.push_back(thread_seconds() - start);
            const std::vector<Transform> places(bodies_.poses.begin(), bodies_.poses.end());
            for (std::size_t k = 0; k < peers.size(); ++k) {
                start = thread_seconds();
                const std::size_t touching = peers[k]->step(places);
                theirs[k].push_back(thread_seconds() - start);
                row.counters["touching, " + peers[k]->name()] = static_cast<double>(touching);
            }
        }
        row.ours = kMilliseconds * median(ours);
        row.counters["pairs of boxes"] = static_cast<double>(world_.pairs().size());
        for (std::size_t k = 0; k < peers.size(); ++k) {
            const double time = kMilliseconds * median(theirs[k]);
            row.counters[peers[k]->name() + ", ms"] = time;
            if (!row.theirs || time < *row.theirs)
                row.theirs = time, row.peer = peers[k]->name();
        }
        return row;
    }

private:
    MovingCrowd bodies_;
    World world_;
    std::vector<BodyId> ids_;
};

std::size_t count_touching(World& world, Row& row) {
    const std::vector<ContactManifold> manifolds = world.contact_manifolds();
    std::size_t pairs = 0, points = 0;
    for (std::size_t i = 0; i < manifolds.size(); ++i) {
        points += manifolds[i].count;
        if (i == 0 || manifolds[i].a != manifolds[i - 1].a || manifolds[i].b != manifolds[i - 1].b)
            ++pairs;
    }
    row.counters["manifolds"] = static_cast<double>(manifolds.size());
    row.counters["points"] = static_cast<double>(points);
    return pairs;
}

} // namespace

void add_mesh_world_rows(Report& report, const MeshWorldOptions& options) {
    set_threads(1);
    const MeshCrowd crowd = crowd_of(options);
    std::vector<Model> models;
    for (const Mesh& mesh : crowd.meshes)
        models.emplace_back(mesh);
    for (const double spacing : options.spacings) {
        const MovingCrowd bodies(options.bodies, spacing, options.seed);
        const std::string name = fmt::format("{} meshes, spacing {}, ", options.bodies, spacing);
        const auto peers_of = [&](bool manifolds) {
            std::vector<std::unique_ptr<MeshWorldPeer>> peers;
            if (options.alone)
                return peers;
            peers.push_back(make_fcl_mesh_world(crowd, manifolds));
            if (manifolds)
                peers.push_back(make_bullet_mesh_world(crowd));
            std::erase(peers, nullptr);
            return peers;
        };
        report.rows.push_back(
            MeshWorldTrial(crowd, models, bodies)
                .measure(name + "touching", options.steps, 1, peers_of(false),
                         [](World& world, Row&) { return world.collide().size(); }));
        for (const std::size_t every : {1, 10}) {
            const std::string which = every == 1 ? "manifolds" : "manifolds, one body of 10 moves";
            report.rows.push_back(
                MeshWorldTrial(crowd, models, bodies)
                    .measure(name + which, options.steps, every, peers_of(true), count_touching));
        }
    }
    set_threads(0);
}

} // namespace abut::bench
