#include <abut/progress.h>
#include <abut/scene.h>
#include <abut/vector.h>

#include "measure.h"
#include "peers/peer_simulation.h"
#include "placement.h"
#include "simulator/scenes.h"
#include "suite.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace abut::bench {

namespace {

struct SimulateOptions {
    std::string mesh;
    std::string only;
    double seconds = 0; ///< 0: as the scene says
    bool alone = false, sleep = false;
};

constexpr int kStepsOfSecond = 60;
constexpr double kMillimetres = 1e3;
constexpr double kDensity = 1000; ///< of meshes

/// A scene, and what is told of it.
struct Trial {
    std::string name;
    SimulatedScene scene;
    std::size_t watched = 0; ///< the body whose drift is told
    double seconds = 60;
};

SimulatedBody box_body(const simulation::Brick& brick) {
    SimulatedBody body;
    body.half = brick.half, body.at = brick.centre;
    body.mass = 8 * brick.half.x * brick.half.y * brick.half.z * brick.density;
    return body;
}

Trial trial_of_bricks(const std::string& name, const std::vector<simulation::Brick>& bricks,
                      double seconds) {
    Trial trial{name, {}, bricks.size() - 1, seconds};
    for (const simulation::Brick& brick : bricks)
        trial.scene.bodies.push_back(box_body(brick));
    return trial;
}

/// Capsules on joints, which swing down from the horizontal.
Trial chain(int links) {
    constexpr double kLength = 0.25, kRadius = 0.04, kMass = 1.5;
    Trial trial{fmt::format("chain of {} capsules", links), {}, 0, 20};
    const double top = (links + 2) * kLength;
    SimulatedBody ball;
    ball.kind = SimulatedBody::Kind::ball, ball.radius = 0.1, ball.at = {0, 0, top};
    trial.scene.bodies.push_back(ball);
    for (std::size_t i = 0; i < static_cast<std::size_t>(links); ++i) {
        SimulatedBody link;
        link.kind = SimulatedBody::Kind::capsule, link.radius = kRadius;
        link.half = {0.5 * kLength, 0, 0}, link.mass = kMass;
        link.at = {(static_cast<double>(i) + 0.5) * kLength, 0, top};
        trial.scene.bodies.push_back(link);
        trial.scene.joints.push_back({i, i + 1, {static_cast<double>(i) * kLength, 0, top}});
    }
    trial.watched = trial.scene.bodies.size() - 1;
    return trial;
}

/// A mesh on a floor, and another one falls on it.
Trial two_meshes(const simulation::PairOfMeshes& pair) {
    Trial trial{fmt::format("two meshes of {} and {} triangles", pair.meshes[0].triangles.size(),
                            pair.meshes[1].triangles.size()),
                {},
                2,
                20};
    trial.scene.bodies.push_back(box_body(simulation::floor_brick()));
    for (std::size_t i = 0; i < 2; ++i) {
        SimulatedBody body;
        body.kind = SimulatedBody::Kind::mesh, body.mesh = pair.meshes[i];
        const simulation::Mass mass = simulation::mass_of(body.mesh, kDensity);
        const simulation::Matrix turn =
            simulation::rotation_matrix(simulation::normalised(pair.poses[i].rotation));
        for (Vec3& p : body.mesh.positions)
            p = turn * (p - mass.centre);
        body.at = pair.poses[i].translation + turn * mass.centre, body.mass = mass.mass;
        trial.scene.bodies.push_back(std::move(body));
    }
    trial.scene.friction = pair.material.friction, trial.scene.rolling = pair.material.rolling;
    return trial;
}

/// Our example simulator as a peer of Bullet.
class OurSimulation final : public SimulationPeer {
public:
    explicit OurSimulation(const SimulatedScene& scene) : simulator_(settings(scene.sleep)) {
        for (const SimulatedBody& body : scene.bodies)
            add(body, {.density = 0, .friction = scene.friction, .rolling = scene.rolling});
        for (const SimulatedJoint& joint : scene.joints)
            simulator_.join(simulation::JointKind::ball, joint.a, joint.b, {joint.at});
    }
    [[nodiscard]] std::string name() const override { return "Abut's example simulator"; }
    void step(double seconds) override { simulator_.step(seconds); }
    [[nodiscard]] Transform place(std::size_t body) const override {
        return simulator_.bodies()[body].pose;
    }
    [[nodiscard]] double speed(std::size_t body) const override {
        return length(simulator_.bodies()[body].velocity);
    }
    [[nodiscard]] double energy() const override { return simulator_.energy(); }

private:
    static simulation::Settings settings(bool sleep) {
        simulation::Settings settings;
        settings.sleep = sleep;
        return settings;
    }
    void add(const SimulatedBody& body, simulation::Material material) {
        const auto add_shape = [&](const auto& shape) {
            if (body.mass > 0)
                material.density = body.mass / simulation::mass_of(shape, 1).mass;
            simulator_.add(shape, {body.at}, material);
        };
        switch (body.kind) {
        case SimulatedBody::Kind::box:
            return add_shape(Box3{-1 * body.half, body.half});
        case SimulatedBody::Kind::ball:
            return add_shape(Sphere{{}, body.radius});
        case SimulatedBody::Kind::capsule:
            return add_shape(Capsule{{-1 * body.half, body.half}, body.radius});
        case SimulatedBody::Kind::mesh:
            return add_shape(Model(body.mesh));
        }
    }

    simulation::Simulator simulator_;
};

/// The figures of one simulator: drift, energy and the gaps of joints.
class Figures {
public:
    Figures(const SimulatedScene& scene, std::size_t watched) : scene_(scene), watched_(watched) {}

    /// After a step.
    void take(const SimulationPeer& simulator, int step, double seconds) {
        time_ += seconds, ++steps_;
        const double energy = simulator.energy();
        if (step == kStepsOfSecond)
            start_ = origin(simulator);
        if (step > kStepsOfSecond)
            rise_ = std::max(rise_, energy - energy_);
        energy_ = energy;
        drift_ = step > kStepsOfSecond ? length(origin(simulator) - start_) : 0;
        speed_ = simulator.speed(watched_);
        for (const SimulatedJoint& joint : scene_.joints)
            gap_ = std::max(gap_, length(end_of(simulator, joint.a, joint.at) -
                                         end_of(simulator, joint.b, joint.at)));
    }
    [[nodiscard]] double step_time() const { return time_ / std::max(steps_, 1); }
    void add_to(Row& row, const std::string& whose) const {
        row.counters["drift after 1 s, mm, " + whose] = kMillimetres * drift_;
        row.counters["largest rise of energy in a step, J, " + whose] = rise_;
        row.counters["speed at the end, mm/s, " + whose] = kMillimetres * speed_;
        if (!scene_.joints.empty())
            row.counters["largest gap of a joint, mm, " + whose] = kMillimetres * gap_;
    }

private:
    [[nodiscard]] Vec3 origin(const SimulationPeer& simulator) const {
        return placed(simulator.place(watched_), {});
    }
    [[nodiscard]] Vec3 end_of(const SimulationPeer& simulator, std::size_t body,
                              const Vec3& at) const {
        return placed(simulator.place(body), at - scene_.bodies[body].at);
    }

    const SimulatedScene& scene_;
    std::size_t watched_;
    double time_ = 0, energy_ = 0, rise_ = 0, drift_ = 0, speed_ = 0, gap_ = 0;
    int steps_ = 0;
    Vec3 start_;
};

Row run_trial(Trial trial, const SimulateOptions& options) {
    trial.scene.sleep = options.sleep;
    const double seconds = options.seconds > 0 ? options.seconds : trial.seconds;
    OurSimulation ours(trial.scene);
    const auto peer = options.alone ? nullptr : make_bullet_simulation(trial.scene);
    Figures our_figures(trial.scene, trial.watched), their_figures(trial.scene, trial.watched);
    const int steps = static_cast<int>(seconds * kStepsOfSecond);
    for (int step = 1; step <= steps; ++step) {
        const auto run = [&](SimulationPeer& simulator, Figures& figures) {
            const double start = thread_seconds();
            simulator.step(1.0 / kStepsOfSecond);
            const double time = thread_seconds() - start;
            figures.take(simulator, step, time);
        };
        run(ours, our_figures);
        if (peer)
            run(*peer, their_figures);
    }
    Row row{fmt::format("{}, {} s", trial.name, seconds),
            kMilliseconds * our_figures.step_time(),
            {},
            {},
            "ms/step",
            1,
            {}};
    our_figures.add_to(row, "ours");
    if (peer) {
        row.peer = peer->name();
        row.theirs = kMilliseconds * their_figures.step_time();
        their_figures.add_to(row, "peer");
    }
    return row;
}

Report run_simulate_suite(const SimulateOptions& options) {
    Report report;
    report.suite = "simulate";
    report.notes.push_back("60 steps a second; one thread, processor time");
    set_threads(1);
    const std::vector<Trial> trials{
        trial_of_bricks("stack of 10 boxes", simulation::stack_bricks(10), 60),
        trial_of_bricks("stack of 20 boxes", simulation::stack_bricks(20), 60),
        trial_of_bricks("wall of 510 bricks", simulation::wall_bricks(25, 20), 10), chain(20),
        two_meshes(options.mesh.empty() ? simulation::ball_on_disc()
                                        : simulation::pair_of_bunnies(read_mesh(options.mesh)))};
    for (const Trial& trial : trials)
        if (trial.name.find(options.only) != std::string::npos)
            report.rows.push_back(run_trial(trial, options));
    set_threads(0);
    return report;
}

const Suite kSimulateSuite("simulate", "The example simulator, against Bullet on the same scenes",
                           [](CLI::App& suite) -> RunSuite {
                               const auto options = std::make_shared<SimulateOptions>();
                               suite.add_option("--mesh", options->mesh,
                                                "The bunny that falls on another one");
                               suite.add_option("--seconds", options->seconds, "Of each scene");
                               suite.add_flag("--alone", options->alone, "Without the peer");
                               suite.add_flag("--sleep", options->sleep,
                                              "Bodies at rest may fall asleep");
                               add_only(suite, options->only);
                               return [options] { return run_simulate_suite(*options); };
                           });

} // namespace

} // namespace abut::bench
