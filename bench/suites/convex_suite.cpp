#include <abut/convex.h>
#include <abut/rigid.h>
#include <abut/scene.h>

#include "measure.h"
#include "peers/peer_convex.h"
#include "placement.h"
#include "suite.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace abut::bench {

namespace {

struct ConvexSuiteOptions {
    std::vector<std::string> files;                    ///< models whose hulls are measured too
    std::vector<std::size_t> vertices{100, 500, 2000}; ///< of the ellipsoids
    std::size_t poses = 2000;                          ///< in each case
    bool alone = false;                                ///< without peers
    std::string only; ///< runs only the cases whose name contains this
    int rounds = 5;
    std::uint64_t seed = 1;
};

Vec3 combined(double s, const Vec3& a, double t, const Vec3& b) {
    return {s * a.x + t * b.x, s * a.y + t * b.y, s * a.z + t * b.z};
}

/// The hull of random points on an ellipsoid with half axes 1, 0.7, 0.5.
Convex ellipsoid(std::size_t vertices, scenes::Random& random) {
    std::vector<Vec3> points;
    while (points.size() < vertices) {
        const Vec3 d = random_direction(random);
        points.push_back({d.x, 0.7 * d.y, 0.5 * d.z});
    }
    return Convex(points);
}

/// The hull of a model, scaled to half diagonal 1, so that its reach is about that of an ellipsoid.
Convex hull_of(const std::string& file) {
    Mesh mesh = read_mesh(file);
    normalise(mesh);
    for (Vec3& p : mesh.positions)
        p = {2 * p.x, 2 * p.y, 2 * p.z};
    return Convex(mesh.positions);
}

class ConvexSuite {
public:
    explicit ConvexSuite(const ConvexSuiteOptions& options)
        : options_(options), random_(options.seed) {
        report_.suite = "convex";
        report_.notes.push_back(fmt::format("{} poses a case, nanoseconds a query", options.poses));
    }

    Report run() && {
        for (const std::size_t vertices : options_.vertices)
            cases(fmt::format("ellipsoids, {} vertices", vertices), ellipsoid(vertices, random_),
                  ellipsoid(vertices, random_));
        for (const std::string& file : options_.files) {
            const Convex body = hull_of(file);
            cases(fmt::format("{}, {} vertices", std::filesystem::path(file).stem().string(),
                              body.vertices().size()),
                  body, body);
        }
        return std::move(report_);
    }

private:
    /// Random poses: both bodies are rotated at random, and b is at most `reach` away. The pairs
    /// are all apart, or all meeting.
    std::vector<PosedPair> random_poses(const Convex& a, const Convex& b, bool apart) {
        std::vector<PosedPair> poses;
        while (poses.size() < options_.poses) {
            const double reach = apart ? 1 + 1.5 * unit(random_) : 1.2 * unit(random_);
            const Pose world_a{{}, random_rotation(random_)};
            const Pose world_b{combined(reach, random_direction(random_), 0, {}),
                               random_rotation(random_)};
            if ((abut::distance(a, world_a, b, world_b).distance > 0) == apart)
                poses.push_back({world_a, world_b});
        }
        return poses;
    }

    /// Random poses in which the bodies overlap by 1e-4 to 1e-2, from where they touch.
    std::vector<PosedPair> shallow_poses(const Convex& a, const Convex& b) {
        std::vector<PosedPair> poses;
        while (poses.size() < options_.poses) {
            const Pose world_a{{}, random_rotation(random_)};
            Pose world_b{combined(3, random_direction(random_), 0, {}), random_rotation(random_)};
            const double depth = std::pow(10, -4 + 2 * unit(random_));
            for (const double to : {0.2, -depth}) {
                const ConvexGap now = abut::distance(a, world_a, b, world_b);
                const Vec3 way = combined(1, now.point_b, -1, now.point_a);
                world_b.translation = combined(1, world_b.translation, to / now.distance - 1, way);
            }
            poses.push_back({world_a, world_b});
        }
        return poses;
    }

    /// Paths of 250 steps: b rotates by one degree per step, and moves by 0.01 on a circle around
    /// a.
    std::vector<PosedPair> path_poses(double radius) {
        std::vector<PosedPair> poses;
        while (poses.size() < options_.poses) {
            const Pose world_a{{}, random_rotation(random_)};
            Pose world_b{{}, random_rotation(random_)};
            const Vec3 axis = random_direction(random_), u = random_direction(random_);
            const Vec3 other = random_direction(random_);
            const double along = u.x * other.x + u.y * other.y + u.z * other.z;
            const Vec3 across = combined(1, other, -along, u);
            const double length = std::hypot(across.x, across.y, across.z);
            for (std::size_t i = 0; i < kSteps; ++i) {
                const double angle = 0.01 * static_cast<double>(i) / radius;
                world_b.translation = combined(radius * std::cos(angle), u,
                                               radius * std::sin(angle) / length, across);
                poses.push_back({world_a, world_b});
                world_b.rotation = turned(world_b.rotation, axis, 1);
            }
        }
        poses.resize(options_.poses);
        return poses;
    }

    /// Paths of 250 steps: b rotates by half a degree per step, slides as far around a, and keeps
    /// the gap, or the depth if it is negative.
    std::vector<PosedPair> sliding_poses(const Convex& a, const Convex& b, double gap) {
        std::vector<PosedPair> poses;
        while (poses.size() < options_.poses) {
            const Pose world_a{{}, random_rotation(random_)};
            Pose world_b{{}, random_rotation(random_)};
            const Vec3 axis = random_direction(random_), u = random_direction(random_);
            const Vec3 other = random_direction(random_);
            const double along = u.x * other.x + u.y * other.y + u.z * other.z;
            const Vec3 across = combined(1, other, -along, u);
            const double length = std::hypot(across.x, across.y, across.z);
            for (std::size_t i = 0; i < kSteps; ++i) {
                const double angle = 0.5 * std::numbers::pi / 180 * static_cast<double>(i);
                world_b.translation =
                    combined(3 * std::cos(angle), u, 3 * std::sin(angle) / length, across);
                // Twice, since the first translation is long and rounds accordingly.
                for (const double to : {0.2, gap}) {
                    const ConvexGap now = abut::distance(a, world_a, b, world_b);
                    const Vec3 way = combined(1, now.point_b, -1, now.point_a);
                    world_b.translation =
                        combined(1, world_b.translation, to / now.distance - 1, way);
                }
                poses.push_back({world_a, world_b});
                world_b.rotation = turned(world_b.rotation, axis, 0.5);
            }
        }
        poses.resize(options_.poses);
        return poses;
    }

    using Query = std::function<double(const PosedPair& poses, std::size_t index)>;
    using PeerQuery = double (ConvexPeer::*)(std::size_t);

    void compare(const std::string& name, const Convex& a, const Convex& b,
                 const std::vector<PosedPair>& poses, const Query& ours, PeerQuery theirs,
                 std::optional<double> error) {
        if (name.find(options_.only) == std::string::npos)
            return;
        std::vector<double> our_answers(poses.size()), their_answers(poses.size());
        const Work work = [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                our_answers[i] = ours(poses[i], i);
        };
        using MakePeer = std::unique_ptr<ConvexPeer> (*)(const Convex&, const Convex&);
        const std::vector<MakePeer> peers =
            options_.alone ? std::vector<MakePeer>{nullptr}
                           : std::vector<MakePeer>{make_fcl_convex, make_bullet_convex};
        for (const MakePeer make : peers) {
            const std::unique_ptr<ConvexPeer> peer = make != nullptr ? make(a, b) : nullptr;
            Work peer_work;
            if (peer) {
                peer->set_poses(poses);
                peer_work = [&](std::size_t begin, std::size_t end) {
                    for (std::size_t i = begin; i < end; ++i)
                        their_answers[i] = ((*peer).*theirs)(i);
                };
            }
            const Turns turns =
                take_turns(poses.size(), poses.size(), options_.rounds, work, peer_work);
            const double nanoseconds = 1e9 / static_cast<double>(poses.size());
            Row row{name, turns.ours * nanoseconds, {}, {}, "ns/query", 1, {}};
            if (error)
                row.counters["largest relative error"] = *error;
            if (peer) {
                row.peer = peer->name(), row.theirs = turns.theirs * nanoseconds;
                double beyond = 0;
                for (std::size_t i = 0; i < poses.size(); ++i)
                    beyond += std::abs(our_answers[i] - their_answers[i]) > 1e-4 ? 1 : 0;
                row.counters["answers of the peer more than 1e-4 off"] = beyond;
            }
            report_.rows.push_back(row);
        }
    }

    /// Compares with the distance of the bodies' triangles, on some of the poses.
    static double largest_error(const Convex& a, const Convex& b,
                                const std::vector<PosedPair>& poses) {
        const Model model_a(a.mesh()), model_b(b.mesh());
        double largest = 0;
        for (std::size_t i = 0; i < poses.size(); i += 10) {
            const double surfaces =
                abut::distance(model_a, poses[i].a, model_b, poses[i].b).distance;
            const double bodies = abut::distance(a, poses[i].a, b, poses[i].b).distance;
            if (bodies > 0)
                largest = std::max(largest, std::abs(bodies - surfaces) / surfaces);
        }
        return largest;
    }

    void cases(const std::string& name, const Convex& a, const Convex& b) {
        const auto cold = [&](const PosedPair& p, std::size_t /*index*/) {
            return abut::distance(a, p.a, b, p.b).distance;
        };
        ConvexWarmStart warm_start;
        const auto warm = [&](const PosedPair& p, std::size_t index) {
            if (index % kSteps == 0)
                warm_start = {};
            return abut::distance(a, p.a, b, p.b, {.warm_start = &warm_start}).distance;
        };
        const auto measure = [&](const std::string& what, const std::vector<PosedPair>& poses,
                                 const Query& ours) {
            compare(name + ", " + what, a, b, poses, ours, &ConvexPeer::distance,
                    largest_error(a, b, poses));
        };
        measure("distance, coherent", path_poses(2.1), warm);
        for (const double gap : {1e-3, 1e-6, 1e-9})
            measure(fmt::format("distance, sliding at {:g}", gap), sliding_poses(a, b, gap), warm);
        const std::vector<PosedPair> apart = random_poses(a, b, true);
        measure("distance, random", apart, cold);
        measure("distance, random, old warm start", apart, warm);
        const std::vector<PosedPair> meeting = random_poses(a, b, false);
        measure("distance, random, meeting", meeting, cold);
        compare(name + ", penetration, random", a, b, meeting,
                [&](const PosedPair& p, std::size_t /*index*/) {
                    return abut::penetration(a, p.a, b, p.b).depth;
                },
                &ConvexPeer::penetration, {});
        compare(name + ", penetration, shallow", a, b, shallow_poses(a, b),
                [&](const PosedPair& p, std::size_t /*index*/) {
                    return abut::penetration(a, p.a, b, p.b).depth;
                },
                &ConvexPeer::penetration, {});
        const auto warm_depth = [&](const PosedPair& p, std::size_t index) {
            if (index % kSteps == 0)
                warm_start = {};
            return abut::penetration(a, p.a, b, p.b, {.warm_start = &warm_start}).depth;
        };
        compare(name + ", penetration, sliding at 0.003", a, b, sliding_poses(a, b, -3e-3),
                warm_depth, &ConvexPeer::penetration, {});
        compare(name + ", penetration, coherent", a, b, path_poses(0.5), warm_depth,
                &ConvexPeer::penetration, {});
    }

    static constexpr std::size_t kSteps = 250;
    const ConvexSuiteOptions& options_;
    scenes::Random random_;
    Report report_;
};

/// Measures pairs of convex bodies against FCL and Bullet.
///
/// Errors      as read_mesh.
Report run_convex_suite(const ConvexSuiteOptions& options) {
    return ConvexSuite(options).run();
}

const Suite kConvexSuite("convex", "Pairs of convex bodies, against FCL and Bullet",
                         [](CLI::App& suite) -> RunSuite {
                             const auto options = std::make_shared<ConvexSuiteOptions>();
                             suite.add_option("files", options->files,
                                              "Model files whose hulls are taken too");
                             suite.add_option("--vertices", options->vertices, "Of the ellipsoids");
                             suite.add_option("--poses", options->poses, "In each case");
                             suite.add_flag("--alone", options->alone, "Without peers");
                             add_only(suite, options->only);
                             add_rounds(suite, options->rounds);
                             suite.add_option("--seed", options->seed, "Of bodies and poses");
                             return [options] { return run_convex_suite(*options); };
                         });

} // namespace

} // namespace abut::bench
