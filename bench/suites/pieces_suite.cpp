#include <abut/convex_pieces.h>
#include <abut/error.h>
#include <abut/model.h>
#include <abut/penetration.h>
#include <abut/progress.h>
#include <abut/rigid.h>
#include <abut/scene.h>

#include "measure.h"
#include "peers/peer_rigid.h"
#include "placement.h"
#include "scenes/bodies.h"
#include "suite.h"
#include "suites/machine_parts.h"

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

struct PiecesSuiteOptions {
    std::vector<std::string> files; ///< two for each pair; closed
    std::size_t poses = 500;        ///< in each regime
    std::string part;               ///< runs only the machine parts whose name contains this
    std::string only;               ///< runs only the cases whose name contains this
    std::uint32_t curved = 0;       ///< if not 0: only builds of generated bodies with this many
                                    ///< triangles are measured
    int rounds = 5;
    std::uint64_t seed = 1;
};

enum class Ask : std::uint8_t { distance, within, first_contact, penetration };

struct PiecesCase {
    const char* name = "";
    Ask ask = Ask::distance;
    Regime regime = Regime::separated;
    bool small_steps = false;
    [[nodiscard]] bool coherent() const { return small_steps || regime == Regime::path; }
};
constexpr std::array kPiecesCases{
    PiecesCase{"distance, separated", Ask::distance, Regime::separated},
    PiecesCase{"distance, graze out", Ask::distance, Regime::graze_out},
    PiecesCase{"distance, graze in", Ask::distance, Regime::graze_in},
    PiecesCase{"distance, deep", Ask::distance, Regime::deep},
    PiecesCase{"distance, coherent path", Ask::distance, Regime::path},
    PiecesCase{"distance, small steps", Ask::distance, Regime::separated, true},
    PiecesCase{"within 0.1, separated", Ask::within, Regime::separated},
    PiecesCase{"first contact, graze in", Ask::first_contact, Regime::graze_in},
    PiecesCase{"first contact, graze out", Ask::first_contact, Regime::graze_out},
    PiecesCase{"penetration, graze in", Ask::penetration, Regime::graze_in},
    PiecesCase{"penetration, deep", Ask::penetration, Regime::deep},
};
constexpr double kTolerance = 0.1;

/// Paths as in a simulation: 50 steps of 0.1 degrees and 0.0005. They start at the separated poses,
/// where b is 0.05 to 0.5 farther away than at its first touch.
std::vector<PosedPair> small_steps(const RigidScene& scene, std::size_t count,
                                   scenes::Random& random) {
    std::vector<PosedPair> poses;
    const auto& starts = scene.of(Regime::separated);
    for (std::size_t k = 0; poses.size() < count; ++k) {
        const PosedPair& start = starts[k % starts.size()];
        const Vec3 axis = random_direction(random), step = random_direction(random);
        Pose moved;
        for (std::size_t i = 0; i < kPathSteps && poses.size() < count; ++i) {
            // The pose of b, followed by the step's motion.
            const Transform by = moved;
            Transform b;
            for (std::size_t c = 0; c < 4; ++c)
                for (std::size_t r = 0; r < 3; ++r) {
                    double sum = c == 3 ? by.m[9 + r] : 0;
                    for (std::size_t j = 0; j < 3; ++j)
                        sum += by.m[3 * j + r] * start.b.m[3 * c + j];
                    b.m[3 * c + r] = sum;
                }
            poses.push_back({start.a, b});
            moved.rotation = turned(moved.rotation, axis, 0.1);
            moved.translation = {moved.translation.x + 0.0005 * step.x,
                                 moved.translation.y + 0.0005 * step.y,
                                 moved.translation.z + 0.0005 * step.z};
        }
    }
    return poses;
}

void add_build_row(const std::string& name, const Mesh& mesh, int rounds, Report& report) {
    set_threads(1);
    const Model model(mesh);
    std::vector<double> ours, theirs;
    std::size_t pieces = 0, bytes = 0;
    for (int round = 0; round < rounds; ++round) {
        double start = thread_seconds();
        const ConvexPieces solid(model);
        ours.push_back(1e3 * (thread_seconds() - start));
        pieces = solid.size(), bytes = solid.bytes();
        start = thread_seconds();
        const Model tree(mesh);
        theirs.push_back(1e3 * (thread_seconds() - start));
    }
    set_threads(0);
    const auto triangles = static_cast<double>(mesh.triangles.size());
    report.rows.push_back(
        {name,
         median(ours),
         "triangle tree",
         median(theirs),
         "ms",
         1,
         {{"triangles", triangles},
          {"pieces", static_cast<double>(pieces)},
          {"bytes a triangle", static_cast<double>(bytes) / triangles},
          {"the tree's bytes a triangle", static_cast<double>(model.bytes()) / triangles}}});
}

/// A sphere with one shallow dent. Nearly all of its surface is one convex patch.
Mesh dented_sphere(std::uint32_t triangles) {
    Mesh mesh = scenes::sphere(triangles);
    for (Vec3& p : mesh.positions)
        if (const double off = std::hypot(p.x - 1, p.y, p.z); off < 0.2)
            p.x -= 0.05 * (0.2 - off);
    return mesh;
}

class PiecesSuite {
public:
    PiecesSuite(const PiecesSuiteOptions& options, const RigidScene& scene, Report& report)
        : options_(options), scene_(scene), report_(report), random_(options.seed),
          model_a_(scene.a), model_b_(scene.b), a_(model_a_), b_(model_b_),
          peers_(make_fcl_peers(scene.a, scene.b)),
          steps_(small_steps(scene, options.poses, random_)) {}

    void run() {
        add_build_row(scene_.name + ", build of the first", scene_.a, options_.rounds, report_);
        for (const PiecesCase& c : kPiecesCases)
            if (std::string_view(c.name).find(options_.only) != std::string_view::npos)
                run(c);
    }

private:
    using Query = std::function<double(const PosedPair&)>;

    void run(const PiecesCase& c) {
        PiecesWarmStart warm_start;
        WarmStart tree_warm_start;
        const auto start_path = [&] { warm_start = {}, tree_warm_start = {}; };
        PiecesWarmStart* const w = c.coherent() ? &warm_start : nullptr;
        WarmStart* const tw = c.coherent() ? &tree_warm_start : nullptr;
        double hull_pairs = 0;
        const Query ours = [&](const PosedPair& p) {
            if (c.ask == Ask::within)
                return within(a_, p.a, b_, p.b, kTolerance, {.warm_start = w}) ? 1.0 : 0.0;
            if (c.ask == Ask::first_contact)
                return collide(a_, p.a, b_, p.b, {.warm_start = w}).meet ? 1.0 : 0.0;
            if (c.ask == Ask::penetration)
                return penetration(a_, p.a, b_, p.b, {.separation = false}).depth;
            const PiecesGap gap = distance(a_, p.a, b_, p.b, {.warm_start = w});
            hull_pairs += static_cast<double>(gap.counters.hull_pairs);
            return gap.distance;
        };
        const Query trees = [&](const PosedPair& p) {
            if (c.ask == Ask::within)
                return within(model_a_, p.a, model_b_, p.b, kTolerance, {.warm_start = tw}) ? 1.0
                                                                                            : 0.0;
            if (c.ask == Ask::first_contact)
                return collide(model_a_, p.a, model_b_, p.b, {.warm_start = tw}).meet() ? 1.0 : 0.0;
            if (c.ask == Ask::penetration)
                return penetration(model_a_, p.a, model_b_, p.b, {.separation = false}).depth;
            return distance(model_a_, p.a, model_b_, p.b, {.warm_start = tw}).distance;
        };
        compare(c, "triangle tree", start_path, ours, trees, hull_pairs);
        if (RigidPeer* const fcl = c.ask == Ask::penetration ? nullptr : best_fcl(c))
            compare(
                c, fcl->name(), start_path, ours,
                [&](const PosedPair& p) {
                    fcl->place(p);
                    return fcl->run(query_of(c.ask), p, kTolerance);
                },
                hull_pairs);
    }

    static RigidQuery query_of(Ask ask) {
        return ask == Ask::within          ? RigidQuery::within
               : ask == Ask::first_contact ? RigidQuery::first_contact
                                           : RigidQuery::distance;
    }

    [[nodiscard]] const std::vector<PosedPair>& poses_of(const PiecesCase& c) const {
        return c.small_steps ? steps_ : scene_.of(c.regime);
    }

    RigidPeer* best_fcl(const PiecesCase& c) {
        RigidPeer* best = nullptr;
        double least = 0;
        const auto& poses = poses_of(c);
        for (const auto& peer : peers_) {
            if (!peer->answers(query_of(c.ask)))
                continue;
            const double start = thread_seconds();
            for (std::size_t i = 0; i < poses.size(); i += 10) {
                peer->place(poses[i]);
                peer->run(query_of(c.ask), poses[i], kTolerance);
            }
            if (const double s = thread_seconds() - start; best == nullptr || s < least)
                best = peer.get(), least = s;
        }
        return best;
    }

    void compare(const PiecesCase& c, const std::string& peer,
                 const std::function<void()>& start_path, const Query& ours, const Query& theirs,
                 double& hull_pairs) {
        const auto& poses = poses_of(c);
        std::vector<double> our_answers(poses.size()), their_answers(poses.size());
        const auto work = [&](const Query& query, std::vector<double>& answers) {
            return [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                    if (i % kPathSteps == 0)
                        start_path();
                    answers[i] = query(poses[i]);
                }
            };
        };
        hull_pairs = 0;
        const Turns turns = take_turns(poses.size(), 5 * kPathSteps, options_.rounds,
                                       work(ours, our_answers), work(theirs, their_answers));
        const auto count = static_cast<double>(poses.size());
        Row row{scene_.name + ", " + c.name,
                1e6 * turns.ours / count,
                peer,
                1e6 * turns.theirs / count,
                "us",
                1,
                {}};
        if (c.ask == Ask::distance)
            row.counters["hull pairs"] = hull_pairs / count / options_.rounds;
        if (c.ask == Ask::penetration) { // two lower bounds of the depth
            const double sum = std::accumulate(our_answers.begin(), our_answers.end(), 0.0);
            row.counters["depth, of theirs"] =
                sum / std::accumulate(their_answers.begin(), their_answers.end(), 0.0);
            report_.rows.push_back(row);
            return;
        }
        double differ = 0;
        for (std::size_t i = 0; i < poses.size(); ++i)
            differ += std::abs(our_answers[i] - their_answers[i]) > 1e-9 ? 1 : 0;
        row.counters["answers that differ"] = differ;
        report_.rows.push_back(row);
    }

    const PiecesSuiteOptions& options_;
    const RigidScene& scene_;
    Report& report_;
    scenes::Random random_;
    Model model_a_, model_b_;
    ConvexPieces a_, b_;
    std::vector<std::unique_ptr<RigidPeer>> peers_;
    std::vector<PosedPair> steps_;
};

/// Measures solids as unions of convex pieces against the triangle trees and FCL: machine parts,
/// each with itself, and pairs of files.
///
/// Errors      as read_mesh and ConvexPieces; Error{bad_argument} for an odd number of files.
Report run_pieces_suite(const PiecesSuiteOptions& options) {
    if (options.files.size() % 2 != 0)
        throw Error(ErrorCode::bad_argument, "an odd number of files: they come in pairs");
    Report report;
    report.suite = "pieces";
    const auto run = [&](const std::string& name, Mesh a, Mesh b) {
        const RigidScene scene =
            make_rigid_scene(name, std::move(a), std::move(b), options.poses, options.seed);
        PiecesSuite(options, scene, report).run();
    };
    const auto stem = [](const std::string& file) {
        return std::filesystem::path(file).stem().string();
    };
    if (options.curved > 0) {
        const auto add = [&](const char* name, const Mesh& mesh) {
            add_build_row(std::string(name) + ", build", mesh, options.rounds, report);
        };
        add("knot", scenes::knot(options.curved));
        add("boulder", scenes::boulder(options.curved));
        add("dented sphere", dented_sphere(options.curved));
        return report;
    }
    for (const NamedMesh& part : machine_parts())
        if (part.name.find(options.part) != std::string::npos)
            run(part.name, part.mesh, part.mesh);
    for (std::size_t i = 0; i + 1 < options.files.size(); i += 2)
        run(stem(options.files[i]) + " / " + stem(options.files[i + 1]),
            read_mesh(options.files[i]), read_mesh(options.files[i + 1]));
    return report;
}

const Suite kPiecesSuite("pieces", "Solids of convex pieces, against the triangle trees and FCL",
                         [](CLI::App& suite) -> RunSuite {
                             const auto options = std::make_shared<PiecesSuiteOptions>();
                             suite.add_option("files", options->files, "Closed models, two a pair");
                             suite.add_option("--poses", options->poses, "In each regime");
                             suite.add_option(
                                 "--curved", options->curved,
                                 "Instead: builds of curved bodies of so many triangles");
                             suite.add_option("--part", options->part,
                                              "Machine parts whose name has this in it");
                             add_only(suite, options->only);
                             add_rounds(suite, options->rounds);
                             suite.add_option("--seed", options->seed, "Of the poses");
                             return [options] { return run_pieces_suite(*options); };
                         });

} // namespace

} // namespace abut::bench
