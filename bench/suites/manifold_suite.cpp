#include <abut/progress.h>
#include <abut/world.h>

#include "measure.h"
#include "peers/peer_manifolds.h"
#include "suite.h"
#include "suites/mesh_world_rows.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace abut::bench {

namespace {

struct ManifoldSuiteOptions {
    std::size_t bodies = 1000;
    int steps = 60;
    bool alone = false;
    std::string only;
    std::uint64_t seed = 1;
    MeshWorldOptions meshes;
};

constexpr double kMargin = 0.02; ///< Bullet's contact breaking threshold

/// Bodies, and their poses in the first step. Each moves a little in every step.
struct ContactScene {
    std::string name;
    std::vector<ContactBody> bodies;
    std::vector<Pose> poses;
};

class SceneMaker {
public:
    explicit SceneMaker(const ManifoldSuiteOptions& options)
        : count_(options.bodies), random_(options.seed) {}

    /// Stacks of ten boxes on a floor.
    ContactScene stacks() {
        ContactScene scene{"stacked boxes", {}, {}};
        ContactBody floor;
        floor.half = {400, 400, 1}, floor.is_static = true;
        scene.bodies.push_back(floor);
        scene.poses.push_back({{0, 0, -1}, {1, 0, 0, 0}});
        ContactBody box;
        box.half = {0.5, 0.5, 0.5};
        for (std::size_t i = 0; i < count_; ++i) {
            const std::size_t stack = i / 10, level = i % 10;
            const std::size_t row = stack / 20, column = stack % 20;
            scene.bodies.push_back(box);
            scene.poses.push_back(
                {{3.0 * static_cast<double>(column), 3.0 * static_cast<double>(row),
                  0.499 + 0.998 * static_cast<double>(level)},
                 {1, 0, 0, 0}});
        }
        return scene;
    }
    /// Bodies at random places, each with about three partners.
    ContactScene crowd(const std::string& name, ContactBody::Kind kind) {
        ContactScene scene{name, {}, {}};
        const double side = 0.85 * std::cbrt(static_cast<double>(count_));
        for (std::size_t i = 0; i < count_; ++i) {
            ContactBody body;
            body.kind = kind;
            body.half = {draw(0.3, 0.5), draw(0.3, 0.5), draw(0.3, 0.5)};
            body.radius = 0.25;
            if (kind == ContactBody::Kind::hull)
                for (int k = 0; k < 24; ++k)
                    body.points.push_back(on_sphere(0.5));
            scene.bodies.push_back(body);
            const Vec3 at{draw(0, side), draw(0, side), draw(0, side)};
            scene.poses.push_back({at, {draw(-1, 1), draw(-1, 1), draw(-1, 1), draw(0.1, 1)}});
        }
        return scene;
    }
    /// Bodies that lie on a flat floor of triangles, 1 mm in it, clear of each other.
    ContactScene on_mesh(const std::string& name, const ContactBody& body, double lowest,
                         double cell) {
        constexpr double kSpacing = 2;
        ContactScene scene{fmt::format("{} on a mesh of {} m cells", name, cell), {}, {}};
        const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(count_)));
        ContactBody floor;
        floor.kind = ContactBody::Kind::mesh, floor.is_static = true;
        floor.mesh = flat_mesh(kSpacing * static_cast<double>(side + 1), cell);
        scene.bodies.push_back(floor);
        scene.poses.push_back({});
        for (std::size_t i = 0; i < count_; ++i) {
            const std::size_t row = 1 + i / side;
            const double turn = draw(0, 3.141592653589793), c = std::cos(turn), s = std::sin(turn);
            const double half = std::sqrt(0.5); // capsules lie: they are turned about y, too
            scene.bodies.push_back(body);
            scene.poses.push_back(
                {{kSpacing * static_cast<double>(1 + i % side) + draw(-0.5, 0.5),
                  kSpacing * static_cast<double>(row) + draw(-0.5, 0.5), -lowest - 1e-3},
                 body.kind == ContactBody::Kind::capsule
                     ? std::array<double, 4>{half * c, -half * s, half * c, half * s}
                     : std::array<double, 4>{c, 0, 0, s}});
        }
        return scene;
    }
    /// The next step's poses.
    void move(ContactScene& scene) {
        for (std::size_t i = 0; i < scene.poses.size(); ++i) {
            if (scene.bodies[i].is_static)
                continue;
            Pose& pose = scene.poses[i];
            pose.translation = {pose.translation.x + draw(-1e-3, 1e-3),
                                pose.translation.y + draw(-1e-3, 1e-3),
                                pose.translation.z + draw(-1e-4, 1e-4)};
            pose.rotation[3] += draw(-1e-3, 1e-3);
        }
    }

private:
    static Mesh flat_mesh(double size, double cell) {
        const auto cells = static_cast<std::uint32_t>(std::ceil(size / cell));
        Mesh mesh;
        for (std::uint32_t k = 0; k <= cells; ++k)
            for (std::uint32_t i = 0; i <= cells; ++i)
                mesh.positions.push_back({cell * i, cell * k, 0});
        for (std::uint32_t k = 0; k < cells; ++k)
            for (std::uint32_t i = 0; i < cells; ++i) {
                const std::uint32_t v = k * (cells + 1) + i, w = v + cells + 1;
                mesh.triangles.push_back({v, v + 1, w + 1});
                mesh.triangles.push_back({v, w + 1, w});
            }
        return mesh;
    }
    double draw(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    Vec3 on_sphere(double radius) {
        const double z = draw(-1, 1), angle = draw(0, 6.283185307179586), r = std::sqrt(1 - z * z);
        return {radius * r * std::cos(angle), radius * r * std::sin(angle), radius * z};
    }

    std::size_t count_;
    std::mt19937_64 random_;
};

BodyId add_to(World& world, const ContactBody& body, const Pose& pose) {
    const BodyOptions options{.is_static = body.is_static};
    const Vec3& half = body.half;
    if (body.kind == ContactBody::Kind::box)
        return world.add(Box3{{-half.x, -half.y, -half.z}, half}, pose, options);
    if (body.kind == ContactBody::Kind::capsule)
        return world.add(Capsule{{{0, 0, -half.z}, {0, 0, half.z}}, body.radius}, pose, options);
    if (body.kind == ContactBody::Kind::ball)
        return world.add(Sphere{{}, body.radius}, pose, options);
    if (body.kind == ContactBody::Kind::mesh)
        return world.add(Model(body.mesh), pose, options);
    return world.add(Convex(body.points), pose, options);
}

Row measure_scene(ContactScene scene, SceneMaker& maker, const ManifoldSuiteOptions& options,
                  double margin = kMargin, double peer_margin = kOwnMargin) {
    set_threads(1);
    World world;
    std::vector<BodyId> ids;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        ids.push_back(add_to(world, scene.bodies[i], scene.poses[i]));
    const auto peer = options.alone ? nullptr : make_bullet_manifolds(scene.bodies, peer_margin);
    std::vector<double> ours, theirs;
    std::size_t pairs = 0, points = 0, peer_points = 0;
    for (int step = -3; step < options.steps; ++step) { // three steps to warm up
        maker.move(scene);
        const double start = thread_seconds();
        for (std::size_t i = 0; i < ids.size(); ++i)
            world.move(ids[i], scene.poses[i]);
        const auto manifolds = world.contact_manifolds(margin);
        const double middle = thread_seconds();
        if (peer)
            peer_points = peer->step(scene.poses);
        if (step >= 0)
            ours.push_back(middle - start), theirs.push_back(thread_seconds() - middle);
        pairs = manifolds.size(), points = 0;
        for (const ContactManifold& manifold : manifolds)
            points += manifold.count;
    }
    set_threads(0);
    Row row{fmt::format("{}, {}", options.bodies, scene.name),
            kMilliseconds * median(ours),
            {},
            {},
            "ms/step",
            1,
            {}};
    row.counters["manifolds"] = static_cast<double>(pairs);
    row.counters["points"] = static_cast<double>(points);
    if (peer) {
        row.peer = peer->name();
        row.theirs = kMilliseconds * median(theirs);
        row.counters["points of the peer"] = static_cast<double>(peer_points);
    }
    return row;
}

/// Adds rows of bodies of each kind on floors of triangles, with and without a margin.
void add_floor_rows(Report& report, SceneMaker& maker, const ManifoldSuiteOptions& options) {
    constexpr double kFloorMargin = 0.01;
    ContactBody box, hull, capsule, ball;
    box.half = {0.5, 0.5, 0.5};
    hull.kind = ContactBody::Kind::hull;
    for (int k = 0; k < 12; ++k) // a prism of twelve sides
        for (const double z : {-0.4, 0.4})
            hull.points.push_back({0.5 * std::cos(0.5235987755982988 * k),
                                   0.5 * std::sin(0.5235987755982988 * k), z});
    capsule.kind = ContactBody::Kind::capsule, capsule.half = {0, 0, 0.4}, capsule.radius = 0.1;
    ball.kind = ContactBody::Kind::ball, ball.radius = 0.4;
    for (const double cell : {1.0, 0.25})
        for (const auto& [name, body, lowest] :
             {std::tuple("boxes", box, -0.5), std::tuple("hulls", hull, -0.4),
              std::tuple("capsules", capsule, -0.1), std::tuple("balls", ball, -0.4)})
            for (const double margin : {0.0, kFloorMargin}) {
                ContactScene scene = maker.on_mesh(name, body, lowest, cell);
                scene.name += fmt::format(", margin {} m", margin);
                if (scene.name.find(options.only) != std::string::npos)
                    report.rows.push_back(
                        measure_scene(std::move(scene), maker, options, margin, margin));
            }
}

Report run_manifold_suite(const ManifoldSuiteOptions& options) {
    Report report;
    report.suite = "manifolds";
    report.notes.push_back(
        "a step moves all bodies and finds all contacts; the margin is 0.02, and 0 for meshes");
    SceneMaker maker(options);
    std::vector<ContactScene> scenes;
    scenes.push_back(maker.stacks());
    scenes.push_back(maker.crowd("random boxes", ContactBody::Kind::box));
    scenes.push_back(maker.crowd("random capsules", ContactBody::Kind::capsule));
    scenes.push_back(maker.crowd("random hulls of 24 points", ContactBody::Kind::hull));
    for (ContactScene& scene : scenes)
        if (scene.name.find(options.only) != std::string::npos)
            report.rows.push_back(measure_scene(std::move(scene), maker, options));
    add_floor_rows(report, maker, options);
    if (std::string("meshes").find(options.only) != std::string::npos) {
        MeshWorldOptions meshes = options.meshes;
        meshes.bodies = options.bodies, meshes.alone = options.alone;
        add_mesh_world_rows(report, meshes);
    }
    return report;
}

const Suite kManifoldSuite("manifolds", "Contact manifolds of a World, against Bullet",
                           [](CLI::App& suite) -> RunSuite {
                               const auto options = std::make_shared<ManifoldSuiteOptions>();
                               suite.add_option("--bodies", options->bodies, "In each case");
                               suite.add_option("--steps", options->steps, "In each case");
                               suite.add_option("--meshes", options->meshes.files,
                                                "Meshes of about 2,000 triangles, in place of "
                                                "boulders");
                               suite.add_option("--spacings", options->meshes.spacings,
                                                "Of the meshes, whose boxes have a diagonal of 1");
                               suite.add_flag("--alone", options->alone, "Without peers");
                               add_only(suite, options->only);
                               suite.add_option("--seed", options->seed, "Of bodies and poses");
                               return [options] { return run_manifold_suite(*options); };
                           });

} // namespace

} // namespace abut::bench
